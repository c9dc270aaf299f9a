#!/usr/bin/env python3
"""Cases per second of reedvalve's lanes, beside what others use, at equal achieved error in one run.

Everyone solves the 64 x 64 sweep of pressure and gap over 40 ms and is timed at its loosest tolerance with which
every fall and closing time is within 1e-4 (relative) of the stored reference, which SciPy made with rtol 1e-12.
Rounds of all contenders follow each other, so that what else the machine does hits all alike; medians count. Then:
work and precision, growing numbers of cases, growing numbers of lanes, and memory.

Writes benchmark.md, a CSV file of each table, machine.json and work_precision.png.

usage: benchmark.py [--build FOLDER] [--peers FOLDER] [--output FOLDER] [--quick]
"""

from __future__ import annotations

import argparse
import sys
import tempfile
from dataclasses import dataclass
from pathlib import Path
from statistics import median

import numpy as np
from contenders import LADDER, Bench, Contender, loosest_tolerance
from machine import describe
from report import Table, draw_work_precision, grouped, write_report
from sweep import LIMIT, ROOT, spread_sample

LONGEST = 45.0  # a single measurement that would take longer is left out [s]


@dataclass(frozen=True)
class Extent:
    """How much is measured."""

    rounds: int = 5
    seconds: float = 1.0  # that a round of a contender lasts at least
    sample: int = 32  # cases for SciPy
    rtols: tuple[float, ...] = (1e-4, 1e-5, 1e-6, 1e-7, 1e-8, 1e-9, 1e-10)
    sides: tuple[int, ...] = (32, 100, 316, 1000)  # of square sweeps: 10^3 to 10^6 cases
    widths: tuple[int, ...] = (1, 2, 4, 8, 16, 32, 64, 128, 256, 512)
    cases: int = 4096  # of the sweep, for compiled peers
    ladder: tuple[float, ...] = LADDER  # tolerances to choose from
    scipy: tuple[str, ...] = ("LSODA", "Radau", "DOP853")
    python_peers: bool = True  # that compile when they start


QUICK = Extent(rounds=2, seconds=0.2, sample=4, rtols=(1e-4, 1e-6, 1e-8), sides=(32, 100), widths=(1, 16, 256),
               ladder=LADDER[6:36:2], scipy=("LSODA",), python_peers=False)  # fmt: skip
SMOKE = Extent(rounds=1, seconds=0.0, sample=2, rtols=(1e-5, 1e-6), sides=(8,), widths=(64,), cases=64,
               ladder=(1e-5, 1e-6, 1e-7), scipy=("LSODA",),
               python_peers=False)  # fmt: skip


def say(text: str) -> None:
    """What is going on."""
    print(f"== {text}", file=sys.stderr, flush=True)


# ---- equal achieved error -------------------------------------------------------------------


def set_tolerances(bench: Bench, rows: list[Contender], ladder: tuple[float, ...]) -> None:
    """The loosest tolerance of each row; the number of threads makes no difference."""
    known: dict[str, float] = {}
    for row in rows:
        if row.name not in known:
            say(f"tolerance of {row.name}")
            known[row.name] = find_tolerance(bench, row, ladder)
        row.rtol = known[row.name]


def find_tolerance(bench: Bench, row: Contender, ladder: tuple[float, ...]) -> float:
    """All cases must meet the limit; where they take long, a sample says where on the ladder to begin."""
    if row.name.startswith("CVODE"):
        start = loosest_tolerance(bench.cvode(few(bench, 256)), ladder)
        ladder = ladder[ladder.index(start) :]
    if row.slow_start:
        ladder = tuple(rtol for rtol in ladder if rtol <= 1e-4)[::2]
    return loosest_tolerance(row, ladder)


