"""All tables that a result allows, and what has to be said about it."""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

from reedpost import paper
from reedpost.field_tables import field_tables
from reedpost.gap_study import gap_table
from reedpost.results import Result
from reedpost.statements import parts_statements
from reedpost.studies import EXPERIMENT, FIELDS, GAP_STUDY, PRESSURE_SWEEP, Variant, studies, variants
from reedpost.tables import Table, as_csv, as_markdown, as_text, errors_csv
from reedpost.time_tables import SWEEPS, experiment_table, sweep_table

MOST_VARIANTS = 12  # more tables than that nobody reads
MOST_FAILURES = 20  # listed one by one


@dataclass
class Comparison:
    """What one result has to say beside the paper."""

    result: Result
    tables: list[Table] = field(default_factory=list)
    notes: list[str] = field(default_factory=list)  # remarks on the result as a whole
    problems: list[str] = field(default_factory=list)  # faults that no table shows

    @property
    def complete(self) -> bool:
        """Whether no needed case is missing and none failed."""
        return not self.problems and not any(table.problems for table in self.tables)


def compare(result: Result) -> Comparison:
    """Every table that the cases of a result allow."""
    comparison = Comparison(result)
    groups = variants(result)
    for number, variant in enumerate(groups[:MOST_VARIANTS], start=1):
        tables = _variant_tables(variant)
        if len(groups) > 1:
            for table in tables:
                table.name += f"_{number}"
                table.title += f" ({variant.label})"
        comparison.tables += tables
    if len(groups) > MOST_VARIANTS:
        comparison.problems.append(
            f"the sweep makes {len(groups)} variants of the valve; only the first {MOST_VARIANTS} are compared"
        )
    comparison.problems += _other_failures(result, comparison.tables)
    comparison.notes += _warnings(result)
    return comparison


def _variant_tables(variant: Variant) -> list[Table]:
    """The tables of one variant, each with the data in which its model's valve is not the paper's."""
    tables: list[tuple[str, Table]] = []
    for study in studies(variant):
        if study == PRESSURE_SWEEP:
            tables += [(model, sweep_table(variant, key, model)) for key in SWEEPS for model in variant.models]
        elif study == GAP_STUDY:
            for model in variant.models:
                tables.append((model, gap_table(variant, model)))
                if table := parts_statements(variant, model):
                    tables.append((model, table))
        elif study == FIELDS:
            models = [model for model in variant.models if model in paper.FILM_MODELS]
            tables += [(model, table) for model in models for table in field_tables(variant, model)]
        elif study == EXPERIMENT:
            tables += [(model, experiment_table(variant, model)) for model in variant.models]
    for model, table in tables:
        table.notes += _data_notes(variant, model)
    return [table for _, table in tables]


def _data_notes(variant: Variant, model: str) -> list[str]:
    """What a model's cases were given that is not the paper's, and what the paper does not know."""
    result, case = variant.result, int(variant.cases_of(model)[0])
    other = paper.differences(result, case)
    if EXPERIMENT in studies(variant):
        gaps = variant.axis("film.gap_mm")
        if not all(math.isclose(gap, paper.GAP_MM, rel_tol=1e-6) for gap in gaps):
            other.append(f"film.gap_mm = {gaps[0]:g} instead of {paper.GAP_MM:g} (Sec. III A)")
    notes = ["NOT THE PAPER'S DATA AS READ HERE:", *(f"- {line}" for line in other)] if other else []
    if model in paper.FILM_MODELS:
        load = result.value("hydro.load", case) or paper.FILM_LOAD
        edge = result.value("film.edge_elongation", case)
        edge = f"{edge:g}" if isinstance(edge, float) else "unknown"
        notes.append(f"Nothing is fitted: no k_a, no k_s. Hydrodynamic load: {load}; edge elongation: {edge}.")
    return notes


def _other_failures(result: Result, tables: list[Table]) -> list[str]:
    """Failed cases that no table mentions."""
    told = " ".join(problem for table in tables for problem in table.problems)
    rest = [f for f in result.failures() if f"case {f[0]} (" not in told]
    lines = [
        f"case {case} (model {result.model[case - 1]}) failed: {status}: {message or 'no reason given'}"
        for case, status, message in rest[:MOST_FAILURES]
    ]
    if len(rest) > MOST_FAILURES:
        lines.append(f"and {len(rest) - MOST_FAILURES} more cases failed")
    return lines


def _warnings(result: Result) -> list[str]:
    """How many cases carry each warning, with the first one's text."""
    lines = []
    for name in result.warnings():
        warned = np.flatnonzero(result.warned(name))
        if len(warned):
            text = result.message(int(warned[0])).removeprefix("warning: ") or "no text"
            count = f"{len(warned)} of {result.count} cases carry the warning {name}"
            lines.append(f"{count}; case {warned[0] + 1}: {text}")
    return lines


def terminal_text(comparison: Comparison) -> str:
    """All tables for a terminal."""
    parts = [f"== {comparison.result.folder} ==\n"]
    parts += [as_text(table) for table in comparison.tables]
    lines = [*comparison.notes, *(f"INCOMPLETE: {problem}" for problem in comparison.problems)]
    parts += ["\n".join(lines) + "\n"] if lines else []
    return "\n".join(parts)


def write_tables(comparison: Comparison, folder: Path) -> list[Path]:
    """Write each table as CSV, the error summary as CSV and all tables as Markdown."""
    folder.mkdir(parents=True, exist_ok=True)
    title = comparison.result.attribute("title") or comparison.result.folder.name
    sections = [f"# {title}\n", *(as_markdown(table) for table in comparison.tables)]
    remarks = [f"* {note}" for note in comparison.notes]
    remarks += [f"* **Incomplete:** {problem}" for problem in comparison.problems]
    sections += ["\n".join(["## The result as a whole", "", *remarks]) + "\n"] if remarks else []
    texts = {f"{table.name}.csv": as_csv(table) for table in comparison.tables}
    texts["errors.csv"] = errors_csv(comparison.tables)
    texts["tables.md"] = "\n".join(sections)
    paths = []
    for name, text in texts.items():
        path = folder / name
        path.write_text(text, encoding="utf-8", newline="\n")
        paths.append(path)
    return paths
