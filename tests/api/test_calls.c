/* Random calls with good, odd and wrong arguments: no code but those of the header, no crash, no leak (small and rare ones
 * are for valgrind to find). `test_calls [sequences]`, each of up to twelve calls; the seed is fixed. */
#include <malloc.h>
#include <stdint.h>

#include "api_check.h"

enum { places = 4, calls = 12, spare = 65536 /* what malloc itself keeps aside [byte] */ };

/* The Fortran 77 interface, with the lengths of texts behind the other arguments. */
void rv_new_(int *iv, int *ierr);
void rv_free_(int *iv, int *ierr);
void rv_msg_(const int *iv, char *text, int *ierr, size_t length);
void rv_name_(const char *list, const int *i, char *name, char *unit, int *ierr, size_t, size_t, size_t);
void rv_set_(const int *iv, const char *key, const double *x, int *ierr, size_t length);
void rv_setc_(const int *iv, const char *key, const char *word, int *ierr, size_t, size_t);
void rv_getc_(const int *iv, const char *key, char *word, int *ierr, size_t, size_t);
void rv_meas_(const int *iv, const char *name, double *x, int *ierr, size_t length);
void rv_begin_(const int *iv, const double *t0, int *ierr);
void rv_step_(const int *iv, const double *t1, const double *in0, const double *in1, const double *out0, const double *out1,
              int *ierr);
void rv_state_(const int *iv, double *t, double *q, double *v, const int *n, double *h, int *ierr);
void rv_size_(const int *iv, int *n, int *ierr);
void rv_save_(const int *iv, double *w, const int *n, int *ierr);
void rv_rest_(const int *iv, const double *w, const int *n, int *ierr);
void rv_cases_(const int *iv, const int *nk, const char *key, const int *nc, const double *x, const int *nm, double *y,
               int *istat, const int *nthr, int *ierr, size_t length);

static uint64_t seed = 5256;

/* Marsaglia (2003), doi:10.18637/jss.v008.i14. */
static unsigned draw(unsigned below) {
  seed ^= seed << 13;
  seed ^= seed >> 7;
  seed ^= seed << 17;
  return (unsigned)((seed >> 16) % below);
}

static double number(void) {
  static const double some[] = {0.05, 0.0, -1.0, 20.0, 1.0, 2.0, 1e-3, 0.2, 6.0, NAN, INFINITY, 1e300, 1e-300, -0.0, 0.5, 3.0};
  return some[draw(sizeof some / sizeof *some)];
}

static const char *word(void) {
  static const char *const some[] = {"film.gap_mm",   "run.model",         "squeeze",         "traditional",  NULL,
                                     "",              "pressure.kind",     "trace",           "0.05",         ".true.",
                                     "run.traces",    "pressure.file",     "none.csv",        "\xff\xfe.\x01", "film.gap",
                                     "steady_mm",     "reed.width_mm",     "solver.method",   "explicit",     "auto",
                                     "hydro.load",    "none",              "run.t_end_ms",    "sweep.key",    "run.start",
                                     "equilibrium",   "pressure.inlet_kpa", "closing_ms",     "film_table",   "a.b.c'\"\n"};
  return some[draw(sizeof some / sizeof *some)];
}

static void check_code(int code) { CHECK(code >= RV_OK && code <= RV_DOMAIN); }

static void call_state(rv_valve *valve) {
  static char state[1000];
  size_t bytes = draw(1000);
  double t, next;
  if (draw(4) > 0) check_code(rv_valve_state_size(valve, &bytes));
  check_code(rv_valve_state_save(valve, draw(8) > 0 ? state : NULL, bytes));
  if (draw(4) == 0) state[draw(sizeof state)] ^= 1;
  check_code(rv_valve_state_restore(valve, state, bytes));
  check_code(rv_valve_state(valve, draw(2) ? &t : NULL, NULL, NULL, draw(2) ? &next : NULL));
}

