/* Stepping: the whole case in 50 us steps, states saved and restored, the film models, and wrong uses. */
#include "api_check.h"

static const double rtol = 1e-6;
static const double gap = 0.05;                            /* the defaults' [mm] */
static const double wet_frequency = 6.283185307 * 0.769946;  /* the defaults', of results.nc [rad/ms] */

/* The square wave of the defaults, Eq. (20): 20 kPa, period 40 ms, ramps of 1 ms. */
static double inlet(double t_ms) {
  double part;
  if (t_ms < 10.0) {
    part = t_ms + 0.5;
  } else if (t_ms < 30.0) {
    part = 20.5 - t_ms;
  } else {
    part = t_ms - 39.5;
  }
  return 20000.0 * fmin(fmax(part, 0.0), 1.0);
}

static rv_valve *new_valve(const char *model) {
  rv_valve *valve = NULL;
  CHECK(rv_valve_new(&valve) == RV_OK);
  GOOD(valve, rv_valve_set_text(valve, "run.model", model));
  if (strncmp(model, "film", 4) == 0) GOOD(valve, rv_valve_set_real(valve, "film.modes", 2.0));
  GOOD(valve, rv_valve_set_real(valve, "solver.rtol", rtol));
  return valve;
}

static double output(rv_valve *valve, int which) {
  double value = NAN;
  GOOD(valve, rv_valve_output(valve, which, &value));
  return value;
}

/* Step k of 50 us: its ends in ms are k/20 and (k + 1)/20. */
static int step(rv_valve *valve, int k) {
  const double now = k / 20.0, then = (k + 1) / 20.0;
  return rv_valve_step(valve, then / 1000.0, inlet(now), inlet(then), 0.0, 0.0);
}

/* Displacement and velocity within ten times the tolerance, which is of each plus its scale: the static displacement
 * and, for the velocity, that times the angular frequency in the fluid. The film force is as v/(gap + u)^3.
 * The whole case has the tolerance run_rtol: the explicit method's own error in one is 16 times its tolerance. */
static void test_whole_case(const char *model, const char *method, double run_rtol, int steps) {
  rv_valve *valve = new_valve(model);
  size_t samples = 0;
  double *u, *v, *force, worst_u = 0.0, worst_v = 0.0, worst_force = 0.0, most_u = 0.0, most_v = 0.0, most_force = 0.0;
  double steady = NAN;
  GOOD(valve, rv_valve_set_text(valve, "solver.method", method));
  GOOD(valve, rv_valve_set_text(valve, "run.traces", ".true."));
  GOOD(valve, rv_valve_set_real(valve, "run.trace_dt_ms", 0.05));
  GOOD(valve, rv_valve_set_real(valve, "run.t_end_ms", steps / 20.0));
  GOOD(valve, rv_valve_set_real(valve, "solver.rtol", run_rtol));
  GOOD(valve, rv_valve_run(valve));
  GOOD(valve, rv_valve_measure(valve, "steady_mm", &steady));
  GOOD(valve, rv_valve_trace_size(valve, &samples));
  CHECK(samples == (size_t)steps + 1);
  if (samples != (size_t)steps + 1) return;
  u = malloc(samples * sizeof *u);
  v = malloc(samples * sizeof *v);
  force = malloc(samples * sizeof *force);
  GOOD(valve, rv_valve_trace_times(valve, u, samples));
  CHECK(u[0] == 0.0 && fabs(u[samples - 1] - steps / 20000.0) < 1e-15);
  GOOD(valve, rv_valve_trace(valve, RV_DISPLACEMENT, u, samples));
  GOOD(valve, rv_valve_trace(valve, RV_VELOCITY, v, samples));
  GOOD(valve, rv_valve_trace(valve, RV_FILM_FORCE, force, samples));
  GOOD(valve, rv_valve_set_real(valve, "solver.rtol", rtol));
  GOOD(valve, rv_valve_begin(valve, 0.0));
  for (int k = 0; k < steps; k++) {
    GOOD(valve, step(valve, k));
    worst_u = fmax(worst_u, fabs(1e3 * output(valve, RV_DISPLACEMENT) - u[k + 1]));
    worst_v = fmax(worst_v, fabs(output(valve, RV_VELOCITY) - v[k + 1]));
    worst_force = fmax(worst_force, fabs(output(valve, RV_FILM_FORCE) - force[k + 1]));
    most_u = fmax(most_u, fabs(u[k + 1]));
    most_v = fmax(most_v, fabs(v[k + 1]));
    most_force = fmax(most_force, fabs(force[k + 1]));
    CHECK(output(valve, RV_INLET) == inlet((k + 1) / 20.0));
    CHECK(isnan(output(valve, RV_LEAKAGE)) == (strncmp(model, "film", 4) != 0));
  }
  printf("%s, %s: off by %.1e of the displacement, %.1e of the velocity, %.1e of the film force\n", model, method,
         worst_u / most_u, worst_v / most_v, worst_force / most_force);
  CHECK(most_u > 0.1);
  const double limit_u = 10.0 * rtol * (most_u + steady), limit_v = 10.0 * rtol * (most_v + steady * wet_frequency);
  CHECK(worst_u <= limit_u);
  CHECK(worst_v <= limit_v);
  CHECK(worst_force <= most_force * (limit_v / most_v + 3.0 * limit_u / gap));
  free(u);
  free(v);
  free(force);
  rv_valve_free(&valve);
}

