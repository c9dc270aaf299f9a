#!/usr/bin/env python3
"""What a sweep of 100 000 cases from Python costs, beside the same cases without Python.

Rounds of three follow each other: what the program computes, without its files (block_speed); the whole
program, its files among it (its own time, from run.log); Valve.sweep, from arrays to columns. Whatever else the
machine does only adds to a time: the fastest rounds are the ones to compare.

usage: python_cost.py [--build FOLDER] [--rounds N] [--threads N]
"""

from __future__ import annotations

import argparse
import os
import re
import sys
import tempfile
import time
from pathlib import Path
from statistics import median

import numpy as np
from contenders import Bench
from sweep import ROOT

PRESSURES, GAPS = 250, 400


def sweep_from_python(threads: int) -> tuple[float, np.ndarray]:
    """Seconds, and fall and closing times of the cases of sweep_64x64.nml with other counts [ms]."""
    import reedvalve

    valve = reedvalve.Valve(reed_action_area_mm2=12.56, hydro_load="published")
    pressures, gaps = np.linspace(5.0, 40.0, PRESSURES), np.linspace(0.05, 0.30, GAPS)
    start = time.perf_counter()
    result = valve.sweep(reedvalve.product({"pressure.inlet_kpa": pressures, "film.gap_mm": gaps}), threads=threads)
    seconds = time.perf_counter() - start
    return seconds, np.stack([result["fall_ms"], result["closing_ms"]], axis=-1)


def one_round(bench: Bench, deck: Path, threads: int) -> tuple[float, float, float]:
    """Seconds of the kernel, of the program, of the sweep from Python."""
    kernel, times = bench.run_kernel(deck, threads, 0.0)
    bench.run_program(deck, threads)
    log = (deck.with_suffix("") / "run.log").read_text(encoding="utf-8")
    ours, found = sweep_from_python(threads)
    np.testing.assert_allclose(found, times, rtol=3e-5)  # last bits of pressures differ, and so do steps
    return kernel, float(re.findall(r"seconds: ([\d.]+)", log)[-1]), ours


def main() -> int:
    """Measure and print."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").split("\n")[0])
    parser.add_argument("--build", type=Path, default=ROOT / "build" / "release", help="a build folder")
    parser.add_argument("--rounds", type=int, default=7)
    parser.add_argument("--threads", type=int, default=1)
    words = parser.parse_args()
    os.environ["REEDVALVE_LIBRARY"] = str(words.build / "src" / "api" / "libreedvalve.so")
    sys.path.insert(0, str(ROOT / "drivers" / "python"))
    with tempfile.TemporaryDirectory() as folder:
        bench = Bench(words.build, Path(folder), Path(folder))
        deck = bench.deck(1e-6, PRESSURES, GAPS)
        seconds = [one_round(bench, deck, words.threads) for _ in range(words.rounds)]
    columns = list(zip(*seconds, strict=True))
    head = f"{PRESSURES * GAPS} cases, threads: {words.threads}, rounds: {words.rounds}"
    print(f"{head:39} fastest   median     to the first")
    for name, column in zip(("computed, no files", "reedvalve run", "Valve.sweep"), columns, strict=True):
        share = 100.0 * (min(column) / min(columns[0]) - 1.0)
        print(f"{name:39}{min(column):8.3f} {median(column):8.3f} s {share:+13.1f} %")
    return 0


if __name__ == "__main__":
    sys.exit(main())
