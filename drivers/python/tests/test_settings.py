"""Keys as items, decks, other valves like one, and what a valve says when a setting is wrong."""

from __future__ import annotations

import copy
import math
import pickle
import re
import warnings
from pathlib import Path

import numpy as np
import pytest

import reedvalve as rv


def test_values_have_the_kinds_of_keys() -> None:
    """Defaults of docs/decks.md."""
    valve = rv.Valve()
    found = dict(valve)
    assert list(found) == list(rv.KEYS)
    assert found["film.gap_mm"] == 0.05
    assert found["run.model"] == "squeeze"
    assert found["run.title"] == ""
    assert isinstance(found["film.modes"], int)
    assert found["run.traces"] is False
    assert math.isnan(found["reed.action_area_mm2"])
    assert len(valve) == len(found) > 30
    assert "FILM.gap_mm" in valve
    assert "film.gap" not in valve


@pytest.mark.parametrize(
    ("key", "value", "read"),
    [
        ("film.gap_mm", 0.04, 0.04),
        ("Film.Gap_mm", "0.04", 0.04),
        ("film.gap_mm", np.float32(0.5), 0.5),
        ("film.gap_mm", np.array(0.04), 0.04),
        ("film.modes", 5, 5),
        ("film.modes", np.int64(5), 5),
        ("run.traces", True, True),
        ("run.traces", np.True_, True),
        ("run.model", "film", "film"),
        ("run.title", "größer, 'it'", "größer, 'it'"),
        ("pressure.file", Path("p.csv"), "p.csv"),
    ],
)
def test_value_is_set_and_read(key: str, value: object, read: object) -> None:
    """In the types that callers have."""
    valve = rv.Valve()
    valve[key] = value
    assert valve[key] == read
    assert type(valve[key]) is type(read)


@pytest.mark.parametrize(
    ("key", "value", "kind", "message"),
    [
        ("film.gap", 1.0, rv.UnknownKeyError, "'film.gap': there is no such key; did you mean 'film.gap_mm'?"),
        ("gap_mm", 1.0, rv.UnknownKeyError, "'gap_mm': there is no such key; write it with its group: 'film.gap_mm'"),
        ("sweep.key", 1, rv.UnknownKeyError, "'sweep.key': there is no such key of one valve; a sweep runs many cases"),
        (3, 1.0, rv.UnknownKeyError, "keys are texts such as 'film.gap_mm', not 3"),
        ("film.gap_mm", -1.0, rv.BadInputError, "film.gap_mm = -1: must be >= 0 (mm)"),
        ("film.gap_mm", math.nan, rv.BadInputError, "film.gap_mm = NaN: NaN and infinity are not allowed"),
        ("film.gap_mm", "thin", rv.BadInputError, "film.gap_mm = thin: not a number"),
        ("film.gap_mm", "1\x00", rv.BadInputError, r"'1\x00': there is a NUL in it"),
        ("film.gap_mm", None, TypeError, "film.gap_mm: a key takes a number, a word or a bool, not NoneType"),
        ("film.gap_mm", [1.0], TypeError, "film.gap_mm: a key takes a number, a word or a bool, not list"),
        ("film.modes", 4.5, rv.BadInputError, "film.modes = 4.5: not a whole number"),
        ("run.model", 3, rv.BadInputError,
         "run.model = 3: must be one of 'traditional', 'squeeze', 'film', 'film_table'"),
        ("run.title", 3, rv.BadInputError, "run.title = 3: it is a word: set it as text"),
    ],
)  # fmt: skip
def test_wrong_setting(key: object, value: object, kind: type[Exception], message: str) -> None:
    """The right exception with the message; the valve stays as it was."""
    valve = rv.Valve(film_gap_mm=0.04)
    with pytest.raises(kind) as caught:
        valve[key] = value
    assert str(caught.value) == message
    assert valve.settings() == {"film.gap_mm": 0.04}


def test_exceptions_are_pythons_own_too() -> None:
    """For callers that know ValueError, KeyError, OSError; with code and message."""
    with pytest.raises(KeyError) as caught:
        rv.Valve()["film.gap"]
    assert isinstance(caught.value, ValueError)
    assert caught.value.code == 1
    assert caught.value.message == str(caught.value)
    assert rv.Valve().get("film.gap") is None
    with pytest.raises(OSError, match="there is no such file"):
        rv.Valve("nowhere.nml")
    assert isinstance(pickle.loads(pickle.dumps(caught.value)), rv.UnknownKeyError)