/* From a saved state the same bits, in the same valve and in another. */
static void test_restore(const char *model, int steps) {
  rv_valve *valve = new_valve(model), *other = new_valve(model);
  size_t bytes = 0, other_bytes = 0;
  double first[3], again[3];
  GOOD(valve, rv_valve_begin(valve, 0.0));
  GOOD(other, rv_valve_begin(other, 1.0));
  for (int k = 0; k < steps; k++) GOOD(valve, step(valve, k));
  GOOD(valve, rv_valve_state_size(valve, &bytes));
  GOOD(other, rv_valve_state_size(other, &other_bytes));
  CHECK(bytes > 0 && bytes == other_bytes);
  char *memory = malloc(bytes + 1), *state = memory + 1; /* at an odd address */
  GOOD(valve, rv_valve_state_save(valve, state, bytes));
  for (int k = steps; k < 2 * steps; k++) GOOD(valve, step(valve, k));
  GOOD(valve, rv_valve_state(valve, &first[0], NULL, NULL, &first[1]));
  first[2] = output(valve, RV_DISPLACEMENT);
  for (int run = 0; run < 2; run++) {
    rv_valve *next = run == 0 ? valve : other;
    GOOD(next, rv_valve_state_restore(next, state, bytes));
    for (int k = steps; k < 2 * steps; k++) GOOD(next, step(next, k));
    GOOD(next, rv_valve_state(next, &again[0], NULL, NULL, &again[1]));
    again[2] = output(next, RV_DISPLACEMENT);
    CHECK(memcmp(first, again, sizeof first) == 0);
  }
  state[bytes / 2] ^= 1;
  FAILS(valve, rv_valve_state_restore(valve, state, bytes), RV_BAD_INPUT, "damaged");
  FAILS(valve, rv_valve_state_restore(valve, state, bytes - 1), RV_BAD_INPUT, "bytes");
  FAILS(valve, rv_valve_state_restore(valve, NULL, bytes), RV_BAD_INPUT, "NULL");
  FAILS(valve, rv_valve_state_save(valve, state, bytes - 8), RV_BAD_INPUT, "bytes");
  free(memory);
  rv_valve_free(&valve);
  rv_valve_free(&other);
}

