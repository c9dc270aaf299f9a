"""Whole cases and sweeps: the bits of the program, as arrays; and what a caller does wrong with them."""

from __future__ import annotations

import copy
import pickle

import netCDF4
import numpy as np
import pandas as pd
import pytest
import xarray as xr

import reedvalve as rv

PRESSURES, GAPS = np.arange(5.0, 45.0), np.arange(50, 80) / 1000
SWEEP = f"""
&sweep key = 'pressure.inlet_kpa', values = {", ".join(map(str, PRESSURES))} /
&sweep key = 'film.gap_mm', values = {", ".join(map(str, GAPS))} /
"""


def test_case_has_the_bits_of_the_program(run_deck, tmp_path) -> None:
    """Measures and histories of results.nc."""
    folder = run_deck("&run model = 'film_table', traces = .true. /\n")
    result = rv.Valve(tmp_path / "deck.nml").run()
    assert result.status is rv.Status.OK
    with netCDF4.Dataset(folder / "results.nc") as file:
        for name, value in {**result.measures, **result.facts}.items():
            np.testing.assert_array_equal(value, file[name][0].filled(np.nan))
            assert file[name].units == rv.unit(name)
        assert list(result.traces) == list(rv.TRACES)
        for name, values in result.traces.items():
            there = file[name][:].filled(np.nan).reshape(-1)
            np.testing.assert_allclose(values, there, rtol=2e-16 if name == "time_ms" else 0.0)
            assert file[name].units == rv.TRACES[name]
    frame = pd.DataFrame(result.traces)
    assert frame["displacement_mm"].max() == pytest.approx(result.steady_mm + result.overshoot_mm, rel=1e-3)
    assert repr(result).startswith(f"Result(ok, steady_mm={result.steady_mm:.6g}, rise_ms=")
    assert repr(result).endswith("traces=11 of 2001 samples)")


def test_lumped_traces() -> None:
    """The film models' are not there; none at all unless asked for."""
    valve = rv.Valve(run_traces=True, run_t_end_ms=30.0)
    traces = valve.run().traces
    assert list(traces) == list(rv.TRACES)[:6]
    with pytest.raises(KeyError):
        traces["leakage_mm3_ms"]
    valve["run.traces"] = False
    result = valve.run()
    assert not result.traces
    with pytest.raises(rv.BadInputError, match="'displacement_mm': there are no traces; set "):
        result.traces["displacement_mm"]


def test_case_that_fails() -> None:
    """The exception has what there is of it, and survives pickling."""
    with pytest.raises(rv.DomainError, match="the gap is 0") as caught:
        rv.Valve(run_model="film_table", film_gap_mm=0.0).run()
    result = pickle.loads(pickle.dumps(caught.value)).result
    assert result.status is rv.Status.FILM_CLOSED
    assert np.isnan(result.closing_ms)
    with pytest.raises(rv.NotConvergedError) as caught:
        rv.Valve(solver_max_steps=5).run()
    assert caught.value.result.status is rv.Status.TOO_MANY_STEPS
    assert isinstance(caught.value, ArithmeticError)
    with pytest.raises(rv.BadInputError, match="transition") as caught:
        rv.Valve(pressure_transition_ms=30.0).run()
    assert caught.value.result is None


def test_case_that_warns() -> None:
    """At the caller's line, and in the result."""
    with pytest.warns(rv.ReedvalveWarning, match="no closing is measured") as caught:
        result = rv.Valve(run_t_end_ms=1.0).run()
    assert caught[0].filename == __file__
    assert "no closing is measured" in result.message
    assert np.isnan(result.closing_ms)


def test_sweep_has_the_bits_of_the_program(run_deck) -> None:
    """Every column of summary.csv but the message; results.nc to the last bit; any number of threads."""
    folder = run_deck(SWEEP)
    valve = rv.Valve()
    plan = rv.product({"pressure.inlet_kpa": PRESSURES, "film.gap_mm": GAPS})
    result = valve.sweep(plan)
    table = pd.read_csv(folder / "summary.csv").drop(columns="message")
    pd.testing.assert_frame_equal(pd.DataFrame(result), table, rtol=1e-11, check_dtype=False)  # its digits
    with netCDF4.Dataset(folder / "results.nc") as file:
        for name in rv.MEASURES:
            np.testing.assert_array_equal(result[name], file[name][:].filled(np.nan))
    for threads in (1, 3):
        again = valve.sweep(plan, threads=threads)
        for name, column in result.items():
            np.testing.assert_array_equal(column, again[name])


def test_sweep_of_one_case_is_a_run() -> None:
    """Alone a case has the bits of a run."""
    alone = rv.Valve(film_gap_mm=0.03).run()
    result = rv.Valve().sweep({"FILM.gap_mm": 0.03})
    assert result.shape == (1,)
    assert {name: result[name][0] for name in rv.MEASURES} == pytest.approx(alone.measures, rel=0, abs=0, nan_ok=True)
    assert list(result)[:3] == ["case", "model", "film.gap_mm"]


