/* Random calls in random order, in two threads with instances of their own, of FMI 2.0 and 3.0, with good and bad
 * arguments: each is answered, and each refusal has a message. */
#include "rv_fmu.h"

#include <dlfcn.h>
#include <fmi2FunctionTypes.h>
#include <fmi3FunctionTypes.h>
#include <math.h>
#include <pthread.h>
#include <stdarg.h>
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

/* A message of FMI 2.0 is a format. */
static void hear_2(fmi2ComponentEnvironment environment, fmi2String name, fmi2Status status, fmi2String category,
                   fmi2String format, ...) {
  char message[10000];
  va_list list;
  va_start(list, format);
  vsnprintf(message, sizeof message, format, list);
  va_end(list);
  hear(environment, (fmi3Status)status, category, strcmp(name, "one") == 0 ? message : "");
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
  bool is_2; /* FMI 2.0 */
  void *pointer;
  double time;
  void *state;
} subject;

/* ---- FMI 3.0 ---- */

static void open_3(subject *self) {
  self->pointer = CALL(fmi3InstantiateCoSimulation)("one", below(9) == 0 ? "other" : token, "./", false, true, below(9) == 0,
                                                    false, NULL, 0, NULL, hear, NULL);
}

static bool start_3(subject *self) {
  return CALL(fmi3Reset)(self->pointer) == fmi3OK &&
         CALL(fmi3EnterInitializationMode)(self->pointer, false, 0, 0, false, 0) == fmi3OK &&
         CALL(fmi3ExitInitializationMode)(self->pointer) == fmi3OK;
}

/* Through bytes and back; a byte may get damaged on the way. */
static fmi3Status serialize_3(subject *self) {
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

static fmi3Status step_3(subject *self) {
  fmi3Boolean event, end, early;
  double time = self->time, length = below(10) == 0 ? number() : 5e-5;
  fmi3Status status = CALL(fmi3GetFloat64)(self->pointer, (fmi3ValueReference[]){0}, 1, &time, 1);
  if (status != fmi3OK) return status;
  if (below(20) == 0) time = number();
  return CALL(fmi3DoStep)(self->pointer, time, length, true, &event, &end, &early, &self->time);
}

static fmi3Status call_3(subject *self) {
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
  case 11: return serialize_3(self);
  case 12: return below(4) == 0 ? CALL(fmi3FreeFMUState)(self->pointer, &self->state) : step_3(self);
  case 13: return below(9) == 0 ? CALL(fmi3Terminate)(self->pointer) : step_3(self);
  case 14: return below(9) == 0 ? CALL(fmi3EnterEventMode)(self->pointer) : step_3(self);
  case 15: return below(4) == 0 ? CALL(fmi3SetFloat64)(self->pointer, NULL, 1, &x, 1) : step_3(self);
  default: return step_3(self);
  }
}

/* ---- FMI 2.0 ---- */

static void open_2(subject *self) {
  const fmi2CallbackFunctions functions = {hear_2, NULL, NULL, NULL, NULL}; /* which is gone soon: only what it says counts */
  self->pointer = CALL(fmi2Instantiate)("one", below(9) == 0 ? fmi2ModelExchange : fmi2CoSimulation,
                                        below(9) == 0 ? "other" : token,
                                        below(9) == 0 ? "file:///no%20where" : "file:///proc/self/cwd", &functions, false,
                                        true);
}

static bool start_2(subject *self) {
  return CALL(fmi2Reset)(self->pointer) == fmi2OK &&
         CALL(fmi2SetupExperiment)(self->pointer, false, 0, 0, false, 0) == fmi2OK &&
         CALL(fmi2EnterInitializationMode)(self->pointer) == fmi2OK &&
         CALL(fmi2ExitInitializationMode)(self->pointer) == fmi2OK;
}

static fmi2Status serialize_2(subject *self) {
  size_t size = 0;
  fmi2Byte *bytes;
  fmi2FMUstate copy = NULL;
  fmi2Status status = CALL(fmi2SerializedFMUstateSize)(self->pointer, self->state, &size);
  if (status != fmi2OK) return status;
  bytes = malloc(size);
  status = CALL(fmi2SerializeFMUstate)(self->pointer, self->state, bytes, size);
  if (status == fmi2OK) status = CALL(fmi2DeSerializeFMUstate)(self->pointer, bytes, size - (below(5) == 0), &copy);
  if (status == fmi2OK) status = CALL(fmi2SetFMUstate)(self->pointer, copy);
  free(bytes);
  return status;
}

