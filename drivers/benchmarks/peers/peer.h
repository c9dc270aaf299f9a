/* What the peers share: the list of cases, the equation of motion, crossings on dense output, the list of times.
 *
 * m u'' + (c + C/h^3 [while u' < 0]) u' + k u = A p(t),  h = u + g0, over one period of the square wave, from rest.
 * Measures: fall, from 90 to 10 % of the steady displacement, and closing, from the start of the pressure's fall to 2 %.
 */
#ifndef RV_PEER_H
#define RV_PEER_H

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

enum { n_levels = 3, n_corners = 6 };
static const double peer_level[n_levels] = {0.90, 0.10, 0.02};          /* of the steady displacement [-] */
static const double peer_factor[n_corners] = {0.5, 1.0, 1.0, 0.0, 0.0, 0.5}; /* of the pressure at the corners [-] */
enum { event_corner = 2 };                                                /* where the pressure starts to fall */

/* One line of the list of cases, SI. */
struct peer_case {
   double mass, damping, stiffness, area; /* [kg], [N s m-1], [N m-1], [m2] */
   double squeeze, gap;                   /* C [N s m2], g0 [m] */
   double pressure, period, transition;   /* [Pa], [s], [s] */
};

/* A case made ready. */
struct peer_valve {
   struct peer_case data;
   double steady, u_scale, v_scale; /* static displacement; what tolerances are relative to [m], [m s-1] */
   double corner[n_corners];        /* of the pressure [s] */
   double p0, slope, t0;            /* pressure [Pa], its rate [Pa s-1] in the present part, and where that starts [s] */
};

static inline void peer_ready(struct peer_valve *valve, const struct peer_case *one) {
   const double half = 0.5 * one->transition, middle = 0.5 * one->period;
   valve->data = *one;
   valve->steady = one->pressure * one->area / one->stiffness;
   valve->u_scale = fmin(valve->steady, one->gap / 3.0);
   valve->v_scale = valve->u_scale * sqrt(one->stiffness / one->mass);
   valve->corner[0] = 0.0;
   valve->corner[1] = half;
   valve->corner[2] = middle - half;
   valve->corner[3] = middle + half;
   valve->corner[4] = one->period - half;
   valve->corner[5] = one->period;
}

/* Enter the part of the pressure between corners i and i + 1. */
static inline void peer_enter(struct peer_valve *valve, int i) {
   valve->t0 = valve->corner[i];
   valve->p0 = peer_factor[i] * valve->data.pressure;
   valve->slope =
       (peer_factor[i + 1] - peer_factor[i]) * valve->data.pressure / (valve->corner[i + 1] - valve->corner[i]);
}

/* u'' [m s-2]. */
static inline double peer_acceleration(const struct peer_valve *valve, double t, double u, double v) {
   const struct peer_case *d = &valve->data;
   const double h = u + d->gap;
   const double film = v < 0.0 ? d->squeeze / (h * h * h) : 0.0;
   return ((valve->p0 + valve->slope * (t - valve->t0)) * d->area - d->stiffness * u - (d->damping + film) * v) / d->mass;
}

/* State at one end of a step: t [s], u [m], v [m s-1], a [m s-2]. */
struct peer_state {
   double t, u, v, a;
};

/* Where the quintic through both ends of a step, with velocities and accelerations, falls through a level [s]. */
static inline double peer_crossing(const struct peer_state *l, const struct peer_state *r, double level) {
   const double h = r->t - l->t;
   const double rise = r->u - l->u - h * (l->v + 0.5 * h * l->a);
   const double dv = h * (r->v - l->v - h * l->a), da = h * h * (r->a - l->a);
   const double c[6] = {l->u - level,
                        h * l->v,
                        0.5 * h * h * l->a,
                        10.0 * rise - 4.0 * dv + 0.5 * da,
                        -15.0 * rise + 7.0 * dv - da,
                        6.0 * rise - 3.0 * dv + 0.5 * da};
   double low = 0.0, high = 1.0, s = (l->u - level) / (l->u - r->u);
   for (int i = 0; i < 60; i++) {
      double f = c[5], slope = 0.0;
      for (int k = 4; k >= 0; k--) {
         slope = slope * s + f;
         f = f * s + c[k];
      }
      if (f > 0.0)
         low = s;
      else
         high = s;
      double next = s - f / slope;
      if (!(next > low && next < high)) next = 0.5 * (low + high);
      if (fabs(next - s) < 1e-14) break;
      s = next;
   }
   return l->t + h * s;
}

