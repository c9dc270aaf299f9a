"""Independent solution of the lumped models, the referee of the Fortran code.

Nothing here is shared with the Fortran code: integrals by Gauss quadrature instead of
closed forms, SciPy's integrators instead of ARKODE. The motion is cut wherever the
right-hand side has a corner, that is at the corners of the pressure history and at
every u' = 0 (where the squeeze force switches), so each piece is smooth and the
integrator keeps its order. SI units throughout.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field

import numpy as np
from scipy.integrate import solve_ivp
from scipy.optimize import brentq

RTOL = 1.0e-12
ATOL = np.array([1.0e-17, 1.0e-13])  # [m, m/s]: 1e-13 of the usual motion


@dataclass(frozen=True)
class Valve:
    """One valve; the defaults are Table II with the reading that reproduces the paper."""

    a: float = 2.5e-3  # clamp to hole edge [m]
    b: float = 1.0e-3  # hole edge to tip [m]
    hole: float = 4.0e-3  # hole diameter D [m]
    width: float = 6.0e-3  # B [m]
    thickness: float = 0.15e-3  # h [m]
    density: float = 8950.0  # [kg/m3]
    youngs: float = 110.0e9  # [Pa]
    k_a: float = 0.91  # stiffness factor of Eq. (18) [-]
    area: float = 12.56e-6  # action area A [m2]
    oil_density: float = 875.0  # [kg/m3]
    viscosity: float = 0.0484  # [Pa s]
    gap: float = 0.05e-3  # film thickness at rest g0 [m]
    k_s: float = 0.0075  # squeeze factor of Eq. (26) [-]
    load: str = "published"  # 'published' | 'maali' | 'none'

    @property
    def length(self) -> float:
        """L = a + D + b [m]."""
        return self.a + self.hole + self.b

    def shape(self, x: np.ndarray) -> np.ndarray:
        """Deflection at x over that at the tip, Eq. (14) [-]."""
        a, b, s = self.a, self.b, self.a + self.hole
        norm = 3 * s**4 + 4 * b * s**3 - 4 * a**3 * s - 4 * a**3 * b + a**4
        root = 2 * (s - a) * (3 * a * x**2 + 3 * s * x**2 - 2 * x**3)
        middle = x**4 - 4 * s * x**3 + 6 * s**2 * x**2 - 4 * a**3 * x + a**4
        tip = 4 * s**3 * x - 4 * a**3 * x + a**4 - s**4
        return np.where(x <= a, root, np.where(x <= s, middle, tip)) / norm

    def shape_integral(self, power: int) -> float:
        """Integral of shape**power over the length [m]; exact for power <= 2."""
        node, weight = np.polynomial.legendre.leggauss(6)
        s = self.a + self.hole
        total = 0.0
        for lo, hi in ((0.0, self.a), (self.a, s), (s, self.length)):
            x = lo + (hi - lo) * (node + 1) / 2
            total += (hi - lo) / 2 * float(weight @ self.shape(x) ** power)
        return total

    @property
    def stiffness(self) -> float:
        """k, Eq. (18) [N/m]."""
        a, b, s = self.a, self.b, self.a + self.hole
        norm = 3 * s**4 + 4 * b * s**3 - 4 * a**3 * s - 4 * a**3 * b + a**4
        inertia = self.width * self.thickness**3 / 12
        return self.k_a * 24 * self.youngs * inertia * self.hole / norm

    @property
    def reed_mass(self) -> float:
        """m_e, Eq. (16), with the squared shape [kg]."""
        return self.density * self.width * self.thickness * self.shape_integral(2)

    def hydrodynamic_load(self) -> tuple[float, float]:
        """Added mass [kg] and damping [N s/m], Eqs. (21)-(23).

        `published`: dry frequency, Re = rho omega h B / mu, weight = integral of phi.
        `maali`: wet frequency, Re = rho omega B^2 / (4 mu), weight = integral of phi^2.
        """
        if self.load == "none":
            return 0.0, 0.0
        if self.load == "published":
            reynolds_area, weight = self.thickness * self.width, self.shape_integral(1)
        elif self.load == "maali":
            reynolds_area, weight = self.width**2 / 4, self.shape_integral(2)
        else:
            raise ValueError(f"no hydrodynamic load {self.load!r}")
        oil_mass = np.pi / 4 * self.oil_density * self.width**2 * weight

        def added(omega: float) -> tuple[float, float]:
            reynolds = self.oil_density * omega * reynolds_area / self.viscosity
            mass = oil_mass * (1.0553 + 3.7997 / np.sqrt(reynolds))
            damping = oil_mass * omega * (3.8018 / np.sqrt(reynolds) + 2.7364 / reynolds)
            return mass, damping

        dry = np.sqrt(self.stiffness / self.reed_mass)
        if self.load == "published":
            return added(dry)

        def mismatch(omega: float) -> float:
            return omega**2 * (self.reed_mass + added(omega)[0]) - self.stiffness

        return added(brentq(mismatch, 1e-3 * dry, dry, xtol=1e-12, rtol=1e-15))

    @property
    def squeeze_constant(self) -> float:
        """C = k_s mu L B^3 of F_s = C u' / (u + g0)^3 [N s m2]."""
        return self.k_s * self.viscosity * self.length * self.width**3


