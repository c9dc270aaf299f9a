/* FMI 3.0 co-simulation: the life of an instance, and its steps. */
#include "rv_fmu.h"

#include <math.h>
#include <string.h>

const char *fmi3GetVersion(void) {
  return fmi3Version;
}

fmi3Status fmi3SetDebugLogging(fmi3Instance pointer, fmi3Boolean on, size_t n, const fmi3String categories[]) {
  instance *self = rv_fmu_enter(pointer, __func__, anywhere);
  bool wanted = n == 0;
  if (self == NULL) return fmi3Error;
  if (n > 0 && categories == NULL) return rv_fmu_fail(self, __func__, "categories is NULL");
  for (size_t i = 0; i < n; i++) {
    bool is_warning = categories[i] != NULL && strcmp(categories[i], "logStatusWarning") == 0;
    if (!is_warning && (categories[i] == NULL || strcmp(categories[i], "logStatusError") != 0))
      return rv_fmu_fail(self, __func__, "there is no log category '%s'", categories[i] == NULL ? "NULL" : categories[i]);
    wanted = wanted || is_warning;
  }
  self->tells_warnings = on && wanted;
  return fmi3OK;
}

fmi3Status rv_fmu_set_up(instance *self, const char *function, bool has_tolerance, double tolerance, double start,
                         bool has_stop, double stop) {
  if (!isfinite(start)) return rv_fmu_fail(self, function, "startTime is not a finite number");
  if (has_stop && !(stop > start)) return rv_fmu_fail(self, function, "stopTime %g s is not after startTime %g s", stop, start);
  if (has_tolerance && rv_valve_set_real(self->valve, "solver.rtol", tolerance) != RV_OK)
    return rv_fmu_fail_valve(self, function);
  self->start = start;
  self->time = start;
  self->stop = has_stop ? stop : INFINITY;
  return fmi3OK;
}

fmi3Status fmi3EnterInitializationMode(fmi3Instance pointer, fmi3Boolean has_tolerance, fmi3Float64 tolerance,
                                       fmi3Float64 start, fmi3Boolean has_stop, fmi3Float64 stop) {
  instance *self = rv_fmu_enter(pointer, __func__, instantiated);
  fmi3Status status;
  if (self == NULL) return fmi3Error;
  status = rv_fmu_set_up(self, __func__, has_tolerance, tolerance, start, has_stop, stop);
  if (status == fmi3OK) self->mode = initializing;
  return status;
}

fmi3Status fmi3ExitInitializationMode(fmi3Instance pointer) {
  instance *self = rv_fmu_enter(pointer, __func__, initializing);
  fmi3Status status;
  if (self == NULL) return fmi3Error;
  status = rv_fmu_begin(self, __func__);
  if (status <= fmi3Warning) self->mode = stepping;
  return status;
}

fmi3Status fmi3Terminate(fmi3Instance pointer) {
  instance *self = rv_fmu_enter(pointer, __func__, stepping);
  if (self == NULL) return fmi3Error;
  self->mode = terminated;
  return fmi3OK;
}

fmi3Status fmi3Reset(fmi3Instance pointer) {
  instance *self = rv_fmu_enter(pointer, __func__, anywhere);
  if (self == NULL || !rv_fmu_open_valve(self, __func__)) return fmi3Error;
  for (int i = 0; i < n_inputs; i++) self->input[i] = 0;
  self->start = 0;
  self->time = 0;
  self->stop = INFINITY;
  self->mode = instantiated;
  return fmi3OK;
}

/* What is wrong with a step; NULL: nothing. Importers add up times in their own way: a thousandth of the step is no gap. */
static const char *step_fault(const instance *self, double point, double length) {
  const double slack = 1e-3 * length;
  if (!isfinite(point) || !isfinite(length)) return "it must be finite numbers";
  if (!(length > 0)) return "the step must be longer than 0";
  if (point < self->time - slack) return "time must not go backwards";
  if (point > self->time + slack) return "time must not jump";
  if (point + length > self->stop + slack) return "the step goes beyond stopTime";
  return NULL;
}

fmi3Status fmi3DoStep(fmi3Instance pointer, fmi3Float64 point, fmi3Float64 length, fmi3Boolean no_way_back,
                      fmi3Boolean *event, fmi3Boolean *terminate, fmi3Boolean *early, fmi3Float64 *last) {
  instance *self = rv_fmu_enter(pointer, __func__, stepping);
  const char *fault;
  const double *p;
  double rise_in, rise_out;
  (void)no_way_back;
  if (self == NULL) return fmi3Error;
  if (event == NULL || terminate == NULL || early == NULL || last == NULL)
    return rv_fmu_fail(self, __func__, "a pointer is NULL");
  *event = *terminate = *early = false;
  *last = self->time;
  fault = step_fault(self, point, length);
  if (fault != NULL)
    return rv_fmu_fail(self, __func__, "currentCommunicationPoint %.17g s and communicationStepSize %g s after %.17g s: %s",
                       point, length, self->time, fault);
  p = self->input;
  rise_in = p[2] * length;
  rise_out = p[3] * length;
  if (rv_valve_step(self->valve, point + length, p[0], p[0] + rise_in, p[1], p[1] + rise_out) != RV_OK)
    return rv_fmu_fail_valve(self, __func__);
  self->time = point + length;
  *last = self->time;
  rv_fmu_read_outputs(self);
  return fmi3OK;
}
