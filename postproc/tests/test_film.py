"""Tables, statements and discrepancies of the film models, from made-up results with known answers."""

from __future__ import annotations

import math

import numpy as np
import pytest
from matplotlib import pyplot as plt
from reedpost import film_mesh, paper
from reedpost.cli import main
from reedpost.compare import compare
from reedpost.discrepancies import discrepancies
from reedpost.figures import draw, draw_all
from reedpost.film_discrepancies import STORED
from reedpost.overview import all_series, overview_tables, write_overview
from reedpost.results import read_result
from synthetic_film import HOLE_N, pressure, write_film_result

PRESSURES = tuple(row["inlet_kpa"] for row in paper.table("table_3_fall_time"))


@pytest.fixture(scope="module")
def fields(tmp_path_factory):
    return write_film_result(tmp_path_factory.mktemp("film") / "fields", fields=True)


@pytest.fixture(scope="module")
def film_gaps(tmp_path_factory):
    return write_film_result(tmp_path_factory.mktemp("film") / "gaps", gaps=paper.GAP_STUDY_MM)


@pytest.fixture(scope="module")
def film_sweeps(tmp_path_factory):
    """The pressure sweep without and with the edge's elongation."""
    folder = tmp_path_factory.mktemp("film")
    return [
        write_film_result(folder / f"edge_{edge}", (0.05,), PRESSURES, edge=edge, traces=False) for edge in (0.0, 0.65)
    ]


def column(table, name):
    at = [c.name for c in table.columns].index(name)
    return [row[at] for row in table.rows]


def statements(comparison, name):
    return {row[0]: row[1:] for table in comparison.tables if table.name == name for row in table.rows}


def test_lumped_data_are_no_concern_of_film_models(fields):
    assert paper.differences(read_result(fields), 0) == []
    notes = " ".join(note for table in compare(read_result(fields)).tables for note in table.notes)
    assert "NOT THE PAPER'S DATA" not in notes
    assert "Nothing is fitted: no k_a, no k_s. Hydrodynamic load: maali; edge elongation: 0." in notes


def test_gap_study_of_a_film_model(film_gaps):
    comparison = compare(read_result(film_gaps))
    assert comparison.complete
    table = comparison.tables[0]
    # A = 0.8 of the open valve's force on C, which falls from 19.5 to 20.5 ms: 0.8 is passed after 0.2 ms.
    assert column(table, "a_exceeds_c_ms")[0] == pytest.approx(19.7, abs=1e-6)
    assert column(table, "b_exceeds_c_ms")[0] == pytest.approx(20.15, abs=1e-6)
    assert all(math.isnan(t) for t in column(table, "a_exceeds_c_ms")[1:])
    assert comparison.notes == ["4 of 6 cases carry the warning wide_gap; case 3: the gap is wide"]


def test_statements_say_what_holds(film_gaps):
    said = statements(compare(read_result(film_gaps)), "statements_film")
    assert said["0.05 mm: the force on A exceeds that on C from"] == ["19.70 ms", "19.70 ms", "yes"]
    assert said["0.05 mm: the force on B exceeds that on C from"] == ["20.15 ms", "20.15 ms", "yes"]
    assert said["0.20 mm: the force on C exceeds those on A and B"][1:] == ["throughout the ramp", "yes"]
    assert said["the force on C is the inlet pressure's"][-1] == "yes"
    assert said["it swings below its rest position from"][1:] == ["0.10 mm (7.7 % of steady)", "NO"]
    assert said["0.05 mm: opening is faster than closing"][-1] == "yes"


def test_fields_are_no_gap_study(fields):
    comparison = compare(read_result(fields))
    assert comparison.complete
    assert [table.name for table in comparison.tables] == ["fields_film", "field_statements_film"]
    table = comparison.tables[0]
    assert column(table, "time_ms") == [19.5, 20.0, 20.5, 21.0] * 2
    assert column(table, "c_kpa") == [20.0, 10.0, 0.0, 0.0] * 2
    assert column(table, "a_mean_kpa")[1] == pytest.approx(6.0 * (7.5 - 1.25), rel=2e-3)
    assert column(table, "highest_kpa")[1] == pytest.approx(45.0)
    said = statements(comparison, "field_statements_film")
    assert said["0.05 mm, 20 ms"][-1] == "yes"
    assert said["0.05 mm, 21 ms"][-1] == "NO"
    assert said["0.20 mm, throughout closing"] == ["A and B lie below C", "so they do", "yes"]


def test_a_case_without_field_is_named(tmp_path):
    comparison = compare(read_result(write_film_result(tmp_path / "r", fields=True, fail=1)))
    assert "case 2 (film) has no pressure field: film_closed" in comparison.tables[0].problems


