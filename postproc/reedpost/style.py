"""How the pictures look: legible at a column width of 86 mm, in print and without colour.

Colours are those of Okabe and Ito (2008), told apart by colour-blind readers too; every
model also has its own line and marker.
"""

from __future__ import annotations

import io
from dataclasses import dataclass
from pathlib import Path

import matplotlib as mpl

mpl.use("Agg")  # no display is needed
from matplotlib import pyplot as plt
from matplotlib.figure import Figure

COLUMN_IN = 86.0 / 25.4  # column width of a journal [in]

BLACK, ORANGE, SKY, GREEN = "#000000", "#E69F00", "#56B4E9", "#009E73"
BLUE, VERMILLION, PURPLE, GREY = "#0072B2", "#D55E00", "#CC79A7", "#777777"


@dataclass(frozen=True)
class Look:
    """Colour, line and marker of one model."""

    label: str
    color: str
    line: str | tuple
    marker: str


LOOKS = {
    "squeeze": Look("squeeze", BLUE, "-", "o"),
    "traditional": Look("traditional", VERMILLION, (0, (4, 1.5)), "s"),
    "film": Look("film", GREEN, (0, (5, 1, 1, 1)), "^"),
    "film_table": Look("film table", PURPLE, (0, (1, 1)), "D"),
}

# For curves of one model at several gaps: colour and line, in the order of the gaps.
SERIES = (
    (BLUE, "-"),
    (VERMILLION, (0, (5, 1.2))),
    (GREEN, (0, (5, 1, 1, 1))),
    (ORANGE, (0, (2.5, 1))),
    (PURPLE, (0, (5, 1, 1, 1, 1, 1))),
    (SKY, (0, (1, 0.8))),
)

SETTINGS = {
    "font.family": "DejaVu Sans",  # comes with matplotlib: the same everywhere
    "font.size": 7.5,
    "axes.labelsize": 8,
    "axes.titlesize": 8,
    "xtick.labelsize": 7,
    "ytick.labelsize": 7,
    "legend.fontsize": 7,
    "legend.frameon": False,
    "legend.handlelength": 2.4,
    "axes.linewidth": 0.6,
    "axes.spines.top": False,
    "axes.spines.right": False,
    "xtick.direction": "in",
    "ytick.direction": "in",
    "xtick.major.width": 0.6,
    "ytick.major.width": 0.6,
    "lines.linewidth": 1.2,
    "lines.markersize": 3.8,
    "hatch.linewidth": 0.6,
    "svg.hashsalt": "reedpost",  # the same ids in every run
    "svg.fonttype": "path",
    "figure.constrained_layout.use": True,
}


def look(model: str) -> Look:
    """The look of a model; one of its own for a model not known here."""
    return LOOKS.get(model, Look(model, GREY, (0, (3, 1, 1, 1)), "v"))


def in_style():
    """A context in which figures are made and written in the house style."""
    return plt.rc_context(SETTINGS)


def new_figure(height_mm: float, rows: int = 1, columns: int = 1, **options):
    """A figure of column width and its axes, as an array of rows x columns.

    To be used within `in_style()`, which also holds for what is drawn into it.
    """
    return plt.subplots(rows, columns, figsize=(COLUMN_IN, height_mm / 25.4), squeeze=False, **options)


def svg_bytes(figure: Figure) -> bytes:
    """The figure as SVG; the same picture gives the same bytes."""
    out = io.BytesIO()
    with in_style():
        figure.savefig(out, format="svg", metadata={"Date": None, "Creator": None})
    return out.getvalue()


def save(figure: Figure, path: Path) -> list[Path]:
    """Write `path`.png (300 dpi) and `path`.svg, and let go of the figure."""
    png, svg = path.with_suffix(".png"), path.with_suffix(".svg")
    with in_style():
        figure.savefig(png, dpi=300, metadata={"Software": None})
    svg.write_bytes(svg_bytes(figure))
    plt.close(figure)
    return [png, svg]
