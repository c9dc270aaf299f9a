/* Random calls in random order, in two threads with instances of their own, with good and bad arguments: each
 * is answered, and each refusal has a message. */
#include "rv_fmu.h"

#include <dlfcn.h>
#include <fmi3FunctionTypes.h>
#include <math.h>
#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define CALL(name) ((name##TYPE *)look_up(#name))
enum { most = 4 };

static void *library;
static long calls = 1000; /* of a thread */
static _Thread_local int messages;
static _Thread_local unsigned seed;
static char token[RV_FMU_TOKEN];

typedef void any_function(void);

static any_function *look_up(const char *name) {
  void *found = dlsym(library, name);
  any_function *function;
  if (found == NULL) {
    printf("%s is missing\n", name);
    exit(1);
  }
  memcpy(&function, &found, sizeof function); /* POSIX lets a cast do it, C does not */
  return function;
}

static void hear(fmi3InstanceEnvironment environment, fmi3Status status, fmi3String category, fmi3String message) {
  (void)environment;
  messages++;
  if (message[0] == '\0' || category[0] == '\0' || status == fmi3OK) {
    printf("a message says nothing\n");
    exit(1);
  }
}

static int below(int n) {
  seed = seed * 1103515245u + 12345u;
  return (int)(seed >> 16) % n;
}

static double number(void) {
  static const double odd[] = {NAN, INFINITY, -1, 0, 1e300, 1e-300, 0.05, 2e4, 5e-5, 4, 0.3, 1000};
  return odd[below(12)];
}

static fmi3ValueReference reference(void) {
  return (fmi3ValueReference)(below(8) == 0 ? below(1000) : below(2) == 0 ? below(20) : 100 + below(40));
}

typedef struct {
  fmi3Instance pointer;
  double time;
  fmi3FMUState state;
} subject;

static void open_one(subject *self) {
  CALL(fmi3FreeInstance)(self->pointer); /* NULL is fine */
  memset(self, 0, sizeof *self);
  self->pointer = CALL(fmi3InstantiateCoSimulation)("one", below(9) == 0 ? "other" : token, "./", false, true, below(9) == 0,
                                                    false, NULL, 0, NULL, hear, NULL);
}

/* What leads on after an error, always. */
static void start_again(subject *self) {
  if (CALL(fmi3Reset)(self->pointer) != fmi3OK ||
      CALL(fmi3EnterInitializationMode)(self->pointer, false, 0, 0, false, 0) != fmi3OK ||
      CALL(fmi3ExitInitializationMode)(self->pointer) != fmi3OK) {
    printf("no new start after an error\n");
    exit(1);
  }
}

/* Through bytes and back; a byte may get damaged on the way. */
static fmi3Status serialize(subject *self) {
  size_t size = 0;
  fmi3Byte *bytes;
  fmi3FMUState copy = NULL;
  fmi3Status status = CALL(fmi3SerializedFMUStateSize)(self->pointer, self->state, &size);
  if (status != fmi3OK) return status;
  bytes = malloc(size);
  status = CALL(fmi3SerializeFMUState)(self->pointer, self->state, bytes, size);
  if (below(3) == 0) bytes[below((int)size)] ^= 4;
  if (status == fmi3OK) status = CALL(fmi3DeserializeFMUState)(self->pointer, bytes, size - (below(5) == 0), &copy);
  if (status == fmi3OK) status = CALL(fmi3SetFMUState)(self->pointer, copy);
  free(bytes);
  return status;
}

static fmi3Status step(subject *self) {
  fmi3Boolean event, end, early;
  double time = self->time, length = below(10) == 0 ? number() : 5e-5;
  fmi3Status status = CALL(fmi3GetFloat64)(self->pointer, (fmi3ValueReference[]){0}, 1, &time, 1);
  if (status != fmi3OK) return status;
  if (below(20) == 0) time = number();
  return CALL(fmi3DoStep)(self->pointer, time, length, true, &event, &end, &early, &self->time);
}

