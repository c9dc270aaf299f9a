/* The same valves by the C interface, for Fortran programs to compare bits with. */
#include <reedvalve.h>

void peer_run_(const double *gap_mm, double *closing_ms, double *frequency_hz, int *code);
void peer_step_(const double *gap_mm, const int *steps, double *out, int *code);
void peer_sweep_(const int *cases, const double *values, double *measures, int *status, int *code);

static rv_valve *new_valve(double gap_mm, int *code) {
  rv_valve *valve;
  *code = rv_valve_new(&valve);
  *code += rv_valve_set_real(valve, "film.gap_mm", gap_mm);
  return valve;
}

/* Closing time and frequency of a whole case. */
void peer_run_(const double *gap_mm, double *closing_ms, double *frequency_hz, int *code) {
  rv_valve *valve = new_valve(*gap_mm, code);
  *code += rv_valve_run(valve);
  *code += rv_valve_measure(valve, "closing_ms", closing_ms);
  *code += rv_valve_fact(valve, "wet_frequency_hz", frequency_hz);
  *code += rv_valve_free(&valve);
}

/* Outputs after so many steps of 50 us, in which the inlet rises by 500 Pa. */
void peer_step_(const double *gap_mm, const int *steps, double *out, int *code) {
  rv_valve *valve = new_valve(*gap_mm, code);
  *code += rv_valve_begin(valve, 0.0);
  for (int k = 0; k < *steps; k++) *code += rv_valve_step(valve, 50e-6 * (k + 1), 500.0 * k, 500.0 * (k + 1), 0.0, 0.0);
  for (int i = 0; i < 5; i++) *code += rv_valve_output(valve, i, &out[i]);
  *code += rv_valve_free(&valve);
}

/* Cases of gap [mm] and inlet pressure [kPa]. */
void peer_sweep_(const int *cases, const double *values, double *measures, int *status, int *code) {
  const char *keys[2] = {"film.gap_mm", "pressure.inlet_kpa"};
  rv_valve *valve = new_valve(0.05, code);
  *code += rv_sweep(valve, 2, keys, (size_t)*cases, values, measures, status, 1);
  *code += rv_valve_free(&valve);
}
