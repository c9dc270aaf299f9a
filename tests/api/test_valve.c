/* Making, setting, running and closing valves, in one thread and in two, and every wrong use. */
#include "api_check.h"

static double measure(rv_valve *valve, const char *name) {
  double value = NAN;
  GOOD(valve, rv_valve_measure(valve, name, &value));
  return value;
}

/* Closing time of a valve that is made, run and closed. */
static double run_once(double gap_mm) {
  rv_valve *valve = NULL;
  int status = -1;
  CHECK(rv_valve_new(&valve) == RV_OK);
  CHECK(valve != NULL);
  GOOD(valve, rv_valve_set_real(valve, "film.gap_mm", gap_mm));
  GOOD(valve, rv_valve_set_text(valve, "run.model", "squeeze"));
  GOOD(valve, rv_valve_run(valve));
  GOOD(valve, rv_valve_status(valve, &status));
  CHECK(status == RV_CASE_OK);
  const double closing = measure(valve, "closing_ms");
  CHECK(rv_valve_free(&valve) == RV_OK);
  CHECK(valve == NULL);
  CHECK(rv_valve_free(&valve) == RV_OK);
  return closing;
}

static void test_run_twice(void) {
  const double first = run_once(0.05);
  CHECK(first > 0.0);
  CHECK(run_once(0.05) == first);
  CHECK(run_once(0.03) > first); /* a thinner film closes more slowly */
}

static void test_two_at_once(void) {
  double alone[2], together[2] = {NAN, NAN};
  const double gap[2] = {0.05, 0.03};
  int codes = 0;
  for (int i = 0; i < 2; i++) alone[i] = run_once(gap[i]);
#pragma omp parallel for num_threads(2) reduction(+ : codes)
  for (int i = 0; i < 2; i++) {
    for (int n = 0; n < 20; n++) {
      rv_valve *valve;
      codes += rv_valve_new(&valve);
      codes += rv_valve_set_real(valve, "film.gap_mm", gap[i]);
      codes += rv_valve_run(valve);
      codes += rv_valve_measure(valve, "closing_ms", &together[i]);
      codes += rv_valve_free(&valve);
    }
  }
  CHECK(codes == 0);
  for (int i = 0; i < 2; i++) CHECK(together[i] == alone[i]);
  rv_valve *a, *b;
  double gap_a = 0.0;
  CHECK(rv_valve_new(&a) == RV_OK && rv_valve_new(&b) == RV_OK && a != b);
  GOOD(a, rv_valve_set_real(a, "film.gap_mm", 0.07));
  GOOD(b, rv_valve_set_real(b, "film.gap_mm", 0.02));
  GOOD(a, rv_valve_get_real(a, "film.gap_mm", &gap_a));
  CHECK(gap_a == 0.07);
  rv_valve_free(&a);
  rv_valve_free(&b);
}

/* What keys and messages are made of is not shared between threads: each sees its own texts. */
static void test_texts_at_once(void) {
  static const char *const key[2] = {"film.gap", "pressure.inlet_kp"};
  static const char *const said[2] = {"'film.gap': there is no such key; did you mean 'film.gap_mm'?",
                                      "'pressure.inlet_kp': there is no such key; did you mean 'pressure.inlet_kpa'?"};
  static const char *const model[2] = {"film_table", "squeeze"};
  int wrong = 0;
#pragma omp parallel for num_threads(2) reduction(+ : wrong)
  for (int i = 0; i < 2; i++) {
    rv_valve *valve;
    char text[200];
    wrong += rv_valve_new(&valve) != RV_OK;
    for (int n = 0; n < 3000; n++) {
      wrong += rv_valve_set_real(valve, key[i], 1.0) != RV_BAD_INPUT;
      rv_valve_message(valve, text, sizeof text);
      wrong += strcmp(text, said[i]) != 0;
      wrong += rv_valve_set_text(valve, "run.model", model[i]) != RV_OK;
      wrong += rv_valve_get_text(valve, "run.model", text, sizeof text) != RV_OK;
      wrong += strcmp(text, model[i]) != 0;
    }
    wrong += rv_valve_free(&valve) != RV_OK;
  }
  CHECK(wrong == 0);
}

