"""The commands from outside: exit statuses, files, and the report page."""

from __future__ import annotations

import re
import subprocess
import sys
from html.parser import HTMLParser

import pytest
from reedpost.cli import main


def test_compare_is_fine(sweep, tmp_path, capsys):
    assert main(["compare", str(sweep), "-o", str(tmp_path)]) == 0
    assert "Table IV. Closing time" in capsys.readouterr().out
    assert (tmp_path / "table_4_squeeze.csv").exists()


def test_compare_is_incomplete(broken, tmp_path, capsys):
    assert main(["compare", str(broken), "-o", str(tmp_path)]) == 1
    assert "no case at 15 kPa for model squeeze" in capsys.readouterr().out


def test_one_bad_folder_does_not_stop_the_others(sweep, tmp_path, capsys):
    assert main(["compare", str(tmp_path / "nowhere"), str(sweep), "-o", str(tmp_path)]) == 2
    captured = capsys.readouterr()
    assert "nowhere: no such folder" in captured.err
    assert "Table III" in captured.out
    assert (tmp_path / sweep.name / "tables.md").exists()


def test_output_that_cannot_be_written(sweep, tmp_path, capsys):
    (tmp_path / "file").write_text("in the way")
    assert main(["compare", str(sweep), "-o", str(tmp_path / "file")]) == 2
    assert "cannot write" in capsys.readouterr().err


def test_plot(gaps, broken, tmp_path, capsys):
    assert main(["plot", str(gaps), "-o", str(tmp_path / "g")]) == 0
    assert sorted(p.name for p in (tmp_path / "g").iterdir()) == ["gap_study_squeeze.png", "gap_study_squeeze.svg"]
    assert main(["plot", str(broken), "-o", str(tmp_path / "b")]) == 1
    assert "25 kPa" in capsys.readouterr().err


def test_a_reader_that_has_had_enough(sweep, tmp_path):
    """As of `reedpost compare ... | head`: no word about it, whenever the pipe breaks."""
    words = [sys.executable, "-m", "reedpost", "compare", sweep, "-o", tmp_path]
    with subprocess.Popen(words, stdout=subprocess.PIPE, stderr=subprocess.PIPE) as process:
        process.stdout.close()
        assert process.stderr.read() == b""
    assert process.returncode == 1


def test_usage(capsys):
    with pytest.raises(SystemExit) as stop:
        main(["compare"])
    assert stop.value.code == 2
    assert "DIR" in capsys.readouterr().err


class Page(HTMLParser):
    """Checks that tags are closed in order and collects what points outside."""

    def __init__(self):
        super().__init__()
        self.open, self.links, self.ids = [], [], set()

    def handle_starttag(self, tag, attrs):
        named = dict(attrs)
        self.ids.add(named.get("id"))
        self.links += [named[name] for name in ("src", "href") if name in named]
        if tag not in ("meta", "br", "img", "link", "hr"):
            self.open.append(tag)

    def handle_endtag(self, tag):
        assert self.open.pop() == tag


def test_report_is_one_page(sweep, response, gaps, table5, tmp_path, capsys):
    path = tmp_path / "report.html"
    assert main(["report", *map(str, (sweep, response, gaps, table5)), "-o", str(path)]) == 0
    assert capsys.readouterr().out.strip() == str(path)
    text = path.read_text("utf-8")
    page = Page()
    page.feed(text)
    assert page.open == []
    assert all(link.startswith(("data:", "#")) for link in page.links)
    assert all(link[1:] in page.ids for link in page.links if link.startswith("#"))
    assert sum(link.startswith("data:image/svg+xml") for link in page.links) == 4
    assert not re.search(r"url\(|@import|<script", text)
    assert "Synthetic &quot;valve&quot;" in text
    for words in ("reedvalve 0.1.0", "computed by SciPy", "k_s = 0.008", "3.4 ms", "not measured", "1.503"):
        assert words in text


def test_report_lists_failures(broken, tmp_path):
    path = tmp_path / "report.html"
    assert main(["report", str(broken), "-o", str(path)]) == 1
    text = path.read_text("utf-8")
    assert "Failed cases" in text
    assert "the step size went to zero at t = 19.7 ms" in text
    assert "no case at 15 kPa for model squeeze" in text


def test_report_is_the_same_each_time(sweep, tmp_path):
    pages = []
    for name in ("one.html", "two.html"):
        main(["report", str(sweep), "-o", str(tmp_path / name)])
        pages.append((tmp_path / name).read_bytes())
    assert pages[0] == pages[1]
