/* Where memory ends, what threads a child has that was forked from a program with threads, valves in eight threads, and a
 * caller who stops at NaN. */
#include <fenv.h>
#include <pthread.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include "api_check.h"

enum { cases = 2000, many_cases = 4000000 };

static const char *const gap[1] = {"film.gap_mm"};

/* Its processor has neither floating-point traps nor flags. */
static int under_valgrind(void) {
  const char *preload = getenv("LD_PRELOAD");
  return preload != NULL && strstr(preload, "vgpreload") != NULL;
}

/* The memory that a program may take is bounded neither under the address sanitizer nor under valgrind. */
static int memory_has_bounds(void) {
#ifdef __SANITIZE_ADDRESS__
  return 0;
#else
  return !under_valgrind();
#endif
}

/* No more than so many bytes on top of what the program has. */
static void allow(size_t bytes) {
  struct rlimit limit;
  unsigned long pages = 0;
  FILE *file = fopen("/proc/self/statm", "r");
  CHECK(file != NULL && fscanf(file, "%lu", &pages) == 1);
  if (file != NULL) fclose(file);
  getrlimit(RLIMIT_AS, &limit);
  limit.rlim_cur = pages * (size_t)sysconf(_SC_PAGESIZE) + bytes;
  if (limit.rlim_cur > limit.rlim_max) limit.rlim_cur = limit.rlim_max;
  CHECK(setrlimit(RLIMIT_AS, &limit) == 0);
}

static void test_no_memory(void) {
  rv_valve *valve = NULL;
  size_t samples = 0;
  double *values = calloc(many_cases, sizeof *values), *measures = calloc(9 * (size_t)many_cases, sizeof *measures), one;
  int *status = calloc(many_cases, sizeof *status);
  CHECK(values != NULL && measures != NULL && status != NULL && rv_valve_new(&valve) == RV_OK);
  if (!memory_has_bounds() || api_failed > 0) goto end;
  GOOD(valve, rv_valve_set_text(valve, "run.traces", ".true."));
  GOOD(valve, rv_valve_set_real(valve, "run.t_end_ms", 1.0));
  GOOD(valve, rv_valve_set_real(valve, "run.trace_dt_ms", 1e-6)); /* some 200 MiB */
  GOOD(valve, rv_valve_begin(valve, 0.0));
  allow(80u << 20);
  FAILS(valve, rv_valve_run(valve), RV_INTERNAL, "no memory");
  FAILS(valve, rv_valve_measure(valve, "steady_mm", &one), RV_BAD_INPUT, "run the valve first");
  CHECK(isnan(one));
  FAILS(valve, rv_sweep(valve, 1, gap, many_cases, values, measures, status, 1), RV_INTERNAL, "no memory"); /* its design */
  GOOD(valve, rv_valve_set_text(valve, "run.traces", ".false.")); /* which cut blocks */
  GOOD(valve, rv_valve_set_real(valve, "run.block_size", 1e6));
  for (int i = 0; i < many_cases / 16; i++) values[i] = 0.05;
  FAILS(valve, rv_sweep(valve, 1, gap, many_cases / 16, values, measures, status, 1), RV_INTERNAL, "no memory"); /* its block */
  GOOD(valve, rv_valve_set_text(valve, "run.traces", ".true."));
  GOOD(valve, rv_valve_set_real(valve, "run.trace_dt_ms", 0.01));
  GOOD(valve, rv_valve_run(valve));
  GOOD(valve, rv_valve_trace_size(valve, &samples));
  CHECK(samples == 101);
  GOOD(valve, rv_valve_begin(valve, 0.0));
  GOOD(valve, rv_valve_step(valve, 1e-4, 0.0, 1e3, 0.0, 0.0));
  allow((size_t)1 << 40);
end:
  rv_valve_free(&valve);
  free(values);
  free(measures);
  free(status);
}

static int sweep(int threads, double *measures) {
  static double values[cases];
  static int status[cases];
  rv_valve *valve;
  int code = rv_valve_new(&valve);
  for (int i = 0; i < cases; i++) values[i] = 0.05 + 1e-5 * i;
  code += rv_valve_set_real(valve, "run.t_end_ms", 1.0);
  code += rv_valve_set_real(valve, "run.block_size", 100.0); /* work for several threads */
  code += rv_sweep(valve, 1, gap, cases, values, measures, status, threads);
  return code + rv_valve_free(&valve);
}