/* States of the same length: of the lumped models, and of film models with one degree of freedom. */
static void test_other_models(void) {
  static const char *const model[2][2] = {{"traditional", "squeeze"}, {"film_table", "film"}};
  for (int i = 0; i < 2; i++) {
    rv_valve *valve = new_valve(model[i][0]), *other = new_valve(model[i][1]);
    size_t bytes = 0;
    char state[400];
    GOOD(other, rv_valve_set_real(other, "film.modes", 1.0));
    GOOD(valve, rv_valve_begin(valve, 0.0));
    GOOD(other, rv_valve_begin(other, 0.0));
    GOOD(valve, rv_valve_state_size(valve, &bytes));
    CHECK(bytes <= sizeof state);
    GOOD(valve, rv_valve_state_save(valve, state, bytes));
    FAILS(other, rv_valve_state_restore(other, state, bytes), RV_BAD_INPUT, "no state of such a valve");
    GOOD(valve, rv_valve_state_restore(valve, state, bytes));
    rv_valve_free(&valve);
    rv_valve_free(&other);
  }
}

static void test_state(void) {
  rv_valve *valve = new_valve("film");
  int dofs = 0;
  double t, q[2] = {1.0, 1.0}, v[2] = {1.0, 1.0}, next;
  GOOD(valve, rv_valve_begin(valve, 0.25));
  GOOD(valve, rv_valve_dofs(valve, &dofs));
  CHECK(dofs == 2);
  GOOD(valve, rv_valve_state(valve, &t, q, v, &next));
  CHECK(t == 0.25 && q[0] == 0.0 && q[1] == 0.0 && v[0] == 0.0 && v[1] == 0.0 && next == 0.0);
  CHECK(output(valve, RV_DISPLACEMENT) == 0.0 && isnan(output(valve, RV_FILM_FORCE)));
  GOOD(valve, rv_valve_step(valve, 0.2505, 0.0, 20000.0, 0.0, 0.0));
  GOOD(valve, rv_valve_state(valve, &t, q, v, &next));
  CHECK(t == 0.2505 && q[0] != 0.0 && v[0] != 0.0 && next > 0.0 && next <= 0.0005);
  CHECK(output(valve, RV_LEAKAGE) != 0.0);
  rv_valve_free(&valve);
}

/* Under constant pressure a valve that starts at its equilibrium stays there. */
static void test_equilibrium(void) {
  rv_valve *valve = new_valve("squeeze");
  double first, steady = NAN;
  GOOD(valve, rv_valve_run(valve));
  GOOD(valve, rv_valve_measure(valve, "steady_mm", &steady)); /* under 20 kPa */
  GOOD(valve, rv_valve_set_text(valve, "run.start", "equilibrium"));
  GOOD(valve, rv_valve_begin(valve, 0.0));
  GOOD(valve, rv_valve_step(valve, 1e-3, 15000.0, 15000.0, 1000.0, 1000.0));
  first = output(valve, RV_DISPLACEMENT);
  CHECK(fabs(first - 0.7e-3 * steady) <= rtol * first);
  for (int k = 2; k < 20; k++) GOOD(valve, rv_valve_step(valve, 1e-3 * k, 15000.0, 15000.0, 1000.0, 1000.0));
  CHECK(fabs(output(valve, RV_DISPLACEMENT) - first) <= rtol * first);
  rv_valve_free(&valve);
}

