"""A result of film models as the Fortran program writes it, with forces and pressures made up for the tests."""

from __future__ import annotations

import math
from pathlib import Path

import netCDF4
import numpy as np
from synthetic import MEASURES, STATUS, TRACES, _flags, _text_variable

MODELS = ("traditional", "squeeze", "film", "film_table")
WARNINGS = "reynolds_range cavitation wide_gap"
TIME_MS = np.arange(0.0, 40.001, 0.05)
FIELD_MS = (19.5, 20.0, 20.5, 21.0)
HOLE_N = 1e-3 * math.pi * 4.0 * 20.0  # open valve's force on part C
RAYS, RINGS = 13, 5

DECK = """\
&run      title = 'Synthetic film', model = 'film', t_end_ms = 40, traces = .true., start = 'rest' /
&reed     a_mm = 2.5, b_mm = 1, hole_diameter_mm = 4, width_mm = 6, thickness_mm = 0.15,
          density_kg_m3 = 8950, youngs_modulus_gpa = 110, poisson_ratio = 0.3 /
&fluid    density_kg_m3 = 875, viscosity_pa_s = 0.0484 /
&hydro    load = 'maali' /
&film     gap_mm = 0.05, modes = 4, mesh = 1, edge_elongation = {edge}, vapour_pressure_kpa = -101.325 /
&pressure kind = 'square', inlet_kpa = 20, outlet_kpa = 0, period_ms = 40, transition_ms = 1 /
"""


def inlet_kpa(time):
    """The square wave's closing ramp."""
    return 20.0 * np.clip(20.5 - time, 0.0, 1.0)


def mesh():
    """Nodes of the half land on rays about the hole's centre [mm], and cells counted from 1."""
    corner = math.pi - math.atan2(3.0, 4.5)
    angles = np.concatenate([np.linspace(0, math.pi / 2, 7), np.linspace(math.pi / 2, corner, 5)[1:],
                             np.linspace(corner, math.pi, 3)[1:]])  # fmt: skip
    rim = np.where(angles <= math.pi / 2, 3.0, 0.0)
    side = (angles > math.pi / 2) & (angles <= corner)
    rim[side] = 3.0 / np.sin(angles[side])
    rim[angles > corner] = -4.5 / np.cos(angles[angles > corner])
    radius = 2.0 + np.linspace(0, 1, RINGS) * (rim[:, None] - 2.0)
    x, y = 4.5 + radius * np.cos(angles)[:, None], radius * np.sin(angles)[:, None]
    y[-1] = 0.0
    first = (np.arange(RAYS - 1)[:, None] * RINGS + np.arange(RINGS - 1)).ravel() + 1
    return x.ravel(), y.ravel(), first[:, None] + np.array([0, 1, RINGS + 1, RINGS])


def forces(gap, time):
    """A, B and C [N]: in the narrow gap A and B stay as they are while C falls below them."""
    hole = HOLE_N / 20.0 * inlet_kpa(time)
    if gap < 0.1:
        return np.full_like(time, HOLE_N * 0.8), np.full_like(time, HOLE_N * 0.35), hole
    return 0.5 * hole, 0.4 * hole, hole