static void call_step(rv_valve *valve) {
  static const double pressure[] = {0.0, 1e3, 2e4, -5e3, NAN};
  double t = 0.0, out;
  rv_valve_state(valve, &t, NULL, NULL, NULL);
  if (draw(6) == 0) t = number();
  if (!(t < 10.0)) t = 0.0; /* no run of hours */
  check_code(rv_valve_step(valve, t + draw(5) * 5e-5, pressure[draw(5)], pressure[draw(4)], pressure[draw(4)], 0.0));
  check_code(rv_valve_output(valve, (int)draw(12) - 1, draw(8) > 0 ? &out : NULL));
}

static void call_run(rv_valve *valve) {
  double value, *trace;
  size_t samples = 0;
  int status;
  rv_valve_set_real(valve, "run.t_end_ms", 0.1 * (1 + draw(5)));
  rv_valve_set_real(valve, "run.trace_dt_ms", 0.05);
  check_code(rv_valve_run(valve));
  check_code(rv_valve_status(valve, draw(8) > 0 ? &status : NULL));
  check_code(rv_valve_measure(valve, word(), &value));
  check_code(rv_valve_fact(valve, draw(2) ? word() : "reynolds", draw(8) > 0 ? &value : NULL));
  if (rv_valve_trace_size(valve, &samples) != RV_OK) return;
  trace = malloc((samples + 1) * sizeof *trace);
  check_code(rv_valve_trace(valve, (int)draw(12) - 1, trace, samples));
  check_code(rv_valve_trace_times(valve, trace, samples + (draw(8) == 0)));
  free(trace);
}

static void call_sweep(rv_valve *valve) {
  const char *keys[2] = {"film.gap_mm", draw(2) ? "pressure.inlet_kpa" : word()};
  double values[6], measures[60];
  int status[3];
  CHECK(rv_measure_count() <= 20);
  for (int i = 0; i < 6; i++) values[i] = draw(12) > 0 ? 0.03 * (1 + draw(3)) : number();
  check_code(rv_sweep(valve, (int)draw(4) - 1, keys, draw(4), values, measures, status, 1));
}

static void call_names(void) {
  int i = (int)draw(80) - 2;
  char text[40];
  check_code(rv_key_name(i, draw(8) > 0 ? text : NULL, draw(sizeof text)));
  check_code(rv_key_unit(i, text, draw(sizeof text)));
  check_code(rv_key_help(i, text, draw(sizeof text)));
  CHECK(rv_key_kind(i) >= 0 && rv_key_kind(i) <= RV_TEXT);
  check_code(rv_fact_name(i, text, draw(sizeof text)));
  check_code(rv_trace_unit(i, text, draw(sizeof text)));
}

/* A text of Fortran 77: a word in a longer place, or only the beginning of it. */
static size_t fixed(char text[40]) {
  const char *one = word();
  memset(text, ' ', 40);
  if (one != NULL) memcpy(text, one, strlen(one));
  return draw(40);
}

/* One of a few valves with numbers for handles, or a number that may be none. */
static int number_of[places];

