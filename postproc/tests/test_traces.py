"""The reconstructed traces of Table V: made by the script as they stand, and as they say."""

from __future__ import annotations

from pathlib import Path

import make_table_5_traces as traces
import numpy as np
import pytest
from reference_model import Valve
from scipy.interpolate import PchipInterpolator

FOLDER = Path(traces.__file__).parent
CONDITIONS = tuple(traces.TABLE_5)


def samples(condition):
    """Time [ms after the event] and pressure difference [kPa] of a file."""
    rows = np.loadtxt(FOLDER / f"table_5_condition_{condition}.csv", delimiter=",", skiprows=8)
    return rows[:, 0] - traces.EVENT_MS, rows[:, 1]


@pytest.mark.parametrize("condition", CONDITIONS)
def test_files_are_what_the_script_makes(condition):
    path = FOLDER / f"table_5_condition_{condition}.csv"
    made, kept = traces.trace_text(condition).splitlines(), path.read_text("ascii").splitlines()
    assert made[:8] == kept[:8]
    # Another libm may differ in the last digit written.
    numbers = [np.array([line.split(",") for line in lines[8:]], float) for lines in (made, kept)]
    assert numbers[0].shape == numbers[1].shape
    assert np.abs(numbers[0] - numbers[1]).max() < 2e-6


def test_the_script_writes_into_a_folder(tmp_path, capsys):
    assert traces.main([str(tmp_path)]) == 0
    assert sorted(p.name for p in tmp_path.iterdir()) == [f"table_5_condition_{c}.csv" for c in CONDITIONS]
    assert traces.main(["--help"]) == 2
    assert "usage:" in capsys.readouterr().err


@pytest.mark.parametrize("condition, t_z", [(1, 3.197), (2, 2.273), (3, 2.699)])
def test_zero_of_the_pressure(condition, t_z):
    rate, closes = traces.TABLE_5[condition]
    assert traces.zero_pressure_time(traces.traditional_model(), rate, closes) == pytest.approx(t_z, abs=6e-4)


def test_the_traditional_model_is_the_reference_model():
    model, valve = traces.traditional_model(), Valve()
    added_mass, damping = valve.hydrodynamic_load()
    assert model.mass == pytest.approx(valve.reed_mass + added_mass, rel=1e-13)
    assert model.damping == pytest.approx(damping, rel=1e-13)
    assert model.stiffness == pytest.approx(valve.stiffness, rel=1e-13)


@pytest.mark.parametrize("condition", CONDITIONS)
def test_published_fall_rate(condition):
    time, pressure = samples(condition)
    early, late = np.interp([1.5, 3.0], time, pressure)
    assert (early - late) / 1.5 == pytest.approx(traces.TABLE_5[condition][0], rel=1e-6)


@pytest.mark.parametrize("condition", CONDITIONS)
def test_every_file_says_that_it_is_reconstructed(condition):
    text = (FOLDER / f"table_5_condition_{condition}.csv").read_text("ascii")
    assert "RECONSTRUCTED" in text.splitlines()[0]
    assert "NOT MEASURED" in text.splitlines()[0]


@pytest.mark.parametrize("condition", CONDITIONS)
def test_sampling_suits_a_shape_preserving_cubic(condition):
    """No gap that a checker would take for missing data, and a corner that stays a corner."""
    time, pressure = samples(condition)
    step = np.diff(time)
    assert step.min() > 0
    assert step.max() < 2 * np.median(step)
    assert time[0] == 0.0
    assert time[-1] == pytest.approx(8.0, abs=1e-9)
    rate, closes = traces.TABLE_5[condition]
    t_z = traces.zero_pressure_time(traces.traditional_model(), rate, closes)
    fine = np.linspace(0.0, 8.0, 200001)
    exact = np.minimum(traces.OPEN_KPA, rate * (t_z - fine))
    assert np.abs(PchipInterpolator(time, pressure)(fine) - exact).max() < 1e-3  # of 60 kPa


def test_a_rising_pressure_is_refused():
    with pytest.raises(ValueError, match="fall"):
        traces.closing_time(traces.traditional_model(), -1.0, 3.0, 0.0)