static void test_settings(void) {
  rv_valve *valve;
  double value = 0.0;
  int is_set = -1;
  char text[100];
  CHECK(rv_valve_new(&valve) == RV_OK);
  GOOD(valve, rv_valve_get_real(valve, "film.gap_mm", &value));
  CHECK(value == 0.05); /* the default of docs/decks.md */
  GOOD(valve, rv_valve_is_set(valve, "film.gap_mm", &is_set));
  CHECK(is_set == 0);
  GOOD(valve, rv_valve_get_text(valve, "run.start", text, sizeof text));
  CHECK(strcmp(text, "rest") == 0);
  GOOD(valve, rv_valve_get_text(valve, "Film.Gap_mm", text, sizeof text));
  CHECK(strcmp(text, "0.05") == 0);
  GOOD(valve, rv_valve_get_text(valve, "run.model", text, 4));
  CHECK(strcmp(text, "squ") == 0);
  GOOD(valve, rv_valve_set_text(valve, "film.gap_mm", "0.04"));
  GOOD(valve, rv_valve_is_set(valve, "FILM.gap_mm", &is_set));
  CHECK(is_set == 1);
  CHECK(rv_valve_is_set(valve, "film.gap", &is_set) == RV_BAD_INPUT);
  CHECK(rv_valve_is_set(valve, "film.gap_mm", NULL) == RV_BAD_INPUT);
  GOOD(valve, rv_valve_get_real(valve, "film.gap_mm", &value));
  CHECK(value == 0.04);
  GOOD(valve, rv_valve_set_real(valve, "film.gap_mm", 0.1 + 0.2)); /* 17 digits survive */
  GOOD(valve, rv_valve_get_real(valve, "film.gap_mm", &value));
  CHECK(fabs(value - 0.3) < 1e-15);
  GOOD(valve, rv_valve_set_real(valve, "reed.width_mm", 6000.0 / 10.0));
  rv_valve_message(valve, text, sizeof text);
  CHECK(strstr(text, "unusually large for mm") != NULL);
  GOOD(valve, rv_valve_get_real(valve, "pressure.event_ms", &value));
  CHECK(isnan(value));
  for (int i = 1; i >= 0; i--) {
    GOOD(valve, rv_valve_set_real(valve, "run.traces", i));
    GOOD(valve, rv_valve_get_real(valve, "run.traces", &value));
    CHECK(value == i);
  }
  GOOD(valve, rv_valve_set_real(valve, "solver.max_steps", 1000.0));
  GOOD(valve, rv_valve_set_text(valve, "run.title", "It's a title"));
  GOOD(valve, rv_valve_get_text(valve, "run.title", text, sizeof text));
  CHECK(strcmp(text, "It's a title") == 0);
  rv_valve_free(&valve);
  CHECK(rv_key_count() > 30);
  CHECK(rv_key_name(0, text, sizeof text) == RV_OK && strcmp(text, "run.title") == 0);
  CHECK(rv_key_unit(3, text, sizeof text) == RV_OK && strcmp(text, "ms") == 0);
  CHECK(rv_key_name(rv_key_count(), text, sizeof text) == RV_BAD_INPUT && text[0] == '\0');
  CHECK(rv_key_help(1, text, sizeof text) == RV_OK && strncmp(text, "the valve model", 15) == 0);
  CHECK(rv_key_help(-1, text, sizeof text) == RV_BAD_INPUT && text[0] == '\0');
  CHECK(rv_key_kind(0) == RV_TEXT && rv_key_kind(1) == RV_CHOICE && rv_key_kind(3) == RV_REAL);
  CHECK(rv_key_kind(4) == RV_LOGICAL && rv_key_kind(6) == RV_INTEGER);
  CHECK(rv_key_kind(-1) == 0 && rv_key_kind(rv_key_count()) == 0);
  CHECK(rv_version_text(text, sizeof text) == RV_OK && strcmp(text, VERSION) == 0);
  CHECK(rv_measure_name(0, text, sizeof text) == RV_OK && strcmp(text, "steady_mm") == 0);
  CHECK(rv_measure_unit(8, text, sizeof text) == RV_OK && strcmp(text, "N") == 0);
  CHECK(rv_trace_name(RV_LEAKAGE, text, sizeof text) == RV_OK && strcmp(text, "leakage_mm3_ms") == 0);
  CHECK(rv_measure_name(-1, text, sizeof text) == RV_BAD_INPUT);
  CHECK(rv_measure_name(0, NULL, sizeof text) == RV_BAD_INPUT && rv_trace_unit(0, NULL, 0) == RV_BAD_INPUT);
  CHECK(rv_key_name(0, NULL, sizeof text) == RV_BAD_INPUT && rv_key_unit(0, NULL, sizeof text) == RV_BAD_INPUT);
  CHECK(rv_key_help(0, NULL, sizeof text) == RV_BAD_INPUT && rv_version_text(NULL, sizeof text) == RV_BAD_INPUT);
}