def write_film_result(
    folder: Path,
    gaps=(0.05, 0.20),
    pressures=(20.0,),
    model="film",
    edge=0.0,
    traces=True,
    fields=False,
    steady=0.1305,
    fail: int | None = None,
) -> Path:
    """Write folder/results.nc with one case for each gap and pressure; case `fail`, from 0, has failed."""
    folder.mkdir(parents=True, exist_ok=True)
    cases = [(gap, pressure) for gap in gaps for pressure in pressures]
    n = len(cases)
    gap, pressure = (np.array(values) for values in zip(*cases, strict=True))
    measures = {name: np.full(n, np.nan) for name in MEASURES}
    measures["steady_mm"] = steady * pressure / 20.0
    measures["fall_ms"], measures["closing_ms"] = (c * (1 + edge / 4) * (0.05 / gap) ** 0.5 for c in (1.542, 3.882))
    measures["opening_ms"] = np.full(n, 1.06)
    measures["undershoot_mm"] = np.where(gap > 0.09, 0.01, 0.0)
    measures["peak_squeeze_n"] = np.full(n, 0.06)
    with netCDF4.Dataset(folder / "results.nc", "w") as file:
        file.createDimension("case", n)
        file.title, file.deck, file.effective_values = "Synthetic film", "&run /", DECK.format(edge=edge)
        _flags(file, "model", MODELS, [model] * n)
        for name, values, unit in (("film.gap_mm", gap, "mm"), ("pressure.inlet_kpa", pressure, "kPa")):
            if len(set(values)) > 1:
                _real(file, name, ("case",), values, unit)
        for name, unit in MEASURES.items():
            _real(file, name, ("case",), measures[name], unit)
        _real(file, "lowest_film_kpa", ("case",), -39.0 * 0.05 / gap, "kPa")
        _flags(file, "status", STATUS, ["film_closed" if i == fail else "ok" for i in range(n)])
        warnings = file.createVariable("warnings", "i1", ("case",))
        warnings.flag_masks, warnings.flag_meanings = np.array([1, 2, 4], "i1"), WARNINGS
        warnings[:] = np.where(gap >= 0.15, 4, 0)
        _text_variable(file, "message", 200, ["warning: the gap is wide" if g >= 0.15 else "" for g in gap])
        if traces:
            _traces(file, gap, steady)
        if fields:
            _fields(file, gap, fail)
    return folder


def _real(file, name, dimensions, values, unit):
    variable = file.createVariable(name, "f8", dimensions, fill_value=np.nan)
    variable.units, variable.long_name = unit, name
    variable[:] = values
    return variable


def _traces(file, gap, steady):
    file.createDimension("time", len(TIME_MS))
    _real(file, "time_ms", ("time",), TIME_MS, "ms")
    parts = [forces(g, TIME_MS) for g in gap]
    shape = np.clip(21.0 - TIME_MS, 0.0, 1.0) * steady
    known = {"inlet_kpa": inlet_kpa(TIME_MS), "displacement_mm": shape}
    for name, unit in TRACES.items():
        _real(file, name, ("case", "time"), np.tile(known.get(name, np.zeros_like(TIME_MS)), (len(gap), 1)), unit)
    for i, letter in enumerate("abc"):
        _real(file, f"part_{letter}_n", ("case", "time"), np.array([p[i] for p in parts]), "N")


def _fields(file, gap, fail):
    x, y, faces = mesh()
    for name, size in (("film_node", len(x)), ("field_time", len(FIELD_MS)), ("film_face", len(faces)), ("corner", 4)):
        file.createDimension(name, size)
    topology = file.createVariable("film_mesh", "i4", ())
    topology.cf_role, topology.topology_dimension = "mesh_topology", 2
    topology.node_coordinates, topology.face_node_connectivity = "film_x_mm film_y_mm", "film_faces"
    _real(file, "film_x_mm", ("film_node",), x, "mm")
    _real(file, "film_y_mm", ("film_node",), y, "mm")
    cells = file.createVariable("film_faces", "i4", ("film_face", "corner"))
    cells.cf_role, cells.start_index = "face_node_connectivity", 1
    cells[:] = faces
    _real(file, "field_time_ms", ("field_time",), FIELD_MS, "ms")
    values = np.array([[pressure(g, t, x) for t in FIELD_MS] for g in gap])
    if fail is not None:
        values[fail] = np.nan
    _real(file, "film_pressure_kpa", ("case", "field_time", "film_node"), values, "kPa")


def pressure(gap, time, x):
    """Highest at the root while the reed falls in a narrow gap, below the inlet's else [kPa]."""
    inlet = inlet_kpa(np.array(time))
    return 6.0 * (7.5 - x) * (time > 19.6) if gap < 0.1 else 0.1 * inlet * x
