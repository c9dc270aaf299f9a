// Boost.odeint: Cash-Karp 5(4) with its step control, one case at a time.
//
// The state is u and u' over their scales, so that odeint's one absolute tolerance fits both. Steps end at the corners of
// the pressure; the derivative at a step's start is kept when the step is rejected.
#include "peer.h"

#include <array>
#include <boost/numeric/odeint/algebra/array_algebra.hpp>
#include <boost/numeric/odeint/stepper/controlled_runge_kutta.hpp>
#include <boost/numeric/odeint/stepper/generation.hpp>
#include <boost/numeric/odeint/stepper/runge_kutta_cash_karp54.hpp>

namespace {

namespace odeint = boost::numeric::odeint;
using state = std::array<double, 2>;
using stepper = odeint::runge_kutta_cash_karp54<state, double, state, double, odeint::array_algebra>;

void solve(const peer_case *one, double rtol, double out[2]) {
   peer_valve valve;
   peer_ready(&valve, one);
   const double su = valve.u_scale, sv = valve.v_scale, per_u = sv / su;
   auto rate = [&valve, su, sv, per_u](const state &x, state &dxdt, double t) {
      dxdt[0] = per_u * x[1];
      dxdt[1] = peer_acceleration(&valve, t, su * x[0], sv * x[1]) / sv;
   };
   auto controlled = odeint::make_controlled(rtol, rtol, stepper());
   state x = {0.0, 0.0}, next, dxdt, slope;
   peer_fall fall = {};
   double t = 0.0, step = 1e-3 / per_u;
   for (int i = 0; i < n_corners - 1; i++) {
      const double end = valve.corner[i + 1];
      peer_enter(&valve, i);
      rate(x, dxdt, t);
      while (t < end) {
         const bool last = t + 1.000001 * step >= end;
         double from = t, dt = last ? end - t : step;
         const double tried = dt;
         if (controlled.try_step(rate, x, dxdt, from, next, dt) == odeint::fail) {
            step = dt;
            continue;
         }
         step = last ? std::max(step, dt) : dt;
         const double to = last ? end : t + tried;
         rate(next, slope, to);
         if (i >= event_corner && fall.found < n_levels && su * next[0] <= peer_level[fall.found] * valve.steady) {
            const peer_state l = {t, su * x[0], sv * x[1], sv * dxdt[1]};
            const peer_state r = {to, su * next[0], sv * next[1], sv * slope[1]};
            peer_observe(&fall, &valve, &l, &r);
         }
         t = to;
         x = next;
         dxdt = slope;
      }
   }
   peer_measure(&fall, &valve, out);
}

}  // namespace

int main(int argc, char **argv) { return peer_main(argc, argv, solve); }
