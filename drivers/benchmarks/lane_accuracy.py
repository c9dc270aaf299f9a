#!/usr/bin/env python3
"""What company does to a case: errors and cost of lanes in random blocks of mixed hard and easy cases.

Gap 0.01 to 1 mm, pressure 0.1 to 500 kPa and viscosity 0.001 to 1 Pa s are drawn, evenly in their logarithms. Blocks of
as many cases as there are lanes make every group of lanes a mixture; each case is held against itself run alone with
rtol 1e-11. Then the cost: mixtures, the same cases sorted within one block, and easy cases without and with one hard
case in each group.

The single runs themselves are held against SciPy's Radau with rtol 1e-12, which knows nothing of this code, on a few.

usage: lane_accuracy.py [--build FOLDER] [--output FOLDER] [--cases N] [--seed N] [--check N] [--seconds S]
"""

from __future__ import annotations

import argparse
import re
import subprocess
import sys
import tempfile
from pathlib import Path

import netCDF4
import numpy as np
from report import Table, grouped
from sweep import ROOT, Valve, square_wave_response

KEYS = ("film.gap_mm", "pressure.inlet_kpa", "fluid.viscosity_pa_s")
RANGES = ((0.01, 1.0), (0.1, 500.0), (1e-3, 1.0))
EASY = ((0.1, 1.0), (5.0, 40.0), (0.03, 0.06))  # of the same keys
STIFF = (0.01, 5.0, 1.0)  # a film that damps a thousand times as fast as the reed swings
LIVELY = (1.0, 500.0, 1e-3)  # a reed that swings to the end
RTOLS = (1e-4, 1e-5, 1e-6)
WIDTHS = (1, 8, 64, 256)
EXACT = 1e-11  # tolerance of the single runs
RELATIVE = ("fall_ms", "closing_ms", "steady_mm")


class Blocks:
    """Runs designs of cases."""

    def __init__(self, build: Path, folder: Path, seconds: float) -> None:
        self.program = build / "drivers" / "reedvalve" / "reedvalve"
        self.kernel = build / "drivers" / "benchmarks" / "block_speed"
        self.folder = folder
        self.seconds = str(seconds)
        for path in (self.program, self.kernel):
            if not path.is_file():
                raise SystemExit(f"lane_accuracy: {path} is not built")

    def deck(self, cases: np.ndarray, rtol: float, width: int, block: int, method: str | None) -> Path:
        """A deck of a design; rows are cases in the order of KEYS."""
        text = (ROOT / "inputs" / "sweep_64x64.nml").read_text(encoding="utf-8")
        text = re.sub(r"^&sweep.*\n", "", text, flags=re.MULTILINE)
        solver = f"rtol = {rtol:g}, width = {width}" + (f", method = '{method}'" if method else "")
        for pattern, line in ((r"rtol = \S+", solver), (r"t_end_ms = \S+", f"t_end_ms = 40.0, block_size = {block}")):
            text, found = re.subn(pattern, line, text)
            if found != 1:
                raise SystemExit(f"lane_accuracy: {pattern} is not once in sweep_64x64.nml")
        text = re.sub(r"viscosity_pa_s = \S+", "", text) + "\n&design file = 'plan.csv' /\n"
        lines = [",".join(KEYS), *(",".join(f"{x:.8g}" for x in row) for row in cases)]
        (self.folder / "plan.csv").write_text("\n".join(lines) + "\n", encoding="utf-8")
        path = self.folder / "blocks.nml"
        path.write_text(text, encoding="utf-8")
        return path

    def run(self, *words: object) -> dict[str, np.ndarray]:
        """Measures of all cases; NaN where one did not happen."""
        deck, out = self.deck(*words), self.folder / "blocks"
        done = subprocess.run(
            [self.program, "run", deck, "-o", out, "--force", "--quiet"], capture_output=True, text=True
        )
        if done.returncode > 1:
            raise SystemExit(f"lane_accuracy: reedvalve run: {done.stderr}")
        with netCDF4.Dataset(out / "results.nc") as file:
            result = {name: file[name][:].filled(np.nan) for name in (*RELATIVE, "undershoot_mm")}
            return result | {"failed": file["status"][:] != 0}

    def rate(self, cases: np.ndarray, *words: object) -> float:
        """Cases per second without files, one thread; NaN where a case fails."""
        done = subprocess.run(
            [self.kernel, self.deck(cases, *words), "1", self.folder / "times", self.seconds],
            capture_output=True,
            text=True,
        )
        return len(cases) / float(done.stdout) if done.returncode == 0 else float("nan")

    def methods(self) -> list[str | None]:
        """Values of solver.method; None where this build has no such key."""
        deck = self.deck(draw(np.random.default_rng(1), 2, RANGES), 1e-6, 1, 1, "explicit")
        known = subprocess.run([self.program, "check", deck], capture_output=True).returncode == 0
        return ["implicit", "explicit"] if known else [None]


def draw(random: np.random.Generator, count: int, ranges: tuple[tuple[float, float], ...]) -> np.ndarray:
    """Cases, evenly in the logarithm of each key."""
    low, high = np.log(np.array(ranges)).T
    return np.exp(low + (high - low) * random.random((count, len(ranges))))


