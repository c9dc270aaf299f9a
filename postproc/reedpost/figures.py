"""The pictures: histories, times against pressure, gap study, experiment."""

from __future__ import annotations

import math

import numpy as np
from matplotlib.lines import Line2D

from reedpost import film_mesh, paper
from reedpost.film_figures import field_picture, models_picture, parts_picture
from reedpost.gap_study import closing_event_ms
from reedpost.overview import all_series
from reedpost.picture import Album, Picture
from reedpost.results import Result
from reedpost.studies import (
    EXPERIMENT,
    FIELDS,
    GAP_STUDY,
    PRESSURE_SWEEP,
    Variant,
    studies,
    trace_case,
    variants,
)
from reedpost.style import BLACK, BLUE, GREY, SERIES, in_style, look, new_figure
from reedpost.time_tables import SWEEPS

MOST_FIELDS = 6  # pictures of pressure fields


def draw(result: Result) -> Album:
    """Every picture that a result allows; of several variants the first is drawn."""
    album = Album()
    groups = variants(result)
    variant = groups[0]
    if len(groups) > 1:
        text = f"the sweep makes {len(groups)} variants of the valve; only the first is drawn"
        album.problems.append(f"{text}: {variant.label}")
    with in_style():
        for study in studies(variant):
            if study == PRESSURE_SWEEP:
                _draw_sweep(variant, album)
            elif study == GAP_STUDY:
                _draw_gaps(variant, album)
            elif study == FIELDS:
                _draw_fields(variant, album)
            elif study == EXPERIMENT:
                album.pictures.append(experiment_picture(variant, album.problems))
    if not (album.pictures or album.problems):
        album.problems.append("there is no picture of a gap study without a film")
    return album


def draw_all(results: list[Result]) -> Album:
    """What several results show together."""
    with in_style():
        picture = models_picture(all_series(results))
    return Album([picture] if picture else [])


def _draw_fields(variant: Variant, album: Album) -> None:
    result = variant.result
    cases = [case for case in variant.cases.tolist() if film_mesh.has_field(result, case)]
    if len(cases) > MOST_FIELDS:
        album.problems.append(f"{len(cases)} cases hold pressure fields; only the first {MOST_FIELDS} are drawn")
    album.pictures += [field_picture(result, case) for case in cases[:MOST_FIELDS]]
    if not cases:
        album.problems.append(
            "no pressure field to draw: its cases failed, or film.fields_ms names no time of their runs"
        )


def _draw_sweep(variant: Variant, album: Album) -> None:
    pressures = variant.axis("pressure.inlet_kpa")
    if len(pressures) > 3:
        album.pictures.append(times_picture(variant, album.problems))
    shown = [p for p in paper.HISTORY_KPA if np.isclose(pressures, p, rtol=1e-6).any()]
    if variant.result.has_traces:
        album.pictures.append(history_picture(variant, shown or list(pressures[:3]), album.problems))
    elif len(pressures) <= 3:
        album.problems.append("no displacement histories to draw: run with traces = .true.")


def history_picture(variant: Variant, pressures: list[float], problems: list[str]) -> Picture:
    """Displacement against time while opening and while closing, one row a pressure (Fig. 12)."""
    result, time = variant.result, variant.result.time()
    fea = {row["inlet_kpa"]: row["fea_ms"] for row in paper.table("table_4_closing_time")}
    figure, grid = new_figure(
        28.0 * len(pressures) + 18.0, len(pressures), 2, sharey="row", sharex="col",
        gridspec_kw={"width_ratios": [1.0, 1.25]},
    )  # fmt: skip
    gap = variant.gap_to_draw
    with_fea = variant.is_the_papers and gap == paper.GAP_MM
    event = closing_event_ms(result, int(variant.cases[0]))
    windows = [(0.0, 5.0), (event - 0.5, event + 6.5)]
    for pressure, row in zip(pressures, grid, strict=True):
        steady = math.nan
        for model in variant.models:
            case = _good_case(variant, model, pressure, gap, problems)
            if case is None:
                continue
            u = 1e3 * result.trace("displacement_mm", case)
            steady = 1e3 * float(result.measure("steady_mm")[case])
            for axes in row:
                axes.plot(time, u, color=look(model).color, ls=look(model).line)
        for axes, window in zip(row, windows, strict=True):
            axes.set_xlim(window)
            axes.axhline(0.0, color=GREY, lw=0.5, zorder=0)
        row[1].tick_params(labelleft=False)
        row[1].annotate(f"{pressure:g} kPa", (0.97, 0.93), xycoords="axes fraction", ha="right", va="top")
        if with_fea and pressure in fea:
            row[1].plot(event + fea[pressure], 0.02 * steady, marker="x", color=BLACK, ls="", mew=1.2)
    for axes, title in zip(grid[0], ("opening", "closing"), strict=True):
        axes.set_title(title)
    for axes in grid[-1]:
        axes.set_xlabel("time (ms)")
    figure.supylabel("displacement (µm)", fontsize=8)
    handles = [
        Line2D([], [], color=look(model).color, ls=look(model).line, label=look(model).label)
        for model in variant.models
    ]
    crosses = ""
    if with_fea:
        handles += [Line2D([], [], color=BLACK, marker="x", ls="", mew=1.2, label="finite elements, 2 %")]
        crosses = " Crosses: where the published finite elements reach 2 % of the steady displacement."
    figure.legend(
        handles=handles, loc="outside upper center", ncols=3, columnspacing=1.0, handlelength=1.8,
        handletextpad=0.4,
    )  # fmt: skip
    return Picture(
        "displacement_histories",
        "Tip displacement while opening and closing at "
        + ", ".join(f"{p:g}" for p in pressures)
        + f" kPa, gap {gap:g} mm.{crosses}",
        figure,
    )


