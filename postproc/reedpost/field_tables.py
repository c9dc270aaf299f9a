"""Pressures on the parts of the reed at the stored times, beside what the paper says of Figs. 6 and 7."""

from __future__ import annotations

import math

import numpy as np

from reedpost import film_mesh, paper
from reedpost.results import Result
from reedpost.statements import COLUMNS as STATEMENT_COLUMNS
from reedpost.statements import WIDE_MM, yes
from reedpost.studies import Variant
from reedpost.tables import Column, Table

EQUAL = 0.05  # two pressures are called equal within this share
COLUMNS = [
    Column("gap_mm", "gap", "mm", ".3g"),
    Column("inlet_kpa", "inlet", "kPa", "g"),
    Column("time_ms", "time", "ms", "g"),
    Column("c_kpa", "C", "kPa", ".2f"),
    Column("a_mean_kpa", "A, mean", "kPa", ".2f"),
    Column("b_mean_kpa", "B, mean", "kPa", ".2f"),
    Column("highest_kpa", "highest", "kPa", ".2f"),
    Column("highest_x_mm", "at x", "mm", ".2f"),
    Column("highest_y_mm", "at |y|", "mm", ".2f"),
    Column("lowest_kpa", "lowest", "kPa", ".2f"),
]


def field_tables(variant: Variant, model: str) -> list[Table]:
    """Pressures of all cases with fields, and the statements as far as these cases bear on them."""
    result = variant.result
    table = Table(f"fields_{model}", f"Film pressure while closing: {model} model", COLUMNS)
    statements = Table(
        f"field_statements_{model}", f"What the paper says of Figs. 6 and 7: {model} model", STATEMENT_COLUMNS
    )
    for case in variant.cases_of(model).tolist():
        if not film_mesh.has_field(result, case):
            table.problems.append(f"case {case + 1} ({model}) has no pressure field: {result.status[case]}")
            continue
        rows = case_rows(result, case)
        table.rows += rows
        inlet, gap = (float(result.value(key, case)) for key in ("pressure.inlet_kpa", "film.gap_mm"))
        if math.isclose(inlet, paper.GAP_STUDY_KPA, rel_tol=1e-6):
            statements.rows += _said(rows, gap)
    table.notes.append("Means over the land's parts A (x < a) and B; C: the inlet pressure, which holds over the hole.")
    statements.notes.append(f"By the means over the parts; equal: within {100 * EQUAL:g} %.")
    return [table, statements] if statements.rows else [table]


def case_rows(result: Result, case: int) -> list[list[float]]:
    """One row a stored time."""
    x, y, _ = film_mesh.half_land(result)
    gap, inlet = (float(result.value(key, case)) for key in ("film.gap_mm", "pressure.inlet_kpa"))
    rows = []
    for number, time in enumerate(film_mesh.field_times(result).tolist()):
        pressure = film_mesh.field(result, case, number)
        if not np.isfinite(pressure).all():
            continue
        top = int(pressure.argmax())
        a, b = film_mesh.land_means(result, case, pressure)
        c = film_mesh.inlet_kpa(result, case, time)
        rows.append(
            [gap, inlet, time, c, a, b, float(pressure[top]), float(x[top]), float(y[top]), float(pressure.min())]
        )
    return rows


def _said(rows: list[list[float]], gap: float) -> list[list[str]]:
    """The paper's sentences about one gap beside our rows of it."""
    at = {round(row[2], 6): (row[4], row[5], row[3]) for row in rows}  # time -> A, B, C

    def text(time: float) -> str:
        return "A {:.1f}, B {:.1f}, C {:.1f} kPa".format(*at[time])

    lines = []
    if math.isclose(gap, paper.GAP_MM, rel_tol=1e-6):
        sentences = (
            (19.5, "C is the highest", lambda a, b, c: c > max(a, b)),
            (20.0, "A surpasses C", lambda a, b, c: a > c),
            (20.5, "A is the highest, C zero", lambda a, b, c: a > b and a > c and abs(c) < 1e-6),
            (21.0, "B equals A", lambda a, b, c: abs(b - a) <= EQUAL * abs(a)),
        )
        for time, words, holds in sentences:
            if time in at:
                lines.append([f"0.05 mm, {time:g} ms", words, text(time), yes(holds(*at[time]))])
    elif math.isclose(gap, WIDE_MM, rel_tol=1e-6):
        above = [time for time, (a, b, c) in at.items() if max(a, b) > c]
        lines.append(
            ["0.20 mm, throughout closing", "A and B lie below C",
             f"not at {', '.join(f'{t:g}' for t in above)} ms (C = 0; {text(above[0])})" if above else "so they do",
             yes(not above)]
        )  # fmt: skip
    return lines
