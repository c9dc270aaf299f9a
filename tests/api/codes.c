/* The header's numbers, for a Fortran program to compare. */
#include "reedvalve.h"

void api_codes(int *code, int *ending, int *output);

void api_codes(int *code, int *ending, int *output) {
  const int codes[] = {RV_OK, RV_BAD_INPUT, RV_IO, RV_NOT_CONVERGED, RV_DOMAIN, RV_INTERNAL};
  const int endings[] = {RV_CASE_OK,           RV_CASE_STEP_TOO_SMALL, RV_CASE_FILM_CLOSED, RV_CASE_NOT_FINITE,
                         RV_CASE_TOO_MANY_STEPS, RV_CASE_NO_CONVERGENCE, RV_CASE_BAD_CASE};
  const int outputs[] = {RV_DISPLACEMENT, RV_FILM_FORCE, RV_LEAKAGE, RV_FILM_LOW};
  for (int i = 0; i < 6; i++) code[i] = codes[i];
  for (int i = 0; i < 7; i++) ending[i] = endings[i];
  for (int i = 0; i < 4; i++) output[i] = outputs[i];
}
