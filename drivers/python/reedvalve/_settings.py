"""The settings of a valve: a handle of the library, opened and closed, and the keys of a deck as items."""

from __future__ import annotations

import ctypes
import numbers
import os
import threading
import weakref
from collections.abc import Iterator, Mapping
from typing import TypeVar, Union

import numpy as np

from ._errors import BadInputError, UnknownKeyError, error_of, warn
from ._library import LIB, take_text
from ._names import KEYS, Kind

Value = Union[float, int, bool, str]
Self = TypeVar("Self", bound="Settings")
_GROUPS = frozenset(name.partition(".")[0] for name in KEYS)


class Settings(Mapping[str, Value]):
    """What a valve is made of; see Valve."""

    __hash__ = object.__hash__
    __eq__ = object.__eq__

    def __init__(self, deck: str | os.PathLike[str] | None = None, **keys: Value) -> None:
        self._handle = ctypes.c_void_p()
        self._finalizer = weakref.finalize(self, LIB.rv_valve_free, ctypes.byref(self._handle))
        self._lock = threading.RLock()
        path = os.fsdecode(deck) if deck is not None else ""
        self._folder = os.path.abspath(os.path.dirname(path))
        if deck is None:
            code, message = LIB.rv_valve_new(ctypes.byref(self._handle)), ""
        else:
            code, message = take_text(LIB.rv_valve_new_deck, encoded(path), ctypes.byref(self._handle))
        if code != 0:
            raise error_of(code, message)
        warn(message)
        for name, value in keys.items():
            self[_key_of(name)] = value

    def __setattr__(self, name: str, value: object) -> None:
        if _key_of(name) in KEYS:
            raise AttributeError(f"{name}: settings are items: valve[{_key_of(name)!r}] = {value!r}")
        super().__setattr__(name, value)

    def close(self) -> None:
        """Give the memory back; more than once is fine. Every other call is a BadInputError from then on."""
        with self._lock:
            self._finalizer()

    def __enter__(self: Self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    def __repr__(self) -> str:
        if not self._finalizer.alive:
            return f"{type(self).__name__}(closed)"
        return f"{type(self).__name__}({', '.join(f'{name}={value!r}' for name, value in self.settings().items())})"

    def _check(self, code: int) -> None:
        """Raise what a code means; the caller holds the lock."""
        if code != 0:
            raise error_of(code, self._message())

    def _message(self) -> str:
        return take_text(LIB.rv_valve_message, self._handle)[1]

    def __getitem__(self, name: str) -> Value:
        key = KEYS.get(name.lower()) if isinstance(name, str) else None
        if key is None:
            raise UnknownKeyError(self._advice(name))
        with self._lock:
            if key.kind in (Kind.CHOICE, Kind.TEXT):
                code, text = take_text(LIB.rv_valve_get_text, self._handle, encoded(name))
                self._check(code)
                return text
            number = ctypes.c_double()
            self._check(LIB.rv_valve_get_real(self._handle, encoded(name), ctypes.byref(number)))
        if key.kind is Kind.REAL:
            return number.value
        return number.value > 0.5 if key.kind is Kind.LOGICAL else int(number.value)

    def __setitem__(self, name: str, value: Value) -> None:
        if not isinstance(name, str) or name.lower() not in KEYS:
            raise UnknownKeyError(self._advice(name))
        with self._lock:
            if isinstance(value, (bool, np.bool_)):
                code = LIB.rv_valve_set_text(self._handle, encoded(name), b".true." if value else b".false.")
            elif isinstance(value, (str, os.PathLike)):
                code = LIB.rv_valve_set_text(self._handle, encoded(name), encoded(os.fspath(value)))
            elif isinstance(value, numbers.Real) or (isinstance(value, np.ndarray) and value.ndim == 0):
                code = LIB.rv_valve_set_real(self._handle, encoded(name), float(value))
            else:
                raise TypeError(f"{name}: a key takes a number, a word or a bool, not {type(value).__name__}")
            self._check(code)
            warn(self._message())

    def _advice(self, name: object) -> str:
        """What the library says of a key that is none."""
        if not isinstance(name, str):
            return f"keys are texts such as 'film.gap_mm', not {name!r}"
        with self._lock:
            LIB.rv_valve_is_set(self._handle, encoded(name), ctypes.byref(ctypes.c_int()))
            return self._message()

    def __iter__(self) -> Iterator[str]:
        return iter(KEYS)

    def __len__(self) -> int:
        return len(KEYS)

    def __contains__(self, name: object) -> bool:
        return isinstance(name, str) and name.lower() in KEYS

    def update(self, keys: Mapping[str, Value]) -> None:
        """Set several keys, one after the other."""
        for name, value in keys.items():
            self[name] = value

    def settings(self) -> dict[str, Value]:
        """What the deck or the caller has set: ``Valve(**valve.settings())`` is another valve like this one.

        The name of a pressure trace comes with its folder.
        """
        is_set = ctypes.c_int()
        found = {}
        with self._lock:
            for name in KEYS:
                self._check(LIB.rv_valve_is_set(self._handle, encoded(name), ctypes.byref(is_set)))
                if is_set.value:
                    found[name] = self[name]
        if "pressure.file" in found:
            found["pressure.file"] = os.path.join(self._folder, str(found["pressure.file"]))
        return found


def _key_of(word: str) -> str:
    """The key that a Python name stands for; a word that begins with no group stays what it is."""
    group, _, name = word.partition("_")
    return f"{group}.{name}" if group in _GROUPS else word


def encoded(text: str) -> bytes:
    """A text for the library, which takes NUL for its end."""
    encoded = os.fsencode(text)
    if b"\0" in encoded:
        raise BadInputError(f"{text!r}: there is a NUL in it")
    return encoded
