/* One ARKODE integrator for `lanes` systems of `states` equations each, seen as plain arrays.
 *
 * Layout of a state: y[k*lanes + i] is equation k of lane i. The error norm is the largest of the
 * lanes' weighted root-mean-square norms, so that every lane honours the tolerance on its own. */
#ifndef RV_ARKODE_H
#define RV_ARKODE_H

typedef struct rv_arkode rv_arkode;

/* y' = f(t, y). 0: done; > 0: outside the model's domain, try a smaller step; < 0: give up. */
typedef int (*rv_rhs_fn)(double t, const double *y, double *ydot, void *data);

/* Solve z = predicted + known + gamma f(t, z) for every lane; out comes z - predicted. Returns as rv_rhs_fn. */
typedef int (*rv_stage_fn)(double t, double gamma, const double *predicted, const double *known, double *correction,
                           void *data);

/* Error weights, one over the allowed error of each entry. Returns 0, or < 0. */
typedef int (*rv_weight_fn)(const double *y, double *weight, void *data);

/* What a step returned; any negative value is ARKODE's own return flag. */
enum { RV_STEPPED = 0, RV_AT_STOP = 1 };

/* `table` is ARKODE's name of an implicit Butcher table, `first_step` the size of the first step to try. States come as
 * their first half q and their second half v. Functions of type int return 0 (rv_arkode_step: see above) or a negative flag; rv_arkode_message then
 * holds a sentence. rv_arkode_worst_lane returns the lane, from 0, with the largest error estimate. */
int rv_arkode_new(int lanes, int states, double t0, const double *q0, const double *v0, const char *table, double first_step, rv_rhs_fn rhs,
                  rv_stage_fn stage, rv_weight_fn weight, void *data, rv_arkode **self);
int rv_arkode_step(rv_arkode *self, double t_stop, double *t, double *q, double *v);
int rv_arkode_restart(rv_arkode *self, double t, const double *q, const double *v);
int rv_arkode_fix_step(rv_arkode *self, double step);
int rv_arkode_worst_lane(rv_arkode *self);
void rv_arkode_message(const rv_arkode *self, char *buffer, int size);
void rv_arkode_free(rv_arkode **self);
void rv_sundials_version(char *buffer, int size);

#endif