def errors(result: dict[str, np.ndarray], exact: dict[str, np.ndarray]) -> tuple[list[float], int, int]:
    """Of all cases that ended well in both: largest errors of fall, closing, steady (relative) and undershoot (over
    steady), and how many measures are in one only; and how many cases failed."""
    well = ~(result["failed"] | exact["failed"])
    worst = []
    for name in (*RELATIVE, "undershoot_mm"):
        size = exact["steady_mm"] if name == "undershoot_mm" else exact[name]
        worst.append(float(np.nanmax((np.abs(result[name] - exact[name]) / size)[well])))
    missing = sum(int((np.isnan(result[name]) != np.isnan(exact[name]))[well].sum()) for name in RELATIVE)
    return worst, missing, int(result["failed"].sum())


def distance_to_scipy(cases: np.ndarray, exact: dict[str, np.ndarray], count: int) -> float:
    """Largest relative distance of fall and closing times to SciPy's, of the first cases."""
    worst = [0.0]
    for i, (gap, inlet, viscosity) in enumerate(cases[:count]):
        scipy = square_wave_response(Valve(gap=1e-3 * gap, viscosity=viscosity), 1e3 * inlet, squeeze=True)
        worst += [abs(exact["fall_ms"][i] / scipy.fall_ms - 1.0), abs(exact["closing_ms"][i] / scipy.closing_ms - 1.0)]
    return float(np.nanmax(worst))


def accuracy(blocks: Blocks, cases: np.ndarray, method: str | None, exact: dict[str, np.ndarray]) -> Table:
    """Worst lane errors."""
    name = method or "implicit"
    table = Table(f"lane_accuracy_{name}", f"Worst errors of {len(cases)} cases in mixed groups of lanes, {name}",
                  ["rtol", "lanes", "fall", "closing", "steady", "undershoot", "worst/rtol", "missing",
                   "failed"])  # fmt: skip
    for rtol in RTOLS:
        for width in WIDTHS:
            worst, missing, failed = errors(blocks.run(cases, rtol, width, width, method), exact)
            table.rows.append([f"{rtol:.0e}", str(width), *(f"{error:.1e}" for error in worst),
                               f"{max(worst) / rtol:.1f}", str(missing), str(failed)])  # fmt: skip
    table.note = (
        f"Against the same cases alone at rtol {EXACT:g}, of which {int(exact['failed'].sum())} failed: fall, closing "
        "and steady relative, undershoot over the steady displacement (it is zero below ten times rtol); missing: "
        "measures that happened in one run only."
    )
    return table


def cost(blocks: Blocks, cases: np.ndarray, easy: np.ndarray, method: str | None, rtol: float = 1e-5) -> Table:
    """What mixtures cost."""
    name = method or "implicit"
    table = Table(f"lane_cost_{name}", f"Cost of mixtures at rtol {rtol:g}: cases/s on one core, {name}",
                  ["lanes", "mixed", "sorted", "easy", "easy, one stiff", "easy, one lively"])  # fmt: skip
    for width in WIDTHS:
        rates = [blocks.rate(cases, rtol, width, block, method) for block in (width, len(cases))]
        rates.append(blocks.rate(easy, rtol, width, width, method))
        for hard in (STIFF, LIVELY) if width > 1 else ():
            company = easy.copy()
            company[::width] = hard
            rates.append(blocks.rate(company, rtol, width, width, method))
        cells = [grouped(rate) for rate in rates[:3]]
        cells += [f"{grouped(rate)} (x {rates[2] / rate:.2f})" for rate in rates[3:]]
        cells = ["a case fails" if np.isnan(rate) else cell for rate, cell in zip(rates, cells, strict=True)]
        table.rows.append([str(width), *cells, *["-"] * (5 - len(rates))])
    table.note = (
        "mixed: blocks of as many cases as lanes, in random order; sorted: the same cases in one block, which sorts "
        "them. easy: gap 0.1 to 1 mm, 5 to 40 kPa, 0.03 to 0.06 Pa s; with one stiff (0.01 mm, 5 kPa, 1 Pa s) or one "
        "lively case (1 mm, 500 kPa, 0.001 Pa s) in each group, and how many times as long that takes."
    )
    return table


def main() -> int:
    """Measure and print."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").split("\n")[0])
    parser.add_argument("--build", type=Path, default=ROOT / "build" / "release", help="a build folder")
    parser.add_argument("--output", type=Path, default=ROOT / "results" / "benchmarks", help="for lane_accuracy.md")
    parser.add_argument("--cases", type=int, default=1024)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--check", type=int, default=0, help="single runs to hold against SciPy, some seconds each")
    parser.add_argument("--seconds", type=float, default=0.5, help="that a measurement of speed lasts at least")
    words = parser.parse_args()
    random = np.random.default_rng(words.seed)
    cases = draw(random, words.cases, RANGES)
    easy = draw(random, words.cases, EASY)
    with tempfile.TemporaryDirectory() as folder:
        blocks = Blocks(words.build.resolve(), Path(folder), words.seconds)
        methods = blocks.methods()
        exact = blocks.run(cases, EXACT, 1, 256, methods[0])
        if words.check:
            far = distance_to_scipy(cases, exact, words.check)
            print(f"Largest relative distance of {words.check} single runs to SciPy's Radau: {far:.1e}\n")
        tables = [accuracy(blocks, cases, method, exact) for method in methods]
        tables += [cost(blocks, cases, easy, method) for method in methods]
    text = "\n".join(table.markdown() for table in tables)
    words.output.mkdir(parents=True, exist_ok=True)
    (words.output / "lane_accuracy.md").write_text("# Lanes in company\n\n" + text, encoding="utf-8")
    for table in tables:
        table.write_csv(words.output)
    print(text)
    return 0


if __name__ == "__main__":
    sys.exit(main())