static void test_wrong_settings(void) {
  rv_valve *valve;
  double value = 0.0;
  char text[10] = "old";
  CHECK(rv_valve_new(&valve) == RV_OK);
  FAILS(valve, rv_valve_set_real(valve, "film.gap_mm", -0.05), RV_BAD_INPUT, "film.gap_mm = -0.05: must be >= 0 (mm)");
  FAILS(valve, rv_valve_set_real(valve, "film.gap_mm", NAN), RV_BAD_INPUT, "NaN and infinity are not allowed");
  FAILS(valve, rv_valve_set_real(valve, "film.gap_mm", INFINITY), RV_BAD_INPUT, "NaN and infinity are not allowed");
  FAILS(valve, rv_valve_set_real(valve, "film.gap_m", 1.0), RV_BAD_INPUT, "did you mean 'film.gap_mm'?");
  FAILS(valve, rv_valve_set_real(valve, "gap_mm", 1.0), RV_BAD_INPUT, "'film.gap_mm'");
  FAILS(valve, rv_valve_set_real(valve, "", 1.0), RV_BAD_INPUT, "no such key");
  FAILS(valve, rv_valve_set_real(valve, "sweep.count", 2.0), RV_BAD_INPUT, "a sweep");
  FAILS(valve, rv_valve_set_real(valve, "film.fields_ms", 2.0), RV_BAD_INPUT, "pressure fields");
  FAILS(valve, rv_valve_set_real(valve, "solver.max_steps", 1.5), RV_BAD_INPUT, "whole number");
  FAILS(valve, rv_valve_set_real(valve, "pressure.file", 1.0), RV_BAD_INPUT, "as text");
  FAILS(valve, rv_valve_set_text(valve, "run.model", "squeze"), RV_BAD_INPUT, "did you mean 'squeeze'?");
  FAILS(valve, rv_valve_set_text(valve, "film.gap_mm", "0.05mm"), RV_BAD_INPUT, "its unit is mm");
  FAILS(valve, rv_valve_set_real(valve, NULL, 1.0), RV_BAD_INPUT, "NULL");
  FAILS(valve, rv_valve_set_text(valve, "run.model", NULL), RV_BAD_INPUT, "NULL");
  FAILS(valve, rv_valve_get_real(valve, "run.model", &value), RV_BAD_INPUT, "as text");
  CHECK(isnan(value));
  FAILS(valve, rv_valve_get_real(valve, "film.gap_mm", NULL), RV_BAD_INPUT, "NULL");
  FAILS(valve, rv_valve_get_text(valve, "film.gap_mm", NULL, 10), RV_BAD_INPUT, "NULL");
  FAILS(valve, rv_valve_get_text(valve, NULL, text, sizeof text), RV_BAD_INPUT, "NULL");
  CHECK(strcmp(text, "") == 0);
  FAILS(valve, rv_valve_get_text(valve, "film.gapp_mm", text, sizeof text), RV_BAD_INPUT, "film.gap_mm");
  FAILS(valve, rv_valve_set_real(valve, "run.traces", 2.0), RV_BAD_INPUT, ".true. or .false.");
  GOOD(valve, rv_valve_get_real(valve, "film.gap_mm", &value));
  CHECK(value == 0.05); /* nothing of all that was set */
  GOOD(valve, rv_valve_set_real(valve, "reed.hole_diameter_mm", 7.0));
  FAILS(valve, rv_valve_run(valve), RV_BAD_INPUT, "must not exceed reed.width_mm");
  GOOD(valve, rv_valve_set_real(valve, "reed.width_mm", 8.0));
  GOOD(valve, rv_valve_run(valve));
  GOOD(valve, rv_valve_set_text(valve, "pressure.kind", "trace"));
  FAILS(valve, rv_valve_run(valve), RV_BAD_INPUT, "needs pressure.file");
  GOOD(valve, rv_valve_set_text(valve, "pressure.file", "there_is_none.csv"));
  FAILS(valve, rv_valve_run(valve), RV_BAD_INPUT, "there_is_none.csv");
  char *longest = malloc(6000);
  memset(longest, 'x', 5999);
  longest[5999] = '\0';
  FAILS(valve, rv_valve_set_text(valve, "run.title", longest), RV_BAD_INPUT, "too long");
  longest[300] = '\0';
  FAILS(valve, rv_valve_set_text(valve, "run.title", longest), RV_BAD_INPUT, "at most 200");
  free(longest);
  rv_valve_free(&valve);
}

