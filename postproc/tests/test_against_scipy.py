"""The program against an independent solution: a 64 x 64 sweep of pressure and gap.

The program is found through the environment variable REEDVALVE. Its whole sweep is
compared with the stored SciPy solution, and a fixed random sample of 12 cases, the
corners among them, with solutions made afresh. The traditional model and the traces of
Table V are compared too.
"""

from __future__ import annotations

import os
import random
import subprocess
from pathlib import Path

import make_sweep_reference as stored
import make_table_5_traces as traces
import numpy as np
import pytest
from reedpost.results import read_result
from reference_model import Valve, square_wave_response, trace_response
from synthetic import table_5_cases

TIME_LIMIT = 1.0e-4  # relative, of fall and closing time
LENGTH_LIMIT = 1.0e-5  # of undershoot and overshoot [mm]
SAMPLE = [0, 63, 4032, 4095, *sorted(random.Random(4096).sample(range(1, 4095), 8))]

DECK = """\
&run      title = 'SciPy test', {run} /
&reed     a_mm = 2.5, b_mm = 1.0, hole_diameter_mm = 4.0, width_mm = 6.0, thickness_mm = 0.15,
          density_kg_m3 = 8950.0, youngs_modulus_gpa = 110.0, k_a = 0.91, action_area_mm2 = 12.56 /
&fluid    density_kg_m3 = 875.0, viscosity_pa_s = 0.0484 /
&hydro    load = 'published' /
&film     gap_mm = 0.05, k_s = 0.0075, acts = 'closing' /
&pressure {pressure} /
&solver   rtol = 1.0e-6 /
{sweeps}"""
SQUARE = "model = 'squeeze', t_end_ms = 40.0"
WAVE = "kind = 'square', inlet_kpa = 20.0, outlet_kpa = 0.0, period_ms = 40.0, transition_ms = 1.0"
SWEEPS = """\
&sweep    key = 'pressure.inlet_kpa', from = 5.0, to = 40.0, count = 64 /
&sweep    key = 'film.gap_mm', from = 0.05, to = 0.30, count = 64 /
"""


def run_program(folder, deck):
    """What the program makes of a deck's text."""
    program = os.environ.get("REEDVALVE")
    if not program:
        pytest.skip("REEDVALVE, the path of the reedvalve program, is not set")
    (folder / "case.nml").write_text(deck, encoding="utf-8")
    run = subprocess.run(
        [program, "run", "case.nml", "-o", "out", "--quiet"], cwd=folder, capture_output=True, text=True
    )
    assert run.returncode == 0, run.stderr
    return read_result(folder / "out")


@pytest.fixture(scope="module")
def program_sweep(tmp_path_factory):
    """The program's measures, column -> 4096 values, in the order of the stored sweep."""
    result = run_program(tmp_path_factory.mktemp("sweep"), DECK.format(run=SQUARE, pressure=WAVE, sweeps=SWEEPS))
    cases = np.array(stored.sweep_cases())
    assert np.allclose(result.swept["pressure.inlet_kpa"], cases[:, 0], rtol=1e-12)
    assert np.allclose(result.swept["film.gap_mm"], cases[:, 1], rtol=1e-12)
    return {name: result.measure(name) for name in stored.COLUMNS[2:]}


def hold(ours, reference, cases):
    """All limits, for arrays of measures of the given cases."""
    for name in ("fall_ms", "closing_ms"):
        error = np.abs(ours[name] / reference[name] - 1.0)
        assert np.isfinite(error).all()
        worst = int(error.argmax())
        assert error[worst] < TIME_LIMIT, f"{name} of case {cases[worst] + 1} is off by {error[worst]:.2e}"
    for name in ("undershoot_mm", "overshoot_mm"):
        error = np.abs(ours[name] - reference[name])
        assert np.isfinite(error).all()
        worst = int(error.argmax())
        assert error[worst] < LENGTH_LIMIT, f"{name} of case {cases[worst] + 1} is off by {error[worst]:.2e} mm"


def test_whole_sweep_against_the_stored_solution(program_sweep):
    hold(program_sweep, stored.read_reference(), range(4096))


def test_sample_against_fresh_solutions(program_sweep):
    cases = stored.sweep_cases()
    fresh = np.array([stored.solve_case(cases[i]) for i in SAMPLE])
    reference = dict(zip(stored.COLUMNS, fresh.T, strict=True))
    hold({name: values[SAMPLE] for name, values in program_sweep.items()}, reference, SAMPLE)


@pytest.mark.parametrize("load", ["published", "maali", "none"])
def test_traditional_model_against_fresh_solutions(load, tmp_path):
    deck = DECK.format(run=SQUARE.replace("squeeze", "traditional"), pressure=WAVE, sweeps="")
    result = run_program(tmp_path, deck.replace("'published'", f"'{load}'"))
    expected = square_wave_response(Valve(load=load), 20.0e3, squeeze=False, method="DOP853")
    for name in ("fall_ms", "closing_ms", "zero_ms"):
        assert result.measure(name)[0] == pytest.approx(getattr(expected, name), rel=TIME_LIMIT)
    for name in ("overshoot_mm", "undershoot_mm"):
        assert result.measure(name)[0] == pytest.approx(getattr(expected, name), abs=LENGTH_LIMIT)


def test_table_5_against_fresh_solutions(tmp_path):
    cases = table_5_cases()
    files = [str(Path(traces.__file__).with_name(case.file)) for case in cases[:3]]
    sweep = "&sweep key = 'pressure.file', values = " + ", ".join(f"'{file}'" for file in files) + " /\n"
    pressure = f"kind = 'trace', file = '{files[0]}', event_ms = 500.0"
    deck = DECK.format(run="model = 'traditional', 'squeeze'", pressure=pressure, sweeps=sweep)
    ours = run_program(tmp_path, deck).measure("zero_ms")
    for i, case in enumerate(cases):
        expected = trace_response(Valve(), case.drive, case.model == "squeeze", method="DOP853").zero_ms
        assert ours[i] == pytest.approx(expected, rel=TIME_LIMIT)


def test_the_limits_can_be_missed():
    """The check itself goes red: an error just above each limit is found."""
    reference = stored.read_reference()
    for name, factor, shift in (("fall_ms", 1.0 + 1.1e-4, 0.0), ("undershoot_mm", 1.0, 1.1e-5)):
        ours = {**reference, name: reference[name] * factor + shift}
        with pytest.raises(AssertionError, match=name):
            hold(ours, reference, range(4096))
