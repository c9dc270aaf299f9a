#!/usr/bin/env python3
"""Cases per second of the 64 x 64 sweep of pressure and gap, beside SciPy's integrators.

Everything is solved to the same accuracy: fall and closing time of every case within 1e-4
(relative) of the stored reference, which SciPy made with rtol 1e-12. reedvalve solves all
4096 cases of inputs/sweep_64x64.nml; SciPy solves a fixed sample of them, one after the
other, with the loosest tolerance of a ladder that meets the limit. Rounds of all programs
follow each other, so that what else the machine does hits all alike; medians are printed.

usage: benchmark.py [--build FOLDER] [--rounds N] [--sample N]
"""

from __future__ import annotations

import argparse
import math
import os
import platform
import re
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable
from dataclasses import dataclass, field
from itertools import pairwise
from pathlib import Path
from statistics import median

import numpy as np
import scipy
from scipy.integrate import solve_ivp

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "postproc" / "tests"))
from make_sweep_reference import read_reference, sweep_cases  # noqa: E402
from reference_model import Valve  # noqa: E402

LIMIT = 1.0e-4  # relative, of fall and closing time
RTOL = 1.0e-5  # of reedvalve; the power of ten that meets LIMIT
BLOCK = 512  # cases in a block, so that there is work for two threads
SCIPY = ("LSODA", "Radau", "DOP853")
IMPLICIT = ("LSODA", "Radau")  # take a Jacobian
LADDER = [1e-3, 3e-4, 1e-4, 3e-5, 1e-5, 3e-6, 1e-6, 3e-7, 1e-7]  # SciPy's tolerances
CORNERS = [0.0, 0.5e-3, 19.5e-3, 20.5e-3, 39.5e-3, 40e-3]  # of the square wave [s]
FACTORS = [0.5, 1.0, 1.0, 0.0, 0.0, 0.5]  # of the inlet pressure there
LEVELS = [0.90, 0.10, 0.02]  # of the steady displacement
EVENT = 19.5e-3  # start of the closing [s]


@dataclass
class Contender:
    """One way to solve the cases."""

    name: str
    threads: int
    rtol: float
    run: Callable[[], tuple[float, np.ndarray]]  # -> seconds; fall and closing time [ms], a row each
    cases: np.ndarray  # which of the 4096, from 0
    seconds: list[float] = field(default_factory=list)
    error: float = math.nan  # largest relative error of fall and closing time

    def measure(self, reference: np.ndarray) -> None:
        """One round."""
        seconds, times = self.run()
        self.seconds.append(seconds)
        self.error = largest_error(times, reference[self.cases])

    def rate(self, seconds: float | None = None) -> float:
        """Cases per second, of the median round."""
        return len(self.cases) / (seconds or median(self.seconds))


def largest_error(times: np.ndarray, reference: np.ndarray) -> float:
    """Relative; infinite when a time is missing."""
    error = np.abs(times / reference - 1.0)
    return float(error.max()) if np.isfinite(error).all() else math.inf


# ---- reedvalve ------------------------------------------------------------------------------


def write_deck(path: Path, width: int) -> Path:
    """inputs/sweep_64x64.nml with this benchmark's tolerance, block and lanes."""
    text = (ROOT / "inputs" / "sweep_64x64.nml").read_text(encoding="utf-8")
    for pattern, line in ((r"rtol = \S+", f"rtol = {RTOL:g}, width = {width}"),
                          (r"t_end_ms = \S+", f"t_end_ms = 40.0, block_size = {BLOCK}")):  # fmt: skip
        text, found = re.subn(pattern, line, text)
        if found != 1:
            raise SystemExit(f"benchmark: {pattern} is not once in sweep_64x64.nml")
    path.write_text(text, encoding="utf-8")
    return path


def run_kernel(program: Path, deck: Path, threads: int) -> tuple[float, np.ndarray]:
    """The cases without files; the program takes its own time."""
    table = deck.with_suffix(".kernel")
    out = subprocess.run([program, deck, str(threads), table], check=True, capture_output=True, text=True).stdout
    return float(out), np.loadtxt(table, delimiter=",")


