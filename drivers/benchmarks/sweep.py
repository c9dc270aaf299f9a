"""The cases that everything is measured with: the 64 x 64 sweep of pressure and gap, and larger ones like it.

The deck is inputs/sweep_64x64.nml with other tolerances, lanes or counts. Peers read the same cases as a list of
numbers, made by the reference model in Python, which shares nothing with the program.
"""

from __future__ import annotations

import re
import sys
from dataclasses import replace
from pathlib import Path

import numpy as np

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "postproc" / "tests"))
from make_sweep_reference import read_reference, sweep_cases  # noqa: E402
from reference_model import Valve  # noqa: E402
from reference_model import square_wave_response as square_wave_response  # noqa: E402

LIMIT = 1.0e-4  # relative, of every fall and closing time
PERIOD, TRANSITION = 40e-3, 1e-3  # of the square wave [s]
HEADER = "mass_kg,damping_n_s_m,stiffness_n_m,area_m2,squeeze_n_s_m2,gap_m,pressure_pa,period_s,transition_s"


def deck_text(rtol: float, pressures: int = 64, gaps: int = 64, **solver: object) -> str:
    """The deck with `pressures` x `gaps` cases; further words are keys of &solver, None leaves one out."""
    text = (ROOT / "inputs" / "sweep_64x64.nml").read_text(encoding="utf-8")
    words = [f"rtol = {rtol:g}"]
    words += [f"{key} = {value!r}" for key, value in solver.items() if value is not None]
    counts = iter((pressures, gaps))
    for pattern, line, due in (
        (r"rtol = \S+", lambda _: ", ".join(words), 1),
        (r"count = 64", lambda _: f"count = {next(counts)}", 2),
    ):
        text, found = re.subn(pattern, line, text)
        if found != due:
            raise SystemExit(f"benchmark: {pattern} is {found} times in sweep_64x64.nml, not {due}")
    return text


def write_cases(path: Path, cases: list[tuple[float, float]]) -> Path:
    """The list that peers read, of (inlet pressure [kPa], gap [mm])."""
    valve = Valve()
    added_mass, damping = valve.hydrodynamic_load()
    lines = [HEADER]
    for inlet, gap in cases:
        one = replace(valve, gap=1e-3 * gap)
        numbers = (one.reed_mass + added_mass, damping, one.stiffness, one.area, one.squeeze_constant, one.gap)
        lines.append(",".join(f"{float(x):.17g}" for x in (*numbers, 1e3 * inlet, PERIOD, TRANSITION)))
    path.write_text("\n".join(lines) + "\n", encoding="utf-8")
    return path


def all_cases() -> list[tuple[float, float]]:
    """(inlet pressure [kPa], gap [mm]) of the 4096 cases in the deck's order."""
    return sweep_cases()


def reference_times() -> np.ndarray:
    """Fall and closing time [ms] of the 4096 cases, a row each; SciPy's DOP853 with rtol 1e-12."""
    stored = read_reference()
    return np.stack([stored["fall_ms"], stored["closing_ms"]], axis=1)


def largest_error(times: np.ndarray, reference: np.ndarray) -> float:
    """Relative, of all fall and closing times; infinite when one is missing."""
    error = np.abs(times / reference - 1.0)
    return float(error.max()) if np.isfinite(error).all() else float("inf")


def spread_sample(count: int) -> np.ndarray:
    """Some of the 4096 cases, from 0: first and last and, between them, all pressures and gaps in turn."""
    return np.linspace(0, 4095, count).round().astype(int)
