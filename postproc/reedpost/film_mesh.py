"""The film's mesh under the half reed, the whole reed made from it, and means over the reed's parts."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from reedpost.results import Result

FINE = 8  # pieces a cell's side is cut into where means over the parts are taken
LAND_A, LAND_B, HOLE_C = 0, 1, 2


@dataclass(frozen=True)
class Planform:
    """Lengths of the reed from above [mm]."""

    root: float  # a, from the clamp to the hole
    hole_radius: float
    half_width: float

    @property
    def centre(self) -> float:
        """Of the hole, from the clamp."""
        return self.root + self.hole_radius

    @property
    def length(self) -> float:
        """From the clamp to the tip."""
        return self.centre + self.half_width


def planform(result: Result, case: int) -> Planform:
    """The reed of a case."""
    a, diameter, width = (float(result.value(f"reed.{k}_mm", case)) for k in ("a", "hole_diameter", "width"))
    return Planform(a, diameter / 2, width / 2)


@dataclass(frozen=True)
class Mesh:
    """Nodes [mm] and cells of three or four nodes, counted from 0."""

    x: np.ndarray
    y: np.ndarray
    quads: np.ndarray  # (n, 4)
    triangles: np.ndarray  # (n, 3)
    part: np.ndarray  # of the quads, then of the triangles
    source: np.ndarray  # each node's number in the file; -1: over the hole, inside its edge

    def values(self, field: np.ndarray, inlet: float) -> np.ndarray:
        """A field of the file, spread over the nodes of this mesh."""
        return np.where(self.source >= 0, field[self.source], inlet)


def half_land(result: Result) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """x, y [mm] and the cells' nodes, counted from 0, as stored."""
    data = result.dataset
    faces = data["film_faces"].values.astype(int) - int(data["film_faces"].attrs.get("start_index", 0))
    return data["film_x_mm"].values.astype(float), data["film_y_mm"].values.astype(float), faces


def field_times(result: Result) -> np.ndarray:
    """Times of the stored fields [ms]."""
    return result.dataset["field_time_ms"].values.astype(float)


def field(result: Result, case: int, number: int) -> np.ndarray:
    """The film's pressure at the nodes [kPa]; NaN where none was stored."""
    return result.dataset["film_pressure_kpa"].isel(case=case, field_time=number).values.astype(float)


def has_field(result: Result, case: int) -> bool:
    """Whether a case has any field; lumped models and failed cases have none."""
    return bool(np.isfinite(result.dataset["film_pressure_kpa"].isel(case=case).values).any())


def inlet_kpa(result: Result, case: int, time_ms: float) -> float:
    """Inlet pressure at a time [kPa]: as recorded, else that of the square wave."""
    if result.has_traces:
        return float(np.interp(time_ms, result.time(), result.trace("inlet_kpa", case)))
    from reedpost.gap_study import closing_event_ms

    high, low = (float(result.value(f"pressure.{k}_kpa", case)) for k in ("inlet", "outlet"))
    event, ramp = closing_event_ms(result, case), float(result.value("pressure.transition_ms", case))
    return high + (low - high) * min(max((time_ms - event) / ramp, 0.0), 1.0)