/* Numbers of the model behind the case; which method it was integrated with is one of them. */
static void test_facts(void) {
  rv_valve *valve;
  double value = 0.0;
  char text[40];
  CHECK(rv_valve_new(&valve) == RV_OK);
  FAILS(valve, rv_valve_fact(valve, "reynolds", &value), RV_BAD_INPUT, "run the valve first");
  for (int explicit = 0; explicit < 2; explicit++) {
    GOOD(valve, rv_valve_set_text(valve, "solver.method", explicit ? "explicit" : "implicit"));
    GOOD(valve, rv_valve_run(valve));
    GOOD(valve, rv_valve_fact(valve, "solver_method", &value));
    CHECK(value == 1.0 + explicit);
  }
  GOOD(valve, rv_valve_fact(valve, "wet_frequency_hz", &value));
  CHECK(fabs(value - 769.946) < 1e-3); /* the defaults', of results.nc */
  GOOD(valve, rv_valve_fact(valve, "lowest_film_kpa", &value));
  CHECK(isnan(value)); /* no film model */
  CHECK(rv_fact_count() == 8);
  CHECK(rv_fact_name(7, text, sizeof text) == RV_OK && strcmp(text, "solver_method") == 0);
  CHECK(rv_fact_unit(0, text, sizeof text) == RV_OK && strcmp(text, "N m-1") == 0);
  CHECK(rv_fact_name(8, text, sizeof text) == RV_BAD_INPUT && text[0] == '\0');
  rv_valve_free(&valve);
}

