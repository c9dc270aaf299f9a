/* Checks of the C programs: each says what failed, in which line; the program ends with their number. */
#ifndef API_CHECK_H
#define API_CHECK_H

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "reedvalve.h"

static int api_failed = 0, api_passed = 0;

#define CHECK(condition)                                        \
  do {                                                          \
    if (condition) {                                            \
      api_passed++;                                             \
    } else {                                                    \
      api_failed++;                                             \
      printf("%s:%d: WRONG %s\n", __FILE__, __LINE__, #condition); \
    }                                                           \
  } while (0)

/* The call succeeds, or its message is shown. */
#define GOOD(valve, call)                                                        \
  do {                                                                           \
    if ((call) == RV_OK) {                                                       \
      api_passed++;                                                              \
    } else {                                                                     \
      char text_[1000];                                                          \
      rv_valve_message(valve, text_, sizeof text_);                              \
      api_failed++;                                                              \
      printf("%s:%d: WRONG %s: %s\n", __FILE__, __LINE__, #call, text_);          \
    }                                                                            \
  } while (0)

/* The call returns this code, and its message holds this part. */
#define FAILS(valve, call, code, part)                                                              \
  do {                                                                                              \
    char text_[1000];                                                                               \
    const int code_ = (call);                                                                       \
    rv_valve_message(valve, text_, sizeof text_);                                                   \
    if (code_ == (code) && strstr(text_, part) != NULL) {                                           \
      api_passed++;                                                                                 \
    } else {                                                                                        \
      api_failed++;                                                                                 \
      printf("%s:%d: WRONG %s: code %d, message '%s'\n", __FILE__, __LINE__, #call, code_, text_);   \
    }                                                                                               \
  } while (0)

static int api_finish(void) {
  printf("%d passed, %d failed\n", api_passed, api_failed);
  return api_failed > 0 || api_passed == 0;
}

#endif
