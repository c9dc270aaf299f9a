"""Pictures of the film models: pressure fields, forces on the reed's parts, all models against pressure."""

from __future__ import annotations

import math

import numpy as np
from matplotlib.cm import ScalarMappable
from matplotlib.colors import Normalize
from matplotlib.lines import Line2D
from matplotlib.patches import Circle, PathPatch
from matplotlib.path import Path as Outline
from matplotlib.ticker import MaxNLocator

from reedpost import film_mesh, paper
from reedpost.film_mesh import Planform
from reedpost.gap_study import closing_event_ms
from reedpost.overview import FEWEST, Series
from reedpost.picture import Picture
from reedpost.results import Result
from reedpost.studies import Variant
from reedpost.style import BLACK, BLUE, GREEN, GREY, VERMILLION, look, new_figure
from reedpost.time_tables import SWEEPS

MAP = "viridis"  # perceptually uniform, and told apart in grey
BANDS = 32  # of colour
PIECES = 3  # the stored cells' sides are cut into, along the quadratic elements
PARTS = (("a", "A, land at the root", BLACK, "-"), ("b", "B, rest of the land", GREEN, (0, (5, 1, 1, 1))),
         ("c", "C, over the hole", BLUE, (0, (4, 1.5))))  # fmt: skip


def field_picture(result: Result, case: int) -> Picture:
    """Film pressure on the whole reed at the stored times (Figs. 6 and 7)."""
    times, form = film_mesh.field_times(result), film_mesh.planform(result, case)
    mesh = film_mesh.whole_reed(result, case, PIECES)
    inlets = [film_mesh.inlet_kpa(result, case, time) for time in times.tolist()]
    stored = [film_mesh.field(result, case, i) for i in range(len(times))]
    values = [mesh.values(film_mesh.finer(result, v, PIECES), p) for v, p in zip(stored, inlets, strict=True)]
    low, high = min(0.0, *(float(np.nanmin(v)) for v in values)), max(float(np.nanmax(v)) for v in values)
    high = high if high > low else low + 1.0
    norm, ticks = Normalize(low, high), MaxNLocator(9, steps=[1, 2, 5, 10]).tick_values(low, high)
    ticks = ticks[(ticks >= low) & (ticks <= high)]
    lines = ticks[np.abs(ticks) > 1e-9 * high]  # zero is the outlet's, all along the edge
    columns = min(3, len(times))
    rows = math.ceil(len(times) / columns)
    figure, grid = new_figure(31.0 * rows + 16.0, rows, columns, sharex=True, sharey=True)
    triangles = np.concatenate([mesh.quads[:, [0, 1, 2]], mesh.quads[:, [0, 2, 3]]])
    for axes, time, inlet, film, value in zip(grid.flat, times, inlets, stored, values, strict=False):
        filled = axes.tricontourf(mesh.x, mesh.y, triangles, value, np.linspace(low, high, BANDS), norm=norm, cmap=MAP)
        filled.set_edgecolor("face")  # no hairlines between the bands in SVG
        filled.set_linewidth(0.2)
        axes.tricontour(mesh.x, mesh.y, triangles, value, lines, colors="white", linewidths=0.35, alpha=0.7)
        color = ScalarMappable(norm, MAP).to_rgba(inlet)
        axes.add_patch(Circle((form.centre, 0.0), form.hole_radius, facecolor=color, edgecolor="white", lw=0.8))
        axes.add_patch(PathPatch(_outline(form), facecolor="none", edgecolor=BLACK, lw=0.8))
        axes.plot([0.0, 0.0], [-form.half_width, form.half_width], color=BLACK, lw=2.2, solid_capstyle="butt")
        axes.set_title(f"{time:g} ms", pad=11)
        axes.annotate(f"inlet {inlet:.3g}, film {_span(film)}", (0.5, 1.02), xycoords="axes fraction",
                      ha="center", va="bottom", fontsize=5.5)  # fmt: skip
        axes.set_aspect("equal")
        axes.set_xlim(-0.3, form.length + 0.2)
        axes.set_xticks([0.0, form.root, form.centre, form.length])
        axes.set_yticks([-form.half_width, 0.0, form.half_width])
    for axes in list(grid.flat)[len(times) :]:
        axes.set_visible(False)
    for axes in grid[-1]:
        axes.set_xlabel("x (mm)")
    for axes in grid[:, 0]:
        axes.set_ylabel("y (mm)")
    bar = figure.colorbar(ScalarMappable(norm, MAP), ax=grid, orientation="horizontal", aspect=40, shrink=0.9)
    bar.set_label("pressure (kPa)")
    bar.set_ticks(ticks)
    gap, pressure = (float(result.value(key, case)) for key in ("film.gap_mm", "pressure.inlet_kpa"))
    model = str(result.model[case])
    return Picture(
        f"film_pressure_{model}_{1e3 * gap:.0f}um_{pressure:g}kpa".replace(".", "p"),
        f"Pressure under the reed while it closes at {pressure:g} kPa, gap {gap:g} mm, {model} model. Thick line: the"
        " clamp; circle: the hole, where the inlet pressure holds. The lower half mirrors the upper one.",
        figure,
    )


