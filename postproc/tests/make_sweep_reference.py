"""Make ref/sweep_64x64.csv.gz: the squeeze model over 64 pressures and 64 gaps.

Every case is solved by reference_model with DOP853 at rtol 1e-12. The program at rtol 1e-11,
implicitly and explicitly, agrees to 1e-11 in the median and to 5e-10 in the worst case, where
Radau (ten times as slow) is on the program's side. About ten minutes on two cores:

    python make_sweep_reference.py
"""

from __future__ import annotations

import gzip
from multiprocessing import Pool
from pathlib import Path

import numpy as np
from reference_model import Valve, square_wave_response

PATH = Path(__file__).parent / "ref" / "sweep_64x64.csv.gz"
PRESSURES_KPA = np.linspace(5.0, 40.0, 64)
GAPS_MM = np.linspace(0.05, 0.30, 64)
COLUMNS = ("inlet_kpa", "gap_mm", "fall_ms", "closing_ms", "overshoot_mm", "undershoot_mm")
HEADER = """\
# Squeeze model, Table II with k_s = 0.0075 and the published hydrodynamic load, square wave
# of 40 ms with ramps of 1 ms, from rest: 64 inlet pressures x 64 gaps, evenly spaced.
# Made by make_sweep_reference.py (SciPy DOP853, rtol 1e-12).
"""


def sweep_cases() -> list[tuple[float, float]]:
    """(inlet pressure [kPa], gap [mm]) of all cases, the gap varying fastest."""
    return [(float(p), float(g)) for p in PRESSURES_KPA for g in GAPS_MM]


def solve_case(case: tuple[float, float], method: str = "DOP853") -> tuple[float, ...]:
    """One row in the order of COLUMNS."""
    inlet, gap = case
    valve = Valve(gap=gap * 1e-3)
    r = square_wave_response(valve, inlet * 1e3, squeeze=True, method=method)
    return inlet, gap, r.fall_ms, r.closing_ms, r.overshoot_mm, r.undershoot_mm


def read_reference() -> dict[str, np.ndarray]:
    """The stored sweep: column name -> 4096 values in the order of sweep_cases()."""
    table = np.loadtxt(PATH, delimiter=",", skiprows=HEADER.count("\n") + 1)
    return dict(zip(COLUMNS, table.T, strict=True))


def main() -> None:
    """Solve all cases and write the file; equal results give equal bytes."""
    with Pool() as pool:
        rows = pool.map(solve_case, sweep_cases(), chunksize=16)
    lines = [",".join(f"{value:.11g}" for value in row) for row in rows]
    text = HEADER + ",".join(COLUMNS) + "\n" + "\n".join(lines) + "\n"
    with open(PATH, "wb") as raw, gzip.GzipFile("", "wb", mtime=0, fileobj=raw) as packed:
        packed.write(text.encode("ascii"))


if __name__ == "__main__":
    main()