def test_overview_puts_models_beside_each_other(sweep, film_sweeps, gaps, tmp_path):
    results = [read_result(folder) for folder in (sweep, gaps, *film_sweeps)]
    assert [s.label for s in all_series(results)] == ["traditional", "squeeze", "film", "film, edge 0.65"]
    tables = {table.name: table for table in overview_tables(results)}
    closing = tables["overview_table_4"]
    assert column(closing, "film_vs_fea_percent")[3] == pytest.approx(100 * (3.882 / 3.88 - 1))
    assert column(closing, "published_vs_fea_percent")[0] == pytest.approx(100 * (6.08 / 4.91 - 1))
    assert closing.errors[-1].what == "closing time, film_edge_0p65"
    assert any("mesh scatter" in note for note in closing.notes)
    steady = {row[0].strip(): row[1:] for row in tables["overview_steady"].rows}
    assert steady["finite elements (Table I)"] == [0.0951, 0.0]
    assert steady["film, ours"] == [pytest.approx(0.1305), pytest.approx(37.2, abs=0.05)]
    assert steady["squeeze, ours"][1] == pytest.approx(-1.9, abs=0.05)
    names = [path.name for path in write_overview(list(tables.values()), tmp_path)]
    assert names[-2:] == ["overview_steady.csv", "overview.md"]


def test_another_valve_has_no_place_in_the_overview(broken):
    assert [s.label for s in all_series([read_result(broken)])] == []


def test_discrepancies_come_from_the_results(film_sweeps, film_gaps):
    texts = dict(discrepancies([read_result(folder) for folder in (*film_sweeps, film_gaps)]))
    text = " ".join(texts.values())
    assert any(title.endswith("steady displacement is 37 % above the finite elements'") for title in texts)
    assert "from 1.54 to 1.79 ms (+16 %)" in text
    assert "-39.0 kPa (model film, inlet 20 kPa, gap 0.05 mm)" in text
    assert "4 of 22 film cases carry that warning" in text
    assert STORED not in text


def test_discrepancies_without_film_models_say_so(sweep):
    texts = dict(discrepancies([read_result(sweep)]))
    assert " ".join(texts.values()).count(f"({STORED})") == 4
    assert any("37 % above" in title for title in texts)


def test_pictures(fields, film_gaps, film_sweeps):
    results = [read_result(folder) for folder in (fields, film_gaps, *film_sweeps)]
    albums = [*map(draw, results), draw_all(results)]
    assert [[picture.name for picture in album.pictures] for album in albums] == [
        ["film_pressure_film_50um_20kpa", "film_pressure_film_200um_20kpa"],
        ["parts_film"],
        ["times_against_pressure"],
        ["times_against_pressure"],
        ["all_models_against_pressure"],
    ]
    assert not any(album.problems for album in albums)
    bars = {axes.get_xlabel() for axes in albums[0].pictures[0].figure.axes}
    assert "pressure (kPa)" in bars
    plt.close("all")


def test_the_report_holds_all_of_it(fields, film_sweeps, tmp_path):
    path = tmp_path / "report.html"
    assert main(["report", str(fields), *map(str, film_sweeps), "-o", str(path)]) == 0
    text = path.read_text("utf-8")
    for words in ('<h2 id="all">All models</h2>', "37 % above", "edge elongation", "wide_gap", "part B overtakes C"):
        assert words in text


def test_whole_reed_covers_the_planform(fields):
    result = read_result(fields)
    whole = 6.0 * 4.5 + math.pi * 4.5
    for pieces, limit in ((1, 1e-2), (3, 1e-3)):
        mesh = film_mesh.whole_reed(result, 0, pieces)
        corners = [*mesh.quads[:, :3], *mesh.quads[:, [0, 2, 3]], *mesh.triangles]
        x, y = mesh.x[corners], mesh.y[corners]
        area = 0.5 * ((x[:, 1] - x[:, 0]) * (y[:, 2] - y[:, 0]) - (x[:, 2] - x[:, 0]) * (y[:, 1] - y[:, 0]))
        assert (area > 0).all()  # no cell is turned over by the mirror
        assert area.sum() == pytest.approx(whole, rel=limit)
        assert np.unique(np.round([mesh.x, mesh.y], 9), axis=1).shape[1] == len(mesh.x)  # no node twice


def test_finer_fields_pass_through_the_stored_ones(fields):
    result = read_result(fields)
    x, _, _ = film_mesh.half_land(result)
    coarse = pressure(0.05, 20.0, x)
    fine = film_mesh.finer(result, coarse, 3)
    mesh = film_mesh.whole_reed(result, 0, 3)
    assert np.allclose(fine, 6.0 * (7.5 - mesh.x[: len(fine)]))  # the nodes move with the same interpolation
    assert np.isin(np.round(coarse, 9), np.round(fine, 9)).all()
    assert fine[0] == coarse[0]


def test_forces_are_of_the_open_valve(fields):
    result = read_result(fields)
    assert result.trace("part_c_n", 0)[0] == pytest.approx(HOLE_N)
    assert result.has_parts(0)
    assert result.warned("wide_gap").tolist() == [False, True]
    assert not result.warned("no_such_warning").any()