@dataclass(frozen=True)
class Polygon:
    """A pressure difference made of straight lines between corners."""

    time: np.ndarray  # corners [s]
    pressure: np.ndarray  # p_in - p_out at the corners [Pa]


def square_wave(inlet: float, period: float = 40e-3, transition: float = 1e-3) -> Polygon:
    """First period of Eqs. (19), (20), outlet pressure 0. `inlet` in Pa."""
    half = transition / 2
    time = [0.0, half, period / 2 - half, period / 2 + half, period - half, period]
    return Polygon(np.array(time), inlet * np.array([0.5, 1.0, 1.0, 0.0, 0.0, 0.5]))


@dataclass
class Motion:
    """A solution as smooth pieces (start [s], end [s], dense output)."""

    pieces: list[tuple[float, float, Callable]] = field(default_factory=list)

    def __call__(self, t: np.ndarray) -> np.ndarray:
        """Displacement [m] and velocity [m/s] at the times t [s]; shape (2, len(t))."""
        start = np.array([piece[0] for piece in self.pieces])
        number = np.clip(np.searchsorted(start, t, side="right") - 1, 0, None)
        out = np.empty((2, len(t)))
        for i in np.unique(number):
            out[:, number == i] = self.pieces[i][2](t[number == i])
        return out

    def first_fall_through(self, level: float, after: float) -> float:
        """When u first falls below `level` [m] after `after` [s]; NaN when it does not."""
        for start, end, dense in self.pieces:
            begin = max(start, after)
            if begin >= end or not dense(begin)[0] > level >= dense(end)[0]:
                continue  # u' keeps its sign within a piece: looking at its ends is enough
            return brentq(lambda t, f=dense: f(t)[0] - level, begin, end, xtol=1e-18, rtol=1e-15)
        return np.nan

    def extremes(self, after: float, before: float) -> tuple[float, float]:
        """Least and largest displacement [m] between two times [s]."""
        ends = [
            float(dense(t)[0])
            for start, end, dense in self.pieces
            for t in (max(start, after), min(end, before))
            if max(start, after) < min(end, before)
        ]
        return min(ends), max(ends)


def still(state: np.ndarray) -> Callable:
    """The 'dense output' of a valve that does not move."""
    return lambda t: np.multiply.outer(state, np.ones_like(t))


