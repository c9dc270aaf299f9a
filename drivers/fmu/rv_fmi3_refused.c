/* FMI 3.0: the functions of other interface types, of types of variable that no valve has, and of features that the model
 * description does not claim. Each is there, for importers look all of them up, and each is an error with a message. */
#include "rv_fmu.h"

#pragma GCC diagnostic ignored "-Wunused-parameter" /* no argument is looked at */

fmi3Status rv_fmu_refuse(fmi3Instance pointer, const char *function) {
  instance *self = rv_fmu_enter(pointer, function, anywhere);
  if (self == NULL) return fmi3Error;
  return rv_fmu_fail(self, function, "this FMU does not offer this function");
}

fmi3Status rv_fmu_no_variables(fmi3Instance pointer, const char *function, size_t n) {
  instance *self = rv_fmu_enter(pointer, function, anywhere);
  if (self == NULL) return fmi3Error;
  return n == 0 ? fmi3OK : rv_fmu_fail(self, function, "there is no variable of this type");
}

static fmi3Instance no_instance(const char *function, fmi3InstanceEnvironment environment, fmi3LogMessageCallback log) {
  instance nobody = {.name = (char *)"reedvalve", .environment = environment, .log = log};
  rv_fmu_fail(&nobody, function, "this FMU is for co-simulation only");
  return NULL;
}

fmi3Instance fmi3InstantiateModelExchange(fmi3String name, fmi3String token, fmi3String resources, fmi3Boolean visible,
                                          fmi3Boolean logging, fmi3InstanceEnvironment environment,
                                          fmi3LogMessageCallback log) {
  return no_instance(__func__, environment, log);
}

fmi3Instance fmi3InstantiateScheduledExecution(fmi3String name, fmi3String token, fmi3String resources,
                                               fmi3Boolean visible, fmi3Boolean logging,
                                               fmi3InstanceEnvironment environment, fmi3LogMessageCallback log,
                                               fmi3ClockUpdateCallback update, fmi3LockPreemptionCallback lock,
                                               fmi3UnlockPreemptionCallback unlock) {
  return no_instance(__func__, environment, log);
}

/* Types of variable: getting and setting */
#define VARIABLES self, const fmi3ValueReference reference[], size_t n
#define NO_TYPE(Type)                                                                            \
  fmi3Status fmi3Get##Type(fmi3Instance VARIABLES, fmi3##Type value[], size_t n_values) {        \
    return rv_fmu_no_variables(self, __func__, n);                                                      \
  }                                                                                              \
  fmi3Status fmi3Set##Type(fmi3Instance VARIABLES, const fmi3##Type value[], size_t n_values) {  \
    return rv_fmu_no_variables(self, __func__, n);                                                      \
  }
NO_TYPE(Float32)
NO_TYPE(Int8)
NO_TYPE(UInt8)
NO_TYPE(Int16)
NO_TYPE(UInt16)
NO_TYPE(UInt32)
NO_TYPE(UInt64)
NO_TYPE(Boolean)
NO_TYPE(String)

fmi3Status fmi3GetBinary(fmi3Instance VARIABLES, size_t size[], fmi3Binary value[], size_t n_values) {
  return rv_fmu_no_variables(self, __func__, n);
}
fmi3Status fmi3SetBinary(fmi3Instance VARIABLES, const size_t size[], const fmi3Binary value[], size_t n_values) {
  return rv_fmu_no_variables(self, __func__, n);
}
fmi3Status fmi3GetClock(fmi3Instance VARIABLES, fmi3Clock value[]) {
  return rv_fmu_no_variables(self, __func__, n);
}
fmi3Status fmi3SetClock(fmi3Instance VARIABLES, const fmi3Clock value[]) {
  return rv_fmu_no_variables(self, __func__, n);
}

/* Everything else: a name, and its arguments */
#define REFUSE(function, ...) \
  fmi3Status function(fmi3Instance self, __VA_ARGS__) { return rv_fmu_refuse(self, __func__); }
