/* reedvalve: dynamics of cantilever reed valves with squeeze flow, as a C library.
 *
 * Results. Every function of type int returns RV_OK or another rv_code, but for the counts and rv_key_kind. Nothing is
 *    printed and the program is never stopped. After a call with a valve, rv_valve_message tells why it failed, or what
 *    it warns of; calls without a valve have their code alone.
 * Handles. An rv_valve is a handle, not an address to look behind. NULL, a closed handle, a copy of a closed one and any
 *    other pointer are RV_BAD_INPUT. What is made by rv_valve_new or rv_valve_new_deck is closed by rv_valve_free.
 * Ownership. Every other pointer is the caller's memory and is not kept after the call. Texts are NUL-terminated, at
 *    most 4096 bytes; those that are given back are cut to fit into the buffer of `size` bytes.
 * Units. Keys have the unit of decks, which their name ends in (film.gap_mm). Measures and traces have the unit their
 *    name ends in, too, as in summary.csv. Times, pressures, states and outputs of stepping are in SI: s, Pa, m, m/s, N,
 *    m3/s. What is not known or did not happen is NaN; so is a number that a call failed to tell, and a
 *    text is empty then. Arrays stay as they are.
 * Threads. Different valves may be used by different threads at once. One valve is for one thread at a time. A process
 *    that was forked from one whose sweeps ran on several threads runs its own on one.
 * Floating point. A caller who lets NaN or overflow stop the program (feenableexcept, -ffpe-trap) is not stopped by the
 *    library's own, and finds flags and traps as they were. */
#ifndef REEDVALVE_H
#define REEDVALVE_H

#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct rv_valve rv_valve;

enum rv_code {
  RV_OK = 0,
  RV_BAD_INPUT = 1,     /* the caller's data are not allowed, or the call is out of order */
  RV_IO = 2,            /* a file could not be read */
  RV_NOT_CONVERGED = 3, /* the integration gave up */
  RV_DOMAIN = 4,        /* the state left the model's domain: film closed, or not a number */
  RV_INTERNAL = 5       /* no memory, or a fault of the library */
};

/* How a case ended. */
enum rv_case {
  RV_CASE_OK = 0,
  RV_CASE_STEP_TOO_SMALL = 1,
  RV_CASE_FILM_CLOSED = 2,
  RV_CASE_NOT_FINITE = 3,
  RV_CASE_TOO_MANY_STEPS = 4,
  RV_CASE_NO_CONVERGENCE = 5,
  RV_CASE_BAD_CASE = 6
};

/* What a key takes. */
enum rv_kind {
  RV_REAL = 1,
  RV_INTEGER = 2,
  RV_LOGICAL = 3, /* .true. or .false. */
  RV_CHOICE = 4,  /* one of some words */
  RV_TEXT = 5
};

/* Outputs of stepping, at the time reached. Those after RV_FILM_FORCE are of the film models only, else NaN. */
enum rv_out {
  RV_DISPLACEMENT = 0, /* of the tip, positive when open [m] */
  RV_VELOCITY = 1,     /* of the tip [m/s] */
  RV_INLET = 2,        /* inlet pressure [Pa] */
  RV_OUTLET = 3,       /* outlet pressure [Pa] */
  RV_FILM_FORCE = 4,   /* of the film against the motion, referred to the tip, positive against closing [N] */
  RV_PART_A = 5,       /* pressure force on the land at x < a [N] */
  RV_PART_B = 6,       /* on the rest of the land [N] */
  RV_PART_C = 7,       /* over the hole [N] */
  RV_LEAKAGE = 8,      /* flow out of the film at the free edges [m3/s] */
  RV_FILM_LOW = 9      /* lowest pressure in the film [Pa] */
};

/* The version of the library, "0.1.0". */
int rv_version_text(char *buffer, size_t size);

/* ---- A valve and its settings ---- */

/* A valve with the defaults of a deck, see docs/decks.md. */
int rv_valve_new(rv_valve **out);

/* A valve with the settings of a deck of one case. On failure *out is NULL and `message`, which may be NULL, holds all
 * faults of the deck, one a line; on success its warnings. */
int rv_valve_new_deck(const char *path, rv_valve **out, char *message, size_t size);

/* Closes *self and makes it NULL. NULL, or a pointer to NULL, is fine. */
int rv_valve_free(rv_valve **self);

/* What the last call with this valve had to say; empty: nothing. */
int rv_valve_message(rv_valve *self, char *buffer, size_t size);

/* Set a key, "film.gap_mm", to a value in its unit or to a word: a choice, a file, .true. or .false., a number. Files are
 * relative to the folder of the deck that the valve was made of, else to where the program runs. The value is checked
 * here, what keys must share when it is used. Results and the state of stepping end with a new setting. */
int rv_valve_set_real(rv_valve *self, const char *key, double value);
int rv_valve_set_text(rv_valve *self, const char *key, const char *value);

/* The value of a key: as set, or the default; NaN or empty where the default follows from other keys, as the key's help
 * says. A logical is 1 or 0 as a number. */
