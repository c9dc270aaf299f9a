/* Every SUNDIALS call of reedvalve: the lanes' vector, the stage solver and the integrator. */
#include "rv_arkode.h"

#include <arkode/arkode_arkstep.h>
#include <float.h>
#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sundials/sundials_context.h>
#include <sundials/sundials_nonlinearsolver.h>
#include <sundials/sundials_nvector.h>
#include <sundials/sundials_types.h>
#include <sundials/sundials_version.h>

#define SUNDIALS_NUMBER (SUNDIALS_VERSION_MAJOR * 100 + SUNDIALS_VERSION_MINOR)

/* Names and signatures that changed after 6.4. */
#if SUNDIALS_NUMBER >= 700
#define CONTEXT_CREATE(ctx) SUNContext_Create(SUN_COMM_NULL, ctx)
#else
#define CONTEXT_CREATE(ctx) SUNContext_Create(NULL, ctx)
#endif
#if SUNDIALS_NUMBER >= 701
#include <sunadaptcontroller/sunadaptcontroller_soderlind.h>
#define ARK(name) ARKode##name
#else
#define ARK(name) ARKStep##name
#endif

/* ---- Vector of lanes ------------------------------------------------------------------------ */

/* Vectors that are equal share their numbers, for ARKODE copies and clears more than it computes. Each vector brings
 * numbers along, so that one that is to be written finds some that nobody uses. Vectors never outlive their store. */
typedef struct numbers {
  int users; /* vectors that have these */
  double *data;
  struct numbers *next; /* free as well */
} numbers;

typedef struct {
  int lanes, states;
  numbers *zero, *free;
} lane_store;

typedef struct {
  lane_store *store;
  numbers *shared;
} lane_content;

static lane_store *store_of(N_Vector v) { return ((lane_content *)v->content)->store; }

static numbers **numbers_of(N_Vector v) { return &((lane_content *)v->content)->shared; }

static const double *values(N_Vector v) { return (*numbers_of(v))->data; }

static void release(lane_store *store, numbers *old) {
  if (--old->users > 0) return;
  old->next = store->free;
  store->free = old;
}

/* Let z have the numbers of another vector, or zeros. */
static void share(N_Vector z, numbers *with) {
  with->users++;
  release(store_of(z), *numbers_of(z));
  *numbers_of(z) = with;
}

/* Numbers of z's own, to be written one and all. What it had stays readable until the next call. */
static double *new_values(N_Vector z) {
  lane_store *store = store_of(z);
  numbers **own = numbers_of(z);
  if ((*own)->users > 1) {
    numbers *fresh = store->free;
    store->free = fresh->next;
    fresh->users = 1;
    (*own)->users--;
    *own = fresh;
  }
  return (*own)->data;
}

static sunindextype count(N_Vector v) {
  const lane_store *store = store_of(v);
  return (sunindextype)store->lanes * store->states;
}

static bool is_zero(N_Vector v) { return *numbers_of(v) == store_of(v)->zero; }

static N_Vector lanes_new(SUNContext context, lane_store *store);

static N_Vector_ID lanes_id(N_Vector v) {
  (void)v;
  return SUNDIALS_NVEC_CUSTOM;
}

static N_Vector lanes_clone(N_Vector v) { return lanes_new(v->sunctx, store_of(v)); }

static void drop_numbers(numbers *these) {
  if (these != NULL) free(these->data);
  free(these);
}

/* With the vector goes the room that came with it. */
static void lanes_destroy(N_Vector v) {
  if (v == NULL) return;
  if (v->content != NULL) {
    lane_store *store = store_of(v);
    numbers *one;
    release(store, *numbers_of(v));
    one = store->free;
    store->free = one->next;
    drop_numbers(one);
  }
  free(v->content);
  v->content = NULL;
  N_VFreeEmpty(v);
}

static void lanes_space(N_Vector v, sunindextype *reals, sunindextype *integers) {
  *reals = count(v);
  *integers = 2;
}

