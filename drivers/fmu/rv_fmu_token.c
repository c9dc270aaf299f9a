/* What tells whether a model description and a library's settings belong together. */
#include "rv_fmu.h"

#include <inttypes.h>
#include <stdio.h>

/* FNV-1a, http://www.isthe.com/chongo/tech/comp/fnv/ */
uint64_t rv_fmu_hash(const void *data, size_t size) {
  const unsigned char *byte = data;
  uint64_t hash = 0xcbf29ce484222325u;
  for (size_t i = 0; i < size; i++) hash = (hash ^ byte[i]) * 0x100000001b3u;
  return hash;
}

void rv_fmu_token(const void *deck, size_t size, char token[RV_FMU_TOKEN]) {
  snprintf(token, RV_FMU_TOKEN, "{reedvalve " RV_FMU_VERSION " %016" PRIx64 "}", rv_fmu_hash(deck, size));
}
