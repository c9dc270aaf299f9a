"""One HTML page about a set of results, with everything it needs inside it."""

from __future__ import annotations

import base64
from html import escape

import numpy as np

from reedpost import __version__
from reedpost.compare import compare
from reedpost.discrepancies import discrepancies
from reedpost.figures import draw, draw_all
from reedpost.overview import overview_tables
from reedpost.picture import Picture
from reedpost.results import Result
from reedpost.style import svg_bytes
from reedpost.tables import as_html

STYLE = """
:root { color-scheme: light; }
body { font: 16px/1.5 system-ui, sans-serif; max-width: 52rem; margin: 0 auto; padding: 1rem;
       color: #111; background: #fff; }
h1 { line-height: 1.2; } h2 { margin-top: 2.5rem; border-bottom: 2px solid #0072B2; }
h3 { margin-bottom: .4rem; }
.wide { overflow-x: auto; }
table { border-collapse: collapse; font-variant-numeric: tabular-nums; font-size: .9rem; }
th, td { padding: .15rem .6rem; text-align: right; white-space: nowrap; }
.words { text-align: left; white-space: normal; }
th { vertical-align: bottom; } thead, tfoot { border-top: 1px solid #111; border-bottom: 1px solid #111; }
table.facts th, table.facts td { text-align: left; vertical-align: top; white-space: normal; }
.notes { font-size: .9rem; margin-top: .4rem; } .bad { color: #a03000; font-weight: 600; }
figure { margin: 1.5rem 0; text-align: center; } figcaption { text-align: left; font-size: .9rem; }
figure img { width: 100%; max-width: 28rem; height: auto; }
pre { background: #f4f4f4; padding: .6rem; font-size: .8rem; white-space: pre-wrap;
      overflow-wrap: anywhere; }
@media print { body { font-size: 10pt; max-width: none; padding: 0; } h2 { break-before: page; }
  h2:first-of-type { break-before: auto; } figure, table, h3, details { break-inside: avoid; }
  h3 { break-after: avoid; } .wide { overflow: visible; } }
"""

VERSIONS = (
    ("code_version", "program"),
    ("compiler", "compiler"),
    ("library_versions", "libraries"),
)

DERIVED = ("stiffness_n_m", "reed_mass_kg", "added_mass_kg", "added_damping_n_s_m", "reynolds", "wet_frequency_hz",
           "lowest_film_kpa")  # fmt: skip


def build_report(results: list[Result]) -> tuple[str, bool]:
    """The page, and whether every result holds all that it should."""
    sections, complete = [], True
    together = _together(results)
    for number, result in enumerate(results, start=1):
        section, whole = _section(result, number)
        sections.append(section)
        complete = complete and whole
    titles = [result.attribute("title") or result.folder.name for result in results]
    contents = "".join(f'<li><a href="#run{i}">{escape(title)}</a></li>' for i, title in enumerate(titles, start=1))
    contents = f'<li><a href="#all">All models</a></li>{contents}' if together else contents
    verdict = (
        "All cases are there and none failed."
        if complete
        else '<span class="bad">Some cases are missing or failed; see the marked lines.</span>'
    )
    open_points = "\n".join(
        f"<dt><strong>{escape(title)}</strong></dt><dd>{escape(text)}</dd>" for title, text in discrepancies(results)
    )
    page = f"""<!DOCTYPE html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<title>reedvalve: {escape(titles[0])}</title>
<style>{STYLE}</style>
</head>
<body>
<h1>Cantilever reed valve: ours beside the paper's</h1>
<p>{verdict} "Published" are the paper's own models, FE its finite elements.</p>
<ol>{contents}<li><a href="#open">Open discrepancies</a></li></ol>
{together}{"".join(sections)}
<h2 id="open">Open discrepancies</h2>
<dl>
{open_points}
</dl>
<p><small>Made by reedpost {escape(__version__)}.</small></p>
</body>
</html>
"""
    return page, complete