def run_program(program: Path, deck: Path, threads: int) -> tuple[float, np.ndarray]:
    """The whole program from its start to its end, results written."""
    folder = deck.with_suffix("")
    words = [program, "run", deck, "-o", folder, "--threads", str(threads), "--force", "--quiet"]
    start = time.perf_counter()
    subprocess.run(words, check=True)
    seconds = time.perf_counter() - start
    table = np.genfromtxt(folder / "summary.csv", delimiter=",", names=True, deletechars="", dtype=None, encoding=None)
    return seconds, np.stack([table["fall_ms"], table["closing_ms"]], axis=1)


# ---- SciPy ----------------------------------------------------------------------------------


class ScipyValve:
    """The squeeze model in plain Python floats, which is the fastest that SciPy takes."""

    def __init__(self, inlet_kpa: float, gap_mm: float) -> None:
        valve = Valve(gap=1e-3 * gap_mm)
        added_mass, self.damping = valve.hydrodynamic_load()
        self.mass = valve.reed_mass + added_mass
        self.stiffness, self.gap, self.film = valve.stiffness, valve.gap, valve.squeeze_constant
        self.force = 1e3 * inlet_kpa * valve.area
        self.steady = self.force / self.stiffness

    def solve(self, method: str, rtol: float) -> tuple[float, float]:
        """Fall and closing time [ms]; corner to corner, crossings as events."""
        omega = math.sqrt(self.stiffness / self.mass)
        size = min(self.steady, 10 * self.gap)
        atol = [rtol * size, rtol * size * omega]
        falls: list[np.ndarray] = [np.array([]) for _ in LEVELS]
        jacobian = {"jac": self.jacobian} if method in IMPLICIT else {}
        state = [0.0, 0.0]
        for i in range(len(CORNERS) - 1):
            part = self.piece(i)
            events = [self.crossing(level) for level in LEVELS] if CORNERS[i] >= EVENT else None
            run = solve_ivp(part, CORNERS[i : i + 2], state, method, rtol=rtol, atol=atol, events=events, **jacobian)
            if run.status < 0:
                return math.nan, math.nan
            state = run.y[:, -1]
            if events:
                falls = [np.append(old, new) for old, new in zip(falls, run.t_events, strict=True)]
        first = [float(times[0]) if len(times) else math.nan for times in falls]
        return 1e3 * (first[1] - first[0]), 1e3 * (first[2] - EVENT)

    def piece(self, i: int) -> Callable:
        """Right-hand side between two corners."""
        start, p0 = CORNERS[i], FACTORS[i] * self.force
        slope = (FACTORS[i + 1] - FACTORS[i]) * self.force / (CORNERS[i + 1] - start)
        k, c, film, gap, m = self.stiffness, self.damping, self.film, self.gap, self.mass

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
        film = self.film / (u + self.gap) ** 3 if v < 0.0 else 0.0
        by_u = 3 * film * v / (u + self.gap) - self.stiffness
        return [[0.0, 1.0], [by_u / self.mass, -(self.damping + film) / self.mass]]

    def crossing(self, level: float) -> Callable:
        """Event: u falls below a part of the steady displacement."""
        height = level * self.steady

        def distance(_t: float, y: np.ndarray) -> float:
            return y[0] - height

        distance.direction = -1.0
        return distance


def run_scipy(cases: list[tuple[float, float]], method: str, rtol: float) -> tuple[float, np.ndarray]:
    """Cases one after the other."""
    valves = [ScipyValve(*case) for case in cases]
    start = time.perf_counter()
    times = [valve.solve(method, rtol) for valve in valves]
    return time.perf_counter() - start, np.array(times)


def loosest_tolerance(cases: list[tuple[float, float]], method: str, reference: np.ndarray) -> float:
    """The first of the ladder that meets LIMIT, and goes on meeting it one step tighter."""
    errors = [largest_error(run_scipy(cases, method, LADDER[0])[1], reference)]
    for loose, tight in pairwise(LADDER):
        errors.append(largest_error(run_scipy(cases, method, tight)[1], reference))
        if max(errors[-2:]) < LIMIT:
            return loose
    raise SystemExit(f"benchmark: {method} does not meet {LIMIT:g}")