def _span(film: np.ndarray) -> str:
    """Lowest to highest pressure of the film in few characters."""
    texts = ("0" if abs(p) < 0.005 else f"{p:.2g}" if p < 0 else f"{p:.3g}" for p in (film.min(), film.max()))
    return " to ".join(texts).replace("-", "\u2212")


def _outline(form: Planform) -> Outline:
    """The reed's edge: a rectangle and a semicircle."""
    angle = np.linspace(math.pi / 2, -math.pi / 2, 61)
    x = np.concatenate([[0.0], form.centre + form.half_width * np.cos(angle), [0.0, 0.0]])
    y = np.concatenate([[form.half_width], form.half_width * np.sin(angle), [-form.half_width, form.half_width]])
    return Outline(np.column_stack([x, y]))


def parts_picture(variant: Variant, model: str, problems: list[str]) -> Picture:
    """Forces on parts A, B and C and the displacement while closing, one panel a gap (Fig. 8)."""
    result, time = variant.result, variant.result.time()
    gaps, pressure = variant.gaps_to_draw, variant.pressure_to_draw
    rows = math.ceil(len(gaps) / 2)
    figure, grid = new_figure(34.0 * rows + 18.0, rows, 2, sharex=True, sharey=True)
    mates = []
    forces, lengths = np.zeros(0), np.zeros(0)
    for number, gap in enumerate(gaps):
        axes = grid.flat[number]
        mate = axes.twinx()
        mates.append(mate)
        axes.set_title(f"gap {gap:.2f} mm", pad=3)
        axes.set_zorder(mate.get_zorder() + 1)
        axes.patch.set_visible(False)
        axes.axhline(0.0, color=GREY, lw=0.5, zorder=0)
        case = variant.find(model, pressure, gap)
        if case is None or result.status[case] != "ok":
            why = "no case" if case is None else f"{result.status[case]} in the case"
            problems.append(f"{why} to draw: model {model}, gap {gap:g} mm")
            continue
        for part, _, color, line in PARTS:
            axes.plot(time, result.trace(f"part_{part}_n", case), color=color, ls=line)
        mate.plot(time, 1e3 * result.trace("displacement_mm", case), color=VERMILLION, ls=(0, (1, 1)), lw=1.0)
        event = closing_event_ms(result, case)
        axes.set_xlim(event - 0.5, event + 4.0)
        shown = (time >= event - 0.5) & (time <= event + 4.0)
        forces = np.concatenate([forces, *(result.trace(f"part_{part}_n", case)[shown] for part, *_ in PARTS)])
        lengths = np.append(lengths, 1e3 * result.trace("displacement_mm", case)[shown])
    if len(forces):
        _same_zero(grid[0, 0], mates, forces, lengths)
    for axes in list(grid.flat)[len(gaps) :]:
        axes.set_visible(False)
    for axes in grid[-1]:
        axes.set_xlabel("time (ms)")
    figure.supylabel("force (N)", fontsize=8)
    for number, mate in enumerate(mates):
        mate.tick_params(axis="y", colors=VERMILLION, right=number % 2 == 1, labelright=number % 2 == 1)
        if number % 2 and number // 2 == (rows - 1) // 2:
            mate.set_ylabel("displacement (µm)", color=VERMILLION)
    handles = [Line2D([], [], color=color, ls=line, label=label) for _, label, color, line in PARTS]
    handles.append(Line2D([], [], color=VERMILLION, ls=(0, (1, 1)), lw=1.0, label="tip displacement"))
    figure.legend(handles=handles, loc="outside upper center", ncols=2, columnspacing=1.5)
    return Picture(
        f"parts_{model}",
        f"Forces of the pressure on parts A, B and C of the reed, and its tip displacement, while closing at"
        f" {pressure:g} kPa for gaps of {gaps[0]:.2f} to {gaps[-1]:.2f} mm, {model} model.",
        figure,
    )


