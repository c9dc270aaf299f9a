"""The referee itself: against closed forms, between two integrators, and its stored sweep."""

from __future__ import annotations

import random
from multiprocessing import Pool

import make_sweep_reference as stored
import make_table_5_traces as traces
import numpy as np
import pytest
from reference_model import Polygon, Valve, solve, square_wave_response, trace_response


def test_derived_numbers_of_table_2():
    valve = Valve()
    added_mass, damping = valve.hydrodynamic_load()
    assert valve.stiffness == pytest.approx(2691.932, abs=5e-4)
    assert valve.reed_mass == pytest.approx(1.586025e-5, abs=5e-12)
    assert valve.shape_integral(1) / valve.length == pytest.approx(0.406010, abs=5e-7)
    assert valve.shape_integral(2) / valve.length == pytest.approx(0.262533, abs=5e-7)
    assert added_mass == pytest.approx(9.916e-5, abs=5e-9)
    assert damping == pytest.approx(0.26896, abs=5e-6)
    assert Valve(k_s=0.008).squeeze_constant == pytest.approx(6.27264e-13, rel=1e-12)


def test_wet_frequency_load():
    added_mass, damping = Valve(load="maali").hydrodynamic_load()
    assert added_mass == pytest.approx(5.72985e-5, abs=5e-11)
    assert damping == pytest.approx(0.036578, abs=5e-7)


def test_free_vibration_is_exact():
    """No fluid: u = u0 cos(omega t) after the pressure is gone, whatever the integrator."""
    valve = Valve(load="none")
    start = 1.0e-4
    omega = np.sqrt(valve.stiffness / valve.reed_mass)
    quiet = Polygon(np.array([0.0, 1.0e-3]), np.array([0.0, 0.0]))
    time = np.linspace(0.0, 1.0e-3, 101)
    for method in ("Radau", "DOP853"):
        u = solve(valve, quiet, squeeze=False, start=start, method=method)(time)[0]
        assert np.abs(u - start * np.cos(omega * time)).max() < 1e-8 * start


def test_overdamped_film_closes_like_stefan():
    """Film force against a constant load alone: 1/h^2 grows linearly, C/(2 h^2) = F t + const.

    A reed of nearly no stiffness and mass, pressed on its seat from above, is that film.
    """
    valve = Valve(youngs=1.0, density=1.0e-3, load="none", gap=0.1e-3)
    time = np.linspace(0.0, 10.0e-3, 11)
    pressure = -1.0e3
    drive = Polygon(time[[0, -1]], np.full(2, pressure))
    h = solve(valve, drive, squeeze=True)(time)[0] + valve.gap
    force = -pressure * valve.area
    exact = (valve.gap**-2 + 2 * force * time / valve.squeeze_constant) ** -0.5
    assert h == pytest.approx(exact, rel=1e-5)


FALL = (2.843, 2.191, 1.783, 1.503, 1.299, 1.144, 1.024, 0.931)
CLOSING = (6.039, 5.144, 4.552, 4.117, 3.775, 3.494, 3.256, 3.049)


@pytest.mark.parametrize("case", range(8))
def test_the_reading_of_the_paper(case):
    """Fall and closing times that the project's reading of the paper gives, to their last digit."""
    inlet = 5.0e3 * (case + 1)
    squeeze = square_wave_response(Valve(), inlet, squeeze=True, method="DOP853")
    assert squeeze.fall_ms == pytest.approx(FALL[case], abs=6e-4)
    assert squeeze.closing_ms == pytest.approx(CLOSING[case], abs=6e-4)
    traditional = square_wave_response(Valve(), inlet, squeeze=False, method="DOP853")
    assert traditional.fall_ms == pytest.approx(0.623, abs=6e-4)
    assert traditional.closing_ms == pytest.approx(1.021, abs=6e-4)


@pytest.mark.parametrize("k_s, closes", [(0.0075, (3.871, 2.781, 3.326)), (0.008, (3.898, 2.801, 3.351))])
def test_predictions_for_table_5(k_s, closes):
    for (rate, published), expected in zip(traces.TABLE_5.values(), closes, strict=True):
        t_z = traces.zero_pressure_time(traces.traditional_model(), rate, published)
        corner = max(0.0, t_z - traces.OPEN_KPA / rate)
        time = np.array(sorted({0.0, corner, 8.0}))
        drive = Polygon(time * 1e-3, 1e3 * np.minimum(traces.OPEN_KPA, rate * (t_z - time)))
        squeeze = trace_response(Valve(k_s=k_s), drive, squeeze=True, method="DOP853")
        assert squeeze.zero_ms == pytest.approx(expected, abs=6e-4)
        traditional = trace_response(Valve(k_s=k_s), drive, squeeze=False, method="DOP853")
        assert traditional.zero_ms == pytest.approx(published, abs=1e-9)


def same_case(row, fresh):
    """A stored row beside a fresh solution; the stored digits are the limit."""
    assert fresh[:4] == pytest.approx(row[:4], rel=1e-8)
    assert fresh[4:] == pytest.approx(row[4:], abs=1e-9)


def test_stored_sweep_is_of_the_stated_cases():
    table = stored.read_reference()
    cases = np.array(stored.sweep_cases())
    assert np.allclose(table["inlet_kpa"], cases[:, 0], rtol=1e-10)
    assert np.allclose(table["gap_mm"], cases[:, 1], rtol=1e-10)
    assert all(np.isfinite(column).all() for column in table.values())


def test_stored_sweep_is_what_both_integrators_give():
    """The file comes from DOP853: some of it again, and the slowest and the liveliest case by Radau, which shares
    nothing with it but the equation."""
    cases, table = stored.sweep_cases(), stored.read_reference()
    again = [63, 4032, *random.Random(64).sample(range(1, 4095), 6)]
    sample = {0: "Radau", 4095: "Radau"} | dict.fromkeys(again, "DOP853")
    for i, method in sample.items():
        same_case([table[name][i] for name in stored.COLUMNS], stored.solve_case(cases[i], method))


def test_whole_stored_sweep(request):
    if not request.config.getoption("--whole-sweep"):
        pytest.skip("takes about ten minutes; ask for it with --whole-sweep")
    with Pool() as pool:
        fresh = pool.map(stored.solve_case, stored.sweep_cases(), chunksize=16)
    for row, case in zip(zip(*stored.read_reference().values(), strict=True), fresh, strict=True):
        same_case(row, case)
