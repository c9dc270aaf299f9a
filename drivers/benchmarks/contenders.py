"""Ways to solve the cases, each a program of its own that is timed: reedvalve's lanes and what others use."""

from __future__ import annotations

import itertools
import os
import shutil
import subprocess
import sys
from collections.abc import Callable
from dataclasses import dataclass, field
from itertools import pairwise
from pathlib import Path
from statistics import median

import numpy as np
from sweep import LIMIT, all_cases, deck_text, largest_error, reference_times, spread_sample, write_cases

LADDER = tuple(mantissa * 10.0**-exponent for exponent in range(3, 10) for mantissa in (1, 0.7, 0.5, 0.3, 0.2, 0.15))
PEERS = Path(__file__).parent / "peers"

# Starts a program, and prints its seconds and largest resident memory [MiB]. An interpreter of its own, for a new
# process counts the memory of the one that started it as its own.
STOPWATCH = """
import os, sys, time
start = time.perf_counter()
process = os.posix_spawn(sys.argv[1], sys.argv[1:], os.environ)
_, status, usage = os.wait4(process, 0)
print(time.perf_counter() - start, usage.ru_maxrss / 1024)
sys.exit(os.waitstatus_to_exitcode(status))
"""


@dataclass
class Contender:
    """One way to solve cases; `solve` takes a tolerance and at least so many seconds.

    It gives the seconds of one round of all its cases and their fall and closing times [ms].
    """

    name: str
    solve: Callable[[float, float], tuple[float, np.ndarray]]
    cases: np.ndarray  # which of the 4096, from 0
    cores: int = 1
    rtol: float = float("nan")
    error: float = float("nan")  # largest relative one of fall and closing time
    seconds: list[float] = field(default_factory=list)  # of one round, each time it was measured
    slow_start: bool = False  # compiling takes longer than what is measured

    def errors_at(self, rtol: float) -> float:
        """Largest error with a tolerance; infinite when the cases cannot be solved with it."""
        try:
            return largest_error(self.solve(rtol, 0.0)[1], reference_times()[self.cases])
        except subprocess.CalledProcessError:
            return float("inf")

    def measure(self, enough: float) -> None:
        """Once more, for so many seconds at least."""
        seconds, times = self.solve(self.rtol, enough)
        self.seconds.append(seconds)
        self.error = largest_error(times, reference_times()[self.cases])

    @property
    def rate(self) -> float:
        """Cases per second, of the median round."""
        return len(self.cases) / median(self.seconds)

    def over(self, other: Contender) -> float:
        """How many times as fast as another: the median of rounds that ran one after the other."""
        pairs = zip(self.seconds, other.seconds, strict=False)  # a slow starter has fewer rounds
        return median(theirs / ours for ours, theirs in pairs) * len(self.cases) / len(other.cases)

    @property
    def span(self) -> tuple[float, float]:
        """Cases per second of the slowest and the fastest round."""
        return len(self.cases) / max(self.seconds), len(self.cases) / min(self.seconds)


def loosest_tolerance(contender: Contender, ladder: tuple[float, ...]) -> float:
    """The first of the ladder that meets LIMIT and still does one step further down: met once may be luck."""
    errors = {ladder[0]: contender.errors_at(ladder[0])}
    for loose, tight in pairwise(ladder):
        errors[tight] = contender.errors_at(tight)
        if max(errors[loose], errors[tight]) < LIMIT:
            return loose
    raise SystemExit(f"benchmark: {contender.name} does not meet {LIMIT:g}: {errors}")


