"""Tables and a picture of what was measured."""

from __future__ import annotations

import csv
import json
from dataclasses import dataclass, field
from pathlib import Path


@dataclass
class Table:
    """One table; cells are written as they are."""

    name: str  # of its CSV file
    title: str
    header: list[str]
    rows: list[list[str]] = field(default_factory=list)
    note: str = ""

    def markdown(self) -> str:
        """With its title and note; all columns but the first to the right."""
        widths = [max(len(row[i]) for row in (self.header, *self.rows)) for i in range(len(self.header))]
        lines = [f"## {self.title}", "", self._line(self.header, widths)]
        lines.append("|" + "|".join("-" * (w + 1) + ("-" if i == 0 else ":") for i, w in enumerate(widths)) + "|")
        lines += [self._line(row, widths) for row in self.rows]
        return "\n".join([*lines, *(["", self.note] if self.note else []), ""])

    @staticmethod
    def _line(cells: list[str], widths: list[int]) -> str:
        first, *others = zip(cells, widths, strict=True)
        parts = [first[0].ljust(first[1])] + [cell.rjust(width) for cell, width in others]
        return "| " + " | ".join(parts) + " |"

    def write_csv(self, folder: Path) -> None:
        """Digits of numbers without the blanks that group them."""
        with open(folder / f"{self.name}.csv", "w", newline="", encoding="utf-8") as file:
            writer = csv.writer(file)
            writer.writerows([[cell.replace(" ", "") if is_number(cell) else cell for cell in row]
                              for row in (self.header, *self.rows)])  # fmt: skip


def is_number(cell: str) -> bool:
    """Whether a cell is one, perhaps with grouped digits."""
    try:
        float(cell.replace(" ", ""))
    except ValueError:
        return False
    return True


def grouped(number: float) -> str:
    """Three significant digits, thousands set apart: 12 300."""
    rounded = float(f"{number:.3g}")
    return f"{rounded:,.0f}".replace(",", " ") if rounded >= 100 else f"{rounded:g}"


def write_report(folder: Path, machine: dict[str, object], tables: list[Table], pictures: list[str]) -> Path:
    """benchmark.md, a CSV of each table, machine.json."""
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "machine.json").write_text(json.dumps(machine, indent=2) + "\n", encoding="utf-8")
    for table in tables:
        table.write_csv(folder)
    facts = ", ".join(f"{key} {value}" for key, value in machine.items() if key not in ("simd", "processor", "cores"))
    head = f"# Benchmark\n\n{machine['cores']} cores, {machine['processor']}; {facts}\n"
    parts = [head, *(table.markdown() for table in tables), *(f"![{name}]({name})\n" for name in pictures)]
    path = folder / "benchmark.md"
    path.write_text("\n".join(parts), encoding="utf-8")
    return path


def draw_work_precision(path: Path, lines: dict[str, list[tuple[float, float]]], limit: float) -> None:
    """Cases per second against largest error, a line a contender; points are (error, rate)."""
    import matplotlib

    matplotlib.use("Agg")
    import matplotlib.pyplot as plt

    figure, axes = plt.subplots(figsize=(7.5, 5.0), layout="constrained")
    markers = "os^Dv<>pP"
    for i, (name, points) in enumerate(lines.items()):
        ours = name.startswith("reedvalve")
        axes.loglog(*zip(*points, strict=True), marker=markers[i % len(markers)], markersize=4,
                    linewidth=2.0 if ours else 1.0, linestyle="-" if ours else "--", label=name)  # fmt: skip
    axes.axvline(limit, color="0.3", linestyle=":", label=f"the limit, {limit:g}")
    axes.invert_xaxis()
    axes.set_xlabel("largest relative error of fall and closing time")
    axes.set_ylabel("cases per second, one core")
    axes.grid(True, which="major", color="0.9")
    axes.legend(frameon=False, fontsize="small")
    figure.savefig(path, dpi=150)
    plt.close(figure)
