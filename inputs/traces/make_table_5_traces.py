#!/usr/bin/env python3
"""Reconstruct the pressure traces of Table V from the published fall rates.

The measured traces p2 and p3 are not published. What is: the mean fall rate r_p of
p_d = p2 - p3 between 501.5 and 503 ms, Eq. (28), and the closing time that the
traditional model (no squeeze force) found with each trace. So the trace is taken as

    p_d(t) = min(p_open, r_p (t_z - t)),    t counted from 500 ms,

and its one unknown, t_z, is chosen such that the traditional model, started at
equilibrium, reaches u = 0 at its published closing time. The traces are
RECONSTRUCTED, NOT MEASURED. What the squeeze model makes of them is a prediction:
nothing in them is fitted to it or to the experiment.

The open pressure difference p_open is not published either; 60 kPa is assumed.

usage: make_table_5_traces.py [FOLDER]     (default: the folder of this script)
"""

from __future__ import annotations

import sys
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.polynomial import Polynomial
from scipy.optimize import brentq

EVENT_MS = 500.0  # the closing event on the traces' clock [ms]
END_MS = 8.0  # length of a trace after the event [ms]
STEP_MS = 0.01  # spacing of the samples [ms]
CORNER_MS = 1.0e-4  # spacing of the samples next to a corner [ms]
OPEN_KPA = 60.0  # assumed open pressure difference [kPa]

# Table V: condition -> (fall rate r_p [kPa/ms], the traditional model's closing time [ms])
TABLE_5 = {1: (18.0, 3.3), 2: (38.0, 2.4), 3: (22.0, 2.8)}


@dataclass(frozen=True)
class Oscillator:
    """The traditional model, Eq. (27): mass u'' + damping u' + stiffness u = area p_d."""

    mass: float  # reed and added mass [kg]
    damping: float  # added damping [N s/m]
    stiffness: float  # [N/m]
    area: float  # [m2]


def traditional_model() -> Oscillator:
    """The valve of Table II with the `published` reading of the hydrodynamic load.

    Eqs. (14), (16), (18) and (21)-(23) with the reed's frequency in vacuum,
    Re = rho_f omega h B / mu, and added mass and damping weighted with the
    integral of the deflection shape.
    """
    a, b, hole, width, thick = 2.5e-3, 1.0e-3, 4.0e-3, 6.0e-3, 0.15e-3  # [m]
    density, youngs, k_a, area = 8950.0, 110.0e9, 0.91, 12.56e-6  # [kg/m3, Pa, -, m2]
    oil_density, viscosity = 875.0, 0.0484  # [kg/m3, Pa s]
    s = a + hole
    length = s + b
    norm = 3 * s**4 + 4 * b * s**3 - 4 * a**3 * s - 4 * a**3 * b + a**4
    shape = (
        (0.0, a, Polynomial([0, 0, 3 * (a + s), -2]) * (2 * (s - a) / norm)),
        (a, s, Polynomial([a**4, -4 * a**3, 6 * s**2, -4 * s, 1]) / norm),
        (s, length, Polynomial([a**4 - s**4, 4 * s**3 - 4 * a**3]) / norm),
    )

    def integral(power: int) -> float:
        parts = ((lo, hi, (phi**power).integ()) for lo, hi, phi in shape)
        return sum(primitive(hi) - primitive(lo) for lo, hi, primitive in parts)

    stiffness = k_a * 24 * youngs * (width * thick**3 / 12) * hole / norm
    reed_mass = density * width * thick * integral(2)
    omega = np.sqrt(stiffness / reed_mass)
    reynolds = oil_density * omega * thick * width / viscosity
    gamma_r = 1.0553 + 3.7997 / np.sqrt(reynolds)
    gamma_i = 3.8018 / np.sqrt(reynolds) + 2.7364 / reynolds
    oil_mass = np.pi / 4 * oil_density * width**2 * integral(1)
    return Oscillator(
        mass=reed_mass + oil_mass * gamma_r,
        damping=oil_mass * omega * gamma_i,
        stiffness=stiffness,
        area=area,
    )