class Bench:
    """Where programs, decks and lists of cases are, and how each is run."""

    def __init__(self, build: Path, peers: Path, folder: Path, cases: int = 4096) -> None:
        self.kernel = build / "drivers" / "benchmarks" / "block_speed"
        self.program = build / "drivers" / "reedvalve" / "reedvalve"
        self.peers, self.folder = peers, folder
        self.numbers = itertools.count()
        self.some = spread_sample(cases) if cases < 4096 else np.arange(4096)  # of a smoke test
        for path in (self.kernel, self.program):
            if not path.is_file():
                raise SystemExit(f"benchmark: {path} is not built")
        self.methods = self.known_methods()

    def new_file(self, suffix: str) -> Path:
        """A name in the scratch folder that was not used yet."""
        return self.folder / f"{next(self.numbers)}{suffix}"

    def deck(self, *words: object, **keys: object) -> Path:
        """A deck as deck_text says."""
        path = self.new_file(".nml")
        path.write_text(deck_text(*words, **keys), encoding="utf-8")
        return path

    def known_methods(self) -> list[str | None]:
        """Values of solver.method; None where this build has no such key."""
        deck = self.deck(1e-6, method="explicit")
        known = subprocess.run([self.program, "check", deck], capture_output=True).returncode == 0
        return ["implicit", "explicit"] if known else [None]

    def run_kernel(self, deck: Path, threads: int, enough: float) -> tuple[float, np.ndarray]:
        """Without files; the program takes its own time."""
        table = self.new_file(".times")
        out = run([self.kernel, deck, threads, table, enough])
        times = np.loadtxt(table, delimiter=",")
        table.unlink()
        return float(out), times

    def run_program(self, deck: Path, threads: int) -> tuple[float, float]:
        """The whole program, results written anew: seconds, and its largest resident memory [MiB]."""
        folder = deck.with_suffix("")
        if folder.exists():
            shutil.rmtree(folder)
        program = [self.program, "run", deck, "-o", folder, "--threads", threads, "--quiet"]
        seconds, memory = run([sys.executable, "-I", "-c", STOPWATCH, *program]).split()
        return float(seconds), float(memory)

    def lanes(self, method: str | None, threads: int, **keys: object) -> Contender:
        """reedvalve's own, without files."""

        def solve(rtol: float, enough: float) -> tuple[float, np.ndarray]:
            deck = self.deck(rtol, method=method, **keys)
            return self.run_kernel(deck, threads, enough)

        return Contender(f"reedvalve, {method or 'implicit'} lanes", solve, np.arange(4096), threads)

    def peer(self, name: str, words: list[object], cases: np.ndarray) -> Contender:
        """A peer's program."""
        listed = all_cases()
        path = write_cases(self.new_file(".csv"), [listed[i] for i in cases])

        def solve(rtol: float, enough: float) -> tuple[float, np.ndarray]:
            table = self.new_file(".times")
            out = run([*words, path, f"{rtol:g}", enough, table])
            return float(out), np.loadtxt(table, delimiter=",", ndmin=2)

        return Contender(name, solve, cases)

    odeint_name, cvode_name = "Boost.odeint Cash-Karp, C++", "CVODE BDF, C"

    def cvode(self, cases: np.ndarray) -> Contender:
        """CVODE on these cases."""
        return self.peer(self.cvode_name, [self.peers / "cvode"], cases)

    def all_peers(self, scipy: tuple[str, ...], few: int, python_peers: bool) -> list[Contender]:
        """Those that were set up; SciPy on `few` of the cases. What is left out is told."""
        sample = spread_sample(min(few, len(self.some)))
        rows = []
        for name, needs, words in self.wanted_peers()[: 4 if python_peers else 2]:
            if needs.is_file():
                rows.append(self.peer(name, words, self.some))
                rows[-1].slow_start = name.startswith("diffrax")
            else:
                print(f"benchmark: {name} is left out: {needs} is not there", file=sys.stderr)
        for method in scipy:
            rows.append(self.peer(f"SciPy {method}", [sys.executable, PEERS / "scipy_peer.py", method], sample))
        return rows

    def wanted_peers(self) -> list[tuple[str, Path, list[object]]]:
        """Name, the file without which there is none, words of its command; those in Python last."""
        odeint, cvode = self.peers / "odeint", self.peers / "cvode"
        python, ready = self.peers / "venv" / "bin" / "python", self.peers / "venv" / "ready"
        one_core = ["taskset", "--cpu-list", str(max(os.sched_getaffinity(0)))]  # XLA takes all there are
        return [
            (self.odeint_name, odeint, [odeint]),
            (self.cvode_name, cvode, [cvode]),
            ("numbalsoda LSODA", ready, [python, PEERS / "numbalsoda_peer.py"]),
            ("diffrax Dopri5, vmap", ready, [*one_core, python, PEERS / "diffrax_peer.py"]),
        ]


def run(words: list[object]) -> str:
    """Standard output of a program that must not fail."""
    done = subprocess.run([str(word) for word in words], check=True, capture_output=True, text=True)
    return done.stdout