def _together(results: list[Result]) -> str:
    """All models of all results beside each other; empty when there is nothing to compare."""
    tables, album = overview_tables(results), draw_all(results)
    if not tables:
        return ""
    parts = ['<h2 id="all">All models</h2>', *map(_figure, album.pictures), *map(as_html, tables)]
    return "\n".join(parts) + "\n"


def _section(result: Result, number: int) -> tuple[str, bool]:
    """One result: what was run, tables, pictures, the deck; and whether it is complete."""
    comparison, album = compare(result), draw(result)
    problems = [*comparison.problems, *album.problems]
    title = result.attribute("title") or result.folder.name
    parts = [f'<h2 id="run{number}">{escape(title)}</h2>', _facts(result)]
    if result.failures():
        parts.append(_failures(result))
    if problems or comparison.notes:
        parts.append('<ul class="notes">')
        parts += [f"<li>{escape(note)}</li>" for note in comparison.notes]
        parts += [f'<li class="bad">Incomplete: {escape(problem)}</li>' for problem in problems]
        parts.append("</ul>")
    parts += [_figure(picture) for picture in album.pictures]
    parts += [as_html(table) for table in comparison.tables]
    for name, heading in (("deck", "The deck"), ("effective_values", "All effective values")):
        text = escape(result.attribute(name).strip())
        parts.append(f"<details open><summary>{heading}</summary><pre>{text}</pre></details>")
    return "\n".join(parts) + "\n", comparison.complete and not album.problems


def _facts(result: Result) -> str:
    """What was run, with which versions."""
    failed = len(result.failures())
    facts = [
        ("folder", result.folder.resolve().name),
        ("models", ", ".join(result.models)),
        ("cases", f"{result.count}, of which {failed} failed" if failed else f"{result.count}, all fine"),
        *((key, _span(values)) for key, values in result.swept.items()),
        *_derived(result),
        *((label, result.attribute(name) or "not recorded") for name, label in VERSIONS),
    ]
    rows = "".join(f"<tr><th>{escape(k)}</th><td>{escape(v)}</td></tr>" for k, v in facts)
    return f'<table class="facts">{rows}</table>'


def _derived(result: Result) -> list[tuple[str, str]]:
    """The models' numbers behind the cases, such as the stiffness, as far as the file holds them."""
    lines = []
    for name in DERIVED:
        if name in result.dataset:
            values, attributes = result.measure(name), result.dataset[name].attrs
            known = values[np.isfinite(values)]
            if len(known):
                low, high = known.min(), known.max()
                text = f"{low:.5g}" if np.isclose(low, high, rtol=1e-9) else f"{low:.5g} to {high:.5g}"
                unit = attributes.get("units", "1")
                lines.append((attributes.get("long_name", name), text if unit == "1" else f"{text} {unit}"))
    return lines


def _span(values: np.ndarray) -> str:
    """A swept key's values in words."""
    distinct = list(dict.fromkeys(values.tolist()))
    if len(distinct) <= 8:
        return ", ".join(f"{v:g}" if isinstance(v, float) else str(v) for v in distinct)
    if isinstance(distinct[0], float):
        return f"{len(distinct)} values from {min(distinct):g} to {max(distinct):g}"
    return f"{len(distinct)} values"


def _failures(result: Result, most: int = 50) -> str:
    """The failed cases with their reasons."""
    failures = result.failures()
    rows = "".join(
        f"<tr><td>{case}</td><td>{escape(status)}</td><td>{escape(message)}</td></tr>"
        for case, status, message in failures[:most]
    )
    more = f"<p>and {len(failures) - most} more</p>" if len(failures) > most else ""
    head = "<tr><th>case</th><th>status</th><th>reason</th></tr>"
    return f'<h3 class="bad">Failed cases</h3><table class="facts">{head}{rows}</table>{more}'


def _figure(picture: Picture) -> str:
    data = base64.b64encode(svg_bytes(picture.figure)).decode("ascii")
    caption = escape(picture.caption)
    return (
        f'<figure><img alt="{caption}" src="data:image/svg+xml;base64,{data}">'
        f"<figcaption>{caption}</figcaption></figure>"
    )