static void lanes_scale(sunrealtype c, N_Vector x, N_Vector z) {
  const double *xd = values(x);
  const sunindextype n = count(z);
  double *zd;
  if (c == 0.0 || c == 1.0) {
    share(z, c == 0.0 ? store_of(z)->zero : *numbers_of(x));
    return;
  }
  zd = new_values(z);
  for (sunindextype i = 0; i < n; i++) zd[i] = c * xd[i];
}

static void lanes_const(sunrealtype c, N_Vector z) {
  const sunindextype n = count(z);
  double *zd;
  if (c == 0.0) {
    share(z, store_of(z)->zero);
    return;
  }
  zd = new_values(z);
  for (sunindextype i = 0; i < n; i++) zd[i] = c;
}

static void lanes_linear_sum(sunrealtype a, N_Vector x, sunrealtype b, N_Vector y, N_Vector z) {
  const double *xd = values(x), *yd = values(y);
  const sunindextype n = count(z);
  double *zd;
  if (xd == yd) {
    lanes_scale(a + b, x, z);
  } else if (is_zero(y)) {
    lanes_scale(a, x, z);
  } else if (is_zero(x)) {
    lanes_scale(b, y, z);
  } else {
    zd = new_values(z);
    for (sunindextype i = 0; i < n; i++) zd[i] = a * xd[i] + b * yd[i];
  }
}

static void lanes_prod(N_Vector x, N_Vector y, N_Vector z) {
  const double *xd = values(x), *yd = values(y);
  double *zd = new_values(z);
  const sunindextype n = count(z);
  for (sunindextype i = 0; i < n; i++) zd[i] = xd[i] * yd[i];
}

static void lanes_div(N_Vector x, N_Vector y, N_Vector z) {
  const double *xd = values(x), *yd = values(y);
  double *zd = new_values(z);
  const sunindextype n = count(z);
  for (sunindextype i = 0; i < n; i++) zd[i] = xd[i] / yd[i];
}

static void lanes_abs(N_Vector x, N_Vector z) {
  const double *xd = values(x);
  double *zd = new_values(z);
  const sunindextype n = count(z);
  for (sunindextype i = 0; i < n; i++) zd[i] = fabs(xd[i]);
}

static void lanes_inv(N_Vector x, N_Vector z) {
  const double *xd = values(x);
  double *zd = new_values(z);
  const sunindextype n = count(z);
  for (sunindextype i = 0; i < n; i++) zd[i] = 1.0 / xd[i];
}

static void lanes_add_const(N_Vector x, sunrealtype b, N_Vector z) {
  const double *xd = values(x);
  double *zd = new_values(z);
  const sunindextype n = count(z);
  for (sunindextype i = 0; i < n; i++) zd[i] = xd[i] + b;
}

static sunrealtype lanes_max_norm(N_Vector x) {
  const double *xd = values(x);
  const sunindextype n = count(x);
  double largest = 0.0;
  for (sunindextype i = 0; i < n; i++) largest = fmax(largest, fabs(xd[i]));
  return largest;
}

static sunrealtype lanes_min(N_Vector x) {
  const double *xd = values(x);
  const sunindextype n = count(x);
  double smallest = xd[0];
  for (sunindextype i = 1; i < n; i++) smallest = fmin(smallest, xd[i]);
  return smallest;
}

/* Eight entries that lie in registers (vector types of gcc and clang), and what comparing them gives. */
typedef double octet __attribute__((vector_size(64), aligned(8), may_alias));
typedef long long octet_mask __attribute__((vector_size(64), aligned(8), may_alias));

