/* SUNDIALS CVODE: BDF with a dense 2 x 2 Jacobian, one case at a time, its memory used from case to case.
 *
 * It starts anew at the corners of the pressure: its history of smooth steps is worth nothing across them, and kept it
 * needs a ten times smaller tolerance for the same error. Crossings are found on the dense output's quintic, which is faster than
 * CVODE's own root finding.
 */
#include "peer.h"

#include <cvode/cvode.h>
#include <nvector/nvector_serial.h>
#include <sundials/sundials_config.h>
#include <sunlinsol/sunlinsol_dense.h>
#include <sunmatrix/sunmatrix_dense.h>

#if SUNDIALS_VERSION_MAJOR < 7
#define SUN_COMM_NULL NULL
typedef realtype sunrealtype;
#endif

static void *memory;
static N_Vector state, tolerance;
static struct peer_valve valve;

static int rate(sunrealtype t, N_Vector y, N_Vector ydot, void *unused) {
   const double *x = N_VGetArrayPointer(y);
   double *d = N_VGetArrayPointer(ydot);
   (void)unused;
   d[0] = x[1];
   d[1] = peer_acceleration(&valve, t, x[0], x[1]);
   return 0;
}

static int jacobian(sunrealtype t, N_Vector y, N_Vector fy, SUNMatrix J, void *unused, N_Vector a, N_Vector b, N_Vector c) {
   const double *x = N_VGetArrayPointer(y);
   double *j = SUNDenseMatrix_Data(J);
   const struct peer_case *d = &valve.data;
   const double h = x[0] + d->gap, film = x[1] < 0.0 ? d->squeeze / (h * h * h) : 0.0;
   (void)t, (void)fy, (void)unused, (void)a, (void)b, (void)c;
   j[0] = 0.0;
   j[1] = (3.0 * film * x[1] / h - d->stiffness) / d->mass;
   j[2] = 1.0;
   j[3] = -(d->damping + film) / d->mass;
   return 0;
}

static void must(int flag, const char *what) {
   if (flag < 0) peer_die(what);
}

static void set_up(void) {
   SUNContext context;
   must(SUNContext_Create(SUN_COMM_NULL, &context), "SUNContext_Create");
   state = N_VNew_Serial(2, context);
   tolerance = N_VNew_Serial(2, context);
   SUNMatrix matrix = SUNDenseMatrix(2, 2, context);
   SUNLinearSolver solver = SUNLinSol_Dense(state, matrix, context);
   memory = CVodeCreate(CV_BDF, context);
   if (!state || !tolerance || !matrix || !solver || !memory) peer_die("no memory");
   N_VConst(0.0, state);
   must(CVodeInit(memory, rate, 0.0, state), "CVodeInit");
   must(CVodeSetLinearSolver(memory, solver, matrix), "CVodeSetLinearSolver");
   must(CVodeSetJacFn(memory, jacobian), "CVodeSetJacFn");
   must(CVodeSetMaxNumSteps(memory, 1000000), "CVodeSetMaxNumSteps");
}

static struct peer_state state_at(double t) {
   const double *x = N_VGetArrayPointer(state);
   const struct peer_state now = {t, x[0], x[1], peer_acceleration(&valve, t, x[0], x[1])};
   return now;
}

static void solve(const struct peer_case *one, double rtol, double out[2]) {
   struct peer_fall fall = {0};
   peer_ready(&valve, one);
   N_VConst(0.0, state);
   N_VGetArrayPointer(tolerance)[0] = rtol * valve.u_scale;
   N_VGetArrayPointer(tolerance)[1] = rtol * valve.v_scale;
   for (int i = 0; i < n_corners - 1; i++) {
      sunrealtype t = valve.corner[i];
      peer_enter(&valve, i);
      must(CVodeReInit(memory, t, state), "CVodeReInit");
      if (i == 0) must(CVodeSVtolerances(memory, rtol, tolerance), "CVodeSVtolerances");
      struct peer_state before = state_at(t);
      must(CVodeSetStopTime(memory, valve.corner[i + 1]), "CVodeSetStopTime");
      for (int flag = CV_SUCCESS; flag != CV_TSTOP_RETURN;) {
         flag = CVode(memory, valve.corner[i + 1], state, &t, CV_ONE_STEP);
         must(flag, "CVode");
         if (i < event_corner || fall.found == n_levels) continue;
         const struct peer_state now = state_at(t);
         peer_observe(&fall, &valve, &before, &now);
         before = now;
      }
   }
   peer_measure(&fall, &valve, out);
}

int main(int argc, char **argv) {
   set_up();
   return peer_main(argc, argv, solve);
}
