/* FMI 3.0: variables. Real keys are Float64, whole ones Int32, choices Int64; there is nothing of another type. */
#include "rv_fmu.h"

#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

instance *rv_fmu_enter_values(fmi3Instance pointer, const char *function, int allowed, const fmi3ValueReference *reference,
                              size_t n, const void *value, size_t n_values) {
  instance *self = rv_fmu_enter(pointer, function, allowed);
  if (self == NULL) return NULL;
  if (n > 0 && (reference == NULL || value == NULL))
    rv_fmu_fail(self, function, "an array is NULL");
  else if (n != n_values)
    rv_fmu_fail(self, function, "%zu values for %zu variables", n_values, n);
  else
    return self;
  return NULL;
}

static fmi3Status none_to_get(instance *self, const char *function, fmi3ValueReference reference) {
  return rv_fmu_fail(self, function, "no variable of this type has valueReference %u", (unsigned)reference);
}

static fmi3Status none_to_set(instance *self, const char *function, fmi3ValueReference reference) {
  return rv_fmu_fail(self, function, "no variable of this type that can be set has valueReference %u",
                     (unsigned)reference);
}

/* ---- Getting ---- */

/* A real key. Without a value of its own is only the area the pressures act on: it is the hole's. */
static fmi3Status get_key(instance *self, const char *function, const char *name, double *value) {
  if (rv_valve_get_real(self->valve, name, value) != RV_OK) return rv_fmu_fail_valve(self, function);
  if (isnan(*value)) {
    rv_valve_get_real(self->valve, "reed.hole_diameter_mm", value);
    *value = 0.25 * acos(-1.0) * *value * *value;
  }
  return fmi3OK;
}

static fmi3Status get_real(instance *self, const char *function, fmi3ValueReference reference, double *value) {
  parameter found;
  if (reference == 0) {
    *value = self->time;
  } else if (reference - first_input < n_inputs) {
    *value = self->input[reference - first_input];
  } else if (rv_fmu_is_output(self->model, (int)(reference - first_output))) {
    if (self->mode == instantiated) return rv_fmu_fail(self, function, "outputs are known from initialization mode on");
    if (self->mode == initializing) {
      fmi3Status status = rv_fmu_begin(self, function);
      if (status > fmi3Warning) return status;
    }
    *value = self->output[reference - first_output];
  } else if (rv_fmu_parameter(self, reference, &found) && found.kind == RV_REAL) {
    return get_key(self, function, found.name, value);
  } else {
    return none_to_get(self, function, reference);
  }
  return fmi3OK;
}

fmi3Status fmi3GetFloat64(fmi3Instance pointer, const fmi3ValueReference reference[], size_t n, fmi3Float64 value[],
                          size_t n_values) {
  instance *self = rv_fmu_enter_values(pointer, __func__, anywhere, reference, n, value, n_values);
  fmi3Status status = self == NULL ? fmi3Error : fmi3OK;
  for (size_t i = 0; i < n && status <= fmi3Warning; i++) status = get_real(self, __func__, reference[i], &value[i]);
  return status;
}

/* The word of a key of a kind. */
static fmi3Status get_word(instance *self, const char *function, fmi3ValueReference reference, int kind, char *word,
                           parameter *found) {
  if (!rv_fmu_parameter(self, reference, found) || found->kind != kind) return none_to_get(self, function, reference);
  if (rv_valve_get_text(self->valve, found->name, word, longest_word) != RV_OK) return rv_fmu_fail_valve(self, function);
  return fmi3OK;
}

fmi3Status fmi3GetInt32(fmi3Instance pointer, const fmi3ValueReference reference[], size_t n, fmi3Int32 value[],
                        size_t n_values) {
  instance *self = rv_fmu_enter_values(pointer, __func__, anywhere, reference, n, value, n_values);
  fmi3Status status = self == NULL ? fmi3Error : fmi3OK;
  char word[longest_word];
  parameter found;
  for (size_t i = 0; i < n && status == fmi3OK; i++) {
    status = get_word(self, __func__, reference[i], RV_INTEGER, word, &found);
    if (status == fmi3OK) value[i] = (fmi3Int32)strtol(word, NULL, 10);
  }
  return status;
}