static fmi2Status step_2(subject *self) {
  double time, length = below(10) == 0 ? number() : 5e-5;
  fmi2Status status = CALL(fmi2GetRealStatus)(self->pointer, fmi2LastSuccessfulTime, &time);
  if (status != fmi2OK) return status;
  if (below(20) == 0) time = number();
  return CALL(fmi2DoStep)(self->pointer, time, length, true);
}

static fmi2Status call_2(subject *self) {
  const fmi2ValueReference r = reference();
  const double x = number();
  const int i = below(6) - 1;
  double y;
  int m;
  switch (below(18)) {
  case 0: return CALL(fmi2SetReal)(self->pointer, &r, 1, &x);
  case 1: return CALL(fmi2SetInteger)(self->pointer, &r, 1, &i);
  case 2: return CALL(fmi2GetReal)(self->pointer, &r, 1, &y);
  case 3: return CALL(fmi2GetInteger)(self->pointer, below(9) == 0 ? NULL : &r, 1, &m);
  case 4: return CALL(fmi2SetRealInputDerivatives)(self->pointer, &r, 1, below(9) == 0 ? NULL : &i, &x);
  case 5: return CALL(fmi2SetupExperiment)(self->pointer, below(5) == 0, x, below(5) == 0 ? x : 0, below(5) == 0, 1);
  case 6: return CALL(fmi2EnterInitializationMode)(self->pointer);
  case 7: return CALL(fmi2ExitInitializationMode)(self->pointer);
  case 8: return CALL(fmi2Reset)(self->pointer);
  case 9: return CALL(fmi2GetFMUstate)(self->pointer, &self->state);
  case 10: return CALL(fmi2SetFMUstate)(self->pointer, self->state);
  case 11: return serialize_2(self);
  case 12: return below(4) == 0 ? CALL(fmi2FreeFMUstate)(self->pointer, &self->state) : step_2(self);
  case 13: return below(9) == 0 ? CALL(fmi2Terminate)(self->pointer) : step_2(self);
  case 14: return below(9) == 0 ? CALL(fmi2CancelStep)(self->pointer) : step_2(self);
  case 15: return below(9) == 0 ? CALL(fmi2GetBoolean)(self->pointer, &r, 1, &m) : step_2(self);
  case 16: return below(4) == 0 ? CALL(fmi2GetBooleanStatus)(self->pointer, (fmi2StatusKind)i, &m) : step_2(self);
  default: return step_2(self);
  }
}

/* ---- Either ---- */

static void close_one(subject *self) {
  if (self->is_2)
    CALL(fmi2FreeInstance)(self->pointer); /* NULL is fine */
  else
    CALL(fmi3FreeInstance)(self->pointer);
  *self = (subject){.is_2 = self->is_2};
}

/* What leads on after an error, always. */
static void start_again(subject *self) {
  if (self->is_2 ? start_2(self) : start_3(self)) return;
  printf("no new start after an error\n");
  exit(1);
}

/* One call of one of the subjects. */
static fmi3Status call_one(subject *self) {
  const int before = messages;
  fmi3Status status;
  if (below(60) == 0 || self->pointer == NULL) {
    close_one(self);
    if (self->is_2)
      open_2(self);
    else
      open_3(self);
    return fmi3Warning;
  }
  if (below(200) == 0) {
    close_one(self);
    return fmi3Warning;
  }
  status = self->is_2 ? (fmi3Status)call_2(self) : call_3(self);
  if (status > fmi3Error || (status >= fmi3Discard && messages == before)) {
    printf("status %d with %d messages\n", status, messages - before);
    exit(1);
  }
  if (status == fmi3Error && below(3) > 0) start_again(self);
  return status;
}

/* A thread of calls; NULL if too few went well, or were refused. */
static void *run(void *data) {
  subject all[most] = {{.is_2 = true}, {.is_2 = true}};
  long good = 0, refused = 0;
  seed = *(unsigned *)data;
  for (long k = 0; k < calls; k++) {
    fmi3Status status = call_one(&all[below(most)]);
    good += status == fmi3OK;
    refused += status == fmi3Error;
  }
  for (int i = 0; i < most; i++) close_one(&all[i]);
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
