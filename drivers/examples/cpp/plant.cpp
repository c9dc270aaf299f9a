// A pump chamber in front of the valve. A piston drives oil in, the valve lets it out, and the pressure follows from
// dp/dt = K/V (Q_piston - Q_valve): the plant is the caller's, the reed is the library's, and they meet every 20 us.
#include <reedvalve.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>
#include <stdexcept>

namespace {

const double pi = std::acos(-1.0);

// A valve that closes itself, with errors as exceptions.
class Valve {
 public:
  explicit Valve(double largest_pressure) {
    rv_valve *handle;
    check(rv_valve_new(&handle));
    self_.reset(handle);
    // what the tolerance is relative to
    check(rv_valve_set_real(handle, "pressure.inlet_kpa", largest_pressure / 1e3));
    check(rv_valve_begin(handle, 0.0));
  }

  // Go on to t [s] while the inlet pressure goes straight from p0 to p1 [Pa]; the outlet is at 0.
  void step(double t, double p0, double p1) { check(rv_valve_step(self_.get(), t, p0, p1, 0.0, 0.0)); }

  double opening() const {
    double u;
    check(rv_valve_output(self_.get(), RV_DISPLACEMENT, &u));
    return std::max(u, 0.0);
  }

 private:
  struct Close {
    void operator()(rv_valve *handle) const { rv_valve_free(&handle); }
  };

  void check(int code) const {
    if (code == RV_OK) return;
    char message[256] = "";
    rv_valve_message(self_.get(), message, sizeof message);
    throw std::runtime_error(message);
  }

  std::unique_ptr<rv_valve, Close> self_;
};

// The chamber and what flows through an opening of the valve.
struct Chamber {
  double stiffness = 0.7e9 / 20e-6;  // K/V, bulk modulus over volume [Pa/m3]
  double hole = 4e-3;                // diameter [m]
  double density = 875.0;            // [kg/m3]
  double pressure = 0.0;             // [Pa]

  // Flow = conductance * sqrt(pressure) through the curtain between hole and reed [m3/s/Pa^(1/2)]
  double conductance(double opening) const { return 0.65 * pi * hole * opening * std::sqrt(2.0 / density); }

  double flow(double opening) const {
    return std::copysign(conductance(opening) * std::sqrt(std::abs(pressure)), pressure);
  }

  // One implicit Euler step: p + c sqrt(p) = r, or its mirror image where the flow turns back. Below -2 kPa the suction
  // side opens.
  void step(double dt, double inflow, double opening) {
    const double c = dt * stiffness * conductance(opening);
    const double r = pressure + dt * stiffness * inflow;
    const double root = 0.5 * (std::sqrt(c * c + 4.0 * std::abs(r)) - c);
    pressure = std::max(std::copysign(root * root, r), -2e3);
  }
};

// Half a turn out, half a turn back [m3/s].
double piston(double t) { return 6e-6 * std::sin(pi * t / 20e-3); }

void run() {
  const double dt = 20e-6;
  Chamber chamber;
  Valve valve(20e3);
  double out = 0.0, back = 0.0;
  std::printf("t [ms]  p [kPa]  opening [mm]\n");
  for (int k = 1; k <= 1250; k++) {
    const double before = chamber.pressure;
    chamber.step(dt, piston(k * dt), valve.opening());
    valve.step(k * dt, before, chamber.pressure);
    const double flow = chamber.flow(valve.opening());
    (flow > 0.0 ? out : back) += flow * dt;
    if (k % 125 == 0)
      std::printf("%6.1f %8.2f %13.4f\n", 1e3 * k * dt, 1e-3 * chamber.pressure, 1e3 * valve.opening());
  }
  std::printf("Out: %.2f mm3; back, before the reed was on its seat: %.2f mm3.\n", 1e9 * out, -1e9 * back);
}

}  // namespace

int main() {
  try {
    run();
  } catch (const std::exception &error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