int rv_valve_get_real(rv_valve *self, const char *key, double *value);
int rv_valve_get_text(rv_valve *self, const char *key, char *buffer, size_t size);

/* 1: the key was set, by the deck or since; 0: it has its default. */
int rv_valve_is_set(rv_valve *self, const char *key, int *is_set);

/* All keys, i from 0 to rv_key_count() - 1: name, unit, what it means, and its rv_kind (0: there is no such key). */
int rv_key_count(void);
int rv_key_name(int i, char *buffer, size_t size);
int rv_key_unit(int i, char *buffer, size_t size);
int rv_key_help(int i, char *buffer, size_t size);
int rv_key_kind(int i);

/* ---- Whole cases ---- */

/* Run the case under its own pressure history, to run.t_end_ms. */
int rv_valve_run(rv_valve *self);

/* An rv_case. */
int rv_valve_status(rv_valve *self, int *status);

/* A measure by its name, "steady_mm". Names and units: i from 0 to rv_measure_count() - 1. */
int rv_valve_measure(rv_valve *self, const char *name, double *value);
int rv_measure_count(void);
int rv_measure_name(int i, char *buffer, size_t size);
int rv_measure_unit(int i, char *buffer, size_t size);

/* A fact by its name, "wet_frequency_hz": a number of the model behind the case, as in results.nc. Names and units: i from 0
 * to rv_fact_count() - 1. Fact "solver_method" is 1 after an implicit integration, 2 after an explicit one. */
int rv_valve_fact(rv_valve *self, const char *name, double *value);
int rv_fact_count(void);
int rv_fact_name(int i, char *buffer, size_t size);
int rv_fact_unit(int i, char *buffer, size_t size);

/* Traces, if run.traces is .true.: the number of samples, their times [s], and trace i, in the order of rv_out, in the
 * unit rv_trace_unit(i). `samples` must be that number. */
int rv_valve_trace_size(rv_valve *self, size_t *samples);
int rv_valve_trace_times(rv_valve *self, double *times, size_t samples);
int rv_valve_trace(rv_valve *self, int i, double *values, size_t samples);
int rv_trace_count(void);
int rv_trace_name(int i, char *buffer, size_t size);
int rv_trace_unit(int i, char *buffer, size_t size);

/* Run n_cases cases that differ from the valve's settings in n_keys real keys. Key k of case c is
 * values[c*n_keys + k]; measure m of case c comes to measures[c*rv_measure_count() + m], its rv_case to status[c].
 * Cases that fail do not make the call fail; a value that is not allowed does, before any case is run. `threads` 0: as
 * many as OpenMP offers; no more are used than can work at once, and their number does not change a bit of the results.
 * Without memory for so many cases the call is RV_INTERNAL and runs none, as is rv_valve_run without it for its traces. */
int rv_sweep(rv_valve *self, int n_keys, const char *const *keys, size_t n_cases, const double *values, double *measures,
             int *status, int threads);

/* ---- Stepping under the caller's pressures ---- */

/* Begin at time t0 [s], which must be finite, else all stays as it is. The reed is at rest; with run.start =
 * 'equilibrium' it is at the equilibrium under the first step's first pressures. The tolerance solver.rtol is relative to
 * the motion under the largest pressure difference of the valve's own pressure history: set pressure.inlet_kpa and
 * pressure.outlet_kpa to what is to be expected. */
int rv_valve_begin(rv_valve *self, double t0);

/* Go on to t_end [s]. Inlet and outlet pressure [Pa] go straight from p_in0 and p_out0 now to p_in1 and p_out1 at t_end.
 * A step that fails for its numbers leaves all as it was; after one that the integration fails in, with
 * RV_NOT_CONVERGED or RV_DOMAIN, only rv_valve_state_restore or rv_valve_begin lead on. */
int rv_valve_step(rv_valve *self, double t_end, double p_in0, double p_in1, double p_out0, double p_out1);

/* An rv_out at the time reached. Steps do not hold RV_FILM_LOW against film.vapour_pressure_kpa, as whole cases do. */
int rv_valve_output(rv_valve *self, int which, double *value);

/* Degrees of freedom; and the state: time [s], displacement [m] and velocity [m/s] of each of them, and the length of step
 * that is tried first next [s] (0: not known yet). What is NULL is not told. */
int rv_valve_dofs(rv_valve *self, int *dofs);
int rv_valve_state(rv_valve *self, double *t, double *q, double *v, double *next_step);

/* Keep the state as bytes and go back to it: steps from there give the same bits. The bytes fit valves of the same model
 * and size on the same kind of machine; others, and damaged ones, are RV_BAD_INPUT. */
int rv_valve_state_size(rv_valve *self, size_t *bytes);
int rv_valve_state_save(rv_valve *self, void *bytes, size_t size);
int rv_valve_state_restore(rv_valve *self, const void *bytes, size_t size);

#ifdef __cplusplus
}
#endif

#endif