/* The largest of the lanes' norms; an error that is not finite is as large as to be rejected. */
static sunrealtype lanes_wrms_norm(N_Vector x, N_Vector w) {
  const lane_store *store = store_of(x);
  const double *xd = values(x), *wd = values(w);
  const size_t lanes = (size_t)store->lanes;
  octet most = {0.0};
  octet_mask finite = ~(octet_mask){0};
  size_t i = 0;
  for (; i + 8 <= lanes; i += 8) {
    octet sum = {0.0};
    for (int k = 0; k < store->states; k++) {
      const octet e = *(const octet *)(xd + k * lanes + i) * *(const octet *)(wd + k * lanes + i);
      sum += e * e;
    }
    const octet_mask larger = sum > most;
    most = (octet)((larger & (octet_mask)sum) | (~larger & (octet_mask)most));
    finite &= sum <= DBL_MAX;
  }
  double largest = 0.0;
  int bad = 0;
  for (int j = 0; j < 8; j++) {
    largest = most[j] > largest ? most[j] : largest;
    bad |= !finite[j];
  }
  for (; i < lanes; i++) {
    double sum = 0.0;
    for (int k = 0; k < store->states; k++) {
      const double e = xd[k * lanes + i] * wd[k * lanes + i];
      sum += e * e;
    }
    largest = sum > largest ? sum : largest;
    bad |= !(sum <= DBL_MAX);
  }
  return bad ? 1.0e30 : sqrt(largest / store->states);
}

/* z = sum of c[j] x[j] in one pass, thirty-two entries at a time; ARKODE lets z be x[0]. */
enum { most_terms = 16 }; /* of one pass: stages of a table and the state */

static int lanes_linear_combination(int terms, sunrealtype *c, N_Vector *x, N_Vector z) {
  const double *xd[most_terms];
  double factor[most_terms];
  const sunindextype n = count(z);
  double *zd;
  sunindextype i = 0;
  int used = 0;
  if (terms > most_terms) return -1;
  for (int j = 0; j < terms; j++) {
    if (is_zero(x[j])) continue;
    xd[used] = values(x[j]);
    factor[used++] = c[j];
  }
  zd = new_values(z);
  for (; i + 32 <= n; i += 32) {
    octet sum[4] = {{0.0}};
    for (int j = 0; j < used; j++) {
      const octet *next = (const octet *)(xd[j] + i);
      for (int k = 0; k < 4; k++) sum[k] += factor[j] * next[k];
    }
    for (int k = 0; k < 4; k++) ((octet *)(zd + i))[k] = sum[k];
  }
  for (; i < n; i++) {
    double sum = 0.0;
    for (int j = 0; j < used; j++) sum += factor[j] * xd[j][i];
    zd[i] = sum;
  }
  return 0;
}

/* Room for one vector more, in use by `users`. NULL: there is no memory. */
static numbers *new_numbers(const lane_store *store, int users) {
  const size_t bytes = ((size_t)store->lanes * store->states * sizeof(double) + 63) / 64 * 64;
  numbers *fresh = malloc(sizeof *fresh);
  double *data = aligned_alloc(64, bytes);
  if (fresh == NULL || data == NULL) {
    free(fresh);
    free(data);
    return NULL;
  }
  memset(data, 0, bytes);
  *fresh = (numbers){users, data, NULL};
  return fresh;
}

static N_Vector lanes_new(SUNContext context, lane_store *store) {
  N_Vector v = N_VNewEmpty(context);
  lane_content *c = malloc(sizeof *c);
  numbers *fresh = new_numbers(store, 1);
  if (v == NULL || c == NULL || fresh == NULL) {
    drop_numbers(fresh);
    free(c);
    if (v != NULL) N_VFreeEmpty(v);
    return NULL;
  }
  *c = (lane_content){store, fresh};
  v->content = c;
  v->ops->nvgetvectorid = lanes_id;
  v->ops->nvclone = lanes_clone;
  v->ops->nvdestroy = lanes_destroy;
  v->ops->nvspace = lanes_space;
  v->ops->nvgetlength = count;
  v->ops->nvlinearsum = lanes_linear_sum;
  v->ops->nvconst = lanes_const;
  v->ops->nvprod = lanes_prod;
  v->ops->nvdiv = lanes_div;
  v->ops->nvscale = lanes_scale;
  v->ops->nvabs = lanes_abs;
  v->ops->nvinv = lanes_inv;
  v->ops->nvaddconst = lanes_add_const;
  v->ops->nvmaxnorm = lanes_max_norm;
  v->ops->nvwrmsnorm = lanes_wrms_norm;
  v->ops->nvmin = lanes_min;
  v->ops->nvlinearcombination = lanes_linear_combination;
  return v;
}

