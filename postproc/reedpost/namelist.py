"""Read Fortran namelist text: groups of scalars and one-dimensional arrays.

The text comes from a result file, so it has been checked already; what is read here is
the plain form that the effective values are written in, not every liberty of Fortran.
"""

from __future__ import annotations

import re

Value = float | bool | str

_TOKEN = re.compile(
    r"""(?P<comment>![^\n]*)
      | &(?P<group>\w+)
      | (?P<end>/)
      | (?P<key>[A-Za-z]\w*)\s*=
      | (?P<text>'(?:[^']|'')*'|"(?:[^"]|"")*")
      | (?P<word>[^\s,/'"!&=]+)
      | [\s,]+""",
    re.VERBOSE,
)
_LOGICAL = {".true.": True, "t": True, "true": True, ".false.": False, "f": False, "false": False}


def _value(token: re.Match) -> Value:
    if token["text"]:
        quote = token["text"][0]
        return token["text"][1:-1].replace(2 * quote, quote)
    word = token["word"].lower()
    if word in _LOGICAL:
        return _LOGICAL[word]
    try:
        return float(word.replace("d", "e"))
    except ValueError:
        return token["word"]


def read_groups(text: str) -> list[tuple[str, dict[str, list[Value]]]]:
    """All groups in their order, as (name, {key: values}); names in lower case.

    Raises ValueError at text that is no namelist.
    """
    groups: list[tuple[str, dict[str, list[Value]]]] = []
    values: list[Value] | None = None
    inside = False
    at = 0
    while at < len(text):
        token = _TOKEN.match(text, at)
        if token is None:
            raise ValueError(f"not a namelist: {text[at : at + 20]!r}")
        at = token.end()
        kind = token.lastgroup
        if kind == "group":
            groups.append((token["group"].lower(), {}))
            inside, values = True, None
        elif kind == "end":
            inside = False
        elif kind == "key" and inside:
            values = groups[-1][1].setdefault(token["key"].lower(), [])
        elif kind in ("text", "word") and inside and values is not None:
            values.append(_value(token))
    return groups


def flat_values(text: str) -> dict[str, Value | list[Value]]:
    """`group.key` -> its value, or a list where there are several; sweeps are left out."""
    flat: dict[str, Value | list[Value]] = {}
    for group, keys in read_groups(text):
        if group == "sweep":
            continue
        for key, values in keys.items():
            if values:
                flat[f"{group}.{key}"] = values[0] if len(values) == 1 else values
    return flat
