/* FMI 2.0: the functions of model exchange, of types of variable that no valve has, and of features that the model
 * description does not claim, as in FMI 3.0. */
#include "rv_fmu.h"

#include <fmi2Functions.h>

#pragma GCC diagnostic ignored "-Wunused-parameter" /* no argument is looked at */

/* Types of variable: getting and setting */
#define NO_TYPE(Type)                                                                                             \
  fmi2Status fmi2Get##Type(fmi2Component self, const fmi2ValueReference a[], size_t n, fmi2##Type b[]) {          \
    return (fmi2Status)rv_fmu_no_variables(rv_fmu_called_as(self, __func__), __func__, n);                        \
  }                                                                                                               \
  fmi2Status fmi2Set##Type(fmi2Component self, const fmi2ValueReference a[], size_t n, const fmi2##Type b[]) {    \
    return (fmi2Status)rv_fmu_no_variables(rv_fmu_called_as(self, __func__), __func__, n);                        \
  }
NO_TYPE(Boolean)
NO_TYPE(String)

/* Everything else: a name, and its arguments */
#define REFUSAL (fmi2Status)rv_fmu_refuse(rv_fmu_called_as(self, __func__), __func__)
#define REFUSE(function, ...) \
  fmi2Status function(fmi2Component self, __VA_ARGS__) { return REFUSAL; }
#define REFUSE_PLAIN(function) \
  fmi2Status function(fmi2Component self) { return REFUSAL; }
REFUSE(fmi2GetDirectionalDerivative, const fmi2ValueReference a[], size_t b, const fmi2ValueReference c[], size_t d,
       const fmi2Real e[], fmi2Real f[])
REFUSE_PLAIN(fmi2EnterEventMode)
REFUSE(fmi2NewDiscreteStates, fmi2EventInfo *a)
REFUSE_PLAIN(fmi2EnterContinuousTimeMode)
REFUSE(fmi2CompletedIntegratorStep, fmi2Boolean a, fmi2Boolean *b, fmi2Boolean *c)
REFUSE(fmi2SetTime, fmi2Real a)
REFUSE(fmi2SetContinuousStates, const fmi2Real a[], size_t b)
REFUSE(fmi2GetDerivatives, fmi2Real a[], size_t b)
REFUSE(fmi2GetEventIndicators, fmi2Real a[], size_t b)
REFUSE(fmi2GetContinuousStates, fmi2Real a[], size_t b)
REFUSE(fmi2GetNominalsOfContinuousStates, fmi2Real a[], size_t b)
REFUSE(fmi2GetRealOutputDerivatives, const fmi2ValueReference a[], size_t b, const fmi2Integer c[], fmi2Real d[])
REFUSE_PLAIN(fmi2CancelStep)