fmi3Status fmi3GetInt64(fmi3Instance pointer, const fmi3ValueReference reference[], size_t n, fmi3Int64 value[],
                        size_t n_values) {
  instance *self = rv_fmu_enter_values(pointer, __func__, anywhere, reference, n, value, n_values);
  fmi3Status status = self == NULL ? fmi3Error : fmi3OK;
  char word[longest_word];
  parameter found;
  for (size_t i = 0; i < n && status == fmi3OK; i++) {
    status = get_word(self, __func__, reference[i], RV_CHOICE, word, &found);
    if (status == fmi3OK) value[i] = rv_fmu_choice_number(found.key, word);
  }
  return status;
}

/* ---- Setting ---- */

static fmi3Status settle(instance *self, const char *function, int code) {
  self->is_ready = false;
  return code == RV_OK ? rv_fmu_warn_valve(self, function) : rv_fmu_fail_valve(self, function);
}

/* A parameter of a kind that may be set now. */
static bool is_open(instance *self, const char *function, fmi3ValueReference reference, int kind, parameter *found) {
  if (!rv_fmu_parameter(self, reference, found) || found->kind != kind)
    none_to_set(self, function, reference);
  else if (!(self->mode & before_steps))
    rv_fmu_fail(self, function, "%s is fixed when initialization mode is over", found->name);
  else
    return true;
  return false;
}

static const char *const input_name[n_inputs] = {"p_in", "p_out", "p_in_rate", "p_out_rate"};

static fmi3Status set_real(instance *self, const char *function, fmi3ValueReference reference, double value) {
  parameter found;
  if (reference - first_input < n_inputs) {
    if (!isfinite(value))
      return rv_fmu_fail(self, function, "%s must be a finite number", input_name[reference - first_input]);
    self->input[reference - first_input] = value;
    self->is_ready = self->mode == stepping;
    return fmi3OK;
  }
  if (!is_open(self, function, reference, RV_REAL, &found)) return fmi3Error;
  return settle(self, function, rv_valve_set_real(self->valve, found.name, value));
}

fmi3Status rv_fmu_worse(fmi3Status a, fmi3Status b) {
  return a > b ? a : b;
}

fmi3Status fmi3SetFloat64(fmi3Instance pointer, const fmi3ValueReference reference[], size_t n,
                          const fmi3Float64 value[], size_t n_values) {
  instance *self = rv_fmu_enter_values(pointer, __func__, before_end, reference, n, value, n_values);
  fmi3Status status = self == NULL ? fmi3Error : fmi3OK;
  for (size_t i = 0; i < n && status <= fmi3Warning; i++)
    status = rv_fmu_worse(status, set_real(self, __func__, reference[i], value[i]));
  return status;
}

fmi3Status fmi3SetInt32(fmi3Instance pointer, const fmi3ValueReference reference[], size_t n, const fmi3Int32 value[],
                        size_t n_values) {
  instance *self = rv_fmu_enter_values(pointer, __func__, before_end, reference, n, value, n_values);
  fmi3Status status = self == NULL ? fmi3Error : fmi3OK;
  char word[longest_word];
  parameter found;
  for (size_t i = 0; i < n && status <= fmi3Warning; i++) {
    if (!is_open(self, __func__, reference[i], RV_INTEGER, &found)) return fmi3Error;
    snprintf(word, sizeof word, "%" PRId32, value[i]);
    status = rv_fmu_worse(status, settle(self, __func__, rv_valve_set_text(self->valve, found.name, word)));
  }
  return status;
}

fmi3Status fmi3SetInt64(fmi3Instance pointer, const fmi3ValueReference reference[], size_t n, const fmi3Int64 value[],
                        size_t n_values) {
  instance *self = rv_fmu_enter_values(pointer, __func__, before_end, reference, n, value, n_values);
  fmi3Status status = self == NULL ? fmi3Error : fmi3OK;
  parameter found;
  for (size_t i = 0; i < n && status <= fmi3Warning; i++) {
    char word[longest_word] = "";
    if (!is_open(self, __func__, reference[i], RV_CHOICE, &found)) return fmi3Error;
    if (value[i] > 0 && value[i] < INT32_MAX) rv_fmu_choice(found.key, (int)value[i], word, sizeof word);
    if (word[0] == '\0')
      return rv_fmu_fail(self, __func__, "%s has no choice number %" PRId64, found.name, value[i]);
    status = rv_fmu_worse(status, settle(self, __func__, rv_valve_set_text(self->valve, found.name, word)));
  }
  return status;
}
