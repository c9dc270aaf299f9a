"""Command line: compare, plot, fields and report. This module alone prints."""

from __future__ import annotations

import argparse
import os
import sys
from collections.abc import Callable
from pathlib import Path

from reedpost import __version__
from reedpost.results import Result, ResultError, read_result

FINE, INCOMPLETE, UNUSABLE = 0, 1, 2  # exit statuses; a worse one wins

EPILOG = "Exit status: 0 all is there, 1 cases are missing or failed, 2 input that cannot be used."


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(prog="reedpost", description=__doc__.split("\n")[0], epilog=EPILOG)
    parser.add_argument("--version", action="version", version=f"reedpost {__version__}")
    commands = parser.add_subparsers(dest="command", required=True, metavar="COMMAND")
    words = {
        "compare": ("tables beside the paper's, on the terminal and as CSV and Markdown",
                    "folder to write to (default: DIR/compare)"),
        "plot": ("pictures as PNG and SVG", "folder to write to (default: DIR/plots)"),
        "fields": ("film pressure fields as VTK files, for ParaView", "folder to write to (default: DIR/vtk)"),
        "report": ("one HTML page about all folders", "file to write (default: report.html in the first DIR)"),
    }  # fmt: skip
    for name, (text, output) in words.items():
        command = commands.add_parser(name, help=text, description=text, epilog=EPILOG)
        command.add_argument("folders", nargs="+", type=Path, metavar="DIR", help="folder with results.nc")
        command.add_argument("-o", "--output", type=Path, metavar="PATH", help=output)
    return parser


def _complain(text: str) -> None:
    print(f"reedpost: {text}", file=sys.stderr)


def _target(arguments: argparse.Namespace, result: Result, name: str) -> Path:
    """Where one result's files go."""
    if arguments.output is None:
        return result.folder / name
    if len(arguments.folders) == 1:
        return arguments.output
    return arguments.output / result.folder.resolve().name


def _compare(arguments: argparse.Namespace, results: list[Result]) -> int:
    from reedpost.compare import compare, terminal_text, write_tables
    from reedpost.overview import overview_tables, write_overview
    from reedpost.tables import as_text

    status = FINE
    for result in results:
        comparison = compare(result)
        print(terminal_text(comparison))
        folder = _target(arguments, result, "compare")
        write_tables(comparison, folder)
        print(f"written to {folder}\n")
        status = max(status, FINE if comparison.complete else INCOMPLETE)
    if tables := overview_tables(results):
        folder = _target(arguments, results[0], "compare")
        print("== all models ==\n", *map(as_text, tables), sep="\n")
        write_overview(tables, folder)
        print(f"written to {folder}\n")
    return status


def _plot(arguments: argparse.Namespace, results: list[Result]) -> int:
    from reedpost.figures import draw, draw_all

    status = FINE
    for result in results:
        album = draw(result)
        for path in album.save(_target(arguments, result, "plots")):
            print(path)
        for problem in album.problems:
            _complain(f"{result.folder}: {problem}")
            status = INCOMPLETE
    for path in draw_all(results).save(_target(arguments, results[0], "plots")):
        print(path)
    return status


def _fields(arguments: argparse.Namespace, results: list[Result]) -> int:
    from reedpost.paraview import write_fields

    status = FINE
    for result in results:
        paths = write_fields(result, _target(arguments, result, "vtk"))
        for path in paths:
            if path.suffix == ".pvd":
                print(path)
        if not paths:
            _complain(f"{result.folder}: holds no pressure field (film.fields_ms in the deck of a film model)")
            status = INCOMPLETE
    return status


def _report(arguments: argparse.Namespace, results: list[Result]) -> int:
    from reedpost.report import build_report

    page, complete = build_report(results)
    path = arguments.output or results[0].folder / "report.html"
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(page, encoding="utf-8", newline="\n")
    print(path)
    return FINE if complete else INCOMPLETE


def main(words: list[str] | None = None) -> int:
    """Run one command; the value is the exit status."""
    arguments = _parser().parse_args(words)
    commands: dict[str, Callable[[argparse.Namespace, list[Result]], int]] = {
        "compare": _compare, "plot": _plot, "fields": _fields, "report": _report,
    }  # fmt: skip
    results: list[Result] = []
    status = FINE
    for folder in arguments.folders:
        try:
            results.append(read_result(folder))
        except ResultError as error:
            _complain(str(error))
            status = UNUSABLE
    if not results:
        return UNUSABLE
    try:
        status = max(status, commands[arguments.command](arguments, results))
        sys.stdout.flush()
        return status
    except BrokenPipeError:  # whoever read the output, `head` say, has had enough
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())  # nor does the last flush find it broken
        return INCOMPLETE
    except OSError as error:
        _complain(f"cannot write: {error}")
        return UNUSABLE
    finally:
        for result in results:
            result.dataset.close()
