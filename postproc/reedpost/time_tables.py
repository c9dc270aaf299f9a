"""Tables III, IV and V: times beside finite elements or experiment and the published model."""

from __future__ import annotations

import math

import numpy as np

from reedpost import paper
from reedpost.measured import NO_CASE, measured, number
from reedpost.studies import TraceCase, Variant, trace_case
from reedpost.tables import Cell, Column, Table, percent, summarise

FEA, EXPERIMENT = "fea", "experiment"  # columns of the paper's tables that errors are against
SHORT = {FEA: "FE", EXPERIMENT: "exp."}
LONG = {FEA: "finite elements", EXPERIMENT: "experiment", "published": "published model"}

# Table of the paper -> its number and file, the measure, its name, its definition
SWEEPS = {
    "table_3": ("III", "table_3_fall_time", "fall_ms", "fall time",
                "from 90 % to 10 % of the steady displacement"),
    "table_4": ("IV", "table_4_closing_time", "closing_ms", "closing time",
                "from 19.5 ms, where the pressure ramp starts, to 2 % of the steady displacement"),
}  # fmt: skip


def _columns(first: list[Column], target: str, published: str | None) -> list[Column]:
    """Columns of a comparison: the target, the published model, ours, and their errors."""
    short = SHORT[target]
    columns = [*first, Column(f"{target}_ms", short, "ms", ".2f")]
    if published:
        columns += [
            Column("published_ms", "published", "ms", ".2f"),
            Column(f"published_vs_{target}_percent", f"publ./{short}", "%", "+.1f"),
        ]
    columns += [Column("ours_ms", "ours", "ms", ".3f")]
    if published:
        columns += [Column("ours_vs_published_percent", "ours/publ.", "%", "+.1f")]
    return [*columns, Column(f"ours_vs_{target}_percent", f"ours/{short}", "%", "+.1f")]


def _cells(row: dict[str, float], target: str, published: str | None, ours: Cell) -> list[Cell]:
    """The cells of one row in the order of _columns, without the first columns."""
    aim = row[f"{target}_ms"]
    if not published:
        return [aim, ours, percent(number(ours), aim)]
    theirs = row[f"{published}_ms"]
    errors = [percent(number(ours), x) for x in (theirs, aim)]
    return [aim, theirs, percent(theirs, aim), ours, *errors]


def add_errors(table: Table, what: str) -> None:
    """Add a footer: largest and root-mean-square error of every column of errors."""
    largest: list[Cell] = ["largest", *[None] * (len(table.columns) - 1)]
    rms: list[Cell] = ["RMS", *[None] * (len(table.columns) - 1)]
    for i, column in enumerate(table.columns):
        if not column.name.endswith("_percent"):
            continue
        who, against = column.name.removesuffix("_percent").split("_vs_")
        errors = summarise(f"{what}, {who}", LONG[against], [number(row[i]) for row in table.rows])
        table.errors.append(errors)
        largest[i] = errors.largest
        rms[i] = "-" if math.isnan(errors.rms) else f"{errors.rms:.1f}"  # has no sign
    table.footer = [largest, rms]


def sweep_table(variant: Variant, key: str, model: str) -> Table:
    """Table III ('table_3') or IV ('table_4') for one model."""
    roman, file, measure, quantity, definition = SWEEPS[key]
    published = paper.PUBLISHED.get(model)
    table = Table(
        name=f"{key}_{model}",
        title=f"Table {roman}. {quantity.capitalize()}, gap {paper.GAP_MM:g} mm: {model} model",
        columns=_columns([Column("inlet_kpa", "inlet", "kPa", "g")], FEA, published),
    )
    for row in _rows_needed(variant, paper.table(file), table):
        pressure = row["inlet_kpa"]
        case = variant.find(model, pressure, paper.GAP_MM)
        if case is None:
            ours: Cell = NO_CASE
            table.problems.append(f"no case at {pressure:g} kPa for model {model}")
        else:
            ours = measured(variant.result, case, measure, f"{model}, {pressure:g} kPa", table)
        table.rows.append([pressure, *_cells(row, FEA, published, ours)])
    add_errors(table, f"{quantity}, {model}")
    scatter = paper.mesh_scatter(measure)
    low, high = scatter.percent
    table.notes += [
        f"{quantity.capitalize()}: {definition}. FE: the paper's finite elements.",
        f"FE mesh scatter (Table I, 20 kPa): {scatter.lowest:.2f} to {scatter.highest:.2f} ms, "
        f"{low:+.1f} to {high:+.1f} % of the mesh used.",
    ]
    return table


def _rows_needed(variant: Variant, rows: tuple[dict[str, float], ...], table: Table) -> list[dict[str, float]]:
    """All rows of the published table, or Fig. 12's when a result holds just its pressures."""
    run = variant.axis("pressure.inlet_kpa")
    if len(run) == len(paper.HISTORY_KPA) and np.allclose(run, paper.HISTORY_KPA, rtol=1e-6):
        table.notes.append("These are the three pressures of Fig. 12; the published table has eight.")
        return [row for row in rows if row["inlet_kpa"] in paper.HISTORY_KPA]
    return list(rows)


def experiment_table(variant: Variant, model: str) -> Table:
    """Table V for one model."""
    published = paper.PUBLISHED.get(model)
    first = [
        Column("condition", "condition", "", "g"),
        Column("rate_kpa_per_ms", "fall rate", "kPa/ms", "g"),
    ]
    table = Table(
        name=f"table_5_{model}",
        title=f"Table V. Closing time (500 ms to u = 0), reconstructed traces: {model} model",
        columns=_columns(first, EXPERIMENT, published),
    )
    seen = [trace_case(variant.result, int(case)) for case in variant.cases_of(model)]
    table.problems = [_stray(trace, model) for trace in seen if trace.condition is None]
    for row in paper.table("table_5_experiment"):
        condition = int(row["condition"])
        match = next((trace for trace in seen if trace.condition == condition), None)
        if match is None:
            ours: Cell = NO_CASE
            table.problems.append(f"no case of condition {condition} for model {model}")
        else:
            what = f"{model}, condition {condition}"
            ours = measured(variant.result, match.case, "zero_ms", what, table)
            if math.isnan(match.rate):
                table.notes.append(f"Condition {condition} is known by its file only: {match.file}.")
        cells = _cells(row, EXPERIMENT, published, ours)
        table.rows.append([float(condition), row["rate_kpa_per_ms"], *cells])
    add_errors(table, f"closing time (u = 0), {model}")
    table.notes.append(
        "The measured traces are not published; these are reconstructed from the fall rates "
        "such that the traditional model closes at its published time."
    )
    return table


def _stray(trace: TraceCase, model: str) -> str:
    """Why a case under a trace has no place in Table V."""
    case = f"case {trace.case + 1} ({model}, {trace.file or 'trace without a name'})"
    if math.isnan(trace.rate):
        return f"{case}: its fall rate is unknown, since the pressures were not recorded (run.traces)"
    return f"{case}: its mean fall rate, {trace.rate:.1f} kPa/ms, is none of Table V"