def _good_case(variant: Variant, model: str, pressure: float, gap: float, problems: list[str]) -> int | None:
    """The case to draw; None, and a line in `problems`, when it is missing or failed."""
    case = variant.find(model, pressure, gap)
    what = f"model {model}, {pressure:g} kPa, gap {gap:g} mm"
    if case is None:
        problems.append(f"no case to draw: {what}")
    elif variant.result.status[case] != "ok":
        problems.append(f"case {case + 1} ({what}) failed and is not drawn: {variant.result.status[case]}")
        return None
    return case


def times_picture(variant: Variant, problems: list[str]) -> Picture:
    """Fall and closing time against pressure, for the paper's valve with the published points."""
    figure, grid = new_figure(115.0, 2, 1, sharex=True)
    gap = variant.gap_to_draw
    with_published = variant.is_the_papers and gap == paper.GAP_MM
    highest = max(40.0 if with_published else 0.0, float(variant.axis("pressure.inlet_kpa")[-1]))
    for axes, key in zip(grid[:, 0], SWEEPS, strict=True):
        _, file, measure, quantity, _ = SWEEPS[key]
        rows = paper.table(file)
        inlet = [row["inlet_kpa"] for row in rows]
        for model in variant.models:
            kind, published = look(model), paper.PUBLISHED.get(model)
            pressures, values = _curve(variant, model, gap, measure, problems)
            axes.plot(pressures, values, color=kind.color, ls=kind.line, label=f"{kind.label}, ours")
            if with_published and published:
                axes.plot(
                    inlet, [row[f"{published}_ms"] for row in rows], color=kind.color, ls="",
                    marker=kind.marker, mfc="white", label=f"{kind.label}, published",
                )  # fmt: skip
        axes.set_ylabel(f"{quantity} (ms)")
        axes.set_ylim(bottom=0.0)
        if not with_published:
            continue
        if not any(model in paper.PUBLISHED for model in variant.models):
            axes.plot(inlet, [row["proposed_ms"] for row in rows], color=BLUE, ls="", marker="o", mfc="white",
                      label="paper's model")  # fmt: skip
        axes.plot(
            inlet, [row["fea_ms"] for row in rows], color=BLACK, ls="", marker="x", mew=1.2,
            label="finite elements",
        )  # fmt: skip
        scatter = paper.mesh_scatter(measure)
        axes.errorbar(
            paper.GAP_STUDY_KPA, scatter.chosen, color=BLACK, capsize=5, lw=1.0, ls="",
            yerr=[[scatter.chosen - scatter.lowest], [scatter.highest - scatter.chosen]],
            label="mesh scatter (Table I)",
        )  # fmt: skip
    grid[1, 0].set_xlabel("inlet pressure (kPa)")
    grid[1, 0].set_xlim(0.0, 1.05 * highest)
    handles, labels = grid[0, 0].get_legend_handles_labels()
    figure.legend(handles, labels, loc="outside upper center", ncols=2, columnspacing=1.5)
    bar = " The bar at 20 kPa is how far the finite elements' own meshes lie apart." if with_published else ""
    return Picture(
        "times_against_pressure", f"Fall and closing time against inlet pressure, gap {gap:g} mm.{bar}", figure
    )


def _curve(variant: Variant, model: str, gap: float, measure: str, problems: list[str]) -> tuple[list, list]:
    """Pressures [kPa] and a measure [ms] of one model at a gap."""
    pressures, values = [], []
    for pressure in variant.axis("pressure.inlet_kpa"):
        case = variant.find(model, float(pressure), gap)
        value = math.nan if case is None else float(variant.result.measure(measure)[case])
        if math.isnan(value):
            problems.append(f"no {measure} to draw at {pressure:g} kPa for model {model}")
        pressures.append(float(pressure))
        values.append(value)
    return pressures, values


def _draw_gaps(variant: Variant, album: Album) -> None:
    if not variant.result.has_traces:
        album.problems.append("no histories of the gap study to draw: run with traces = .true.")
        return
    for model in variant.models:
        if variant.result.has_parts(int(variant.cases_of(model)[0])):
            album.pictures.append(parts_picture(variant, model, album.problems))
        elif model != "traditional":
            album.pictures.append(gap_picture(variant, model, album.problems))


