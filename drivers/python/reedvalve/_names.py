"""What keys, measures and traces there are, as the library tells it: names, units, meaning."""

from __future__ import annotations

import enum
from collections.abc import Mapping
from dataclasses import dataclass
from types import MappingProxyType
from typing import Callable

from ._errors import UnknownKeyError
from ._library import LIB, take_text


class Kind(enum.IntEnum):
    """What a key takes."""

    REAL = 1
    INTEGER = 2
    LOGICAL = 3
    CHOICE = 4
    TEXT = 5


@dataclass(frozen=True)
class Key:
    """A key of decks and valves.

    Attributes:
        name: ``"film.gap_mm"``: group, name, and in the name the unit.
        unit: ``"mm"``; empty: none.
        kind: what it takes.
        help: what it means.
    """

    name: str
    unit: str
    kind: Kind
    help: str


def _names(count: int, name: Callable[..., int], unit: Callable[..., int]) -> Mapping[str, str]:
    """Names and units of so many columns."""
    return MappingProxyType({take_text(name, i)[1]: take_text(unit, i)[1] for i in range(count)})


def _key(i: int) -> Key:
    name, unit, text = (take_text(tell, i)[1] for tell in (LIB.rv_key_name, LIB.rv_key_unit, LIB.rv_key_help))
    return Key(name, unit, Kind(LIB.rv_key_kind(i)), text)


#: All keys by name, in the order of docs/decks.md.
KEYS: Mapping[str, Key] = MappingProxyType({key.name: key for key in map(_key, range(LIB.rv_key_count()))})
#: Units of the measures of a case, by name, in the order of summary.csv.
MEASURES: Mapping[str, str] = _names(LIB.rv_measure_count(), LIB.rv_measure_name, LIB.rv_measure_unit)
#: Units of the facts of a case, the model's numbers behind it, by name; 1: none.
FACTS: Mapping[str, str] = _names(LIB.rv_fact_count(), LIB.rv_fact_name, LIB.rv_fact_unit)
#: Units of the traces of a case, by name, the time first. Those after squeeze_n are of the film models only.
TRACES: Mapping[str, str] = MappingProxyType(
    {"time_ms": "ms", **_names(LIB.rv_trace_count(), LIB.rv_trace_name, LIB.rv_trace_unit)}
)


def unit(name: str) -> str:
    """Unit of a key, a measure, a fact or a trace; empty or 1: none.

    Raises UnknownKeyError for a name that is none of them.

    >>> unit("film.gap_mm"), unit("closing_ms"), unit("velocity_mm_ms")
    ('mm', 'ms', 'mm ms-1')
    """
    if name.lower() in KEYS:
        return KEYS[name.lower()].unit
    for table in (MEASURES, FACTS, TRACES):
        if name in table:
            return table[name]
    raise UnknownKeyError(f"{name!r} is neither a key nor a measure, a fact or a trace")
