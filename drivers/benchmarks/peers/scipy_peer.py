#!/usr/bin/env python3
"""SciPy's solve_ivp, one case at a time; the right-hand side in plain Python floats, the fastest it takes.

usage: scipy_peer.py METHOD CASES RTOL SECONDS TIMES (see peer_main in peer.h)
"""

from __future__ import annotations

import math
import sys
import time
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from scipy.integrate import solve_ivp

FACTORS = [0.5, 1.0, 1.0, 0.0, 0.0, 0.5]  # of the pressure at its corners [-]
LEVELS = [0.90, 0.10, 0.02]  # of the steady displacement [-]
EVENT = 2  # corner where the pressure starts to fall
IMPLICIT = ("LSODA", "Radau", "BDF")  # take a Jacobian


@dataclass
class Valve:
    """One line of the list of cases, SI."""

    mass: float
    damping: float
    stiffness: float
    area: float
    squeeze: float
    gap: float
    pressure: float
    period: float
    transition: float

    def corners(self) -> list[float]:
        """Of the pressure [s]."""
        half, middle = 0.5 * self.transition, 0.5 * self.period
        return [0.0, half, middle - half, middle + half, self.period - half, self.period]

    def rate(self, start: float, end: float, factors: list[float]) -> Callable:
        """Right-hand side between two corners."""
        force = self.pressure * self.area
        p0, slope = factors[0] * force, (factors[1] - factors[0]) * force / (end - start)
        k, c, film, gap, m = self.stiffness, self.damping, self.squeeze, self.gap, self.mass

        def rate(t: float, y: np.ndarray) -> tuple[float, float]:
            u, v = y.tolist()
            drag = c * v
            if v < 0.0:
                drag += film * v / (u + gap) ** 3
            return v, (p0 + slope * (t - start) - k * u - drag) / m

        return rate

    def jacobian(self, _t: float, y: np.ndarray) -> list[list[float]]:
        """Of the right-hand side."""
        u, v = y.tolist()
        film = self.squeeze / (u + self.gap) ** 3 if v < 0.0 else 0.0
        by_u = 3 * film * v / (u + self.gap) - self.stiffness
        return [[0.0, 1.0], [by_u / self.mass, -(self.damping + film) / self.mass]]


def falls_through(height: float) -> Callable:
    """Event: u falls below a height [m]."""

    def distance(_t: float, y: np.ndarray) -> float:
        return y[0] - height

    distance.direction = -1.0
    return distance


def solve(valve: Valve, method: str, rtol: float) -> tuple[float, float]:
    """Fall and closing time [ms]; corner to corner, crossings as events."""
    steady = valve.pressure * valve.area / valve.stiffness
    size = min(steady, 10 * valve.gap)
    atol = [rtol * size, rtol * size * math.sqrt(valve.stiffness / valve.mass)]
    jacobian = {"jac": valve.jacobian} if method in IMPLICIT else {}
    crossings = [falls_through(level * steady) for level in LEVELS]
    found = [math.nan] * len(LEVELS)
    corners, state = valve.corners(), [0.0, 0.0]
    for i in range(len(corners) - 1):
        rate = valve.rate(*corners[i : i + 2], FACTORS[i : i + 2])
        events = crossings if i >= EVENT else None
        run = solve_ivp(rate, corners[i : i + 2], state, method, rtol=rtol, atol=atol, events=events, **jacobian)
        if run.status < 0:
            return math.nan, math.nan
        state = run.y[:, -1]
        for k, times in enumerate(run.t_events or []):
            if math.isnan(found[k]) and len(times):
                found[k] = float(times[0])
    return 1e3 * (found[1] - found[0]), 1e3 * (found[2] - corners[EVENT])


def main(method: str, cases: str, rtol: str, seconds: str, times: str) -> int:
    """Solve the list again and again until the seconds are over."""
    lines = Path(cases).read_text(encoding="utf-8").splitlines()[1:]
    valves = [Valve(*map(float, line.split(","))) for line in lines]
    start, rounds = time.perf_counter(), 0
    while rounds == 0 or time.perf_counter() - start < float(seconds):
        result = [solve(valve, method, float(rtol)) for valve in valves]
        rounds += 1
    print(f"{(time.perf_counter() - start) / rounds:.6e}")
    np.savetxt(times, result, fmt="%.16e", delimiter=",")
    return 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