struct rv_arkode {
  lane_store store;
  double first_step; /* of the start and of each corner; 0: all steps are of one length */
  int at_corner;     /* the last step ended at a stop time */
  rv_rhs_fn rhs;
  rv_stage_fn stage;
  rv_weight_fn weight;
  void *data;
  SUNContext context;
  void *memory;
  N_Vector y;
  SUNNonlinearSolver solver;
#if SUNDIALS_NUMBER >= 701
  SUNAdaptController controller;
#endif
  char message[256];
};

/* ---- Stage solver --------------------------------------------------------------------------- */

static SUNNonlinearSolver_Type stage_type(SUNNonlinearSolver solver) {
  (void)solver;
  return SUNNONLINEARSOLVER_FIXEDPOINT;
}

static int stage_set_function(SUNNonlinearSolver solver, SUNNonlinSolSysFn function) {
  (void)solver;
  (void)function;
  return 0;
}

/* ARKODE asks for the correction zcor of z = zpred + zcor with zcor = gamma f(t, z) + sdata. */
static int stage_solve(SUNNonlinearSolver solver, N_Vector guess, N_Vector correction, N_Vector weight,
                       sunrealtype tolerance, sunbooleantype setup, void *memory) {
  (void)guess;
  (void)weight;
  (void)tolerance;
  (void)setup;
  (void)memory;
  rv_arkode *self = solver->content;
  N_Vector predicted, stage, rhs, known;
  sunrealtype t, gamma;
  void *data;
  if (ARK(GetNonlinearSystemData)(self->memory, &t, &predicted, &stage, &rhs, &gamma, &known, &data) != 0)
    return SUN_NLS_MEM_NULL;
  const int flag = self->stage(t, gamma, values(predicted), values(known), new_values(correction), self->data);
  if (flag > 0) return SUN_NLS_CONV_RECVR;
  return flag < 0 ? SUN_NLS_EXT_FAIL : 0;
}

static SUNNonlinearSolver stage_solver_new(rv_arkode *self) {
  SUNNonlinearSolver solver = SUNNonlinSolNewEmpty(self->context);
  if (solver == NULL) return NULL;
  solver->ops->gettype = stage_type;
  solver->ops->solve = stage_solve;
  solver->ops->setsysfn = stage_set_function;
  solver->content = self;
  return solver;
}

/* ---- Integrator ----------------------------------------------------------------------------- */

static int call_rhs(sunrealtype t, N_Vector y, N_Vector ydot, void *data) {
  rv_arkode *self = data;
  return self->rhs(t, values(y), new_values(ydot), self->data);
}

static int call_weight(N_Vector y, N_Vector weight, void *data) {
  rv_arkode *self = data;
  return self->weight(values(y), new_values(weight), self->data);
}

/* SUNDIALS would print; keep its sentence for the caller instead. */
#if SUNDIALS_NUMBER >= 700
static void keep_message(int line, const char *function, const char *file, const char *message, SUNErrCode code,
                         void *data, SUNContext context) {
  (void)line;
  (void)file;
  (void)code;
  (void)context;
  rv_arkode *self = data;
  snprintf(self->message, sizeof self->message, "%s: %s", function, message);
}
#else
static void keep_message(int code, const char *module, const char *function, char *message, void *data) {
  (void)code;
  (void)module;
  rv_arkode *self = data;
  snprintf(self->message, sizeof self->message, "%s: %s", function, message);
}
#endif

/* Name the call that failed, unless SUNDIALS already said more. */
static int failed(rv_arkode *self, const char *call, int flag) {
  if (flag >= 0) return flag;
  if (self->message[0] == '\0') snprintf(self->message, sizeof self->message, "%s failed with flag %d", call, flag);
  return flag;
}