#define REFUSE_PLAIN(function) \
  fmi3Status function(fmi3Instance self) { return rv_fmu_refuse(self, __func__); }
REFUSE_PLAIN(fmi3EnterEventMode)
REFUSE(fmi3GetNumberOfVariableDependencies, fmi3ValueReference a, size_t *b)
REFUSE(fmi3GetVariableDependencies, fmi3ValueReference a, size_t b[], fmi3ValueReference c[], size_t d[],
       fmi3DependencyKind e[], size_t f)
REFUSE(fmi3GetDirectionalDerivative, const fmi3ValueReference a[], size_t b, const fmi3ValueReference c[], size_t d,
       const fmi3Float64 e[], size_t f, fmi3Float64 g[], size_t h)
REFUSE(fmi3GetAdjointDerivative, const fmi3ValueReference a[], size_t b, const fmi3ValueReference c[], size_t d, const
       fmi3Float64 e[], size_t f, fmi3Float64 g[], size_t h)
REFUSE_PLAIN(fmi3EnterConfigurationMode)
REFUSE_PLAIN(fmi3ExitConfigurationMode)
REFUSE(fmi3GetIntervalDecimal, const fmi3ValueReference a[], size_t b, fmi3Float64 c[], fmi3IntervalQualifier d[])
REFUSE(fmi3GetIntervalFraction, const fmi3ValueReference a[], size_t b, fmi3UInt64 c[], fmi3UInt64 d[],
       fmi3IntervalQualifier e[])
REFUSE(fmi3GetShiftDecimal, const fmi3ValueReference a[], size_t b, fmi3Float64 c[])
REFUSE(fmi3GetShiftFraction, const fmi3ValueReference a[], size_t b, fmi3UInt64 c[], fmi3UInt64 d[])
REFUSE(fmi3SetIntervalDecimal, const fmi3ValueReference a[], size_t b, const fmi3Float64 c[])
REFUSE(fmi3SetIntervalFraction, const fmi3ValueReference a[], size_t b, const fmi3UInt64 c[], const fmi3UInt64 d[])
REFUSE(fmi3SetShiftDecimal, const fmi3ValueReference a[], size_t b, const fmi3Float64 c[])
REFUSE(fmi3SetShiftFraction, const fmi3ValueReference a[], size_t b, const fmi3UInt64 c[], const fmi3UInt64 d[])
REFUSE_PLAIN(fmi3EvaluateDiscreteStates)
REFUSE(fmi3UpdateDiscreteStates, fmi3Boolean *a, fmi3Boolean *b, fmi3Boolean *c, fmi3Boolean *d, fmi3Boolean *e,
       fmi3Float64 *f)
REFUSE_PLAIN(fmi3EnterContinuousTimeMode)
REFUSE(fmi3CompletedIntegratorStep, fmi3Boolean a, fmi3Boolean *b, fmi3Boolean *c)
REFUSE(fmi3SetTime, fmi3Float64 a)
REFUSE(fmi3SetContinuousStates, const fmi3Float64 a[], size_t b)
REFUSE(fmi3GetContinuousStateDerivatives, fmi3Float64 a[], size_t b)
REFUSE(fmi3GetEventIndicators, fmi3Float64 a[], size_t b)
REFUSE(fmi3GetContinuousStates, fmi3Float64 a[], size_t b)
REFUSE(fmi3GetNominalsOfContinuousStates, fmi3Float64 a[], size_t b)
REFUSE(fmi3GetNumberOfEventIndicators, size_t *a)
REFUSE(fmi3GetNumberOfContinuousStates, size_t *a)
REFUSE_PLAIN(fmi3EnterStepMode)
REFUSE(fmi3GetOutputDerivatives, const fmi3ValueReference a[], size_t b, const fmi3Int32 c[], fmi3Float64 d[], size_t
       e)
REFUSE(fmi3ActivateModelPartition, fmi3ValueReference a, fmi3Float64 b)
