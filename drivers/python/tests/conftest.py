"""The package in this tree over the library of the build whose program REEDVALVE names."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[3]
PROGRAM = Path(os.environ.get("REEDVALVE", ROOT / "build" / "release" / "drivers" / "reedvalve" / "reedvalve"))
LIBRARY = PROGRAM.parents[2] / "src" / "api" / "libreedvalve.so"
os.environ.setdefault("REEDVALVE_LIBRARY", str(LIBRARY))
sys.path.insert(0, str(ROOT / "drivers" / "python"))


@pytest.fixture
def run_deck(tmp_path: Path):
    """Runs a deck with the program; the folder of its results."""

    def run(text: str) -> Path:
        deck = tmp_path / "deck.nml"
        deck.write_text(text, encoding="utf-8")
        subprocess.run([PROGRAM, "run", deck, "--quiet", "-o", tmp_path / "results"], check=True)
        return tmp_path / "results"

    return run
