"""The benchmark runs and its peers solve the cases: on few of them, figures mean nothing. make bench has all."""

from __future__ import annotations

import csv
import os
import subprocess
import sys
from pathlib import Path

import pytest
from contenders import loosest_tolerance
from report import Table, grouped
from sweep import HEADER, LIMIT, all_cases, deck_text, reference_times, spread_sample, write_cases

HERE = Path(__file__).parent
BUILD = Path(os.environ["REEDVALVE"]).parents[2] if "REEDVALVE" in os.environ else HERE.parents[1] / "build" / "release"


@pytest.fixture(scope="module")
def peers(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The peers whose libraries are here."""
    folder = tmp_path_factory.mktemp("peers")
    subprocess.run([HERE / "peers" / "build", folder], check=True)
    return folder


def solve(words: list[object], folder: Path, rtol: float, some: list[int]) -> float:
    """Largest error of a peer on some of the cases."""
    import numpy as np

    listed = write_cases(folder / "cases.csv", [all_cases()[i] for i in some])
    done = subprocess.run(
        [*map(str, words), listed, str(rtol), "0", folder / "times"], check=True, capture_output=True, text=True
    )
    assert float(done.stdout) > 0.0
    times = np.loadtxt(folder / "times", delimiter=",", ndmin=2)
    assert times.shape == (len(some), 2)
    return float(abs(times / reference_times()[some] - 1.0).max())


@pytest.mark.parametrize("name", ["odeint", "cvode"])
def test_compiled_peer(name: str, peers: Path, tmp_path: Path) -> None:
    """Its errors follow the tolerance: first, last and some cases between."""
    if not (peers / name).is_file():
        pytest.skip(f"{name}: its library is not installed")
    some = list(spread_sample(16))
    loose, tight = (solve([peers / name], tmp_path, rtol, some) for rtol in (1e-5, 1e-9))
    assert loose < 2e-3  # CVODE's error is some hundred times its tolerance
    assert tight < 2e-7


@pytest.mark.parametrize("method", ["LSODA", "DOP853"])
def test_scipy_peer(method: str, tmp_path: Path) -> None:
    """As above."""
    assert solve([sys.executable, HERE / "peers" / "scipy_peer.py", method], tmp_path, 1e-7, [0, 4095]) < 1e-5


def test_lists_of_cases(tmp_path: Path) -> None:
    """As many numbers as names, positive, in the deck's order."""
    lines = write_cases(tmp_path / "cases.csv", all_cases()[:3]).read_text(encoding="utf-8").splitlines()
    assert lines[0] == HEADER and len(lines) == 4
    rows = [[float(word) for word in line.split(",")] for line in lines[1:]]
    assert all(len(row) == len(HEADER.split(",")) and min(row) > 0.0 for row in rows)
    assert [row[6] for row in rows] == [5000.0] * 3 and rows[0][5] < rows[1][5]


def test_deck_text() -> None:
    """Other tolerance, counts and lanes; None leaves a key out."""
    text = deck_text(1e-5, 8, 16, method="explicit", width=None)
    assert "rtol = 1e-05, method = 'explicit'\n" in text and "width =" not in text
    assert text.index("count = 8") < text.index("count = 16")


def test_loosest_tolerance() -> None:
    """One that meets the limit by luck is not taken."""

    class Lucky:
        name = "lucky"

        def errors_at(self, rtol: float) -> float:
            return {1e-1: 9.0, 1e-2: 0.5 * LIMIT, 1e-3: 2 * LIMIT, 1e-4: 0.5 * LIMIT, 1e-5: 0.1 * LIMIT}[rtol]

    assert loosest_tolerance(Lucky(), (1e-1, 1e-2, 1e-3, 1e-4, 1e-5)) == 1e-4
    with pytest.raises(SystemExit):
        loosest_tolerance(Lucky(), (1e-1, 1e-2, 1e-3, 1e-4))


def test_table(tmp_path: Path) -> None:
    """Markdown lines up; CSV holds plain numbers."""
    table = Table("one", "Title", ["", "cases/s"], [["a lane", grouped(12345.0)], ["b", grouped(0.5)]])
    lines = table.markdown().splitlines()
    assert lines[0] == "## Title" and {len(line) for line in lines[2:]} == {len(lines[2])}
    table.write_csv(tmp_path)
    with open(tmp_path / "one.csv", newline="", encoding="utf-8") as file:
        assert list(csv.reader(file)) == [["", "cases/s"], ["a lane", "12300"], ["b", "0.5"]]


def test_whole_benchmark(peers: Path, tmp_path: Path) -> None:
    """Report, tables and picture, of next to nothing."""
    if not (BUILD / "drivers" / "benchmarks" / "block_speed").is_file():
        pytest.skip(f"reedvalve is not built in {BUILD}")
    words = ["--build", BUILD, "--peers", peers, "--output", tmp_path, "--smoke"]
    done = subprocess.run([sys.executable, HERE / "benchmark.py", *words], capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    names = {path.name for path in tmp_path.iterdir()}
    assert names >= {"benchmark.md", "equal_error.csv", "goals.csv", "work_precision.csv", "cases.csv", "lanes.csv",
                     "machine.json", "work_precision.png"}  # fmt: skip
    with open(tmp_path / "equal_error.csv", newline="", encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    assert all(float(row["error"]) < LIMIT and float(row["cases/s"]) > 0.0 for row in rows)
    assert sum(row[""].startswith("reedvalve") for row in rows) in (2, 4)


def test_lane_accuracy(tmp_path: Path) -> None:
    """Few cases; tests/physics/test_company holds the errors themselves."""
    if not (BUILD / "drivers" / "reedvalve" / "reedvalve").is_file():
        pytest.skip(f"reedvalve is not built in {BUILD}")
    words = ["--build", BUILD, "--output", tmp_path, "--cases", "8", "--seconds", "0"]
    subprocess.run([sys.executable, HERE / "lane_accuracy.py", *words], check=True, capture_output=True)
    assert (tmp_path / "lane_accuracy.md").is_file()
    with open(tmp_path / "lane_accuracy_implicit.csv", newline="", encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    assert {row["lanes"] for row in rows} == {"1", "8", "64", "256"}
    assert all(float(row["closing"]) < 1e-2 for row in rows)


def test_python_cost(monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> None:
    """Kernel, program and sweep from Python solve the same cases: on few of them."""
    if not (BUILD / "drivers" / "benchmarks" / "block_speed").is_file():
        pytest.skip(f"reedvalve is not built in {BUILD}")
    import python_cost

    monkeypatch.setattr(python_cost, "PRESSURES", 8)
    monkeypatch.setattr(sys, "argv", ["python_cost.py", "--build", str(BUILD), "--rounds", "1"])
    assert python_cost.main() == 0
    rows = capsys.readouterr().out.splitlines()
    assert rows[0].startswith("3200 cases, threads: 1, rounds: 1 ")
    assert [row[:18].strip() for row in rows[1:]] == ["computed, no files", "reedvalve run", "Valve.sweep"]
