"""Result files as the Fortran program writes them, computed by the reference model.

They let the package be tested without the program; the layout is that of the project's
results: one variable for each swept key and measure, texts as character variables.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from pathlib import Path

import netCDF4
import numpy as np
from reference_model import (
    Polygon,
    Valve,
    measure,
    solve,
    square_wave,
)

MODELS = ("traditional", "squeeze")
STATUS = ("ok", "step_too_small", "film_closed", "not_finite", "too_many_steps",
          "no_convergence", "bad_case")  # fmt: skip
MEASURES = {
    "steady_mm": "mm", "rise_ms": "ms", "opening_ms": "ms", "overshoot_mm": "mm", "fall_ms": "ms",
    "closing_ms": "ms", "zero_ms": "ms", "undershoot_mm": "mm", "peak_squeeze_n": "N",
}  # fmt: skip
TRACES = {"displacement_mm": "mm", "velocity_mm_ms": "mm ms-1", "inlet_kpa": "kPa",
          "outlet_kpa": "kPa", "squeeze_n": "N"}  # fmt: skip

DECK = """\
&run      title = 'Synthetic "valve"', model = 'traditional', 'squeeze', t_end_ms = 40.0,
          traces = {traces}, start = '{start}' /
&reed     a_mm = 2.5, b_mm = 1.0, hole_diameter_mm = 4.0, width_mm = 6.0, thickness_mm = 0.15,
          density_kg_m3 = 8950.0, youngs_modulus_gpa = 110.0, k_a = 0.91, action_area_mm2 = 12.56 /
