"""Examples of README and user guide, run as printed, with the program that the environment variable REEDVALVE names."""

from __future__ import annotations

import io
import os
import re
import subprocess
import sys
from pathlib import Path

import pandas as pd
import pytest

ROOT = Path(__file__).resolve().parents[2]


def blocks(page):
    """Language and text of each block."""
    return re.findall(r"^```(\w*)\n(.*?)^```$", (ROOT / page).read_text("utf-8"), re.DOTALL | re.MULTILINE)


BLOCKS = blocks("docs/guide.md")
README = [text for _, text in blocks("README.md")]
ERROR = 3e-6  # three tolerances of the integration, of which times are good to about one
PROGRAM = os.environ.get("REEDVALVE")
pytestmark = pytest.mark.skipif(not PROGRAM, reason="REEDVALVE, the path of the reedvalve program, is not set")


def place(words):
    """Where the block is that has these words in it."""
    return next(i for i, (_, text) in enumerate(BLOCKS) if words in text)


def shell(line, folder):
    """One line of the guide, with the names it says they stand for."""
    (folder / "inputs").is_symlink() or (folder / "inputs").symlink_to(ROOT / "inputs")
    names = f'reedvalve() {{ "{PROGRAM}" "$@"; }}; python() {{ "{sys.executable}" "$@"; }}\n'
    return subprocess.run(["sh", "-euc", names + line], cwd=folder, check=True, capture_output=True, text=True)


def told(text, folder):
    """What a Python block prints."""
    done = subprocess.run([sys.executable, "-c", text], cwd=folder, capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    return done.stdout


def alike(ours, printed):
    """The same words, and numbers within some tolerances of the integration: another processor takes other steps."""
    assert len(ours.split()) == len(printed.split())
    for word, other in zip(ours.split(), printed.split(), strict=True):
        try:
            assert float(word) == pytest.approx(float(other), rel=ERROR)
        except ValueError:
            assert word == other


def test_first_deck_and_its_table(tmp_path):
    at = place("A stiffer reed")
    (tmp_path / "my.nml").write_text(BLOCKS[at][1], encoding="utf-8")
    shell("reedvalve run my.nml --quiet", tmp_path)
    at = place("import pandas")
    alike(told(BLOCKS[at][1], tmp_path), BLOCKS[at + 1][1])


def test_design(tmp_path):
    at = place("&design file")
    (tmp_path / "d.nml").write_text(BLOCKS[at][1], encoding="utf-8")
    (tmp_path / "plan.csv").write_text(BLOCKS[at + 1][1], encoding="utf-8")
    assert shell("reedvalve check d.nml", tmp_path).stdout == "d.nml is fine: 3 cases.\n"


def test_measured_pressures(tmp_path):
    """The trace falls, and the reed closes before it ends: nothing to warn of, no time missing."""
    at = place("kind = 'trace'")
    (tmp_path / "t.nml").write_text(BLOCKS[at][1], encoding="utf-8")
    (tmp_path / "p.csv").write_text(BLOCKS[at + 1][1], encoding="utf-8")
    assert shell("reedvalve run t.nml", tmp_path).stderr == ""
    row = dict(
        zip(*(line.split(",") for line in (tmp_path / "t" / "summary.csv").read_text().splitlines()), strict=True)
    )
    assert 1.0 < float(row["fall_ms"]) < float(row["closing_ms"]) < 5.5


def test_histories(tmp_path):
    at = place("inputs/response.nml -o")
    shell(BLOCKS[at][1], tmp_path)
    words = told(
        BLOCKS[at + 1][1].replace("import xarray", "import matplotlib; matplotlib.use('Agg')\nimport xarray"), tmp_path
    )
    first, statuses, *deck = words.splitlines()
    assert re.fullmatch(r"0\.\d+ mm", first) and set(eval(statuses)) == {"ok"} and "&reed" in "".join(deck)


def test_fields(tmp_path):
    at = place("inputs/film_fields.nml -o")
    shell(BLOCKS[at][1], tmp_path)
    assert told(BLOCKS[at + 1][1], tmp_path) == BLOCKS[at + 2][1]
    shell(BLOCKS[at + 3][1].splitlines()[0], tmp_path)
    assert (tmp_path / "fields" / "vtk" / "case_0001.pvd").is_file()


def readme(words):
    """The block of the README that begins with these words."""
    return next(text for text in README if text.startswith(words))


def test_readme_deck_and_summary(tmp_path):
    (tmp_path / "my.nml").write_text(readme("&run\n   title = 'A stiffer reed'"), encoding="utf-8")
    said = shell("reedvalve run my.nml", tmp_path).stdout.splitlines()
    assert said[:2] == readme("$ reedvalve run my.nml").splitlines()[1:3]
    ours = pd.read_csv(tmp_path / "my" / "summary.csv")
    printed = pd.read_csv(io.StringIO(readme("case,model,")))
    pd.testing.assert_frame_equal(ours[printed.columns], printed, rtol=ERROR)


def test_readme_modes(tmp_path):
    deck = re.search(r"For `film.nml`, which is\n`(&run .* /)`", (ROOT / "README.md").read_text("utf-8"))[1]
    (tmp_path / "film.nml").write_text(deck, encoding="utf-8")
    command, *last = readme("$ reedvalve modes").splitlines()
    assert shell(command.removeprefix("$ "), tmp_path).stdout.splitlines()[-len(last) :] == last


def test_readme_routes():
    """Blocks of at most ten lines, which stand on the pages too; each link goes to a heading with such a block below.

    The tests of the pages run them.
    """
    section = (ROOT / "README.md").read_text("utf-8").split("## In other programs")[1].split("\n## ")[0]
    shown = re.findall(r"^```(\w*)\n(.*?)^```$", section, re.DOTALL | re.MULTILINE)
    pages = [block for page in ("c_api", "fortran", "python", "fmu") for block in blocks(f"docs/{page}.md")]
    assert [language for language, _ in shown] == ["c", "fortran", "f77", "python", ""]
    assert all(block in pages and len(block[1].splitlines()) <= 10 for block in shown)
    links = re.findall(r"\(docs/(\w+[.]md)#([-\w]+)\)", section)
    assert len(links) >= 11
    for page, anchor in links:
        sections = re.split(r"^##+ ", (ROOT / "docs" / page).read_text("utf-8"), flags=re.MULTILINE)
        below = next(
            text for text in sections if re.sub(r"[ +]", "-", text.splitlines()[0].lower()).strip("-") == anchor
        )
        assert re.search(r"^```(?!text)\w+\n(.*\n){1,10}?```$", below, re.MULTILINE), (page, anchor)
