"""What the finite element section states in words about the parts of the reed, and what the film models find."""

from __future__ import annotations

import math

import numpy as np

from reedpost import paper
from reedpost.gap_study import SEEN_MM, closing_event_ms, closing_window, part_exceeds_hole_ms
from reedpost.results import Result
from reedpost.studies import Variant, is_monotone_fall
from reedpost.tables import Column, Table

NEAR_MS = 0.05  # the paper reads its times off curves, to this at best
WIDE_MM = 0.20  # gap at which C is said to exceed A and B throughout
TAKES_OVER_MS = {"a": 19.70, "b": 20.15}  # stated for 0.05 mm
SWINGS_FROM_MM = 0.15

COLUMNS = [
    Column("statement", "statement", "", "", words=True),
    Column("finite_elements", "finite elements", "", "", words=True),
    Column("ours", "ours", "", "", words=True),
    Column("holds", "holds", "", "", words=True),
]


def yes(holds: bool) -> str:
    """The word in the last column."""
    return "yes" if holds else "NO"


def parts_statements(variant: Variant, model: str) -> Table | None:
    """The statements about the gap study; None when the result holds no forces on the parts."""
    result = variant.result
    found = {float(gap): variant.find(model, paper.GAP_STUDY_KPA, gap) for gap in variant.axis("film.gap_mm")}
    cases = {g: c for g, c in found.items() if c is not None and result.status[c] == "ok" and result.has_parts(c)}
    if not cases:
        return None
    table = Table(
        f"statements_{model}", f"What the paper says of its finite elements' gap study: {model} model", COLUMNS
    )
    narrow, wide = (
        next((c for g, c in cases.items() if math.isclose(g, gap, rel_tol=1e-6)), None)
        for gap in (paper.GAP_MM, WIDE_MM)
    )
    if narrow is not None:
        table.rows += [_takes_over(result, narrow, part) for part in "ab"]
    if wide is not None:
        table.rows.append(_stays_below(result, wide, table))
    table.rows.append(_follows_inlet(result, list(cases.values())))
    table.rows.append(_a_above_b(result, cases))
    if len(cases) > 1:
        closing = result.measure("closing_ms")[list(cases.values())]
        text = f"{closing[0]:.2f} to {closing[-1]:.2f} ms"
        holds = yes(is_monotone_fall(closing))
        table.rows.append(["the wider the gap the faster it closes", "at every step", text, holds])
        table.rows.append(_swings(result, cases))
    if narrow is not None:
        opening, closing = (float(result.measure(f"{name}_ms")[narrow]) for name in ("opening", "closing"))
        text = f"{opening:.2f} and {closing:.2f} ms"
        table.rows.append(["0.05 mm: opening is faster than closing", "so it is", text, yes(opening < closing)])
    table.notes += [
        "A: land on the root's side of the hole; B: the rest of the land; C: the reed over the hole. Forces are of"
        " pressure above the outlet's.",
        f"A time holds within {NEAR_MS:g} ms.",
    ]
    return table


def _takes_over(result: Result, case: int, part: str) -> list[str]:
    stated, ours = TAKES_OVER_MS[part], part_exceeds_hole_ms(result, case, part)
    text = "never" if math.isnan(ours) else f"{ours:.2f} ms"
    holds = abs(ours - stated) <= NEAR_MS
    if not holds and not math.isnan(ours):
        text += f" ({ours - stated:+.2f} ms)"
    return [f"0.05 mm: the force on {part.upper()} exceeds that on C from", f"{stated:.2f} ms", text, yes(holds)]


def _stays_below(result: Result, case: int, table: Table) -> list[str]:
    event = closing_event_ms(result, case)
    end = event + float(result.value("pressure.transition_ms", case))
    time = result.time()
    parts = np.maximum(result.trace("part_a_n", case), result.trace("part_b_n", case))
    hole = result.trace("part_c_n", case)
    crossings = [part_exceeds_hole_ms(result, case, part) for part in "ab"]
    first = min((t for t in crossings if not math.isnan(t)), default=math.nan)
    text = "throughout the ramp"
    if not math.isnan(first):
        text = f"until {first:.2f} ms, {end - first:.2f} ms before the ramp ends"
    late = float(np.nanmax(parts[closing_window(result, case) & (time >= end)]))
    table.notes.append(
        f"At {WIDE_MM:.2f} mm the force on C is zero once the ramp has ended ({end:g} ms); A or B then reach"
        f" {late:.2g} N, {100 * late / float(np.nanmax(hole)):.1f} % of the open valve's force on C."
    )
    return ["0.20 mm: the force on C exceeds those on A and B", "throughout", text, yes(math.isnan(first))]


def _follows_inlet(result: Result, cases: list[int]) -> list[str]:
    worst = 0.0
    for case in cases:
        area = 1e-3 * math.pi / 4 * float(result.value("reed.hole_diameter_mm", case)) ** 2
        pressure = area * (result.trace("inlet_kpa", case) - result.trace("outlet_kpa", case))
        worst = max(worst, float(np.nanmax(np.abs(result.trace("part_c_n", case) - pressure)) / np.nanmax(pressure)))
    return ["the force on C is the inlet pressure's", "at every gap", "by construction of the model", yes(worst < 1e-3)]


def _a_above_b(result: Result, cases: dict[float, int]) -> list[str]:
    above = []
    for gap, case in cases.items():
        closing = closing_window(result, case)
        a, b = (float(np.nanmax(result.trace(f"part_{part}_n", case)[closing])) for part in "ab")
        above.append((gap, a, b))
    gap, a, b = above[0]
    text = f"largest {a:.3f} and {b:.3f} N at {gap:g} mm"
    return ["A resists closing more than B", "at every gap", text, yes(all(a > b for _, a, b in above))]


def _swings(result: Result, cases: dict[float, int]) -> list[str]:
    under, steady = result.measure("undershoot_mm"), result.measure("steady_mm")
    seen = [(gap, case) for gap, case in cases.items() if under[case] > SEEN_MM]
    text = "at no gap"
    if seen:
        gap, case = seen[0]
        text = f"{gap:.2f} mm ({100 * under[case] / steady[case]:.1f} % of steady)"
    holds = bool(seen) and math.isclose(seen[0][0], SWINGS_FROM_MM, rel_tol=1e-6)
    return ["it swings below its rest position from", f"{SWINGS_FROM_MM:.2f} mm", text, yes(holds)]
