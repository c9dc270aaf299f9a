"""The package and the library know the same names and numbers."""

from __future__ import annotations

import doctest
import re
import shutil
import subprocess
import sys
from dataclasses import fields
from pathlib import Path

import pytest
from conftest import LIBRARY, ROOT

import reedvalve as rv
from reedvalve import _errors, _library

HEADER = re.sub(r"/\*.*?\*/", "", (ROOT / "include" / "reedvalve.h").read_text(encoding="utf-8"), flags=re.S)


def header_enum(name: str) -> dict[str, int]:
    """Names and numbers of an enumeration of the header."""
    body = re.search(rf"enum rv_{name} {{(.*?)}};", HEADER, flags=re.S)[1]
    return {word: int(number) for word, number in re.findall(r"RV_(\w+) = (\d+)", body)}


def test_functions_are_those_of_the_header() -> None:
    """Names, number of arguments, and which of them are real numbers, which go by another register than addresses."""
    declared = dict(re.findall(r"int (rv_\w+)\(([^)]*)\)", HEADER))
    assert set(declared) == set(_library.SIGNATURES)
    for name, words in declared.items():
        kinds = [] if words == "void" else [re.sub(r"\w+(\[\])?$", "", word).strip() for word in words.split(",")]
        ours = _library.SIGNATURES[name]
        assert len(kinds) == len(ours), name
        for kind, our in zip(kinds, ours):
            plain = {"int": "c_int", "double": "c_double", "size_t": "c_ulong"}.get(kind)
            assert our.__name__ == plain if plain else our.__name__ not in ("c_int", "c_double", "c_ulong"), name


def test_numbers_are_those_of_the_header() -> None:
    """Codes, endings, kinds."""
    codes = header_enum("code")
    assert codes.pop("OK") == 0
    assert {kind.code for kind in _errors._KINDS.values()} == set(codes.values())
    for name, kind in (("BAD_INPUT", rv.BadInputError), ("IO", rv.FileError), ("NOT_CONVERGED", rv.NotConvergedError),
                       ("DOMAIN", rv.DomainError), ("INTERNAL", rv.InternalError)):  # fmt: skip
        assert kind.code == codes[name]
    assert {f"CASE_{status.name}": status.value for status in rv.Status} == header_enum("case")
    assert {kind.name: kind.value for kind in rv.Kind} == header_enum("kind")


def test_outputs_are_those_of_the_header() -> None:
    """Each property asks for its own number."""
    asked = []
    valve = rv.Valve()
    valve._output = asked.append
    names = {"DISPLACEMENT": "displacement", "VELOCITY": "velocity", "INLET": "inlet", "OUTLET": "outlet",
             "FILM_FORCE": "film_force", "PART_A": "part_a", "PART_B": "part_b", "PART_C": "part_c",
             "LEAKAGE": "leakage", "FILM_LOW": "film_low"}  # fmt: skip
    for name, number in header_enum("out").items():
        getattr(valve, names[name])
        assert asked.pop() == number, name


def test_measures_are_attributes() -> None:
    """In the library's order."""
    names = [field.name for field in fields(rv.Result)]
    assert names == ["status", "message", *rv.MEASURES, "facts", "traces"]


def test_units() -> None:
    """Of keys in any case, measures and traces; what has none, and what there is not."""
    assert rv.unit("film.gap_mm") == rv.unit("Film.GAP_mm") == "mm"
    assert rv.unit("fluid.viscosity_pa_s") == "Pa s"
    assert rv.unit("peak_squeeze_n") == "N"
    assert rv.unit("leakage_mm3_ms") == "mm3 ms-1"
    assert rv.unit("wet_frequency_hz") == "Hz"
    assert rv.unit("run.model") == ""
    with pytest.raises(rv.UnknownKeyError, match="'gap' is neither"):
        rv.unit("gap")


def test_keys_tell_what_they_mean() -> None:
    """As docs/decks.md has it."""
    page = (ROOT / "docs" / "decks.md").read_text(encoding="utf-8")
    assert rv.KEYS["film.modes"] == rv.Key("film.modes", "", rv.Kind.INTEGER, "plate modes of the film model")
    for key in rv.KEYS.values():
        assert key.help in page


def test_version() -> None:
    """That of the project."""
    assert f"project(reedvalve VERSION {rv.__version__} " in (ROOT / "CMakeLists.txt").read_text(encoding="utf-8")


def test_examples_of_docstrings() -> None:
    """Each runs as printed; what is public calls itself so."""
    result = doctest.testmod(rv)
    assert result.attempted >= 8
    assert result.failed == 0
    assert repr(rv.UnknownKeyError) == "<class 'reedvalve.UnknownKeyError'>"
    assert rv.product.__module__ == "reedvalve"


def import_with(package: Path = Path(rv.__file__).parent, **names: object) -> subprocess.CompletedProcess[str]:
    """Import the package in a new interpreter with these variables of the environment."""
    words = [sys.executable, "-B", "-c", "import reedvalve; print(reedvalve.__version__)"]
    env = {"PYTHONPATH": str(package.parent), **{name: str(value) for name, value in names.items()}}
    return subprocess.run(words, env=env, capture_output=True, text=True)


@pytest.fixture
def whole_package(tmp_path: Path) -> Path:
    """A copy of the package with its library inside, as a wheel has it."""
    package = shutil.copytree(Path(rv.__file__).parent, tmp_path / "reedvalve")
    (package / "libreedvalve.so").symlink_to(LIBRARY)
    return package


def test_library_is_named(whole_package: Path) -> None:
    """REEDVALVE_LIBRARY says which, and no other is taken; else it is that of the package, or an installed one."""
    assert import_with(REEDVALVE_LIBRARY=LIBRARY).stdout == f"{rv.__version__}\n"
    assert import_with(LD_LIBRARY_PATH=LIBRARY.parent).stdout == f"{rv.__version__}\n"
    assert import_with(whole_package, REEDVALVE_LIBRARY="").stdout == f"{rv.__version__}\n"
    for name, why in (("/none.so", "cannot open shared object file"), ("libm.so.6", "undefined symbol: rv_version")):
        refused = import_with(whole_package, REEDVALVE_LIBRARY=name)
        assert refused.returncode != 0
        assert f"ImportError: REEDVALVE_LIBRARY names '{name}', which cannot be loaded: " in refused.stderr
        assert why in refused.stderr


def test_library_is_missing() -> None:
    """The import says what was tried, in plain paths."""
    missing = import_with()
    if missing.returncode != 0:  # else one is installed on this machine
        assert "the library of reedvalve cannot be loaded; REEDVALVE_LIBRARY may name it:" in missing.stderr
        assert f"{_library.INSTALLED}: cannot open shared object file" in missing.stderr
        assert ".." not in missing.stderr.split("may name it:")[1]


def test_numpy_is_missing(tmp_path: Path) -> None:
    """The import says what is needed."""
    (tmp_path / "numpy.py").write_text("raise ModuleNotFoundError('numpy')\n", encoding="utf-8")
    path = f"{tmp_path}:{Path(rv.__file__).parents[1]}"
    assert "ImportError: reedvalve needs NumPy: pip install numpy, or apt" in import_with(PYTHONPATH=path).stderr


def test_installed_name() -> None:
    """The soname under which an installed library is looked for."""
    assert Path(_library.INSTALLED).name == LIBRARY.readlink().name