static void test_wrong_uses(void) {
  rv_valve *valve = new_valve("squeeze");
  size_t bytes = 0;
  double before, after = 3.0, next = 3.0;
  char state[400];
  FAILS(valve, rv_valve_step(valve, 1.0, 0.0, 0.0, 0.0, 0.0), RV_BAD_INPUT, "begin first");
  FAILS(valve, rv_valve_state(valve, &after, NULL, NULL, &next), RV_BAD_INPUT, "begin first");
  CHECK(isnan(after) && isnan(next));
  FAILS(valve, rv_valve_state_size(valve, &bytes), RV_BAD_INPUT, "begin first");
  FAILS(valve, rv_valve_output(valve, RV_VELOCITY, &after), RV_BAD_INPUT, "begin first");
  FAILS(valve, rv_valve_begin(valve, NAN), RV_BAD_INPUT, "finite");
  GOOD(valve, rv_valve_begin(valve, -1e308));
  FAILS(valve, rv_valve_step(valve, 1e308, 0.0, 0.0, 0.0, 0.0), RV_BAD_INPUT, "finite");
  GOOD(valve, rv_valve_begin(valve, 0.0));
  FAILS(valve, rv_valve_step(valve, 1e-300, 0.0, 0.0, 0.0, 0.0), RV_BAD_INPUT, "by more than rounding");
  GOOD(valve, rv_valve_step(valve, 1e-3, 0.0, 20000.0, 0.0, 0.0));
  before = output(valve, RV_DISPLACEMENT);
  FAILS(valve, rv_valve_step(valve, 0.5e-3, 0.0, 0.0, 0.0, 0.0), RV_BAD_INPUT, "time must go on");
  FAILS(valve, rv_valve_step(valve, 1e-3, 0.0, 0.0, 0.0, 0.0), RV_BAD_INPUT, "time must go on");
  FAILS(valve, rv_valve_step(valve, 1e-3 * (1.0 + 4e-16), 0.0, 0.0, 0.0, 0.0), RV_BAD_INPUT, "by more than rounding");
  FAILS(valve, rv_valve_step(valve, NAN, 0.0, 0.0, 0.0, 0.0), RV_BAD_INPUT, "finite");
  FAILS(valve, rv_valve_step(valve, 2e-3, 0.0, NAN, 0.0, 0.0), RV_BAD_INPUT, "finite");
  FAILS(valve, rv_valve_step(valve, 2e-3, 0.0, 0.0, -INFINITY, 0.0), RV_BAD_INPUT, "finite");
  FAILS(valve, rv_valve_output(valve, 10, &after), RV_BAD_INPUT, "no such output");
  FAILS(valve, rv_valve_output(valve, -1, &after), RV_BAD_INPUT, "no such output");
  CHECK(isnan(after));
  FAILS(valve, rv_valve_output(valve, 0, NULL), RV_BAD_INPUT, "NULL");
  FAILS(valve, rv_valve_begin(valve, INFINITY), RV_BAD_INPUT, "finite");
  FAILS(valve, rv_valve_dofs(valve, NULL), RV_BAD_INPUT, "NULL");
  CHECK(output(valve, RV_DISPLACEMENT) == before);
  GOOD(valve, rv_valve_state_size(valve, &bytes));
  CHECK(bytes <= sizeof state);
  GOOD(valve, rv_valve_state_save(valve, state, bytes));
  CHECK(rv_valve_step(valve, 1.0, 0.0, 1e300, 0.0, 0.0) >= RV_NOT_CONVERGED); /* no solver follows that */
  CHECK(rv_valve_message(valve, state + bytes, 1) == RV_OK);
  FAILS(valve, rv_valve_step(valve, 2e-3, 20000.0, 20000.0, 0.0, 0.0), RV_BAD_INPUT, "the last step failed");
  GOOD(valve, rv_valve_state_restore(valve, state, bytes));
  GOOD(valve, rv_valve_step(valve, 2e-3, 20000.0, 20000.0, 0.0, 0.0));
  GOOD(valve, rv_valve_set_real(valve, "film.k_s", 0.008));
  FAILS(valve, rv_valve_step(valve, 3e-3, 0.0, 0.0, 0.0, 0.0), RV_BAD_INPUT, "begin first");
  GOOD(valve, rv_valve_set_real(valve, "film.gap_mm", 0.0));
  FAILS(valve, rv_valve_begin(valve, 0.0), RV_DOMAIN, "the gap is 0");
  FAILS(valve, rv_valve_step(valve, 3e-3, 0.0, 0.0, 0.0, 0.0), RV_BAD_INPUT, "begin first");
  rv_valve_free(&valve);
}

int main(void) {
  test_whole_case("traditional", "implicit", rtol, 800);
  test_whole_case("squeeze", "implicit", rtol, 800);
  test_whole_case("squeeze", "explicit", 0.01 * rtol, 800);
  test_whole_case("film_table", "implicit", rtol, 800);
  test_whole_case("film", "implicit", rtol, 800);
  test_restore("squeeze", 300);
  test_restore("film_table", 100);
  test_restore("film", 10);
  test_other_models();
  test_state();
  test_equilibrium();
  test_wrong_uses();
  return api_finish();
}
