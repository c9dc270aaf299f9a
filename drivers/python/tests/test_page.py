"""docs/python.md: each example, and the quick start, print what stands there; each is short."""

from __future__ import annotations

import contextlib
import io
import os
import re
import subprocess
import sys
from pathlib import Path

import pytest
from conftest import ROOT

import reedvalve

PAGE = (ROOT / "docs" / "python.md").read_text(encoding="utf-8")
EXAMPLES = re.findall(r"^```python\n(.*?)^```\n\n```text\n(.*?)^```\n", PAGE, flags=re.S | re.M)
QUICK_START = ROOT / "drivers" / "examples" / "python" / "quick_start.py"


def test_examples_are_found() -> None:
    """All that the page has."""
    assert len(re.findall(r"^```python", PAGE, flags=re.M)) == len(EXAMPLES) == 5


@pytest.mark.parametrize(("code", "printed"), EXAMPLES)
def test_example(code: str, printed: str) -> None:
    """In at most ten lines."""
    assert len(code.splitlines()) <= 10
    out = io.StringIO()
    with contextlib.redirect_stdout(out):
        exec(code, {"reedvalve": reedvalve})
    assert out.getvalue() == printed


@pytest.mark.parametrize("has_matplotlib", [True, False])
def test_quick_start(has_matplotlib: bool, tmp_path: Path) -> None:
    """With and without Matplotlib; the picture comes with it."""
    lines = ["import runpy, sys", f"runpy.run_path({str(QUICK_START)!r})"]
    if not has_matplotlib:
        lines.insert(1, "sys.modules['matplotlib'] = None")
    names = {**os.environ, "PYTHONPATH": str(Path(reedvalve.__file__).parents[1]), "MPLBACKEND": "Agg"}
    words = [sys.executable, "-W", "error", "-c", "\n".join(lines)]
    done = subprocess.run(words, env=names, cwd=tmp_path, capture_output=True, text=True, check=True)
    assert done.stdout == QUICK_START.with_suffix(".txt").read_text(encoding="utf-8")
    assert f"```text\n{done.stdout}```\n" in PAGE
    assert [path.name for path in tmp_path.iterdir()] == (["quick_start.png"] if has_matplotlib else [])