# ---- The measurement ------------------------------------------------------------------------


def contenders(build: Path, folder: Path, sample: int, reference: np.ndarray) -> list[Contender]:
    """All that is measured."""
    kernel = build / "drivers" / "benchmarks" / "block_speed"
    program = build / "drivers" / "reedvalve" / "reedvalve"
    for path in (kernel, program):
        if not path.is_file():
            raise SystemExit(f"benchmark: {path} is not built")
    everything = np.arange(len(reference))
    lanes, single = write_deck(folder / "lanes.nml", 64), write_deck(folder / "single.nml", 1)
    some = np.linspace(0, len(reference) - 1, sample).round().astype(int)
    cases = [sweep_cases()[i] for i in some]
    rows = [
        Contender("reedvalve, no files", 1, RTOL, lambda: run_kernel(kernel, lanes, 1), everything),
        Contender("reedvalve, no files", 2, RTOL, lambda: run_kernel(kernel, lanes, 2), everything),
        Contender("the same, one lane", 1, RTOL, lambda: run_kernel(kernel, single, 1), everything),
        Contender("reedvalve run", 1, RTOL, lambda: run_program(program, lanes, 1), everything),
        Contender("reedvalve run", 2, RTOL, lambda: run_program(program, lanes, 2), everything),
    ]
    for method in SCIPY:
        rtol = loosest_tolerance(cases, method, reference[some])
        rows.append(Contender(f"SciPy {method}", 1, rtol, lambda m=method, r=rtol: run_scipy(cases, m, r), some))
    return rows


def processor() -> str:
    """What the machine calls its processor."""
    try:
        text = Path("/proc/cpuinfo").read_text(encoding="utf-8")
    except OSError:
        return platform.machine()
    found = re.search(r"model name\s*:\s*(.*)", text)
    return found.group(1) if found else platform.machine()


def print_table(rows: list[Contender], rounds: int) -> None:
    """The result."""
    best = max((row for row in rows if row.name.startswith("SciPy")), key=Contender.rate)
    form = "{:20} {:>7} {:>6} {:>6} {:>8} {:>15} {:>7} {:>8}"
    print(form.format("", "threads", "rtol", "cases", "cases/s", "(range)", "ratio", "error"))
    for row in rows:
        spread = f"({row.rate(max(row.seconds)):.0f} to {row.rate(min(row.seconds)):.0f})"
        ratio, error = f"{row.rate() / best.rate():.3g}", f"{row.error:.1e}"
        print(form.format(row.name, row.threads, f"{row.rtol:.0e}", len(row.cases), f"{row.rate():.0f}", spread,
                          ratio, error))  # fmt: skip
    print(f"cases/s: median and range of {rounds} rounds. ratio: to {best.name}, the fastest of SciPy's on one core.")
    print(f"error: largest relative error of fall and closing time; {LIMIT:g} is allowed.")


def main() -> int:
    """Measure and print; the exit status is 1 when someone misses the accuracy."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").split("\n")[0])
    parser.add_argument("--build", type=Path, default=ROOT / "build" / "release", help="a build folder")
    parser.add_argument("--rounds", type=int, default=7)
    parser.add_argument("--sample", type=int, default=32, help="cases for SciPy")
    words = parser.parse_args()
    stored = read_reference()
    reference = np.stack([stored["fall_ms"], stored["closing_ms"]], axis=1)
    load = os.getloadavg()[0]
    with tempfile.TemporaryDirectory() as folder:
        rows = contenders(words.build, Path(folder), words.sample, reference)
        for _ in range(words.rounds):
            for row in rows:
                row.measure(reference)
    print(f"{os.cpu_count()} cores, {processor()}; Python {platform.python_version()}, SciPy {scipy.__version__}")
    if load > 0.25:
        print(f"The machine was not idle: {load:.1f} other processes ran at the start.")
    print_table(rows, words.rounds)
    missed = [row.name for row in rows if not row.error < LIMIT]
    if missed:
        print(f"The accuracy was missed by: {', '.join(missed)}", file=sys.stderr)
    return 1 if missed else 0


if __name__ == "__main__":
    sys.exit(main())
