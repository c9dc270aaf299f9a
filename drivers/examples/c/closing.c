/* How the film between reed and seat slows a valve: one case as it stands, then a sweep over gap and oil. */
#include <reedvalve.h>
#include <stdio.h>
#include <string.h>

enum { GAPS = 4, OILS = 3, CASES = GAPS * OILS };

static const double gap_mm[GAPS] = {0.03, 0.05, 0.10, 0.20};
static const double viscosity_pa_s[OILS] = {0.01, 0.05, 0.10};

/* Where a measure stands among those of a case; -1: nowhere. */
static int measure_index(const char *name) {
  char other[64];
  for (int i = 0; i < rv_measure_count(); i++)
    if (rv_measure_name(i, other, sizeof other) == RV_OK && strcmp(name, other) == 0) return i;
  return -1;
}

static int one_case(rv_valve *valve) {
  double steady, closing;
  int code;
  if ((code = rv_valve_set_real(valve, "pressure.inlet_kpa", 30.0)) != RV_OK) return code;
  if ((code = rv_valve_run(valve)) != RV_OK) return code;
  if ((code = rv_valve_measure(valve, "steady_mm", &steady)) != RV_OK) return code;
  if ((code = rv_valve_measure(valve, "closing_ms", &closing)) != RV_OK) return code;
  printf("At 30 kPa the reed opens by %.3f mm and closes in %.2f ms.\n\n", steady, closing);
  return RV_OK;
}

static int sweep(rv_valve *valve) {
  const char *keys[2] = {"film.gap_mm", "fluid.viscosity_pa_s"};
  double values[CASES][2], measures[CASES * 32];
  int status[CASES], code, stride = rv_measure_count(), closing = measure_index("closing_ms");
  for (int c = 0; c < CASES; c++) {
    values[c][0] = gap_mm[c / OILS];
    values[c][1] = viscosity_pa_s[c % OILS];
  }
  if (closing < 0 || stride > 32) return RV_INTERNAL;
  if ((code = rv_sweep(valve, 2, keys, CASES, &values[0][0], measures, status, 0)) != RV_OK) return code;

  printf("closing_ms   ");
  for (int o = 0; o < OILS; o++) printf("%5.2f Pa s", viscosity_pa_s[o]);
  for (int c = 0; c < CASES; c++) {
    if (c % OILS == 0) printf("\n%.2f mm gap  ", gap_mm[c / OILS]);
    if (status[c] == RV_CASE_OK)
      printf("%10.2f", measures[c * stride + closing]);
    else
      printf("%10s", "failed");
  }
  printf("\n");
  return RV_OK;
}

int main(void) {
  rv_valve *valve;
  char message[256];
  int code = rv_valve_new(&valve);
  if (code == RV_OK) code = one_case(valve);
  if (code == RV_OK) code = sweep(valve);
  if (code != RV_OK) {
    rv_valve_message(valve, message, sizeof message);
    fprintf(stderr, "error %d: %s\n", code, message);
  }
  rv_valve_free(&valve);
  return code;
}
