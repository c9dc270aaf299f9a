"""The paper's tables and the data its models were given.

Tables I, III, IV and V lie beside this module as CSV files whose comment lines say what
they hold. Table II is here, completed where the print is silent by the reading that
reproduces the published curves (see the project's theory page).
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cache
from importlib import resources

from reedpost.results import Result

AREA_KEY = "reed.action_area_mm2"
GAP_MM = 0.05  # initial distance of the finite element model
GAP_STUDY_KPA = 20.0  # inlet pressure of the gap study
GAP_STUDY_MM = (0.05, 0.10, 0.15, 0.20, 0.25, 0.30)  # Sec. III C: "from 0.05 to 0.30 mm"
HISTORY_KPA = (10.0, 20.0, 30.0)  # Fig. 12
RATE_FROM_MS, RATE_TO_MS = 1.5, 3.0  # Eq. (28), after the closing event
PUBLISHED = {"squeeze": "proposed", "traditional": "traditional"}  # model -> column of the paper
FILM_MODELS = ("film", "film_table")
FILM_LOAD = "maali"  # hydrodynamic load of film models unless the deck says otherwise
LUMPED_MODELS = tuple(PUBLISHED)
LUMPED_STEADY_MM = 0.0933  # at 20 kPa, Eqs. (18) and (19) with Table II; not printed in the paper


@dataclass(frozen=True)
class Datum:
    """One value the paper's models were given, in the deck's unit."""

    key: str
    value: float | str
    source: str  # where it comes from
    square_only: bool = False  # belongs to the square wave, so traces have none
    lumped_only: bool = False  # film models do without it


DATA = (
    Datum("reed.a_mm", 2.5, "Table II"),
    Datum("reed.b_mm", 1.0, "Table II"),
    Datum("reed.hole_diameter_mm", 4.0, "Table II"),
    Datum("reed.width_mm", 6.0, "Table II"),
    Datum("reed.thickness_mm", 0.15, "Table II"),
    Datum("reed.density_kg_m3", 8950.0, "Table II"),
    Datum("reed.youngs_modulus_gpa", 110.0, "Table II"),
    Datum("reed.k_a", 0.91, "Table II", lumped_only=True),
    Datum(AREA_KEY, 12.56, "Table II", lumped_only=True),
    Datum("fluid.density_kg_m3", 875.0, "Table II"),
    Datum("fluid.viscosity_pa_s", 0.0484, "Table II"),
    Datum("film.k_s", 0.0075, "the reading; Table II prints it rounded, 0.008", lumped_only=True),
    Datum("film.acts", "closing", "Eq. (15)", lumped_only=True),
    Datum("hydro.load", "published", "the reading; the print leaves Re and omega open", lumped_only=True),
    Datum("pressure.outlet_kpa", 0.0, "Sec. III A", square_only=True),
    Datum("pressure.period_ms", 40.0, "Fig. 4", square_only=True),
    Datum("pressure.transition_ms", 1.0, "Sec. III A", square_only=True),
    Datum("run.start", "rest", "Sec. V A", square_only=True),
)


def same(value: object, reference: float | str) -> bool:
    """Whether a deck's value is the paper's, but for the rounding of a decimal number."""
    if isinstance(reference, str) or not isinstance(value, float):
        return value == reference
    return math.isclose(value, reference, rel_tol=1e-9, abs_tol=1e-12)


def differences(result: Result, case: int) -> list[str]:
    """How a case's physical data differ from the paper's; one sentence for each key.

    A key that is not among the effective values has no effect on the case, or is left to its model.
    """
    square = result.value("pressure.kind", case) != "trace"
    film = result.model[case] in FILM_MODELS
    found = []
    for datum in DATA:
        if film and datum.lumped_only:
            continue
        value = result.value(datum.key, case)
        if datum.key == AREA_KEY and value is None:
            found.append(f"{datum.key} is not given, so the hole's area holds; it is {datum.value:g} in Table II")
        if value is None or (datum.square_only and not square) or same(value, datum.value):
            continue
        ours, papers = (f"{v:g}" if isinstance(v, float) else f"'{v}'" for v in (value, datum.value))
        found.append(f"{datum.key} = {ours} instead of {papers} ({datum.source})")
    return found


def is_the_valve(result: Result, case: int) -> bool:
    """Whether reed, oil and pressure wave are the paper's, whatever the reading of its fitted factors."""
    fitted = tuple(f"{datum.key} " for datum in DATA if datum.lumped_only)
    return not [line for line in differences(result, case) if not line.startswith(fitted)]


def action_area_mm2(result: Result, case: int) -> float:
    """The area the pressure acts on [mm2]; the hole's unless the deck says otherwise."""
    area = result.value(AREA_KEY, case)
    if isinstance(area, float):
        return area
    return math.pi / 4 * float(result.value("reed.hole_diameter_mm", case)) ** 2


@cache
def table(name: str) -> tuple[dict[str, float], ...]:
    """Rows of one reference table, e.g. 'table_3_fall_time', as column -> value."""
    text = resources.files("reedpost").joinpath("reference", f"{name}.csv").read_text("utf-8")
    lines = [line for line in text.splitlines() if line and not line.startswith("#")]
    columns = lines[0].split(",")
    return tuple(
        {column: float(cell) for column, cell in zip(columns, line.split(","), strict=True)} for line in lines[1:]
    )


@dataclass(frozen=True)
class MeshScatter:
    """How far the finite elements' four meshes lie apart, Table I (20 kPa, gap 0.05 mm)."""

    lowest: float  # in the column's unit, as the others
    highest: float
    chosen: float  # of the mesh the authors went on with

    @property
    def percent(self) -> tuple[float, float]:
        """Lowest and highest against the chosen mesh [%]."""
        return tuple(100 * (x / self.chosen - 1) for x in (self.lowest, self.highest))


def mesh_scatter(column: str) -> MeshScatter:
    """Scatter of 'steady_mm', 'fall_ms' or 'closing_ms' over the meshes of Table I."""
    rows = table("table_1_mesh")
    chosen = next(row[column] for row in rows if row["mesh_number"] == 42564)
    values = [row[column] for row in rows]
    return MeshScatter(min(values), max(values), chosen)
