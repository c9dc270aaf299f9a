#!/usr/bin/env python3
"""numbalsoda: LSODA with everything compiled by Numba, one case at a time.

LSODA gives values at times asked for only, so crossings are looked for on a grid of 0.1 ms after the event, with the
quintic through displacement, velocity and acceleration between them; that is good to 1e-6. The state is u and u' over
their scales: numbalsoda has one absolute tolerance.

usage: numbalsoda_peer.py CASES RTOL SECONDS TIMES (see peer_main in peer.h)
"""

from __future__ import annotations

import sys
import time

import numba
import numpy as np
from numbalsoda import lsoda, lsoda_sig

MASS, DAMPING, STIFFNESS, AREA, SQUEEZE, GAP, PRESSURE, PERIOD, TRANSITION = range(9)
P0, SLOPE, START, U_SCALE, V_SCALE = range(9, 14)  # what the solver adds to a case's numbers
FACTORS = np.array([0.5, 1.0, 1.0, 0.0, 0.0, 0.5])  # of the pressure at its corners [-]
LEVELS = np.array([0.90, 0.10, 0.02])  # of the steady displacement [-]
EVENT = 2  # corner where the pressure starts to fall
GRID = 0.1e-3  # [s]


@numba.njit(inline="always")
def acceleration(t, u, v, p):
    """u'' [m s-2]."""
    h = u + p[GAP]
    drag = p[DAMPING] * v
    if v < 0.0:
        drag += p[SQUEEZE] * v / (h * h * h)
    return ((p[P0] + p[SLOPE] * (t - p[START])) * p[AREA] - p[STIFFNESS] * u - drag) / p[MASS]


@numba.cfunc(lsoda_sig)
def rate(t, x, dx, p_):
    """Of the scaled state."""
    p = numba.carray(p_, (14,))
    dx[0] = x[1] * p[V_SCALE] / p[U_SCALE]
    dx[1] = acceleration(t, x[0] * p[U_SCALE], x[1] * p[V_SCALE], p) / p[V_SCALE]


ADDRESS = rate.address


@numba.njit
def crossing(t0, t1, u0, v0, a0, u1, v1, a1, level):
    """Where the quintic between two instants falls through a level [s]."""
    h = t1 - t0
    rise, dv, da = u1 - u0 - h * (v0 + 0.5 * h * a0), h * (v1 - v0 - h * a0), h * h * (a1 - a0)
    c3, c4, c5 = 10 * rise - 4 * dv + 0.5 * da, -15 * rise + 7 * dv - da, 6 * rise - 3 * dv + 0.5 * da
    low, high = 0.0, 1.0
    for _ in range(50):
        s = 0.5 * (low + high)
        if u0 - level + s * (h * v0 + s * (0.5 * h * h * a0 + s * (c3 + s * (c4 + s * c5)))) > 0.0:
            low = s
        else:
            high = s
    return t0 + h * low


@numba.njit
def solve(case, rtol):
    """Fall and closing time [ms]."""
    p = np.zeros(14)
    p[:9] = case
    half, middle = 0.5 * p[TRANSITION], 0.5 * p[PERIOD]
    corners = np.array([0.0, half, middle - half, middle + half, p[PERIOD] - half, p[PERIOD]])
    steady = p[PRESSURE] * p[AREA] / p[STIFFNESS]
    p[U_SCALE] = min(steady, 10 * p[GAP])
    p[V_SCALE] = p[U_SCALE] * np.sqrt(p[STIFFNESS] / p[MASS])
    found, times, state = 0, np.full(3, np.nan), np.zeros(2)
    for i in range(5):
        start, end = corners[i], corners[i + 1]
        p[START], p[P0] = start, FACTORS[i] * p[PRESSURE]
        p[SLOPE] = (FACTORS[i + 1] - FACTORS[i]) * p[PRESSURE] / (end - start)
        looks = i >= EVENT and found < 3
        grid = np.linspace(start, end, (round((end - start) / GRID) if looks else 1) + 1)
        path, well = lsoda(ADDRESS, state, grid, p, rtol, rtol, 1000000)
        if not well:
            break
        state = path[-1]
        for k in range(len(grid) - 1 if looks else 0):
            while found < 3 and path[k + 1, 0] * p[U_SCALE] <= LEVELS[found] * steady:
                u0, v0 = path[k, 0] * p[U_SCALE], path[k, 1] * p[V_SCALE]
                u1, v1 = path[k + 1, 0] * p[U_SCALE], path[k + 1, 1] * p[V_SCALE]
                a0, a1 = acceleration(grid[k], u0, v0, p), acceleration(grid[k + 1], u1, v1, p)
                level = LEVELS[found] * steady
                times[found] = crossing(grid[k], grid[k + 1], u0, v0, a0, u1, v1, a1, level)
                found += 1
    return 1e3 * (times[1] - times[0]), 1e3 * (times[2] - corners[EVENT])


@numba.njit
def solve_all(cases, rtol, out):
    """One round."""
    for i in range(len(cases)):
        out[i] = solve(cases[i], rtol)


def main(path: str, rtol: str, seconds: str, times: str) -> int:
    """Solve the list again and again until the seconds are over; compiling is not timed."""
    cases = np.loadtxt(path, delimiter=",", skiprows=1, ndmin=2)
    out = np.empty((len(cases), 2))
    solve_all(cases[:1], float(rtol), out)
    start, rounds = time.perf_counter(), 0
    while rounds == 0 or time.perf_counter() - start < float(seconds):
        solve_all(cases, float(rtol), out)
        rounds += 1
    print(f"{(time.perf_counter() - start) / rounds:.6e}")
    np.savetxt(times, out, fmt="%.16e", delimiter=",")
    return 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