def _same_zero(axes, mates: list, forces: np.ndarray, lengths: np.ndarray) -> None:
    """Scales on which all that is shown fits and zero is at one height."""
    below = max(0.05, *(-1.15 * float(np.nanmin(v) / np.nanmax(v)) for v in (forces, lengths)))
    axes.set_ylim(-below * float(np.nanmax(forces)), 1.08 * float(np.nanmax(forces)))
    for mate in mates:
        mate.set_ylim(-below * float(np.nanmax(lengths)), 1.08 * float(np.nanmax(lengths)))


def models_picture(series: list[Series]) -> Picture | None:
    """Fall and closing time of all models against pressure; None when one result holds all there is.

    That result has a picture of its own, of the same curves.
    """
    curves = [s for s in series if s.count >= FEWEST]
    if len({s.variant.result.folder for s in curves}) < 2:
        return None
    figure, grid = new_figure(132.0, 2, 1, sharex=True)
    for axes, key in zip(grid[:, 0], SWEEPS, strict=True):
        _, file, measure, quantity, _ = SWEEPS[key]
        rows = paper.table(file)
        inlet, fea = ([row[name] for row in rows] for name in ("inlet_kpa", "fea_ms"))
        low, high = paper.mesh_scatter(measure).percent
        axes.fill_between(inlet, [t * (1 + low / 100) for t in fea], [t * (1 + high / 100) for t in fea],
                          color=GREY, alpha=0.3, lw=0, label="mesh scatter (20 kPa)")  # fmt: skip
        axes.plot(inlet, fea, color=BLACK, ls="", marker="x", mew=1.2, label="finite elements")
        axes.plot(inlet, [row["proposed_ms"] for row in rows], color=BLUE, ls="", marker="o", mfc="white",
                  label="paper's fitted model")  # fmt: skip
        for s in curves:
            kind = look(s.model)
            light = {"alpha": 0.55, "lw": 0.9} if s.edge else {}
            axes.plot(inlet, [s.value(measure, p) for p in inlet], color=kind.color, ls=kind.line,
                      label=s.label, **light)  # fmt: skip
        axes.set_ylabel(f"{quantity} (ms)")
        axes.set_ylim(bottom=0.0)
    grid[1, 0].set_xlabel("inlet pressure (kPa)")
    grid[1, 0].set_xlim(0.0, 42.0)
    handles, labels = grid[0, 0].get_legend_handles_labels()
    handles, labels = [handles[i] for i in (1, 0)] + handles[2:], [labels[i] for i in (1, 0)] + labels[2:]
    figure.legend(handles, labels, loc="outside upper center", ncols=2, columnspacing=1.2, handlelength=1.8)
    return Picture(
        "all_models_against_pressure",
        f"Fall and closing time of all models against inlet pressure, gap {paper.GAP_MM:g} mm. The band is the scatter"
        " of the finite elements' meshes, known at 20 kPa only, in per cent.",
        figure,
    )