def closing_time(model: Oscillator, rate: float, open_ms: float, start_ms: float) -> float:
    """When u first reaches zero, for p_d = rate (open_ms - max(t, start_ms)) [ms].

    `rate` in kPa/ms. Equilibrium until start_ms; from there the exact response of the
    underdamped oscillator to a pressure that falls at a constant rate.
    """
    omega = np.sqrt(model.stiffness / model.mass)
    decay = model.damping / (2 * model.mass)
    ring = np.sqrt(omega**2 - decay**2)
    lag = model.damping / model.stiffness

    def displacement_over_rate(t_ms: float) -> float:  # k u / (A rate) [s]
        t = (t_ms - start_ms) * 1e-3
        transient = np.exp(-decay * t) * (lag * np.cos(ring * t) + (lag * decay - 1) / ring * np.sin(ring * t))
        return (open_ms - start_ms) * 1e-3 - (t - lag + transient)

    if rate <= 0:
        raise ValueError("the pressure difference has to fall")
    # One and a half natural periods after p_d = 0 the displacement is below zero for sure.
    latest = open_ms + 1.5e3 * 2 * np.pi / omega
    return brentq(displacement_over_rate, start_ms, latest, xtol=1e-13, rtol=1e-14)


def zero_pressure_time(model: Oscillator, rate: float, closes_ms: float) -> float:
    """t_z: when p_d passes zero, such that `model` closes at `closes_ms` [ms after the event]."""

    def miss(t_z: float) -> float:
        start = max(0.0, t_z - OPEN_KPA / rate)
        return closing_time(model, rate, t_z, start) - closes_ms

    return brentq(miss, 1e-3, closes_ms, xtol=1e-13, rtol=1e-14)


def sample_times(corner_ms: float | None) -> np.ndarray:
    """Times after the event [ms]: every STEP_MS, doubling from CORNER_MS about a corner.

    A shape-preserving cubic rounds a corner off over the two intervals that meet
    there, so these are made 1e-4 ms short; elsewhere it is exact on a polygon.
    """
    grid = STEP_MS * np.arange(round(END_MS / STEP_MS) + 1)
    if corner_ms is None:
        return grid
    steps = CORNER_MS * 2.0 ** np.arange(np.ceil(np.log2(STEP_MS / CORNER_MS)))
    near = np.cumsum(steps)
    kept = grid[np.abs(grid - corner_ms) > near[-1] + STEP_MS / 2]
    return np.sort(np.concatenate([kept, corner_ms - near, [corner_ms], corner_ms + near]))


def trace_text(condition: int) -> str:
    """The CSV file of one condition of Table V, comment lines first."""
    rate, closes = TABLE_5[condition]
    t_z = zero_pressure_time(traditional_model(), rate, closes)
    corner = t_z - OPEN_KPA / rate
    t = np.round(sample_times(corner if corner > 0 else None), 6)  # as printed below
    pressure = np.minimum(OPEN_KPA, rate * (t_z - t))
    lines = [
        f"# Table V, condition {condition}: RECONSTRUCTED pressure difference, NOT MEASURED.",
        "# The paper publishes the mean fall rate between 501.5 and 503 ms only, Eq. (28).",
        f"# p_d(t) = min({OPEN_KPA:g} kPa, r_p (t_z - t)), t from {EVENT_MS:g} ms,"
        f" r_p = {rate:g} kPa/ms, t_z = {t_z:.6f} ms.",
        "# t_z is chosen such that the traditional model, started at equilibrium, reaches u = 0",
        f"# at its published closing time, {closes:g} ms. The open pressure difference, {OPEN_KPA:g} kPa, is assumed.",
        "# Past the valve's closing the line goes on falling, which has no meaning any more.",
        "# Made by make_table_5_traces.py.",
        "t_ms,p_diff_kpa",
    ]
    lines += [f"{EVENT_MS + ti:.6f},{pi:.7f}" for ti, pi in zip(t, pressure, strict=True)]
    return "\n".join(lines) + "\n"


def main(arguments: list[str]) -> int:
    """Write the three traces; the exit status is 2 when the command line is wrong."""
    if len(arguments) > 1 or any(word.startswith("-") for word in arguments):
        print(__doc__.rsplit("\n\n", 1)[-1].strip(), file=sys.stderr)
        return 2
    folder = Path(arguments[0]) if arguments else Path(__file__).resolve().parent
    for condition in TABLE_5:
        path = folder / f"table_5_condition_{condition}.csv"
        path.write_text(trace_text(condition), encoding="ascii", newline="\n")
        print(path)
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
