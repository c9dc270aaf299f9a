#!/usr/bin/env python3
"""Largest errors of the 64 x 64 sweep of pressure and gap against the tolerance.

inputs/sweep_64x64.nml is run with one rtol after the other; its measures are held against
the stored reference, which SciPy made with rtol 1e-12.

usage: accuracy.py [--build FOLDER] [RTOL...]
"""

from __future__ import annotations

import argparse
import re
import subprocess
import sys
import tempfile
from pathlib import Path

import numpy as np

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "postproc" / "tests"))
from make_sweep_reference import read_reference  # noqa: E402

RTOLS = ["1e-3", "1e-4", "1e-5", "1e-6", "1e-7", "1e-8", "1e-9"]
RELATIVE = ("fall_ms", "closing_ms")
ABSOLUTE = ("undershoot_mm", "overshoot_mm")


def run(program: Path, folder: Path, rtol: str) -> np.ndarray:
    """The program's summary of all cases."""
    text = (ROOT / "inputs" / "sweep_64x64.nml").read_text(encoding="utf-8")
    text, found = re.subn(r"rtol = \S+", f"rtol = {rtol}", text)
    if found != 1:
        raise SystemExit("accuracy: rtol is not once in sweep_64x64.nml")
    deck, results = folder / "sweep.nml", folder / "sweep"
    deck.write_text(text, encoding="utf-8")
    subprocess.run([program, "run", deck, "-o", results, "--force", "--quiet"], check=True)
    return np.genfromtxt(
        results / "summary.csv", delimiter=",", names=True, deletechars="", dtype=None, encoding=None
    )  # fmt: skip


def main() -> int:
    """Run and print."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").split("\n")[0])
    parser.add_argument("--build", type=Path, default=ROOT / "build" / "release", help="a build folder")
    parser.add_argument("rtol", nargs="*", default=RTOLS)
    words = parser.parse_args()
    program = words.build / "drivers" / "reedvalve" / "reedvalve"
    if not program.is_file():
        raise SystemExit(f"accuracy: {program} is not built")
    reference = read_reference()
    print(f"{'rtol':>6}" + "".join(f"{name:>15}" for name in (*RELATIVE, *ABSOLUTE)))
    for rtol in words.rtol:
        with tempfile.TemporaryDirectory() as folder:
            table = run(program, Path(folder), rtol)
        errors = [np.abs(table[name] / reference[name] - 1.0).max() for name in RELATIVE]
        errors += [np.abs(table[name] - reference[name]).max() for name in ABSOLUTE]
        print(f"{rtol:>6}" + "".join(f"{error:15.1e}" for error in errors))
    print("Largest errors of 4096 cases: times relative, displacements in mm.")
    return 0


if __name__ == "__main__":
    sys.exit(main())