def whole_reed(result: Result, case: int = 0, pieces: int = 1) -> Mesh:
    """The land on both sides of the symmetry line, and the hole as a fan about its centre.

    With `pieces` each cell's side is cut into as many; `finer` gives a field there.
    """
    x, y, faces = half_land(result)
    form = planform(result, case)
    if pieces > 1 and (spread := _spread(faces, len(x), pieces)) is not None:
        x, y = spread.matrix @ x, spread.matrix @ y
        faces = _cells(spread.rays, spread.rings)
    n = len(x)
    on_line = np.abs(y) < 1e-9 * form.length
    mirrored = np.where(on_line, np.arange(n), n + np.cumsum(~on_line) - 1)
    source = np.concatenate([np.arange(n), np.flatnonzero(~on_line), [-1]])
    xs = np.append(np.concatenate([x, x[~on_line]]), form.centre)
    ys = np.append(np.concatenate([y, -y[~on_line]]), 0.0)
    quads = np.concatenate([faces, mirrored[faces][:, ::-1]])
    rim = np.flatnonzero(np.abs(np.hypot(xs - form.centre, ys) - form.hole_radius) < 1e-3 * form.hole_radius)
    rim = rim[np.argsort(np.arctan2(ys[rim], xs[rim] - form.centre))]
    fan = np.column_stack([np.full(len(rim), len(xs) - 1), rim, np.roll(rim, -1)])
    land = np.where(xs[quads].mean(axis=1) < form.root, LAND_A, LAND_B)
    return Mesh(xs, ys, quads, fan, np.append(land, np.full(len(fan), HOLE_C)), source)


def finer(result: Result, pressure: np.ndarray, pieces: int) -> np.ndarray:
    """A nodal field of the half land on the nodes of whole_reed with `pieces`, before mirroring."""
    _, _, faces = half_land(result)
    spread = _spread(faces, len(pressure), pieces)
    return pressure if spread is None else spread.matrix @ pressure


@dataclass(frozen=True)
class _Spread:
    """From the stored nodes to a finer mesh of `rays` x `rings` nodes."""

    matrix: np.ndarray
    rays: int
    rings: int


def _cells(rays: int, rings: int) -> np.ndarray:
    """Cells between neighbours of nodes numbered along the rays."""
    first = (np.arange(rays - 1)[:, None] * rings + np.arange(rings - 1)).ravel()
    return first[:, None] + np.array([0, 1, rings + 1, rings])


def _spread(faces: np.ndarray, nodes: int, pieces: int) -> _Spread | None:
    """The quadratic elements' own interpolation; None for a mesh that is not of rays and rings."""
    rings = int(faces[0, 3] - faces[0, 0])
    rays = nodes // rings if rings > 0 else 0
    known = rays * rings == nodes and rays % 2 == 1 and rings % 2 == 1
    if not known or not np.array_equal(faces, _cells(rays, rings)):
        return None
    around, across = _quadratic(rays, pieces), _quadratic(rings, pieces)
    return _Spread(np.kron(around, across), len(around), len(across))


def _quadratic(nodes: int, pieces: int) -> np.ndarray:
    """Interpolation matrix of quadratic elements, each over three of the nodes."""
    at = np.arange((nodes - 1) * pieces + 1) / pieces
    first = np.minimum(2 * (at // 2).astype(int), nodes - 3)
    t = at - first
    matrix = np.zeros((len(at), nodes))
    for i, shape in enumerate(((t - 1) * (t - 2) / 2, t * (2 - t), t * (t - 1) / 2)):
        matrix[np.arange(len(at)), first + i] = shape
    return matrix


def land_means(result: Result, case: int, pressure: np.ndarray) -> tuple[float, float]:
    """Mean of a nodal field over parts A (x < a) and B of the land."""
    x, y, faces = half_land(result)
    middle = (np.arange(FINE) + 0.5) / FINE
    s, t = (grid.ravel() for grid in np.meshgrid(middle, middle))
    shape = np.array([(1 - s) * (1 - t), s * (1 - t), s * t, (1 - s) * t])  # (4, points)
    ds, dt = np.array([t - 1, 1 - t, t, -t]), np.array([s - 1, -s, s, 1 - s])
    area = np.abs((x[faces] @ ds) * (y[faces] @ dt) - (x[faces] @ dt) * (y[faces] @ ds))
    root = x[faces] @ shape < planform(result, case).root
    values = pressure[faces] @ shape
    loads = area * values
    a, b = (float(loads[part].sum() / area[part].sum()) if part.any() else math.nan for part in (root, ~root))
    return a, b