static fmi3Status call(subject *self) {
  const fmi3ValueReference r = reference();
  const double x = number();
  const fmi3Int32 i = below(5) - 1;
  const fmi3Int64 j = below(6) - 1;
  double y;
  fmi3Int32 m;
  fmi3Int64 n;
  switch (below(18)) {
  case 0: return CALL(fmi3SetFloat64)(self->pointer, &r, 1, &x, 1);
  case 1: return CALL(fmi3SetInt32)(self->pointer, &r, 1, &i, 1);
  case 2: return CALL(fmi3SetInt64)(self->pointer, &r, 1, &j, 1);
  case 3: return CALL(fmi3GetFloat64)(self->pointer, &r, 1, &y, 1 + (below(20) == 0));
  case 4: return CALL(fmi3GetInt32)(self->pointer, &r, 1, &m, 1);
  case 5: return CALL(fmi3GetInt64)(self->pointer, &r, 1, &n, 1);
  case 6: return CALL(fmi3EnterInitializationMode)(self->pointer, below(5) == 0, x, below(5) == 0 ? x : 0, below(5) == 0, 1);
  case 7: return CALL(fmi3ExitInitializationMode)(self->pointer);
  case 8: return CALL(fmi3Reset)(self->pointer);
  case 9: return CALL(fmi3GetFMUState)(self->pointer, &self->state);
  case 10: return CALL(fmi3SetFMUState)(self->pointer, self->state);
  case 11: return serialize(self);
  case 12: return below(4) == 0 ? CALL(fmi3FreeFMUState)(self->pointer, &self->state) : step(self);
  case 13: return below(9) == 0 ? CALL(fmi3Terminate)(self->pointer) : step(self);
  case 14: return below(9) == 0 ? CALL(fmi3EnterEventMode)(self->pointer) : step(self);
  case 15: return below(4) == 0 ? CALL(fmi3SetFloat64)(self->pointer, NULL, 1, &x, 1) : step(self);
  default: return step(self);
  }
}

/* One call of one of the subjects. */
static fmi3Status call_one(subject *self) {
  const int before = messages;
  fmi3Status status;
  if (below(60) == 0 || self->pointer == NULL) {
    open_one(self);
    return fmi3Warning;
  }
  if (below(200) == 0) {
    CALL(fmi3FreeInstance)(self->pointer);
    memset(self, 0, sizeof *self);
    return fmi3Warning;
  }
  status = call(self);
  if ((status != fmi3OK && status != fmi3Warning && status != fmi3Error) || (status == fmi3Error && messages == before)) {
    printf("status %d with %d messages\n", status, messages - before);
    exit(1);
  }
  if (status == fmi3Error && below(3) > 0) start_again(self);
  return status;
}

/* A thread of calls; NULL if too few went well, or were refused. */
static void *run(void *data) {
  subject all[most] = {{NULL, 0, NULL}};
  long good = 0, refused = 0;
  seed = *(unsigned *)data;
  for (long k = 0; k < calls; k++) {
    fmi3Status status = call_one(&all[below(most)]);
    good += status == fmi3OK;
    refused += status == fmi3Error;
  }
  for (int i = 0; i < most; i++) CALL(fmi3FreeInstance)(all[i].pointer);
  printf("%ld calls went well, %ld were refused\n", good, refused);
  return good > calls / 5 && refused > calls / 10 ? data : NULL;
}

int main(int count, char **word) {
  static const char deck[] = "&run model = 'squeeze' /\n";
  unsigned seeds[2] = {1, 2};
  pthread_t thread[2];
  bool is_good = true;
  FILE *file = fopen("valve.nml", "w");
  if (count < 2 || file == NULL || fputs(deck, file) < 0 || fclose(file) != 0) return 1;
  if (count > 2) calls = atol(word[2]);
  rv_fmu_token(deck, strlen(deck), token);
  library = dlopen(word[1], RTLD_NOW);
  if (library == NULL) {
    printf("%s\n", dlerror());
    return 1;
  }
  for (int i = 0; i < 2; i++) is_good = pthread_create(&thread[i], NULL, run, &seeds[i]) == 0 && is_good;
  for (int i = 0; i < 2 && is_good; i++) {
    void *result;
    pthread_join(thread[i], &result);
    is_good = result != NULL;
  }
  return is_good ? 0 : 1;
}