def gap_picture(variant: Variant, model: str, problems: list[str]) -> Picture:
    """Displacement and film force while closing, for each gap (Fig. 8)."""
    result, time = variant.result, variant.result.time()
    figure, grid = new_figure(120.0, 2, 1, sharex=True)
    upper, lower = grid[:, 0]
    case, peak = None, 0.0
    gaps, pressure = variant.gaps_to_draw, variant.pressure_to_draw
    for gap, (color, line) in zip(gaps, SERIES, strict=False):
        case = _good_case(variant, model, pressure, gap, problems)
        if case is None:
            continue
        upper.plot(time, 1e3 * result.trace("displacement_mm", case), color=color, ls=line,
                   label=f"{gap:.2f} mm" if round(gap, 2) == gap else f"{gap:.3g} mm")  # fmt: skip
        force = result.trace("squeeze_n", case)
        peak = max(peak, float(np.nanmax(force)))
        lower.plot(time, force, color=color, ls=line)
    case = int(variant.cases[0]) if case is None else case
    event = closing_event_ms(result, case)
    hole = 1e-3 * paper.action_area_mm2(result, case) * pressure
    ramp = float(result.value("pressure.transition_ms", case))
    lower.plot([event - 1.0, event, event + ramp, event + 5.0], [hole, hole, 0.0, 0.0], color=BLACK,
               lw=0.9, label="pressure on the hole, $p_\\mathrm{in} A$")  # fmt: skip
    steady = 1e3 * float(result.measure("steady_mm")[case])
    upper.axhline(0.0, color=GREY, lw=0.5, zorder=0)
    if math.isfinite(steady):
        upper.set_ylim(-0.2 * steady, 1.1 * steady)  # the swing of the opening is not shown
    upper.set_ylabel("displacement (µm)")
    upper.legend(title="gap at rest", title_fontsize=7, loc="upper right")
    lower.set_ylabel("resistance (N)")
    lower.legend(loc="upper right")
    lower.set_xlabel("time (ms)")
    lower.set_xlim(event - 0.25, event + 3.5)
    lower.set_ylim(0.0, min(1.6 * peak, 1.1 * hole) or 1.1 * hole)
    return Picture(
        f"gap_study_{model}",
        f"Closing at {pressure:g} kPa for gaps of {gaps[0]:g} to {gaps[-1]:g} mm, {model} model: tip"
        " displacement, and the film's force beside the pressure on the hole.",
        figure,
    )


def experiment_picture(variant: Variant, problems: list[str]) -> Picture:
    """Closing times of Table V as bars."""
    rows = paper.table("table_5_experiment")
    result = variant.result
    bars: list[tuple[str, list[float], dict]] = [
        ("experiment", [row["experiment_ms"] for row in rows], {"color": BLACK})
    ]
    for model in variant.models:
        kind, published = look(model), paper.PUBLISHED.get(model)
        found = {t.condition: t.case for t in (trace_case(result, int(c)) for c in variant.cases_of(model))}
        ours = []
        for row in rows:
            case = found.get(int(row["condition"]))
            value = math.nan if case is None else float(result.measure("zero_ms")[case])
            if math.isnan(value):
                problems.append(f"no closing time to draw for condition {row['condition']:g}, model {model}")
            ours.append(value)
        if published:
            theirs = [row[f"{published}_ms"] for row in rows]
            hatched = {"facecolor": "white", "edgecolor": kind.color, "hatch": "/////", "lw": 0.8}
            bars.append((f"{kind.label}, published", theirs, hatched))
        bars.append((f"{kind.label}, ours", ours, {"color": kind.color}))
    figure, grid = new_figure(32.0 + 3 * 4.6 * len(bars), 1, 1)
    axes = grid[0, 0]
    pitch = len(bars) + 1.0
    for number, (label, values, options) in enumerate(bars):
        place = [pitch * i + number for i in range(len(rows))]
        drawn = axes.barh(place, values, height=0.82, label=label, **options)
        form = "{:.2f}" if label.endswith("ours") else "{:.1f}"
        axes.bar_label(drawn, [form.format(v) if v == v else "none" for v in values], padding=2, fontsize=7)
    axes.set_yticks(
        [pitch * i + (len(bars) - 1) / 2 for i in range(len(rows))],
        [f"condition {row['condition']:g}\n{row['rate_kpa_per_ms']:g} kPa/ms" for row in rows],
    )
    axes.tick_params(axis="y", length=0)
    axes.invert_yaxis()
    longest = max((v for _, values, _ in bars for v in values if not math.isnan(v)))
    axes.set_xlim(0.0, 1.12 * longest)  # leaves room for the numbers
    axes.set_xlabel("closing time, event to u = 0 (ms)")
    figure.legend(loc="outside upper center", ncols=2)
    return Picture(
        "experiment",
        "Closing times of Table V under pressure traces reconstructed (not measured) from the"
        " published fall rates; the traditional model is matched to its published times by"
        " construction.",
        figure,
    )
