/* FMI 2.0 co-simulation by means of 3.0: statuses have the same numbers, variables the same references. */
#define _GNU_SOURCE /* strncasecmp */
#include "rv_fmu.h"

#include <ctype.h>
#include <fmi2Functions.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

#define SELF rv_fmu_called_as(component, __func__)

instance *rv_fmu_called_as(fmi2Component component, const char *function) {
  instance *self = rv_fmu_enter(component, function, anywhere);
  if (self != NULL) self->called = function;
  return self;
}

const char *fmi2GetTypesPlatform(void) {
  return fmi2TypesPlatform;
}

const char *fmi2GetVersion(void) {
  return fmi2Version;
}

/* ---- Beginning and end ---- */

/* Replace each %20 and its like by the character. False: some % has not two digits behind it, or stands for NUL. */
static bool decode(char *text) {
  char *to = text;
  for (const char *from = text; *from != '\0'; from++) {
    *to = *from;
    if (*from == '%') {
      char digits[3] = {from[1], '\0', '\0'};
      if (from[1] != '\0') digits[1] = from[2];
      if (!isxdigit((unsigned char)digits[0]) || !isxdigit((unsigned char)digits[1])) return false;
      *to = (char)strtol(digits, NULL, 16);
      if (*to == '\0') return false;
      from += 2;
    }
    to++;
  }
  *to = '\0';
  return true;
}

/* The path in a URI of a file of this machine: RFC 8089. NULL: it is no such URI. */
static char *path_of(const char *uri) {
  static const char *const start[] = {"file:///", "file://localhost/", "file:/"};
  char *path;
  size_t n = 0;
  for (int i = 0; i < 3 && n == 0 && uri != NULL; i++)
    if (strncasecmp(uri, start[i], strlen(start[i])) == 0) n = strlen(start[i]);
  if (n == 0 || (n == strlen("file:/") && uri[n] == '/')) return NULL; /* that is another machine */
  path = strdup(uri + n - 1);
  if (path == NULL || decode(path)) return path;
  free(path);
  return NULL;
}

fmi2Component fmi2Instantiate(fmi2String name, fmi2Type type, fmi2String guid, fmi2String resources,
                              const fmi2CallbackFunctions *functions, fmi2Boolean visible, fmi2Boolean logging) {
  instance given = {.name = name == NULL ? (char *)"" : (char *)name, .called = __func__, .tells_warnings = logging};
  instance *self = NULL;
  char *path = path_of(resources);
  (void)visible;
  if (functions != NULL) {
    given.log2 = functions->logger;
    given.environment = functions->componentEnvironment;
  }
  if (type != fmi2CoSimulation)
    rv_fmu_fail(&given, __func__, "this FMU is for co-simulation only");
  else if (path == NULL)
    rv_fmu_fail(&given, __func__, "fmuResourceLocation must be a URI as file:///path, not '%s'",
                resources == NULL ? "NULL" : resources);
  else
    self = rv_fmu_new(&given, __func__, guid, path);
  free(path);
  return self;
}

void fmi2FreeInstance(fmi2Component component) {
  fmi3FreeInstance(component);
}

fmi2Status fmi2SetDebugLogging(fmi2Component component, fmi2Boolean on, size_t n, const fmi2String categories[]) {
  return (fmi2Status)fmi3SetDebugLogging(SELF, on, n, categories);
}

fmi2Status fmi2SetupExperiment(fmi2Component component, fmi2Boolean has_tolerance, fmi2Real tolerance, fmi2Real start,
                               fmi2Boolean has_stop, fmi2Real stop) {
  instance *self = rv_fmu_enter(SELF, __func__, instantiated);
  if (self == NULL) return fmi2Error;
  return (fmi2Status)rv_fmu_set_up(self, __func__, has_tolerance, tolerance, start, has_stop, stop);
}

fmi2Status fmi2EnterInitializationMode(fmi2Component component) {
  instance *self = rv_fmu_enter(SELF, __func__, instantiated);
  if (self == NULL) return fmi2Error;
  self->mode = initializing;
  return fmi2OK;
}

fmi2Status fmi2ExitInitializationMode(fmi2Component component) {
  return (fmi2Status)fmi3ExitInitializationMode(SELF);
}

fmi2Status fmi2Terminate(fmi2Component component) {
  return (fmi2Status)fmi3Terminate(SELF);
}

fmi2Status fmi2Reset(fmi2Component component) {
  return (fmi2Status)fmi3Reset(SELF);
}

/* ---- Variables ---- */

fmi2Status fmi2GetReal(fmi2Component component, const fmi2ValueReference reference[], size_t n, fmi2Real value[]) {
  return (fmi2Status)fmi3GetFloat64(SELF, reference, n, value, n);
}

fmi2Status fmi2SetReal(fmi2Component component, const fmi2ValueReference reference[], size_t n, const fmi2Real value[]) {
  return (fmi2Status)fmi3SetFloat64(SELF, reference, n, value, n);
}

/* Choices are Integer here, too. */
static bool is_choice(const instance *self, fmi2ValueReference reference) {
  parameter found;
  return rv_fmu_parameter(self, reference, &found) && found.kind == RV_CHOICE;
}

fmi2Status fmi2GetInteger(fmi2Component component, const fmi2ValueReference reference[], size_t n, fmi2Integer value[]) {
  instance *self = rv_fmu_enter_values(SELF, __func__, anywhere, reference, n, value, n);
  fmi3Status status = self == NULL ? fmi3Error : fmi3OK;
  for (size_t i = 0; i < n && status == fmi3OK; i++) {
    fmi3Int64 choice = 0;
    if (is_choice(self, reference[i])) {
      status = fmi3GetInt64(self, &reference[i], 1, &choice, 1);
      value[i] = (fmi2Integer)choice;
    } else {
      status = fmi3GetInt32(self, &reference[i], 1, &value[i], 1);
    }
  }
  return (fmi2Status)status;
}