def test_settings_by_name() -> None:
    """With underscores, and with points from a dictionary."""
    assert rv.Valve(film_gap_mm=0.03, run_t_end_ms=20).settings() == {"run.t_end_ms": 20.0, "film.gap_mm": 0.03}
    assert rv.Valve(**{"film.gap_mm": 0.03})["film.gap_mm"] == 0.03
    with pytest.raises(rv.UnknownKeyError, match=r"'film[.]gap': there is no such key"):
        rv.Valve(film_gap=1.0)
    with pytest.raises(rv.UnknownKeyError, match=r"'gap_mm': there is no such key; write it with its group"):
        rv.Valve(gap_mm=1.0)
    with pytest.raises(AttributeError, match=r"valve\['film[.]gap_mm'\] = 0.1"):
        rv.Valve().film_gap_mm = 0.1
    valve = rv.Valve()
    valve.update({"film.gap_mm": 0.03, "run.model": "film"})
    assert repr(valve) == "Valve(run.model='film', film.gap_mm=0.03)"


def test_deck(tmp_path: Path) -> None:
    """Its settings; another valve from them reads the same trace."""
    (tmp_path / "p.csv").write_text("t_ms,p_diff_kpa\n0,20\n1,20\n2,0\n9,0\n", encoding="utf-8")
    (tmp_path / "deck.nml").write_text(
        "&pressure kind = 'trace', file = 'p.csv', event_ms = 1.0 /\n&film gap_mm = 0.04 /\n", encoding="utf-8"
    )
    valve = rv.Valve(tmp_path / "deck.nml", run_title="of a deck")
    assert valve["film.gap_mm"] == 0.04
    assert valve["pressure.file"] == "p.csv"
    again = rv.Valve(**valve.settings())
    assert again["pressure.file"] == str(tmp_path / "p.csv")
    assert again.run().measures == pytest.approx(valve.run().measures, rel=0, abs=0, nan_ok=True)


def test_wrong_deck(tmp_path: Path) -> None:
    """All faults are told; a deck of several cases is no valve."""
    deck = tmp_path / "deck.nml"
    deck.write_text("&reed widht_mm = 6.0 /\n&film gap_mm = -0.05 /\n", encoding="utf-8")
    with pytest.raises(rv.BadInputError) as caught:
        rv.Valve(deck)
    assert "did you mean 'width_mm'?" in str(caught.value)
    assert "deck.nml:2:16: film.gap_mm = -0.05: must be >= 0 (mm)" in str(caught.value)
    deck.write_text("&sweep key = 'film.gap_mm', values = 0.1, 0.2 /\n", encoding="utf-8")
    with pytest.raises(rv.BadInputError, match="a deck of 2 cases; a valve is one case, a sweep runs many"):
        rv.Valve(deck)


def test_warnings_stand_at_the_callers_line(tmp_path: Path) -> None:
    """Whatever the call went through inside the package."""
    valve = rv.Valve()
    with pytest.warns(rv.ReedvalveWarning, match="unusually small for mm; was it given in m") as caught:
        valve["reed.thickness_mm"] = 0.00015
        valve.update({"reed.thickness_mm": 0.00015})
        rv.Valve(reed_thickness_mm=0.00015)
    with pytest.warns(rv.ReedvalveWarning, match="no effect"):
        rv.Valve(film_modes=3).run()
    assert {warning.filename for warning in caught} == {__file__}


def test_warnings_stand_alone() -> None:
    """Without the name of a deck, which there is none of, and without saying what their kind says."""
    closed = re.escape("film.gap_mm = 0: the film is closed from the start; such a case ends there as film_closed")
    valve = rv.Valve()
    with pytest.warns(rv.ReedvalveWarning, match=f"^case 1: {closed}$"):
        valve.sweep({"film.gap_mm": [0.0, 0.05]})
    valve["film.gap_mm"] = 0.0
    with pytest.raises(rv.DomainError, match=f"^warning: {closed}\nat t = 0 ms: "):
        valve.run()
    with pytest.raises(rv.BadInputError, match=r"^pressure\.kind = 'trace' needs pressure\.file"):
        rv.Valve(pressure_kind="trace").run()


def test_closed_valve() -> None:
    """Closing twice is fine, all else is refused."""
    with rv.Valve() as valve:
        assert valve["film.gap_mm"] == 0.05
    valve.close()
    assert repr(valve) == "Valve(closed)"
    for call in (valve.run, valve.state, valve.begin, valve.settings, lambda: valve["film.gap_mm"],
                 lambda: valve.step(1.0, 1.0), lambda: valve.sweep({"film.gap_mm": [1.0]})):  # fmt: skip
        with pytest.raises(rv.BadInputError, match="was closed"):
            call()


def test_copies_are_valves_of_their_own() -> None:
    """With the settings; silent, though a setting is odd."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        valve = rv.Valve(reed_width_mm=600.0)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        for other in (copy.copy(valve), copy.deepcopy(valve), pickle.loads(pickle.dumps(valve))):
            assert other.settings() == valve.settings() == {"reed.width_mm": 600.0}
            other["film.gap_mm"] = 0.03
            assert other != valve
    assert valve["film.gap_mm"] == 0.05
    assert len({valve, other}) == 2
