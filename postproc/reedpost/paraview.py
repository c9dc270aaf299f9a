"""Pressure fields as VTK files: one for each case and time, and a time series for each case."""

from __future__ import annotations

from pathlib import Path
from xml.sax.saxutils import quoteattr

import numpy as np

from reedpost import film_mesh
from reedpost.film_mesh import Mesh
from reedpost.results import Result

QUAD, TRIANGLE = 9, 5  # VTK's cell types


def write_fields(result: Result, folder: Path) -> list[Path]:
    """Write the fields of every case that has some; the time series come after their fields."""
    paths: list[Path] = []
    cases = [case for case in range(result.count) if film_mesh.has_field(result, case)] if result.has_fields else []
    if cases:
        folder.mkdir(parents=True, exist_ok=True)
    for case in cases:
        mesh, entries = film_mesh.whole_reed(result, case), []
        for number, time in enumerate(film_mesh.field_times(result).tolist()):
            pressure = film_mesh.field(result, case, number)
            if not np.isfinite(pressure).all():
                continue
            values = mesh.values(pressure, film_mesh.inlet_kpa(result, case, time))
            path = folder / f"case_{case + 1:04d}_time_{number + 1:03d}.vtu"
            path.write_text(grid_text(mesh, values, time), encoding="ascii", newline="\n")
            paths.append(path)
            entries.append((time, path.name))
        path = folder / f"case_{case + 1:04d}.pvd"
        path.write_text(series_text(entries), encoding="ascii", newline="\n")
        paths.append(path)
    return paths


def grid_text(mesh: Mesh, pressure_kpa: np.ndarray, time_ms: float) -> str:
    """One unstructured grid: the whole reed in mm, z = 0, with the pressure and the reed's parts."""
    cells = len(mesh.quads) + len(mesh.triangles)
    connectivity = np.concatenate([mesh.quads.ravel(), mesh.triangles.ravel()])
    corners = np.repeat([4, 3], [len(mesh.quads), len(mesh.triangles)])
    kinds = np.repeat([QUAD, TRIANGLE], [len(mesh.quads), len(mesh.triangles)])
    points = np.column_stack([mesh.x, mesh.y, np.zeros_like(mesh.x)])
    return f"""<?xml version="1.0"?>
<VTKFile type="UnstructuredGrid" version="1.0" byte_order="LittleEndian">
<UnstructuredGrid>
<FieldData>
{_array("TimeValue", np.array([time_ms]), tuples=1)}
</FieldData>
<Piece NumberOfPoints="{len(mesh.x)}" NumberOfCells="{cells}">
<PointData Scalars="pressure (kPa)">
{_array("pressure (kPa)", pressure_kpa)}
</PointData>
<CellData>
{_array("part (0 A, 1 B, 2 C)", mesh.part)}
</CellData>
<Points>
{_array("points (mm)", points, components=3)}
</Points>
<Cells>
{_array("connectivity", connectivity)}
{_array("offsets", np.cumsum(corners))}
{_array("types", kinds)}
</Cells>
</Piece>
</UnstructuredGrid>
</VTKFile>
"""


def _array(name: str, values: np.ndarray, components: int = 0, tuples: int = 0) -> str:
    whole = values.dtype.kind in "iu"
    numbers = (f"{v:d}" if whole else f"{v:.9g}" for v in values.ravel().tolist())
    more = f' NumberOfComponents="{components}"' if components else ""
    more += f' NumberOfTuples="{tuples}"' if tuples else ""
    kind = "Int64" if whole else "Float64"
    return f'<DataArray type="{kind}" Name={quoteattr(name)}{more} format="ascii">\n{" ".join(numbers)}\n</DataArray>'


def series_text(entries: list[tuple[float, str]]) -> str:
    """A collection of grids with their times [ms]."""
    lines = [f'<DataSet timestep="{time:.9g}" part="0" file={quoteattr(name)}/>' for time, name in entries]
    return "\n".join(
        ['<?xml version="1.0"?>', '<VTKFile type="Collection" version="1.0" byte_order="LittleEndian">', "<Collection>",
         *lines, "</Collection>", "</VTKFile>", ""]
    )  # fmt: skip