static void call_f77(void) {
  static int n;
  static double state[100];
  int *iv = &number_of[draw(places)], wild = (int)draw(200000) - 100, ierr = 0, i = (int)draw(5) - 1, nm = 9, status[3];
  char key[80], text[40], unit[40];
  double x = number(), t = 0.0, values[9] = {0.0}, measures[27];
  size_t length = fixed(key), other = draw(sizeof text);
  if (*iv == 0) rv_new_(iv, &ierr);
  if (draw(8) == 0) iv = &wild;
  switch (draw(11)) {
    case 0:
      rv_free_(iv, &ierr);
      break;
    case 1:
      rv_set_(iv, key, &x, &ierr, length);
      break;
    case 2:
      rv_setc_(iv, "run.model", key, &ierr, 9, length);
      break;
    case 3:
      rv_getc_(iv, key, text, &ierr, length, other);
      break;
    case 4:
      rv_name_(key, &i, text, unit, &ierr, length, other, draw(sizeof text));
      break;
    case 5:
      rv_meas_(iv, key, &x, &ierr, length);
      break;
    case 6:
      rv_begin_(iv, &t, &ierr);
      break;
    case 7:
      t = 5e-5 * draw(5);
      rv_step_(iv, &t, &values[0], &x, &t, &t, &ierr);
      break;
    case 8:
      rv_size_(iv, &n, &ierr);
      if (n > 100 || draw(8) == 0) n = (int)draw(102) - 1;
      rv_save_(iv, state, &n, &ierr);
      break;
    case 9:
      if (draw(4) == 0) state[draw(100)] += 1.0;
      rv_rest_(iv, state, &n, &ierr);
      rv_state_(iv, &t, values, measures, &i, &x, &ierr);
      break;
    default:
      for (int k = 0; k < 9; k++) values[k] = 0.03;
      memset(key + 40, ' ', 40);
      memcpy(key, "film.gap_mm", 11);
      t = 0.3;
      rv_set_(iv, "run.t_end_ms", &t, &ierr, 12);
      rv_cases_(iv, &i, key, &i, values, &nm, measures, status, &i, &ierr, draw(27));
  }
  check_code(ierr);
  rv_msg_(iv, text, &ierr, other);
  check_code(ierr);
}

static void call_any(rv_valve **valve) {
  char text[60];
  double value;
  int is_set;
  switch (draw(19)) {
    case 0:
      if (*valve == NULL || draw(4) == 0) rv_valve_free(valve);
      if (*valve == NULL) check_code(rv_valve_new(valve));
      break;
    case 1:
      rv_valve_free(valve);
      break;
    case 2: {
      rv_valve *copy = *valve;
      if (draw(4) > 0) break;
      rv_valve_free(valve);
      CHECK(copy == NULL || rv_valve_run(copy) == RV_BAD_INPUT);
      break;
    }
    case 3:
    case 4:
      check_code(rv_valve_set_real(*valve, word(), number()));
      break;
    case 5:
    case 6:
      check_code(rv_valve_set_text(*valve, word(), word()));
      break;
    case 7:
      check_code(rv_valve_get_real(*valve, word(), &value));
      break;
    case 8:
      check_code(rv_valve_get_text(*valve, word(), text, draw(sizeof text)));
      check_code(rv_valve_is_set(*valve, word(), draw(8) > 0 ? &is_set : NULL));
      break;
    case 9:
      check_code(rv_valve_begin(*valve, draw(6) > 0 ? 0.0 : number()));
      break;
    case 10:
    case 11:
    case 12:
      call_step(*valve);
      break;
    case 13:
      call_state(*valve);
      break;
    case 14:
      call_run(*valve);
      break;
    case 15:
      call_names();
      break;
    case 16:
    case 17:
      call_f77();
      break;
    default:
      call_sweep(*valve);
  }
  check_code(rv_valve_message(*valve, text, draw(sizeof text)));
}

/* Run sequences on a few valves and close them; the bytes that are in use then. */
static size_t run(long sequences) {
  rv_valve *valve[places] = {NULL};
  for (long n = 0; n < sequences; n++) {
    rv_valve **one = &valve[draw(places)];
    if (*one == NULL) check_code(rv_valve_new(one));
    rv_valve_set_real(*one, "run.t_end_ms", 0.3); /* short sweeps */
    for (unsigned i = draw(calls) + 1; i > 0; i--) call_any(one);
    if (draw(3) == 0) rv_valve_free(one);
  }
  for (int i = 0; i < places; i++) {
    int ierr;
    rv_valve_free(&valve[i]);
    rv_free_(&number_of[i], &ierr);
    check_code(ierr);
  }
  const struct mallinfo2 memory = mallinfo2();
  return memory.uordblks + memory.hblkhd;
}

int main(int count, char **argument) {
  const long half = (count > 1 ? atol(argument[1]) : 3000) / 2;
  const size_t before = run(half);
  CHECK(run(half) <= before + spare);
  return api_finish();
}