static void test_wrong_order(void) {
  rv_valve *valve;
  double value = 0.0;
  int status = 0;
  size_t samples = 0;
  CHECK(rv_valve_new(&valve) == RV_OK);
  FAILS(valve, rv_valve_measure(valve, "steady_mm", &value), RV_BAD_INPUT, "run the valve first");
  FAILS(valve, rv_valve_status(valve, &status), RV_BAD_INPUT, "run the valve first");
  FAILS(valve, rv_valve_trace_size(valve, &samples), RV_BAD_INPUT, "run the valve first");
  GOOD(valve, rv_valve_run(valve));
  FAILS(valve, rv_valve_trace_times(valve, &value, 1), RV_BAD_INPUT, "set run.traces to .true.");
  FAILS(valve, rv_valve_measure(valve, "stedy_mm", &value), RV_BAD_INPUT, "no such name");
  CHECK(isnan(value));
  FAILS(valve, rv_valve_fact(valve, "reynold", &value), RV_BAD_INPUT, "'reynold': there is no such name");
  FAILS(valve, rv_valve_fact(valve, "reynolds", NULL), RV_BAD_INPUT, "NULL");
  FAILS(valve, rv_valve_measure(valve, NULL, &value), RV_BAD_INPUT, "NULL");
  FAILS(valve, rv_valve_measure(valve, "steady_mm", NULL), RV_BAD_INPUT, "NULL");
  GOOD(valve, rv_valve_set_real(valve, "film.gap_mm", 0.04));
  FAILS(valve, rv_valve_measure(valve, "steady_mm", &value), RV_BAD_INPUT, "run the valve first");
  GOOD(valve, rv_valve_set_real(valve, "film.gap_mm", 0.0));
  FAILS(valve, rv_valve_run(valve), RV_DOMAIN, "the gap is 0");
  GOOD(valve, rv_valve_status(valve, &status));
  CHECK(status == RV_CASE_FILM_CLOSED);
  GOOD(valve, rv_valve_measure(valve, "steady_mm", &value));
  CHECK(isnan(value));
  GOOD(valve, rv_valve_set_real(valve, "film.gap_mm", 0.05));
  GOOD(valve, rv_valve_set_real(valve, "solver.max_steps", 3.0));
  FAILS(valve, rv_valve_run(valve), RV_NOT_CONVERGED, "max_steps");
  rv_valve_free(&valve);
}

static void test_handles(void) {
  rv_valve *valve, *copy, *stray = (rv_valve *)&valve;
  char text[100] = "";
  double value;
  CHECK(rv_valve_new(NULL) == RV_BAD_INPUT);
  CHECK(rv_valve_free(NULL) == RV_OK);
  CHECK(rv_valve_run(NULL) == RV_BAD_INPUT);
  CHECK(rv_valve_message(NULL, text, sizeof text) == RV_BAD_INPUT);
  CHECK(strstr(text, "NULL") != NULL);
  CHECK(rv_valve_message(NULL, NULL, 0) == RV_BAD_INPUT);
  CHECK(rv_valve_new(&valve) == RV_OK);
  CHECK(rv_valve_message(valve, NULL, 10) == RV_BAD_INPUT);
  copy = valve;
  CHECK(rv_valve_free(&valve) == RV_OK);
  FAILS(copy, rv_valve_run(copy), RV_BAD_INPUT, "closed");
  CHECK(rv_valve_new(&valve) == RV_OK && valve != copy); /* in the same place */
  FAILS(copy, rv_valve_set_real(copy, "film.gap_mm", 0.1), RV_BAD_INPUT, "closed");
  CHECK(rv_valve_free(&copy) == RV_BAD_INPUT && copy == NULL);
  GOOD(valve, rv_valve_get_real(valve, "film.gap_mm", &value));
  FAILS(stray, rv_valve_begin(stray, 0.0), RV_BAD_INPUT, "never was one");
  CHECK(rv_valve_free(&valve) == RV_OK);
}

static void write_deck(const char *name, const char *text) {
  FILE *file = fopen(name, "w");
  if (file == NULL) return;
  fputs(text, file);
  fclose(file);
}