def few(bench: Bench, count: int) -> np.ndarray:
    """Some of the bench's cases, spread over them."""
    return bench.some[spread_sample(min(count, len(bench.some))) * len(bench.some) // 4096]


def equal_error(bench: Bench, extent: Extent) -> tuple[Table, list[Contender]]:
    """The main table."""
    rows = [bench.lanes(method, threads) for method in bench.methods for threads in (1, 2)]
    rows += bench.all_peers(extent.scipy, extent.sample, extent.python_peers)
    set_tolerances(bench, rows, extent.ladder)
    for i in range(extent.rounds):
        say(f"round {i + 1} of {extent.rounds}")
        for row in rows:
            if i < 2 or not row.slow_start:
                row.measure(extent.seconds)
    table = Table("equal_error", "At equal error: the 64 x 64 sweep",
                  ["", "cores", "rtol", "error", "cases/s", "slowest", "fastest", "to odeint", "to CVODE"])  # fmt: skip
    beside = [find(rows, "Boost"), find(rows, "CVODE")]
    for row in rows:
        ratios = [f"{row.over(other):.3g}" if other else "-" for other in beside]
        rates = [grouped(rate) for rate in (row.rate, *row.span)]
        table.rows.append([row.name, str(row.cores), f"{row.rtol:.1e}", f"{row.error:.1e}", *rates, *ratios])
    table.note = (f"Loosest tolerance with the largest relative error of fall and closing time below {LIMIT:g}; "
                  f"cases/s are median, slowest and fastest of {extent.rounds} interleaved rounds, without files; "
                  "ratios are medians of the rounds' own. "
                  f"SciPy solves {extent.sample} of the cases, all others all.")  # fmt: skip
    return table, rows


def find(rows: list[Contender], start: str, cores: int = 1) -> Contender | None:
    """The first whose name starts so."""
    return next((row for row in rows if row.name.startswith(start) and row.cores == cores), None)


# ---- work and precision ---------------------------------------------------------------------


def work_precision(bench: Bench, extent: Extent) -> tuple[Table, dict[str, list[tuple[float, float]]]]:
    """Error and rate against the tolerance, one core; CVODE and SciPy on samples."""
    rows = [bench.lanes(method, 1) for method in bench.methods]
    for row in bench.all_peers(("LSODA",), extent.sample // 2, python_peers=False):
        rows.append(bench.cvode(few(bench, 256)) if row.name == bench.cvode_name else row)
    header = [""] + [f"{rtol:.0e}" for rtol in extent.rtols]
    table = Table("work_precision", "Work and precision: cases/s (largest error) against rtol, one core", header)
    lines: dict[str, list[tuple[float, float]]] = {}
    for row in rows:
        say(f"work and precision: {row.name}")
        cells, lines[row.name] = [], []
        for rtol in extent.rtols:
            row.rtol, row.seconds = rtol, []
            row.measure(0.3 * extent.seconds)
            cells.append(f"{grouped(row.rate)} ({row.error:.0e})")
            if np.isfinite(row.error):
                lines[row.name].append((row.error, row.rate))
        table.rows.append([row.name, *cells])
    table.note = (f"CVODE on 256, SciPy on {extent.sample // 2} of the cases. "
                  "The reference is good to 5e-10.")  # fmt: skip
    return table, lines


# ---- many cases, many lanes -----------------------------------------------------------------


def many_cases(bench: Bench, extent: Extent, rtols: dict[str, float]) -> tuple[Table, dict[str, tuple[float, float]]]:
    """Kernel and whole program; by method: program over kernel and memory [MiB] of the largest number of cases."""
    table = Table("cases", "Growing numbers of cases: cases/s",
                  ["", "cases", "kernel, 2 threads", "program, 1 thread", "program, 2 threads", "program/kernel",
                   "seconds", "MiB"])  # fmt: skip
    largest = {}
    for method in bench.methods:
        name, seconds = bench.lanes(method, 2).name, 0.0
        for side in extent.sides:
            n = side**2
            if seconds * n > LONGEST:
                table.rows.append([name, grouped(n), "takes too long", *["-"] * 5])
                continue
            say(f"{n} cases: {name}")
            deck = bench.deck(rtols[name], side, side, method=method)
            kernel, alone, both, memory = whole_program(bench, deck, extent)
            seconds = alone / n
            largest[name] = (kernel / both, memory)
            table.rows.append([name, grouped(n), *(grouped(n / time) for time in (kernel, alone, both)),
                               f"{kernel / both:.2f}", f"{both:.3g}", f"{memory:.0f}"])  # fmt: skip
    table.note = (
        "Square sweeps over the same pressures and gaps. Program: from its start to its end, results.nc and "
        "summary.csv written; program/kernel, seconds and largest resident memory with two threads."
    )
    return table, largest


def whole_program(bench: Bench, deck: Path, extent: Extent) -> tuple[float, float, float, float]:
    """Seconds of kernel (two threads) and program (one, two threads), memory of the last [MiB]; interleaved medians."""
    seconds: list[tuple[float, float, float]] = []
    memory = 0.0
    for _ in range(min(3, extent.rounds)):
        kernel = bench.run_kernel(deck, 2, 0.3 * extent.seconds)[0]
        alone = bench.run_program(deck, 1)[0]
        both, peak = bench.run_program(deck, 2)
        seconds.append((kernel, alone, both))
        memory = max(memory, peak)
        if sum(map(sum, seconds)) > LONGEST:
            break
    return *(median(column) for column in zip(*seconds, strict=True)), memory


def many_lanes(bench: Bench, extent: Extent, rtols: dict[str, float]) -> Table:
    """Rate and error against solver.width, one thread."""
    header = [""] + [str(width) for width in extent.widths]
    table = Table("lanes", "Growing numbers of lanes: cases/s (largest error) on one core", header)
    for method in bench.methods:
        cells = []
        for width in extent.widths:
            row = bench.lanes(method, 1, width=width)
            say(f"{width} lanes: {row.name}")
            row.rtol = rtols[row.name]
            row.measure(0.3 * extent.seconds)
            cells.append(f"{grouped(row.rate)} ({row.error:.0e})")
        table.rows.append([row.name, *cells])
    return table


# ---- what is wanted -------------------------------------------------------------------------


def goals(rows: list[Contender], largest: dict[str, tuple[float, float]]) -> Table:
    """Ratios of this run beside what they should be."""
    table = Table("goals", "Ratios of this run", ["", "measured", "wanted"])
    odeint, cvode = find(rows, "Boost"), find(rows, "CVODE")
    for name, beside, wanted in (("implicit", odeint, 3.0), ("implicit", cvode, 200.0), ("explicit", odeint, 5.5)):
        ours = find(rows, f"reedvalve, {name}")
        if ours and beside:
            table.rows.append([f"{name} lanes over {beside.name}", f"{ours.over(beside):.2f}", f"{wanted:g}"])
    for row in rows:
        alone = find(rows, row.name, 1)
        if row.cores == 2 and alone:
            table.rows.append([f"{row.name}: two threads over one", f"{row.over(alone):.2f}", "1.8"])
    for name, (share, memory) in largest.items():
        table.rows.append([f"{name}: program over kernel, most cases", f"{share:.2f}", "0.6"])
        table.rows.append([f"{name}: memory of the program, most cases [MiB]", f"{memory:.0f}", "below 300"])
    return table


def measure(bench: Bench, extent: Extent, output: Path) -> list[str]:
    """Everything; the names of those that missed the accuracy."""
    facts = describe(bench.program)
    main_table, rows = equal_error(bench, extent)
    rtols = {row.name: row.rtol for row in rows}
    precision, lines = work_precision(bench, extent)
    cases, largest = many_cases(bench, extent, rtols)
    tables = [main_table, goals(rows, largest), precision, cases, many_lanes(bench, extent, rtols)]
    path = write_report(output, facts, tables, ["work_precision.png"])
    draw_work_precision(output / "work_precision.png", lines, LIMIT)
    print(path.read_text(encoding="utf-8"))
    return [row.name for row in rows if not row.error < LIMIT]


def main() -> int:
    """Measure and print; the exit status is 1 when someone misses the accuracy."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").split("\n")[0])
    parser.add_argument("--build", type=Path, default=ROOT / "build" / "release", help="a build folder")
    parser.add_argument("--peers", type=Path, default=ROOT / "build" / "peers", help="where peers/build put them")
    parser.add_argument("--output", type=Path, default=ROOT / "results" / "benchmarks", help="for tables and picture")
    parser.add_argument("--quick", action="store_true", help="less of everything, in a minute")
    parser.add_argument("--smoke", action="store_true", help="as little as shows that it works; figures mean nothing")
    words = parser.parse_args()
    extent = SMOKE if words.smoke else QUICK if words.quick else Extent()
    with tempfile.TemporaryDirectory() as folder:
        bench = Bench(words.build.resolve(), words.peers.resolve(), Path(folder), extent.cases)
        missed = measure(bench, extent, words.output)
    if missed:
        print(f"The accuracy was missed by: {', '.join(missed)}", file=sys.stderr)
    return 1 if missed else 0


if __name__ == "__main__":
    sys.exit(main())