fmi2Status fmi2SetInteger(fmi2Component component, const fmi2ValueReference reference[], size_t n,
                          const fmi2Integer value[]) {
  instance *self = rv_fmu_enter_values(SELF, __func__, before_end, reference, n, value, n);
  fmi3Status status = self == NULL ? fmi3Error : fmi3OK;
  for (size_t i = 0; i < n && status <= fmi3Warning; i++) {
    const fmi3Int64 choice = value[i];
    status = rv_fmu_worse(status, is_choice(self, reference[i]) ? fmi3SetInt64(self, &reference[i], 1, &choice, 1)
                                                                : fmi3SetInt32(self, &reference[i], 1, &value[i], 1));
  }
  return (fmi2Status)status;
}

/* The derivative of a pressure is the input of its slope: it stays until it is set again, by either name. */
static fmi3Status set_derivative(instance *self, const char *function, fmi2ValueReference reference, int order,
                                 double value) {
  const fmi3ValueReference slope = reference + n_pressures;
  if (reference - first_input >= n_inputs)
    return rv_fmu_fail(self, function, "only inputs have derivatives: valueReference %u", reference);
  if (order < 1) return rv_fmu_fail(self, function, "there is no derivative of order %d", order);
  if (order == 1 && reference - first_input < n_pressures) return fmi3SetFloat64(self, &slope, 1, &value, 1);
  if (value == 0) return fmi3OK;
  return rv_fmu_warn(self, fmi3Warning, function, "pressures are straight over a step: a higher derivative is not used");
}

fmi2Status fmi2SetRealInputDerivatives(fmi2Component component, const fmi2ValueReference reference[], size_t n,
                                       const fmi2Integer order[], const fmi2Real value[]) {
  instance *self = rv_fmu_enter_values(SELF, __func__, before_end, reference, n, order == NULL ? NULL : value, n);
  fmi3Status status = self == NULL ? fmi3Error : fmi3OK;
  for (size_t i = 0; i < n && status <= fmi3Warning; i++)
    status = rv_fmu_worse(status, set_derivative(self, __func__, reference[i], order[i], value[i]));
  return (fmi2Status)status;
}

/* ---- States ---- */

fmi2Status fmi2GetFMUstate(fmi2Component component, fmi2FMUstate *state) {
  return (fmi2Status)fmi3GetFMUState(SELF, state);
}

fmi2Status fmi2SetFMUstate(fmi2Component component, fmi2FMUstate state) {
  return (fmi2Status)fmi3SetFMUState(SELF, state);
}

fmi2Status fmi2FreeFMUstate(fmi2Component component, fmi2FMUstate *state) {
  return (fmi2Status)fmi3FreeFMUState(SELF, state);
}

fmi2Status fmi2SerializedFMUstateSize(fmi2Component component, fmi2FMUstate state, size_t *size) {
  return (fmi2Status)fmi3SerializedFMUStateSize(SELF, state, size);
}

fmi2Status fmi2SerializeFMUstate(fmi2Component component, fmi2FMUstate state, fmi2Byte bytes[], size_t size) {
  return (fmi2Status)fmi3SerializeFMUState(SELF, state, (fmi3Byte *)bytes, size);
}

fmi2Status fmi2DeSerializeFMUstate(fmi2Component component, const fmi2Byte bytes[], size_t size, fmi2FMUstate *state) {
  return (fmi2Status)fmi3DeserializeFMUState(SELF, (const fmi3Byte *)bytes, size, state);
}

/* ---- Steps ---- */

fmi2Status fmi2DoStep(fmi2Component component, fmi2Real point, fmi2Real length, fmi2Boolean no_way_back) {
  fmi3Boolean event, terminate, early;
  fmi3Float64 last;
  return (fmi2Status)fmi3DoStep(SELF, point, length, no_way_back, &event, &terminate, &early, &last);
}

/* What status there is of steps that are always done; FMI asks for fmi2Discard where it is none. */
static fmi2Status no_status(instance *self, const char *function) {
  if (self == NULL) return fmi2Error;
  return (fmi2Status)rv_fmu_warn(self, fmi3Discard, function, "there is no such status");
}

fmi2Status fmi2GetStatus(fmi2Component component, const fmi2StatusKind kind, fmi2Status *value) {
  (void)kind, (void)value;
  return no_status(SELF, __func__);
}

fmi2Status fmi2GetRealStatus(fmi2Component component, const fmi2StatusKind kind, fmi2Real *value) {
  instance *self = SELF;
  if (self == NULL || kind != fmi2LastSuccessfulTime) return no_status(self, __func__);
  return (fmi2Status)fmi3GetFloat64(self, &(fmi3ValueReference){0}, 1, value, 1);
}

fmi2Status fmi2GetIntegerStatus(fmi2Component component, const fmi2StatusKind kind, fmi2Integer *value) {
  (void)kind, (void)value;
  return no_status(SELF, __func__);
}

fmi2Status fmi2GetBooleanStatus(fmi2Component component, const fmi2StatusKind kind, fmi2Boolean *value) {
  instance *self = SELF;
  if (self == NULL || kind != fmi2Terminated) return no_status(self, __func__);
  if (value == NULL) return (fmi2Status)rv_fmu_fail(self, __func__, "a pointer is NULL");
  *value = fmi2False;
  return fmi2OK;
}

fmi2Status fmi2GetStringStatus(fmi2Component component, const fmi2StatusKind kind, fmi2String *value) {
  (void)kind, (void)value;
  return no_status(SELF, __func__);
}
