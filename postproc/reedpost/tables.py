"""A table with its error summary and remarks, and the forms it is written in."""

from __future__ import annotations

import csv
import html
import io
import math
import textwrap
from dataclasses import dataclass, field

Cell = float | str | None  # None: there is nothing to show


@dataclass(frozen=True)
class Column:
    """One column of a table."""

    name: str  # header in the CSV file, with unit
    head: str  # what readers see
    unit: str  # what readers see below it
    form: str  # format of a number, e.g. '.2f' or '+.1f'
    words: bool = False  # holds words, which start at the left


@dataclass(frozen=True)
class Errors:
    """How far one column lies from a reference, in per cent."""

    what: str  # e.g. 'fall time, squeeze'
    against: str  # e.g. 'published model'
    largest: float  # error of largest magnitude, with its sign [%]
    rms: float  # root mean square [%]
    count: int  # rows it was taken over


def percent(value: float, reference: float) -> float:
    """Relative error [%]; NaN when either is unknown."""
    return 100.0 * (value / reference - 1.0) if reference else math.nan


def summarise(what: str, against: str, errors: list[float]) -> Errors:
    """Largest and root-mean-square error over the known values."""
    known = [e for e in errors if math.isfinite(e)]
    if not known:
        return Errors(what, against, math.nan, math.nan, 0)
    rms = math.sqrt(sum(e * e for e in known) / len(known))
    return Errors(what, against, max(known, key=abs), rms, len(known))


@dataclass
class Table:
    """Rows beside each other, what they come to, and what has to be said about them."""

    name: str  # file name without ending
    title: str
    columns: list[Column]
    rows: list[list[Cell]] = field(default_factory=list)
    footer: list[list[Cell]] = field(default_factory=list)  # largest and RMS errors
    errors: list[Errors] = field(default_factory=list)
    notes: list[str] = field(default_factory=list)
    problems: list[str] = field(default_factory=list)  # what is missing or failed


def cell_text(cell: Cell, form: str) -> str:
    """A cell as readers see it; unknown numbers are a dash."""
    if cell is None:
        return ""
    if isinstance(cell, str):
        return cell
    if math.isnan(cell):
        return "-"
    text = format(cell, form)
    return text.replace("-", "+") if form.startswith("+") and float(text) == 0 else text


def _texts(table: Table, rows: list[list[Cell]]) -> list[list[str]]:
    return [[cell_text(cell, column.form) for cell, column in zip(row, table.columns, strict=True)] for row in rows]


def _wrap(remark: str) -> list[str]:
    """A remark in lines that a terminal shows whole."""
    return textwrap.wrap(remark, 92, initial_indent="  ", subsequent_indent="    ")


def as_text(table: Table) -> str:
    """Aligned for a terminal; remarks below, problems last and marked."""
    heads = [[c.head for c in table.columns], [c.unit for c in table.columns]]
    body, foot = _texts(table, table.rows), _texts(table, table.footer)
    widths = [max(map(len, texts)) for texts in zip(*heads, *body, *foot, strict=True)]

    def line(texts: list[str]) -> str:
        cells = (
            text.ljust(width) if column.words else text.rjust(width)
            for text, width, column in zip(texts, widths, table.columns, strict=True)
        )
        return "  ".join(cells).rstrip()

    rule = "-" * (sum(widths) + 2 * (len(widths) - 1))
    heads = heads if any(heads[1]) else heads[:1]
    lines = [table.title, rule, *map(line, heads), rule, *map(line, body)]
    lines += [rule, *map(line, foot)] if foot else [rule]
    lines += [remark for note in table.notes for remark in _wrap(note)]
    lines += [remark for problem in table.problems for remark in _wrap(f"INCOMPLETE: {problem}")]
    return "\n".join(lines) + "\n"


def as_markdown(table: Table) -> str:
    """A Markdown section with the table, its remarks and its problems."""
    heads = [f"{c.head} [{c.unit}]" if c.unit else c.head for c in table.columns]
    rule = [":---" if c.words else "---:" for c in table.columns]
    rows = [heads, rule, *_texts(table, table.rows), *_texts(table, table.footer)]
    lines = [f"## {table.title}", ""]
    lines += ["| " + " | ".join(text.replace("|", "\\|") for text in row) + " |" for row in rows]
    lines += [""] if table.notes or table.problems else []
    lines += [f"* {note}" for note in table.notes]
    lines += [f"* **Incomplete:** {problem}" for problem in table.problems]
    return "\n".join(lines) + "\n"


def as_csv(table: Table) -> str:
    """Header with units and one line a row; unknown numbers are empty."""
    out = io.StringIO()
    writer = csv.writer(out, lineterminator="\n")
    writer.writerow([column.name for column in table.columns])
    for row in table.rows:
        writer.writerow(
            [
                "" if cell is None or (isinstance(cell, float) and math.isnan(cell)) else
                f"{cell:.9g}" if isinstance(cell, float) else cell
                for cell in row
            ]
        )  # fmt: skip
    return out.getvalue()


def as_html(table: Table) -> str:
    """A figure element with the table, its remarks and its problems."""

    starts = [' class="words"' if c.words else "" for c in table.columns]

    def row(texts: list[str], tag: str) -> str:
        cells = (f"<{tag}{at}>{html.escape(t)}</{tag}>" for t, at in zip(texts, starts, strict=True))
        return f"<tr>{''.join(cells)}</tr>"

    heads = [
        f"<th{at}>{html.escape(c.head)}<br><small>{html.escape(c.unit) or '&nbsp;'}</small></th>"
        for c, at in zip(table.columns, starts, strict=True)
    ]
    parts = [f"<h3>{html.escape(table.title)}</h3>", '<div class="wide"><table>']
    parts += [f"<thead><tr>{''.join(heads)}</tr></thead>", "<tbody>"]
    parts += [row(texts, "td") for texts in _texts(table, table.rows)]
    parts += ["</tbody>"]
    if table.footer:
        parts += ["<tfoot>", *(row(texts, "td") for texts in _texts(table, table.footer)), "</tfoot>"]
    parts += ["</table></div>"]
    if table.notes or table.problems:
        parts += ['<ul class="notes">', *(f"<li>{html.escape(note)}</li>" for note in table.notes)]
        parts += [f'<li class="bad">Incomplete: {html.escape(problem)}</li>' for problem in table.problems]
        parts += ["</ul>"]
    return "\n".join(parts) + "\n"


def errors_csv(tables: list[Table]) -> str:
    """The error summaries of all tables as one CSV text."""
    out = io.StringIO()
    writer = csv.writer(out, lineterminator="\n")
    writer.writerow(["table", "what", "against", "largest_percent", "rms_percent", "rows"])
    for table in tables:
        for e in table.errors:
            numbers = ["" if math.isnan(x) else f"{x:.4f}" for x in (e.largest, e.rms)]
            writer.writerow([table.name, e.what, e.against, *numbers, e.count])
    return out.getvalue()