def solve(
    valve: Valve,
    drive: Polygon,
    squeeze: bool,
    start: float = 0.0,
    method: str = "Radau",
    rtol: float = RTOL,
) -> Motion:
    """The motion under `drive`, from rest at displacement `start` [m].

    `squeeze` adds the squeeze force while u' < 0 (Eq. 15), else Eq. (27) is solved.
    Raises RuntimeError when the integrator gives up.
    """
    added_mass, damping = valve.hydrodynamic_load()
    mass = valve.reed_mass + added_mass
    stiffness, area, gap = valve.stiffness, valve.area, valve.gap
    film = valve.squeeze_constant if squeeze else 0.0
    motion = Motion()
    state = np.array([start, 0.0])
    for i in range(len(drive.time) - 1):
        t, end = drive.time[i], drive.time[i + 1]
        pressure = drive.pressure[i]
        slope = (drive.pressure[i + 1] - pressure) / (end - t)
        corner = t
        while t < end:
            # What u' is about to do decides which branch of Eq. (15) holds.
            load = area * (pressure + slope * (t - corner))
            push = load - stiffness * state[0] - damping * state[1]
            if state[1] == 0.0 and abs(push) <= 1e-12 * abs(load):  # equilibrium, but for rounding
                if slope == 0.0:
                    motion.pieces.append((t, end, still(state)))
                    break
                push = area * slope
            trend = state[1] or push
            c_film = film if trend < 0 else 0.0

            def rate(time, y, c_film=c_film, slope=slope, corner=corner, pressure=pressure):
                force = area * (pressure + slope * (time - corner)) - stiffness * y[0]
                drag = damping + c_film / (y[0] + gap) ** 3
                return [y[1], (force - drag * y[1]) / mass]

            def jacobian(_time, y, c_film=c_film):
                film_rate = c_film / (y[0] + gap) ** 3
                by_u = -stiffness + 3 * film_rate / (y[0] + gap) * y[1]
                return [[0.0, 1.0], [by_u / mass, -(damping + film_rate) / mass]]

            def turning(_time, y):
                return y[1]

            turning.terminal = True
            turning.direction = 1.0 if trend < 0 else -1.0
            extra = {"jac": jacobian} if method == "Radau" else {}
            step = solve_ivp(
                rate, (t, end), state, method, rtol=rtol, atol=ATOL, dense_output=True,
                events=turning, first_step=min(1e-9, end - t), **extra,
            )  # fmt: skip
            if step.status < 0:
                raise RuntimeError(f"{method} at t = {step.t[-1]:.6g} s: {step.message}")
            motion.pieces.append((t, step.t[-1], step.sol))
            t, state = step.t[-1], step.y[:, -1].copy()
            if step.status == 1:
                state[1] = 0.0
    return motion


@dataclass(frozen=True)
class Response:
    """Measures of one case, in the units of the result files."""

    steady_mm: float
    overshoot_mm: float
    fall_ms: float
    closing_ms: float
    zero_ms: float
    undershoot_mm: float


def measure(motion: Motion, steady: float, event: float, end: float) -> Response:
    """Measures about the closing event; `steady` in m, `event` and `end` in s."""
    cross = [motion.first_fall_through(part * steady, event) for part in (0.9, 0.1, 0.02, 0.0)]
    start = motion.pieces[0][0]
    largest = motion.extremes(start, event)[1] if event > start else steady
    least = motion.extremes(event, end)[0]
    return Response(
        steady_mm=1e3 * steady,
        overshoot_mm=1e3 * max(0.0, largest - steady),
        fall_ms=1e3 * (cross[1] - cross[0]),
        closing_ms=1e3 * (cross[2] - event),
        zero_ms=1e3 * (cross[3] - event),
        undershoot_mm=1e3 * max(0.0, -least),
    )


def square_wave_response(valve: Valve, inlet: float, squeeze: bool, **options) -> Response:
    """Measures under the paper's square wave of `inlet` Pa, from rest."""
    drive = square_wave(inlet)
    motion = solve(valve, drive, squeeze, **options)
    return measure(motion, inlet * valve.area / valve.stiffness, drive.time[2], drive.time[-1])


def trace_response(valve: Valve, drive: Polygon, squeeze: bool, **options) -> Response:
    """Measures under a falling trace whose first corner is the event, from equilibrium."""
    steady = drive.pressure[0] * valve.area / valve.stiffness
    motion = solve(valve, drive, squeeze, start=steady, **options)
    return measure(motion, steady, drive.time[0], drive.time[-1])