#define TRY(call)                                                 \
  do {                                                            \
    const int flag_ = (call);                                     \
    if (flag_ < 0) return failed(self, #call, flag_);             \
  } while (0)

/* Each setting that a later SUNDIALS changes the default of is set by name. */
static int configure(rv_arkode *self, const char *table) {
  void *m = self->memory;
#if SUNDIALS_NUMBER >= 700
  TRY(SUNContext_ClearErrHandlers(self->context));
  TRY(SUNContext_PushErrHandler(self->context, keep_message, self));
#else
  TRY(ARKStepSetErrHandlerFn(m, keep_message, self));
#endif
  TRY(ARK(SetUserData)(m, self));
  TRY(ARKStepSetTableName(m, table, "ARKODE_ERK_NONE"));
  TRY(ARK(SetNonlinearSolver)(m, self->solver));
  TRY(ARK(SetDeduceImplicitRhs)(m, SUNTRUE));
  TRY(ARK(SetPredictorMethod)(m, 0));
  TRY(ARK(WFtolerances)(m, call_weight));
  TRY(ARK(SetInterpolantType)(m, ARK_INTERP_LAGRANGE));
  TRY(ARK(SetMaxNumSteps)(m, -1));
  TRY(ARK(SetMaxHnilWarns)(m, -1));
  TRY(ARK(SetSafetyFactor)(m, 0.96));
  TRY(ARK(SetErrorBias)(m, 1.5));
  TRY(ARK(SetFixedStepBounds)(m, 1.0, 1.1));
  TRY(ARK(SetInitStep)(m, self->first_step));
  TRY(ARK(SetMaxErrTestFails)(m, 30));
#if SUNDIALS_NUMBER >= 701
  TRY(ARKodeSetAdaptController(m, self->controller));
#else
  TRY(ARKStepSetAdaptivityMethod(m, ARK_ADAPT_PID, 1, 0, NULL));
#endif
  return 0;
}

/* A state to or from its halves. */
static void put_state(rv_arkode *self, const double *q, const double *v) {
  const size_t half = (size_t)count(self->y) / 2;
  double *y = new_values(self->y);
  memcpy(y, q, half * sizeof(double));
  memcpy(y + half, v, half * sizeof(double));
}

static void get_state(rv_arkode *self, double *q, double *v) {
  const size_t half = (size_t)count(self->y) / 2;
  memcpy(q, values(self->y), half * sizeof(double));
  memcpy(v, values(self->y) + half, half * sizeof(double));
}

static int build(rv_arkode *self, double t0, const double *q0, const double *v0, const char *table) {
  if (CONTEXT_CREATE(&self->context) != 0) {
    snprintf(self->message, sizeof self->message, "SUNContext_Create failed");
    return -1;
  }
  self->store.zero = new_numbers(&self->store, 1);
  if (self->store.zero != NULL) self->y = lanes_new(self->context, &self->store);
  self->solver = stage_solver_new(self);
  if (self->y != NULL) {
    put_state(self, q0, v0);
    self->memory = ARKStepCreate(NULL, call_rhs, t0, self->y, self->context);
  }
#if SUNDIALS_NUMBER >= 701
  self->controller = SUNAdaptController_PID(self->context);
  if (self->controller == NULL) self->memory = NULL;
#endif
  if (self->solver == NULL || self->memory == NULL) {
    snprintf(self->message, sizeof self->message, "no memory for an integrator of %d lanes", self->store.lanes);
    return -1;
  }
  return configure(self, table);
}

int rv_arkode_new(int lanes, int states, double t0, const double *q0, const double *v0, const char *table, double first_step, rv_rhs_fn rhs,
                  rv_stage_fn stage, rv_weight_fn weight, void *data, rv_arkode **out) {
  rv_arkode *self = calloc(1, sizeof *self);
  *out = self;
  if (self == NULL) return -1;
  self->store.lanes = lanes;
  self->store.states = states;
  self->first_step = first_step;
  self->rhs = rhs;
  self->stage = stage;
  self->weight = weight;
  self->data = data;
  return build(self, t0, q0, v0, table);
}

/* Where the next step ends at the latest: the last two before a stop time share what is left. */
static int choose_end(rv_arkode *self, double t, double t_stop, double *end) {
  const double left = t_stop - t, rounding = 1.0e-9;
  double next;
  *end = t_stop;
  TRY(ARK(GetCurrentStep)(self->memory, &next));
  if (self->first_step > 0.0 && left > (1.0 + rounding) * next && left < 2.0 * next) *end = t + 0.5 * left;
  return 0;
}

/* The state in y is that of time t. What was known of errors and lengths of steps is not true of what follows. */
static int begin_anew(rv_arkode *self, double t) {
  self->at_corner = 0;
  if (self->first_step > 0.0) TRY(ARK(SetInitStep)(self->memory, self->first_step));
  TRY(ARK(Reset)(self->memory, t, self->y));
  return 0;
}

int rv_arkode_step(rv_arkode *self, double t_stop, double *t, double *q, double *v) {
  double end = t_stop;
  int flag;
  self->message[0] = '\0';
  if (self->at_corner) TRY(begin_anew(self, *t));
  TRY(choose_end(self, *t, t_stop, &end));
  TRY(ARK(SetStopTime)(self->memory, end));
  /* A step that does not move the time would be repeated for ever: fail instead. */
  TRY(ARK(SetMinStep)(self->memory, 4.0 * DBL_EPSILON * fmax(fabs(*t), fabs(t_stop))));
  flag = ARK(Evolve)(self->memory, end, self->y, t, ARK_ONE_STEP);
  if (flag < 0) return failed(self, "ARKODE", flag);
  get_state(self, q, v);
  self->at_corner = flag == ARK_TSTOP_RETURN && end == t_stop;
  return self->at_corner ? RV_AT_STOP : RV_STEPPED;
}

int rv_arkode_restart(rv_arkode *self, double t, const double *q, const double *v) {
  self->message[0] = '\0';
  put_state(self, q, v);
  return begin_anew(self, t);
}

int rv_arkode_fix_step(rv_arkode *self, double step) {
  self->first_step = 0.0;
  return failed(self, "fixed step", ARK(SetFixedStep)(self->memory, step));
}

int rv_arkode_worst_lane(rv_arkode *self) {
  N_Vector error = lanes_clone(self->y), weight = lanes_clone(self->y);
  const int lanes = self->store.lanes, states = self->store.states;
  int worst = 0;
  if (error != NULL && weight != NULL && ARK(GetEstLocalErrors)(self->memory, error) == 0 &&
      ARK(GetErrWeights)(self->memory, weight) == 0) {
    const double *e = values(error), *w = values(weight);
    double largest = -1.0;
    for (int i = 0; i < lanes; i++) {
      double sum = 0.0;
      for (int k = 0; k < states; k++) sum += fabs(e[k * lanes + i] * w[k * lanes + i]);
      if (!(sum <= largest)) {
        worst = i;
        largest = isnan(sum) ? HUGE_VAL : sum;
      }
    }
  }
  lanes_destroy(error);
  lanes_destroy(weight);
  return worst;
}

void rv_arkode_message(const rv_arkode *self, char *buffer, int size) {
  snprintf(buffer, (size_t)size, "%s", self != NULL ? self->message : "no memory");
}

void rv_arkode_free(rv_arkode **pointer) {
  rv_arkode *self = *pointer;
  *pointer = NULL;
  if (self == NULL) return;
#if SUNDIALS_NUMBER >= 701
  if (self->memory != NULL) ARKodeFree(&self->memory);
  if (self->controller != NULL) SUNAdaptController_Destroy(self->controller);
#else
  if (self->memory != NULL) ARKStepFree(&self->memory);
#endif
  if (self->solver != NULL) SUNNonlinSolFreeEmpty(self->solver);
  lanes_destroy(self->y);
  drop_numbers(self->store.zero);
  if (self->context != NULL) SUNContext_Free(&self->context);
  free(self);
}

void rv_sundials_version(char *buffer, int size) {
  if (SUNDIALSGetVersion(buffer, size) != 0) snprintf(buffer, (size_t)size, "unknown");
}