static void test_decks(void) {
  rv_valve *valve = NULL;
  char text[2000];
  double value = 0.0;
  write_deck("api_one.nml", "&film gap_mm = 0.04 /\n&pressure inlet_kpa = 30.0 /\n");
  CHECK(rv_valve_new_deck("api_one.nml", &valve, text, sizeof text) == RV_OK);
  CHECK(text[0] == '\0');
  GOOD(valve, rv_valve_get_real(valve, "pressure.inlet_kpa", &value));
  CHECK(value == 30.0);
  GOOD(valve, rv_valve_run(valve));
  rv_valve_free(&valve);
  write_deck("api_bad.nml", "&film gap_m = 0.04, k_s = -1.0 /\n");
  CHECK(rv_valve_new_deck("api_bad.nml", &valve, text, sizeof text) == RV_BAD_INPUT);
  CHECK(valve == NULL);
  CHECK(strstr(text, "did you mean 'gap_mm'?") != NULL && strstr(text, "film.k_s = -1.0") != NULL); /* both faults */
  CHECK(text[strlen(text) - 1] != '\n');
  write_deck("api_two.nml", "&sweep key = 'film.gap_mm', values = 0.04, 0.05 /\n");
  CHECK(rv_valve_new_deck("api_two.nml", &valve, text, sizeof text) == RV_BAD_INPUT);
  CHECK(strstr(text, "2 cases") != NULL);
  write_deck("api_swept.nml", "&sweep key = 'film.gap_mm', values = 0.04 /\n");
  CHECK(rv_valve_new_deck("api_swept.nml", &valve, NULL, 0) == RV_OK);
  GOOD(valve, rv_valve_get_real(valve, "film.gap_mm", &value));
  CHECK(value == 0.04);
  rv_valve_free(&valve);
  write_deck("api_fields.nml", "&run model = 'film' /\n&film fields_ms = 1.0 /\n");
  CHECK(rv_valve_new_deck("api_fields.nml", &valve, text, sizeof text) == RV_OK);
  CHECK(strstr(text, "api_fields.nml: warning: film.fields_ms: pressure fields go to the results") != NULL);
  rv_valve_free(&valve);
  CHECK(rv_valve_new_deck("there_is_none.nml", &valve, text, sizeof text) == RV_IO);
  CHECK(strstr(text, "there_is_none.nml") != NULL);
  CHECK(rv_valve_new_deck(NULL, &valve, text, sizeof text) == RV_BAD_INPUT);
  CHECK(rv_valve_new_deck("api_one.nml", NULL, text, sizeof text) == RV_BAD_INPUT);
}

/* A trace file in a deck, and then a square wave in its place: the defaults follow the kind. */
static void test_measured_pressure(void) {
  rv_valve *valve = NULL;
  char text[1000];
  write_deck("api_trace.csv", "t_ms,p_in_kpa,p_out_kpa\n0,0,0\n5,20,0\n10,20,0\n11,0,0\n20,0,0\n");
  write_deck("api_trace.nml", "&pressure kind = 'trace', file = 'api_trace.csv', event_ms = 10.0 /\n");
  CHECK(rv_valve_new_deck("api_trace.nml", &valve, text, sizeof text) == RV_OK);
  GOOD(valve, rv_valve_run(valve));
  GOOD(valve, rv_valve_get_text(valve, "run.start", text, sizeof text));
  CHECK(strcmp(text, "equilibrium") == 0);
  GOOD(valve, rv_valve_get_text(valve, "pressure.file", text, sizeof text));
  CHECK(strcmp(text, "api_trace.csv") == 0);
  GOOD(valve, rv_valve_set_text(valve, "pressure.kind", "square"));
  GOOD(valve, rv_valve_get_text(valve, "run.start", text, sizeof text));
  CHECK(strcmp(text, "rest") == 0);
  GOOD(valve, rv_valve_run(valve));
  rv_valve_message(valve, text, sizeof text);
  CHECK(strstr(text, "pressure.file has no effect") != NULL);
  rv_valve_free(&valve);
  if (system("mkdir -p api_folder && mv api_trace.csv api_trace.nml api_folder") != 0) return;
  CHECK(rv_valve_new_deck("api_folder/api_trace.nml", &valve, text, sizeof text) == RV_OK);
  GOOD(valve, rv_valve_run(valve));
  rv_valve_free(&valve);
}

int main(void) {
  test_run_twice();
  test_two_at_once();
  test_texts_at_once();
  test_settings();
  test_wrong_settings();
  test_facts();
  test_wrong_order();
  test_handles();
  test_decks();
  test_measured_pressure();
  return api_finish();
}
