"""Pictures: the right ones, with labels and units, the same bytes each time."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from matplotlib import pyplot as plt
from reedpost.figures import draw
from reedpost.results import read_result
from reedpost.studies import variants
from reedpost.style import COLUMN_IN, LOOKS, svg_bytes
from synthetic import Case, write_result


@pytest.fixture(autouse=True)
def let_go():
    yield
    plt.close("all")


@pytest.mark.parametrize(
    "name, pictures",
    [
        ("sweep", ["times_against_pressure"]),
        ("response", ["displacement_histories"]),
        ("gaps", ["gap_study_squeeze"]),
        ("table5", ["experiment"]),
    ],
)
def test_which_pictures(name, pictures, request):
    album = draw(read_result(request.getfixturevalue(name)))
    assert [picture.name for picture in album.pictures] == pictures
    assert album.problems == []
    for picture in album.pictures:
        assert picture.caption
        assert picture.figure.get_figwidth() == pytest.approx(COLUMN_IN)
        assert min(t.get_fontsize() for t in picture.figure.findobj(plt.Text) if t.get_text()) >= 5.0


@pytest.mark.parametrize("name", ["sweep", "response", "gaps", "table5"])
def test_axes_have_units(name, request):
    figure = draw(read_result(request.getfixturevalue(name))).pictures[0].figure
    labels = [axes.get_xlabel() for axes in figure.axes if axes.get_xlabel()]
    labels += [axes.get_ylabel() for axes in figure.axes if axes.get_ylabel()]
    labels += [figure.get_supylabel()] if figure.get_supylabel() else []
    assert labels
    assert all(label.endswith(")") for label in labels)


def test_models_differ_without_colour():
    assert len({look.color for look in LOOKS.values()}) == len(LOOKS)
    assert len({str(look.line) for look in LOOKS.values()}) == len(LOOKS)
    assert len({look.marker for look in LOOKS.values()}) == len(LOOKS)


def test_same_bytes_each_time(sweep, tmp_path):
    for name in ("one", "two"):
        draw(read_result(sweep)).save(tmp_path / name)
    for ending in ("png", "svg"):
        one, two = ((tmp_path / d / f"times_against_pressure.{ending}").read_bytes() for d in ("one", "two"))
        assert one == two


def test_published_points_are_drawn(sweep):
    axes = draw(read_result(sweep)).pictures[0].figure.axes[1]
    lines = {line.get_label(): line.get_ydata() for line in axes.lines}
    assert list(lines["finite elements"]) == [4.91, 4.40, 4.13, 3.88, 3.56, 3.42, 3.32, 3.17]
    assert list(lines["squeeze, published"])[:2] == [6.08, 5.00]
    assert lines["squeeze, ours"][0] == pytest.approx(6.039, abs=1e-3)


def test_what_is_missing_is_named(broken):
    problems = draw(read_result(broken)).problems
    assert "no closing_ms to draw at 25 kPa for model squeeze" in problems
    assert "no fall_ms to draw at 20 kPa for model traditional" in problems


def test_svg_carries_no_date(sweep):
    assert b"<dc:date>" not in svg_bytes(draw(read_result(sweep)).pictures[0].figure)


def test_a_valve_with_another_gap_is_drawn(tmp_path):
    time = np.arange(0.0, 40.001, 0.1)
    folder = write_result(tmp_path / "r", [Case("squeeze", gap_mm=0.05 + 0.05)], time)
    result = read_result(folder)
    wider = replace(result, effective={**result.effective, "film.gap_mm": 0.1})
    album = draw(wider)
    assert album.problems == []
    assert "gap 0.1 mm" in album.pictures[0].caption
    assert len(album.pictures[0].figure.axes[0].lines) == 2  # the curve and the zero line


def other_valve(folder):
    """The result of a reed twice as thick."""
    result = read_result(folder)
    return replace(result, effective={**result.effective, "reed.thickness_mm": 0.3})


def test_the_papers_points_stay_with_its_valve(sweep, response):
    times = draw(other_valve(sweep)).pictures[0]
    assert [line.get_label() for line in times.figure.axes[0].lines] == ["traditional, ours", "squeeze, ours"]
    assert not times.figure.axes[0].containers  # nor the meshes' bar
    assert times.caption.endswith("gap 0.05 mm.")
    histories = draw(other_valve(response)).pictures[0]
    assert "finite elements" not in histories.caption
    assert all(line.get_marker() != "x" for axes in histories.figure.axes for line in axes.lines)


def test_pressures_beyond_the_papers_are_in_the_picture(tmp_path):
    folder = write_result(tmp_path / "r", [Case("squeeze", inlet_kpa=p) for p in (10.0, 50.0, 100.0, 200.0)])
    figure = draw(read_result(folder)).pictures[0].figure
    assert figure.axes[1].get_xlim() == (0.0, 210.0)


def test_any_gaps_at_any_pressure_are_drawn(tmp_path):
    time = np.arange(0.0, 40.001, 0.1)
    cases = [Case("squeeze", inlet_kpa=30.0, gap_mm=gap) for gap in (0.06, 0.08)]
    result = read_result(write_result(tmp_path / "r", cases, time))
    album = draw(replace(result, effective={**result.effective, "pressure.inlet_kpa": 30.0}))
    assert album.problems == []
    assert "30 kPa for gaps of 0.06 to 0.08 mm" in album.pictures[0].caption
    assert len(album.pictures[0].figure.axes[0].lines) == 3  # two curves and the zero line


def test_no_picture_is_no_silence(gaps):
    result = read_result(gaps)
    album = draw(replace(result, model=np.full(result.count, "traditional", dtype=object)))
    assert album.pictures == [] and album.problems == ["there is no picture of a gap study without a film"]


def test_too_many_gaps_for_one_picture(sweep):
    """Of 16 those of the paper, or six from the narrowest to the widest."""
    result = read_result(sweep)
    for gaps, drawn in ((np.arange(4, 20), [5, 10, 15]), (np.arange(31, 47), [31, 34, 37, 40, 43, 46])):
        variant = variants(replace(result, swept={"film.gap_mm": 0.01 * gaps}))[0]
        assert variant.gaps_to_draw == pytest.approx([0.01 * gap for gap in drawn])