/* OpenMP's threads stay with the parent; a child that waited for them would never end. */
static void test_fork(void) {
  static double before[9 * cases], after[9 * cases];
  int ending = -1;
  CHECK(sweep(2, before) == RV_OK);
  fflush(stdout);
  const pid_t child = fork();
  if (child == 0) {
    alarm(60);
    _exit(sweep(2, after) != RV_OK || memcmp(before, after, sizeof before) != 0);
  }
  CHECK(child > 0 && waitpid(child, &ending, 0) == child);
  CHECK(WIFEXITED(ending) && WEXITSTATUS(ending) == 0);
  CHECK(sweep(1000, after) == RV_OK && memcmp(before, after, sizeof before) == 0);
}

/* A run, a sweep on two threads and some steps. */
static void *all_calls(void *result) {
  double *number = result, value, values[3] = {0.03, 0.04, 0.05}, measures[27];
  int status[3], code = 0;
  rv_valve *valve;
  for (int n = 0; n < 3; n++) {
    code += rv_valve_new(&valve);
    code += rv_valve_set_text(valve, "run.model", "squeeze");
    code += rv_valve_run(valve);
    code += rv_valve_measure(valve, "closing_ms", &value);
    number[0] = value;
    code += rv_valve_set_real(valve, "run.block_size", 1.0);
    code += rv_sweep(valve, 1, gap, 3, values, measures, status, 2);
    number[1] = measures[5];
    code += rv_valve_begin(valve, 0.0);
    for (int k = 1; k < 20; k++) code += rv_valve_step(valve, 5e-5 * k, 500.0 * k, 500.0 * k, 0.0, 0.0);
    code += rv_valve_output(valve, RV_VELOCITY, &number[2]);
    code += rv_valve_free(&valve);
  }
  number[3] = code;
  return NULL;
}

static void test_eight_threads(void) {
  pthread_t thread[8];
  double alone[4], together[8][4];
  all_calls(alone);
  CHECK(alone[0] > 0.0 && alone[3] == 0.0);
  for (int i = 0; i < 8; i++) CHECK(pthread_create(&thread[i], NULL, all_calls, together[i]) == 0);
  for (int i = 0; i < 8; i++) CHECK(pthread_join(thread[i], NULL) == 0 && memcmp(alone, together[i], sizeof alone) == 0);
}

/* The caller's traps neither hit the library nor change, and the flags are those that the caller raised. */
static void test_floats(void) {
  static double values[cases], measures[9 * cases];
  static int status[cases];
  const int traps = FE_INVALID | FE_DIVBYZERO | FE_OVERFLOW;
  double number[4];
  rv_valve *valve;
  feclearexcept(FE_ALL_EXCEPT);
  feraiseexcept(FE_UNDERFLOW);
#pragma omp parallel num_threads(2)
  feenableexcept(traps); /* in the threads that a sweep gets */
  all_calls(number);
  CHECK(rv_valve_new(&valve) == RV_OK);
  FAILS(valve, rv_valve_set_real(valve, "film.gap_mm", NAN), RV_BAD_INPUT, "NaN");
  FAILS(valve, rv_valve_set_text(valve, "film.gap_mm", "1e999"), RV_BAD_INPUT, "too large");
  GOOD(valve, rv_valve_set_real(valve, "run.t_end_ms", 1.0));
  GOOD(valve, rv_valve_set_real(valve, "run.block_size", 100.0));
  for (int i = 0; i < cases; i++) values[i] = 1e-5 * i;
  GOOD(valve, rv_sweep(valve, 1, gap, cases, values, measures, status, 2));
  values[7] = INFINITY;
  FAILS(valve, rv_sweep(valve, 1, gap, cases, values, measures, status, 2), RV_BAD_INPUT, "infinity");
  GOOD(valve, rv_valve_begin(valve, -1e308));
  FAILS(valve, rv_valve_step(valve, 1e308, 0.0, 0.0, 0.0, 0.0), RV_BAD_INPUT, "finite");
  GOOD(valve, rv_valve_begin(valve, 0.0));
  CHECK(rv_valve_step(valve, 1.0, 0.0, 1e300, 0.0, 0.0) >= RV_NOT_CONVERGED);
  CHECK(rv_valve_free(&valve) == RV_OK);
  CHECK(under_valgrind() || (fegetexcept() == traps && fetestexcept(traps | FE_UNDERFLOW) == FE_UNDERFLOW));
#pragma omp parallel num_threads(2)
  fedisableexcept(traps);
  feclearexcept(FE_ALL_EXCEPT);
}

int main(void) {
  test_fork();
  test_eight_threads();
  test_floats();
  test_no_memory();
  return api_finish();
}
