"""One measure of one case as a table's cell, with a word where there is no number."""

from __future__ import annotations

import math

from reedpost.results import Result
from reedpost.tables import Cell, Table

NO_CASE = "no case"


def measured(result: Result, case: int, name: str, what: str, table: Table) -> Cell:
    """Measure `name` of a case; the status if it failed, which goes to the table's problems.

    `what` says in words which case it is.
    """
    if result.status[case] != "ok":
        reason = result.message(case)
        problem = f"case {case + 1} ({what}) failed: {result.status[case]}"
        if reason:
            problem += f": {reason}"
        cell: Cell = str(result.status[case])
    else:
        value = float(result.measure(name)[case])
        if not math.isnan(value):
            return value
        problem = f"case {case + 1} ({what}) never got as far as {name}"
        cell = "not reached"
    if problem not in table.problems:
        table.problems.append(problem)
    return cell


def number(cell: Cell) -> float:
    """A cell's number, NaN when it holds a word."""
    return cell if isinstance(cell, float) else math.nan
