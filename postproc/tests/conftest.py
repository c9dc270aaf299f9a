"""Synthetic results shared by the tests, and the option that recomputes the whole sweep."""

from __future__ import annotations

import sys
from pathlib import Path

import numpy as np
import pytest

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "inputs" / "traces"))

from reedpost.paper import GAP_STUDY_MM, table
from synthetic import MODELS, Case, table_5_cases, write_result

PRESSURES = [row["inlet_kpa"] for row in table("table_3_fall_time")]
SQUARE_MS = np.arange(0.0, 40.001, 0.05)


def pytest_addoption(parser):
    parser.addoption(
        "--whole-sweep",
        action="store_true",
        help="solve all 4096 cases of the stored sweep again (about ten minutes)",
    )


@pytest.fixture(scope="session")
def sweep(tmp_path_factory):
    """Tables III and IV: both models, eight pressures, no traces."""
    cases = [Case(model, inlet_kpa=p) for model in MODELS for p in PRESSURES]
    return write_result(tmp_path_factory.mktemp("results") / "sweep", cases)


@pytest.fixture(scope="session")
def response(tmp_path_factory):
    """Fig. 12: both models at 10, 20 and 30 kPa with traces."""
    cases = [Case(model, inlet_kpa=p) for model in MODELS for p in (10.0, 20.0, 30.0)]
    return write_result(tmp_path_factory.mktemp("results") / "response", cases, SQUARE_MS)


@pytest.fixture(scope="session")
def gaps(tmp_path_factory):
    """The gap study: both models, six gaps at 20 kPa, with traces."""
    cases = [Case(model, gap_mm=gap) for model in MODELS for gap in GAP_STUDY_MM]
    return write_result(tmp_path_factory.mktemp("results") / "gaps", cases, SQUARE_MS)


@pytest.fixture(scope="session")
def table5(tmp_path_factory):
    """Table V: both models under the three reconstructed traces, recorded."""
    time = 500.0 + np.arange(0.0, 8.001, 0.02)
    return write_result(tmp_path_factory.mktemp("results") / "table5", table_5_cases(), time)


@pytest.fixture(scope="session")
def broken(tmp_path_factory):
    """A pressure sweep with k_s = 0.008 in which three things went wrong.

    The traditional case at 20 kPa failed, the squeeze case at 15 kPa is not there and
    the one at 25 kPa never closed.
    """
    cases = [Case(model, inlet_kpa=p) for model in MODELS for p in PRESSURES]
    cases[3].status = "step_too_small"
    cases[3].message = "the step size went to zero at t = 19.7 ms"
    cases[12].without = ("closing_ms",)
    del cases[10]
    return write_result(tmp_path_factory.mktemp("results") / "broken", cases, k_s=0.008)