/* Crossings of one case: found of them so far, in the order of the levels. */
struct peer_fall {
   int found;
   double time[n_levels]; /* [s] */
};

/* Take a step after the event into account. */
static inline void peer_observe(struct peer_fall *fall, const struct peer_valve *valve, const struct peer_state *l,
                                const struct peer_state *r) {
   while (fall->found < n_levels && r->u <= peer_level[fall->found] * valve->steady) {
      fall->time[fall->found] = peer_crossing(l, r, peer_level[fall->found] * valve->steady);
      fall->found++;
   }
}

/* Fall and closing time [s]; NaN where a level was not reached. */
static inline void peer_measure(const struct peer_fall *fall, const struct peer_valve *valve, double out[2]) {
   out[0] = fall->found > 1 ? fall->time[1] - fall->time[0] : NAN;
   out[1] = fall->found > 2 ? fall->time[2] - valve->corner[event_corner] : NAN;
}

static inline void peer_die(const char *what) {
   fprintf(stderr, "peer: %s\n", what);
   exit(1);
}

static inline double peer_seconds(void) {
   struct timespec now;
   clock_gettime(CLOCK_MONOTONIC, &now);
   return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

/* Solves one case to a tolerance; its times [s] into out. */
typedef void (*peer_solver)(const struct peer_case *one, double rtol, double out[2]);

static inline struct peer_case *peer_read(const char *path, size_t *count) {
   FILE *file = fopen(path, "r");
   char line[512];
   size_t room = 1024;
   struct peer_case *list = (struct peer_case *)malloc(room * sizeof *list);
   if (!file || !list || !fgets(line, sizeof line, file)) peer_die("the list of cases cannot be read");
   for (*count = 0; fgets(line, sizeof line, file); ++*count) {
      if (*count == room) list = (struct peer_case *)realloc(list, (room *= 2) * sizeof *list);
      if (!list) peer_die("no memory");
      struct peer_case *c = &list[*count];
      if (sscanf(line, "%lf,%lf,%lf,%lf,%lf,%lf,%lf,%lf,%lf", &c->mass, &c->damping, &c->stiffness, &c->area, &c->squeeze,
                 &c->gap, &c->pressure, &c->period, &c->transition) != 9)
         peer_die("a case needs nine numbers");
   }
   fclose(file);
   return list;
}

/* The program: PEER CASES RTOL SECONDS TIMES. The cases are solved again and again until SECONDS are over, once at least;
 * seconds of one round go to standard output, fall and closing times [ms] to the file TIMES. */
static inline int peer_main(int argc, char **argv, peer_solver solve) {
   size_t n;
   if (argc != 5) peer_die("usage: PEER CASES RTOL SECONDS TIMES");
   const struct peer_case *list = peer_read(argv[1], &n);
   const double rtol = atof(argv[2]), enough = atof(argv[3]);
   double(*times)[2] = (double(*)[2])malloc((n + 1) * sizeof *times);
   if (!times) peer_die("no memory");
   const double start = peer_seconds();
   double elapsed;
   int rounds = 0;
   do {
      for (size_t i = 0; i < n; i++) solve(&list[i], rtol, times[i]);
      rounds++;
      elapsed = peer_seconds() - start;
   } while (elapsed < enough);
   printf("%.6e\n", elapsed / rounds);
   FILE *file = fopen(argv[4], "w");
   if (!file) peer_die("the list of times cannot be written");
   for (size_t i = 0; i < n; i++) fprintf(file, "%.16e,%.16e\n", 1e3 * times[i][0], 1e3 * times[i][1]);
   if (fclose(file) != 0) peer_die("the list of times cannot be written");
   return 0;
}

#endif
