"""The gap study at 20 kPa, beside what the finite element section states in words."""

from __future__ import annotations

import math

import numpy as np

from reedpost import paper
from reedpost.measured import NO_CASE, measured, number
from reedpost.results import Result
from reedpost.studies import Variant, is_monotone_fall
from reedpost.tables import Cell, Column, Table

SEEN_MM = 1.0e-5  # the accuracy of the solution; an undershoot below it is none
MANY_GAPS = 12  # a table with more rows than that shows the paper's gaps only

COLUMNS = [
    Column("gap_mm", "gap", "mm", ".3g"),
    Column("steady_mm", "steady", "mm", ".4f"),
    Column("fall_ms", "fall", "ms", ".3f"),
    Column("closing_ms", "closing", "ms", ".3f"),
    Column("undershoot_mm", "undershoot", "mm", ".4f"),
    Column("undershoot_percent", "of steady", "%", ".1f"),
    Column("peak_squeeze_n", "peak film", "N", ".4f"),
]
TAKES_OVER = Column("film_exceeds_hole_ms", "film > hole", "ms", ".2f")  # needs traces
PARTS_TAKE_OVER = [Column(f"{p}_exceeds_c_ms", f"{p.upper()} > C", "ms", ".2f") for p in "ab"]  # film models
MEASURES = ("steady_mm", "fall_ms", "closing_ms", "undershoot_mm")


def closing_event_ms(result: Result, case: int) -> float:
    """Start of the closing event of one case [ms]."""
    event = result.value("pressure.event_ms", case)
    if isinstance(event, float):
        return event
    period, ramp = (float(result.value(f"pressure.{k}_ms", case)) for k in ("period", "transition"))
    return 0.5 * (period - ramp)


def closing_window(result: Result, case: int) -> np.ndarray:
    """Which stored times lie between the closing event and the next rise of a square wave."""
    time, event, period = result.time(), closing_event_ms(result, case), result.value("pressure.period_ms", case)
    return (time >= event) & (time < event + (0.5 * period if isinstance(period, float) else np.inf))


def film_exceeds_hole_ms(result: Result, case: int) -> float:
    """When the squeeze force first exceeds the pressure force on the hole [ms]; NaN if never.

    Looked for during the pressure ramp: after it the hole has no force to exceed.
    """
    time, event = result.time(), closing_event_ms(result, case)
    ramp = (time > event) & (time < event + float(result.value("pressure.transition_ms", case)))
    hole = 1e-3 * paper.action_area_mm2(result, case) * result.trace("inlet_kpa", case)[ramp]
    above = np.flatnonzero(result.trace("squeeze_n", case)[ramp] > hole)
    return float(time[ramp][above[0]]) if len(above) else math.nan


def part_exceeds_hole_ms(result: Result, case: int, part: str) -> float:
    """When the force on part 'a' or 'b' first exceeds that on part C, the hole [ms]; NaN if never.

    Looked for during the pressure ramp, as for film_exceeds_hole_ms, and between the stored times.
    """
    time, event = result.time(), closing_event_ms(result, case)
    ramp = (time >= event) & (time <= event + float(result.value("pressure.transition_ms", case)))
    time, excess = time[ramp], (result.trace(f"part_{part}_n", case) - result.trace("part_c_n", case))[ramp]
    after = np.flatnonzero((excess[:-1] <= 0.0) & (excess[1:] > 0.0))
    if not len(after):
        return math.nan
    i = after[0]
    return float(time[i] - excess[i] * (time[i + 1] - time[i]) / (excess[i + 1] - excess[i]))


def gap_table(variant: Variant, model: str) -> Table:
    """The gap study for one model."""
    result = variant.result
    parts = result.has_parts(int(variant.cases_of(model)[0]))
    takes_over = PARTS_TAKE_OVER if parts else [TAKES_OVER] if result.has_traces else []
    table = Table(
        name=f"gap_study_{model}",
        title=f"Gap study at {paper.GAP_STUDY_KPA:g} kPa: {model} model",
        columns=[*COLUMNS, *takes_over],
    )
    for gap in _gaps(variant, table):
        case = variant.find(model, paper.GAP_STUDY_KPA, gap)
        cells: list[Cell] = [gap, NO_CASE, *[None] * (len(table.columns) - 2)]
        if case is None:
            table.problems.append(f"no case at gap {gap:g} mm, 20 kPa for model {model}")
        else:
            what = f"{model}, gap {gap:g} mm"
            values = [measured(result, case, name, what, table) for name in MEASURES]
            cells = [gap, *values, 100 * number(values[3]) / number(values[0])]
            cells += [float(result.measure("peak_squeeze_n")[case])]
            if parts:
                cells += [part_exceeds_hole_ms(result, case, part) for part in "ab"]
            elif takes_over:
                cells.append(film_exceeds_hole_ms(result, case))
        table.rows.append(cells)
    table.notes.append("Finite elements at gap 0.05 mm: steady 0.0951 mm, fall 1.42 ms, closing 3.88 ms (Table I).")
    if model == "traditional":
        table.notes.append("This model has no film, so the gap does not act on it.")
    elif parts:
        table.notes.append("A > C, B > C: when the force on the land's part A or B first exceeds that on the hole, C.")
    else:
        table.notes += _findings(variant, model)
    return table


def _gaps(variant: Variant, table: Table) -> list[float]:
    """The paper's gaps [mm], and the result's further ones unless they are too many to print."""
    own = [float(gap) for gap in variant.axis("film.gap_mm")]
    if len(own) > MANY_GAPS:
        table.notes.append(f"Of the result's {len(own)} gaps only the paper's are shown.")
        return list(paper.GAP_STUDY_MM)
    further = [gap for gap in own if not np.isclose(gap, paper.GAP_STUDY_MM, rtol=1e-6).any()]
    return sorted([*paper.GAP_STUDY_MM, *further])


def _findings(variant: Variant, model: str) -> list[str]:
    """What the finite element section states, and what all gaps of the result show."""
    result = variant.result
    found = {float(gap): variant.find(model, paper.GAP_STUDY_KPA, gap) for gap in variant.axis("film.gap_mm")}
    gaps = [gap for gap, case in found.items() if case is not None and result.status[case] == "ok"]
    if not gaps:
        return []
    cases = [found[gap] for gap in gaps]
    closing, under, steady, opening = (
        result.measure(name)[cases] for name in ("closing_ms", "undershoot_mm", "steady_mm", "opening_ms")
    )
    lines = []
    if len(gaps) > 1:
        verdict = "so it is at every step" if is_monotone_fall(closing) else "not at every step"
        lines.append(f"FE: the wider the gap the faster it closes. Ours: {verdict}.")
    below = np.flatnonzero(under > SEEN_MM)
    verdict = "at no gap"
    if len(below):
        i = below[0]
        verdict = f"from {gaps[i]:.3g} mm on ({100 * under[i] / steady[i]:.1f} % of steady there)"
    lines.append(f"FE: it swings below its rest position from 0.15 mm on. Ours: {verdict}.")
    if math.isclose(gaps[0], paper.GAP_MM, rel_tol=1e-6):
        verdict = "so it is" if opening[0] < closing[0] else "no"
        lines.append(
            f"FE: opening is faster than closing at 0.05 mm. Ours: {verdict} "
            f"({opening[0]:.2f} and {closing[0]:.2f} ms)."
        )
    if result.has_traces:
        lines.append(
            "FE: at 0.05 mm the force on the land exceeds that on the hole from 19.70 ms (root side) "
            "and 20.15 ms (tip side) on, at 0.20 mm never. Ours, whole film: last column."
        )
    return lines
