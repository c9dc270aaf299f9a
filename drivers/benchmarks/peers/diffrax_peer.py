#!/usr/bin/env python3
"""diffrax on JAX: Dopri5, all cases side by side by vmap, compiled by XLA.

Steps end at the corners of the pressure. Crossings are looked for on a grid of 0.1 ms after the event, saved from
Dopri5's dense output, with the quintic through displacement, velocity and acceleration between its points; that is good
to 1e-6.

usage: diffrax_peer.py CASES RTOL SECONDS TIMES (see peer_main in peer.h)
"""

from __future__ import annotations

import sys
import time

import diffrax
import jax
import jax.numpy as jnp
import numpy as np

jax.config.update("jax_enable_x64", True)
FACTORS = (0.5, 1.0, 1.0, 0.0, 0.0, 0.5)  # of the pressure at its corners [-]
LEVELS = (0.90, 0.10, 0.02)  # of the steady displacement [-]
EVENT = 2  # corner where the pressure starts to fall
POINTS = (2, 2, 11, 191, 2)  # of the grid in each part of the pressure; the last one is too late to close in


def acceleration(t, u, v, case, part):
    """u'' [m s-2]."""
    mass, damping, stiffness, area, squeeze, gap = case[:6]
    start, p0, slope = part
    drag = damping * v + jnp.where(v < 0.0, squeeze * v / (u + gap) ** 3, 0.0)
    return ((p0 + slope * (t - start)) * area - stiffness * u - drag) / mass


def crossing(t, path, level):
    """The first fall through a level, on the quintic between two points of the grid [s]; NaN where there is none."""
    u, v, a = path
    below = u <= level
    k = jnp.maximum(jnp.argmax(below), 1)
    h = t[k] - t[k - 1]
    rise = u[k] - u[k - 1] - h * (v[k - 1] + 0.5 * h * a[k - 1])
    dv, da = h * (v[k] - v[k - 1] - h * a[k - 1]), h * h * (a[k] - a[k - 1])
    c = (6 * rise - 3 * dv + 0.5 * da, -15 * rise + 7 * dv - da, 10 * rise - 4 * dv + 0.5 * da,
         0.5 * h * h * a[k - 1], h * v[k - 1], u[k - 1] - level)  # fmt: skip

    def halve(_, ends):
        low, high = ends
        s = 0.5 * (low + high)
        above = jnp.polyval(jnp.stack(c), s) > 0.0
        return jnp.where(above, s, low), jnp.where(above, high, s)

    low, _ = jax.lax.fori_loop(0, 50, halve, (jnp.zeros_like(h), jnp.ones_like(h)))
    return jnp.where(below.any(), t[k - 1] + h * low, jnp.nan)


def solve(case, rtol):
    """Fall and closing time [ms] of one case."""
    mass, _, stiffness, area, _, gap, pressure, period, transition = case
    half, middle = 0.5 * transition, 0.5 * period
    corners = (0.0 * half, half, middle - half, middle + half, period - half, period)
    steady = pressure * area / stiffness
    scale = jnp.stack([jnp.minimum(steady, 10 * gap), jnp.minimum(steady, 10 * gap) * jnp.sqrt(stiffness / mass)])
    y = jnp.zeros(2)
    step = 1e-3 * jnp.sqrt(mass / stiffness)
    pieces = []
    for i, points in enumerate(POINTS):
        start, end = corners[i : i + 2]
        slope = (FACTORS[i + 1] - FACTORS[i]) * pressure / (end - start)
        part = (start, FACTORS[i] * pressure, slope)

        def rate(t, x, part):
            u, v = x[0] * scale[0], x[1] * scale[1]
            return jnp.stack([v / scale[0], acceleration(t, u, v, case, part) / scale[1]])

        grid = jnp.linspace(start, end, points)
        run = diffrax.diffeqsolve(
            diffrax.ODETerm(rate), diffrax.Dopri5(), start, end, step, y, part,
            saveat=diffrax.SaveAt(ts=grid), max_steps=None, adjoint=diffrax.ForwardMode(),
            stepsize_controller=diffrax.PIDController(rtol=rtol, atol=rtol),
        )  # fmt: skip
        y = run.ys[-1]
        if i >= EVENT:
            u, v = run.ys[:, 0] * scale[0], run.ys[:, 1] * scale[1]
            pieces.append((grid, u, v, acceleration(grid, u, v, case, part)))
    falls = [first([crossing(t, path, level * steady) for t, *path in pieces]) for level in LEVELS]
    return 1e3 * jnp.stack([falls[1] - falls[0], falls[2] - corners[EVENT]])


def first(times):
    """Of those that are not NaN."""
    return jnp.nanmin(jnp.stack(times))


@jax.jit
def solve_all(cases, rtol):
    """One round."""
    return jax.vmap(lambda case: solve(case, rtol))(cases)


def main(path: str, rtol: str, seconds: str, times: str) -> int:
    """Solve the list again and again until the seconds are over; compiling is not timed."""
    cases = jnp.asarray(np.loadtxt(path, delimiter=",", skiprows=1, ndmin=2))
    tolerance = jnp.float64(rtol)
    solve_all(cases, tolerance).block_until_ready()
    start, rounds = time.perf_counter(), 0
    while rounds == 0 or time.perf_counter() - start < float(seconds):
        result = solve_all(cases, tolerance).block_until_ready()
        rounds += 1
    print(f"{(time.perf_counter() - start) / rounds:.6e}")
    np.savetxt(times, np.asarray(result), fmt="%.16e", delimiter=",")
    return 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
