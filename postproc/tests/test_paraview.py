"""Pressure fields as VTK files and as UGRID: whole, and opened by other programs where these are installed."""

from __future__ import annotations

import math
from xml.etree import ElementTree

import numpy as np
import pytest
from reedpost.cli import main
from reedpost.results import read_result
from synthetic_film import FIELD_MS, write_film_result

AREA = 6.0 * 4.5 + math.pi * 4.5  # of the whole reed [mm2]


@pytest.fixture(scope="module")
def fields(tmp_path_factory):
    return write_film_result(tmp_path_factory.mktemp("vtk") / "r", fields=True)


def write(fields, folder, capsys):
    assert main(["fields", str(fields), "-o", str(folder)]) == 0
    return capsys.readouterr().out.split()


def test_files_and_times(fields, tmp_path, capsys):
    printed = write(fields, tmp_path, capsys)
    assert printed == [str(tmp_path / f"case_000{n}.pvd") for n in (1, 2)]
    series = ElementTree.parse(printed[0]).getroot().findall("Collection/DataSet")
    assert [float(entry.get("timestep")) for entry in series] == list(FIELD_MS)
    assert all((tmp_path / entry.get("file")).exists() for entry in series)
    assert len(list(tmp_path.glob("*.vtu"))) == 2 * len(FIELD_MS)


def test_grids_are_whole(fields, tmp_path, capsys):
    write(fields, tmp_path, capsys)
    piece = ElementTree.parse(tmp_path / "case_0001_time_002.vtu").getroot().find("UnstructuredGrid/Piece")
    arrays = {a.get("Name"): np.array(a.text.split(), float) for a in piece.iter("DataArray")}
    nodes, cells = int(piece.get("NumberOfPoints")), int(piece.get("NumberOfCells"))
    assert len(arrays["points (mm)"]) == 3 * nodes
    assert len(arrays["pressure (kPa)"]) == nodes
    assert arrays["pressure (kPa)"].max() == pytest.approx(45.0)
    assert arrays["pressure (kPa)"][-1] == 10.0  # over the hole: the inlet's
    assert len(arrays["offsets"]) == len(arrays["types"]) == cells
    assert arrays["offsets"][-1] == len(arrays["connectivity"])
    assert arrays["connectivity"].max() == nodes - 1
    assert set(arrays["part (0 A, 1 B, 2 C)"]) == {0.0, 1.0, 2.0}


def test_a_failed_case_has_no_files(tmp_path, capsys):
    folder = write_film_result(tmp_path / "r", fields=True, fail=0)
    assert write(folder, tmp_path / "vtk", capsys) == [str(tmp_path / "vtk" / "case_0002.pvd")]


def test_results_without_fields_are_told(gaps, tmp_path, capsys):
    assert main(["fields", str(gaps), "-o", str(tmp_path / "vtk")]) == 1
    assert "holds no pressure field" in capsys.readouterr().err
    assert not (tmp_path / "vtk").exists()


def test_vtk_opens_them(fields, tmp_path, capsys):
    vtk = pytest.importorskip("vtk", reason="the vtk package is not installed")
    write(fields, tmp_path, capsys)
    reader = vtk.vtkXMLUnstructuredGridReader()
    reader.SetFileName(str(tmp_path / "case_0001_time_002.vtu"))
    reader.Update()
    sizes = vtk.vtkCellSizeFilter()
    sizes.SetInputConnection(reader.GetOutputPort())
    sizes.Update()
    area = sizes.GetOutput().GetCellData().GetArray("Area")
    values = [area.GetValue(i) for i in range(area.GetNumberOfTuples())]
    assert min(values) > 0.0
    assert sum(values) == pytest.approx(AREA, rel=1e-2)
    assert reader.GetOutput().GetFieldData().GetArray("TimeValue").GetValue(0) == 20.0


def opened_as_ugrid(folder):
    """The field and its mesh, as xugrid reads them."""
    xugrid = pytest.importorskip("xugrid", reason="the xugrid package is not installed")
    return xugrid.open_dataset(folder / "results.nc", decode_times=False, decode_timedelta=False)


@pytest.mark.filterwarnings("ignore")
def test_ugrid_readers_find_the_mesh(fields):
    data = opened_as_ugrid(fields)
    grid = data.ugrid.grids[0]
    result = read_result(fields)
    assert grid.name == "film_mesh"
    assert grid.n_node == result.dataset.sizes["film_node"]
    assert grid.area.sum() == pytest.approx(AREA / 2 - 2 * math.pi, rel=1e-2)
    assert grid.node_dimension in data["film_pressure_kpa"].dims
