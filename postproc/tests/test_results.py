"""Reading results.nc, and saying what is wrong with one that cannot be used."""

from __future__ import annotations

import netCDF4
import numpy as np
import pytest
from reedpost.results import ResultError, read_result


def test_models_keys_and_measures(sweep):
    result = read_result(sweep)
    assert result.count == 16
    assert result.models == ["traditional", "squeeze"]
    assert list(result.swept) == ["pressure.inlet_kpa"]
    assert result.value("pressure.inlet_kpa", 2) == 15.0
    assert result.value("film.gap_mm", 2) == 0.05
    assert result.value("no.such_key", 2) is None
    assert result.measure("fall_ms")[8] == pytest.approx(2.843, abs=1e-3)
    assert not result.has_traces
    assert result.failures() == []


def test_texts_and_failures(broken, table5):
    result = read_result(broken)
    assert result.failures() == [(4, "step_too_small", "the step size went to zero at t = 19.7 ms")]
    assert result.message(0) == ""
    assert read_result(table5).value("pressure.file", 4) == "table_5_condition_2.csv"


def test_times_stay_numbers(response):
    """'ms' must not be taken for a duration."""
    result = read_result(response)
    assert result.time()[-1] == pytest.approx(40.0)
    assert result.measure("closing_ms").dtype == float
    assert np.nanmax(result.trace("displacement_mm", 1)) == pytest.approx(0.123, abs=1e-3)


def test_no_folder_no_file(tmp_path):
    with pytest.raises(ResultError, match="no such folder"):
        read_result(tmp_path / "nowhere")
    with pytest.raises(ResultError, match=r"no results\.nc"):
        read_result(tmp_path)


def test_a_file_of_another_kind(tmp_path):
    (tmp_path / "results.nc").write_bytes(b"not netcdf at all" * 10)
    with pytest.raises(ResultError, match="not a NetCDF file"):
        read_result(tmp_path)


def test_a_netcdf_file_from_elsewhere(tmp_path):
    with netCDF4.Dataset(tmp_path / "results.nc", "w") as file:
        file.createDimension("case", 2)
        file.createVariable("model", "i1", ("case",))
    with pytest.raises(ResultError, match=r"lacks status, steady_mm.*undershoot_mm"):
        read_result(tmp_path)