&fluid    density_kg_m3 = 875.0, viscosity_pa_s = 0.0484 /
&hydro    load = 'published' /
&film     gap_mm = 0.05, k_s = {k_s}, acts = 'closing' /
&pressure kind = '{kind}', inlet_kpa = 20.0, outlet_kpa = 0.0, period_ms = 40.0, transition_ms = 1.0{more} /
&solver   rtol = 1.0e-6 /
"""


@dataclass
class Case:
    """One case to be solved and written."""

    model: str
    inlet_kpa: float = 20.0
    gap_mm: float = 0.05
    drive: Polygon | None = None  # a trace instead of the square wave
    file: str = ""
    status: str = "ok"
    message: str = ""
    without: Sequence[str] = ()  # measures that did not happen
    extra: dict[str, float] = field(default_factory=dict)  # further swept keys


def _text_variable(file: netCDF4.Dataset, name: str, width: int, texts: list[str]) -> None:
    length = f"{name.replace('.', '_')}_length"
    file.createDimension(length, width)
    variable = file.createVariable(name, "S1", ("case", length), zlib=True)
    variable.long_name = name
    variable.units = "1"
    for i, text in enumerate(texts):
        if text:
            variable[i, :] = netCDF4.stringtochar(np.array([text], f"S{width}"))[0]


def _flags(file: netCDF4.Dataset, name: str, words: Sequence[str], values: list[str]) -> None:
    variable = file.createVariable(name, "i1", ("case",))
    variable.flag_values = np.arange(1 if name == "model" else 0, len(words) + (name == "model"),
                                     dtype="i1")  # fmt: skip
    variable.flag_meanings = " ".join(words)
    variable.long_name = name
    variable.units = "1"
    variable[:] = [variable.flag_values[words.index(value)] for value in values]


def write_result(
    folder: Path,
    cases: list[Case],
    time_ms: np.ndarray | None = None,
    k_s: float = 0.0075,
) -> Path:
    """Solve the cases and write folder/results.nc; traces at `time_ms` if given."""
    folder.mkdir(parents=True, exist_ok=True)
    traced = any(case.drive for case in cases)
    text = DECK.format(
        traces=".true." if time_ms is not None else ".false.", k_s=k_s,
        start="equilibrium" if traced else "rest", kind="trace" if traced else "square",
        more=", event_ms = 500.0" if traced else "",
    )  # fmt: skip
    measures = {name: np.full(len(cases), np.nan) for name in MEASURES}
    n_time = 0 if time_ms is None else len(time_ms)
    traces = {name: np.full((len(cases), n_time), np.nan) for name in TRACES}
    for i, case in enumerate(cases):
        if case.status == "ok":
            _solve(case, k_s, time_ms, measures, traces, i)
    with netCDF4.Dataset(folder / "results.nc", "w") as file:
        file.createDimension("case", len(cases))
        file.title = 'Synthetic "valve"'
        file.deck = text
        file.effective_values = text
        file.code_version = "reedvalve 0.1.0"
        file.compiler = "none: computed by SciPy"
        file.library_versions = "SciPy"
        file.Conventions = "CF-1.10"
        _flags(file, "model", MODELS, [case.model for case in cases])
        swept = {
            "pressure.inlet_kpa": ([case.inlet_kpa for case in cases], "kPa"),
            "film.gap_mm": ([case.gap_mm for case in cases], "mm"),
        }
        for key in {key: None for case in cases for key in case.extra}:
            swept[key] = ([case.extra[key] for case in cases], key.rsplit("_", 1)[-1])
        for key, (values, unit) in swept.items():
            if len(set(values)) > 1:
                variable = file.createVariable(key, "f8", ("case",))
                variable.units, variable.long_name = unit, key
                variable[:] = values
        if traced:
            _text_variable(file, "pressure.file", 64, [case.file for case in cases])
        for name, unit in MEASURES.items():
            variable = file.createVariable(name, "f8", ("case",), fill_value=np.nan)
            variable.units, variable.long_name = unit, name
            variable[:] = measures[name]
        _flags(file, "status", STATUS, [case.status for case in cases])
        variable = file.createVariable("warnings", "i1", ("case",))
        variable.flag_masks, variable.flag_meanings = np.array([1], "i1"), "reynolds_range"
        variable[:] = 0
        _text_variable(file, "message", 200, [case.message for case in cases])
        if time_ms is not None:
            file.createDimension("time", n_time)
            variable = file.createVariable("time_ms", "f8", ("time",))
            variable.units, variable.long_name = "ms", "time"
            variable[:] = time_ms
            for name, unit in TRACES.items():
                variable = file.createVariable(name, "f8", ("case", "time"), fill_value=np.nan)
                variable.units, variable.long_name = unit, name
                variable[:] = traces[name]
    return folder


def _solve(case: Case, k_s: float, time_ms: np.ndarray | None, measures: dict, traces: dict,
           i: int) -> None:  # fmt: skip
    valve = Valve(gap=case.gap_mm * 1e-3, k_s=k_s)
    drive = case.drive or square_wave(case.inlet_kpa * 1e3)
    event, end = (drive.time[0] if case.drive else drive.time[2]), drive.time[-1]
    open_pa = float(np.interp(event, drive.time, drive.pressure))
    steady = open_pa * valve.area / valve.stiffness
    squeeze = case.model == "squeeze"
    motion = solve(valve, drive, squeeze, start=steady if case.drive else 0.0, method="DOP853", rtol=1e-9)
    response = measure(motion, steady, event, end)
    for name in ("steady_mm", "overshoot_mm", "fall_ms", "closing_ms", "zero_ms", "undershoot_mm"):
        measures[name][i] = getattr(response, name)
    time = np.linspace(drive.time[0], end, 8001)
    u, v = motion(time)
    force = valve.squeeze_constant * np.maximum(-v, 0.0) / (u + valve.gap) ** 3 * squeeze
    measures["peak_squeeze_n"][i] = force.max()
    if not case.drive:
        measures["opening_ms"][i] = 1e3 * time[np.argmax(u >= 0.98 * steady)]
        measures["rise_ms"][i] = 1e3 * (time[np.argmax(u >= 0.9 * steady)] - time[np.argmax(u >= 0.1 * steady)])
    for name in case.without:
        measures[name][i] = np.nan
    if time_ms is not None:
        shown = 1e-3 * np.asarray(time_ms)
        traces["displacement_mm"][i] = 1e3 * np.interp(shown, time, u)
        traces["velocity_mm_ms"][i] = np.interp(shown, time, v)
        traces["inlet_kpa"][i] = 1e-3 * np.interp(shown, drive.time, drive.pressure)
        traces["outlet_kpa"][i] = 0.0
        traces["squeeze_n"][i] = np.interp(shown, time, force)


def table_5_cases() -> list[Case]:
    """Both models under the three reconstructed traces, read from the project's inputs."""
    folder = Path(__file__).resolve().parents[2] / "inputs" / "traces"
    cases = []
    for model in MODELS:
        for number in (1, 2, 3):
            path = folder / f"table_5_condition_{number}.csv"
            rows = np.loadtxt(path, delimiter=",", skiprows=8)
            ends = np.flatnonzero(np.abs(np.diff(rows[:, 1], 2)) > 0.05) + 1  # the corners
            rows = rows[[0, *ends, -1]]
            drive = Polygon(rows[:, 0] * 1e-3, rows[:, 1] * 1e3)
            cases.append(Case(model, drive=drive, file=path.name))
    return cases
