"""The program's film models through the whole chain; it is found through the environment variable REEDVALVE."""

from __future__ import annotations

import os
import subprocess
from pathlib import Path

import pytest
import xarray as xr
from reedpost.cli import main
from reedpost.compare import compare
from reedpost.overview import overview_tables
from reedpost.results import read_result
from test_paraview import opened_as_ugrid

INPUTS = Path(__file__).resolve().parents[2] / "inputs"


@pytest.fixture(scope="module")
def run(tmp_path_factory):
    """Runs a deck of the project once and gives its folder."""
    program, folder = os.environ.get("REEDVALVE"), tmp_path_factory.mktemp("film_decks")

    def results(deck):
        if not program:
            pytest.skip("REEDVALVE, the path of the reedvalve program, is not set")
        if not (folder / deck).exists():
            subprocess.run([program, "run", INPUTS / f"{deck}.nml", "-o", folder / deck, "--quiet"], check=True)
        return folder / deck

    return results


def errors(tables, name):
    return [row[[c.name for c in tables[name].columns].index("film_vs_fea_percent")] for row in tables[name].rows]


def test_tables_3_and_4(run):
    """The deviations from the finite elements are what they are; a change of them is to be noticed."""
    result = read_result(run("film_tables"))
    assert compare(result).complete
    tables = {table.name: table for table in overview_tables([result])}
    fall, closing = errors(tables, "overview_table_3"), errors(tables, "overview_table_4")
    assert (min(fall), max(fall)) == pytest.approx((-1.3, 11.0), abs=0.6)
    assert (min(closing), max(closing)) == pytest.approx((-4.3, 10.8), abs=0.6)
    steady = {row[0]: row[2] for row in tables["overview_steady"].rows}
    assert steady["film, ours"] == pytest.approx(37.2, abs=0.3)


def test_edges_slow_it_down(run):
    plain, edged = (read_result(run(deck)) for deck in ("film_tables", "film_edge"))
    for name in ("fall_ms", "closing_ms"):
        assert edged.measure(name)[3] / plain.measure(name)[3] == pytest.approx(1.17, abs=0.01)


def test_fields_through_the_whole_chain(run, tmp_path):
    folder = run("film_fields")
    for command in ("compare", "plot", "fields"):
        assert main([command, str(folder), "-o", str(tmp_path / command)]) == 0
    result = read_result(folder)
    assert len(list((tmp_path / "fields").glob("*.vtu"))) == 12
    assert result.trace("part_a_n", 0).shape == result.time().shape
    with xr.open_dataset(folder / "results.nc", decode_timedelta=False) as data:
        assert "UGRID" in data.attrs["Conventions"]
        assert {"field_time_ms", "film_x_mm", "film_y_mm"} <= set(data["film_pressure_kpa"].coords)


@pytest.mark.filterwarnings("ignore")
def test_fields_are_ugrid(run):
    data = opened_as_ugrid(run("film_fields"))
    assert data.ugrid.grids[0].area.sum() == pytest.approx(14.2854, rel=1e-3)  # of the half land [mm2]