def test_sweep_as_dataset() -> None:
    """Keys that vary along one axis alone are its coordinates."""
    plan = rv.product({"pressure.inlet_kpa": [10.0, 20.0], "film.gap_mm": [0.05, 0.07, 0.09]})
    result = rv.Valve().sweep({**plan, "fluid.viscosity_pa_s": 0.05})
    data = xr.Dataset(result.variables())
    assert result.dims == data["closing_ms"].dims == ("pressure.inlet_kpa", "film.gap_mm")
    assert data["film.gap_mm"].values.tolist() == [0.05, 0.07, 0.09]
    assert data["film.gap_mm"].attrs == data["steady_mm"].attrs == {"units": "mm"}
    some = data["closing_ms"].sel({"pressure.inlet_kpa": 20.0, "film.gap_mm": 0.07})
    assert float(some) == result["closing_ms"][4] == result.grid("closing_ms")[1, 1]
    assert data["fluid.viscosity_pa_s"].shape == (2, 3)
    assert repr(result).startswith("SweepResult(2 x 3 cases, none failed; columns case, model, pressure.inlet_kpa, ")
    for other in (copy.copy(result), pickle.loads(pickle.dumps(result))):
        assert repr(other) == repr(result)
        assert other.dims == result.dims


def test_sweep_along_one_axis() -> None:
    """One key is the axis; several that vary together are columns along the cases."""
    one = rv.Valve().sweep({"film.gap_mm": [0.05, 0.07]})
    assert xr.Dataset(one.variables())["closing_ms"].dims == ("film.gap_mm",)
    two = rv.Valve().sweep({"film.gap_mm": [0.05, 0.07], "pressure.inlet_kpa": [10.0, 20.0]})
    data = xr.Dataset(two.variables())
    assert data["closing_ms"].dims == ("case",)
    assert data["case"].values.tolist() == [1, 2]
    grid = rv.Valve().sweep({"film.gap_mm": [[0.05, 0.07]], "pressure.inlet_kpa": [[10.0, 20.0], [30.0, 40.0]]})
    assert grid.dims == ("axis_0", "film.gap_mm")


def test_cases_that_fail_in_a_sweep() -> None:
    """Their status tells; the others are not disturbed."""
    valve = rv.Valve(run_model="film_table")
    with pytest.warns(rv.ReedvalveWarning, match="the film is closed from the start"):
        result = valve.sweep({"film.gap_mm": [0.05, 0.0, 0.07]})
    assert result["status"].tolist() == ["ok", "film_closed", "ok"]
    assert result.ok.tolist() == [True, False, True]
    assert np.isnan(result["closing_ms"][1])
    assert "3 cases, 1 film_closed;" in repr(result)
    assert "the film is closed" in result.message


@pytest.mark.parametrize(
    ("keys", "threads", "kind", "message"),
    [
        ({}, 0, rv.BadInputError, "a sweep varies from 1 to 64 keys"),
        ({"film.gap_mm": []}, 0, rv.BadInputError, "a sweep has from 1 to 2000000000 cases"),
        ({"film.gap": [1.0]}, 0, rv.UnknownKeyError, "'film.gap': there is no such key; did you mean 'film.gap_mm'?"),
        ({"run.model": [1.0]}, 0, rv.BadInputError, "run.model: only real keys can vary from case to case"),
        ({"film.gap_mm": ["thin"]}, 0, rv.BadInputError, "film.gap_mm: a sweep takes numbers, not ['thin']"),
        ({"film.gap_mm": [0.05, -1.0]}, 0, rv.BadInputError, "case 2: film.gap_mm = -1: must be >= 0 (mm)"),
        ({"film.gap_mm": [0.05, np.nan]}, 0, rv.BadInputError,
         "case 2: film.gap_mm = NaN: NaN and infinity are not allowed"),
        ({"film.gap_mm": [1.0, 2.0], "film.k_s": [1.0, 2.0, 3.0]}, 0, rv.BadInputError,
         "these arrays do not go together: film.gap_mm (2,), film.k_s (3,); see reedvalve.product"),
        ({"film.gap_mm": [1.0], "FILM.gap_mm": [1.0]}, 0, rv.BadInputError, "film.gap_mm: a second column of this key"),
        ({"film.gap_mm": [1.0]}, -1, rv.BadInputError,
         "a sweep takes from 1 to 1024 threads; 0: as many as OpenMP offers"),
        ({"film.gap_mm": [1.0]}, 2**32 + 1, rv.BadInputError,
         "a sweep takes from 1 to 1024 threads; 0: as many as OpenMP offers"),
        ({"film.gap_mm": [1.0]}, 0.5, TypeError, "'float' object cannot be interpreted as an integer"),
    ],
)  # fmt: skip
def test_wrong_sweep(keys: dict, threads: float, kind: type[Exception], message: str) -> None:
    """Nothing is run."""
    with pytest.raises(kind) as caught:
        rv.Valve().sweep(keys, threads=threads)
    assert str(caught.value) == message


def test_wrong_product() -> None:
    """Values along one axis only."""
    with pytest.raises(rv.BadInputError, match=r"film.gap_mm: product takes values along one axis, not .* \(1, 2\)"):
        rv.product({"film.gap_mm": [[1.0, 2.0]]})
