"""The C library behind the package: where it is found, and its functions as ctypes knows them."""

from __future__ import annotations

import ctypes
import os
from ctypes import POINTER, c_char_p, c_double, c_int, c_size_t, c_void_p
from pathlib import Path
from typing import Any, Callable

INSTALLED = "libreedvalve.so.0.1"
LONGEST = 65536  # of a text that is taken from the library [byte]

_BUFFER = (c_char_p, c_size_t)
# Arguments of every function of reedvalve.h; arrays are given as addresses.
SIGNATURES: dict[str, tuple[Any, ...]] = {
    "rv_version_text": _BUFFER,
    "rv_valve_new": (POINTER(c_void_p),),
    "rv_valve_new_deck": (c_char_p, POINTER(c_void_p), *_BUFFER),
    "rv_valve_free": (POINTER(c_void_p),),
    "rv_valve_message": (c_void_p, *_BUFFER),
    "rv_valve_set_real": (c_void_p, c_char_p, c_double),
    "rv_valve_set_text": (c_void_p, c_char_p, c_char_p),
    "rv_valve_get_real": (c_void_p, c_char_p, POINTER(c_double)),
    "rv_valve_get_text": (c_void_p, c_char_p, *_BUFFER),
    "rv_valve_is_set": (c_void_p, c_char_p, POINTER(c_int)),
    "rv_key_count": (),
    "rv_key_name": (c_int, *_BUFFER),
    "rv_key_unit": (c_int, *_BUFFER),
    "rv_key_help": (c_int, *_BUFFER),
    "rv_key_kind": (c_int,),
    "rv_valve_run": (c_void_p,),
    "rv_valve_status": (c_void_p, POINTER(c_int)),
    "rv_valve_measure": (c_void_p, c_char_p, POINTER(c_double)),
    "rv_measure_count": (),
    "rv_measure_name": (c_int, *_BUFFER),
    "rv_measure_unit": (c_int, *_BUFFER),
    "rv_valve_fact": (c_void_p, c_char_p, POINTER(c_double)),
    "rv_fact_count": (),
    "rv_fact_name": (c_int, *_BUFFER),
    "rv_fact_unit": (c_int, *_BUFFER),
    "rv_valve_trace_size": (c_void_p, POINTER(c_size_t)),
    "rv_valve_trace_times": (c_void_p, c_void_p, c_size_t),
    "rv_valve_trace": (c_void_p, c_int, c_void_p, c_size_t),
    "rv_trace_count": (),
    "rv_trace_name": (c_int, *_BUFFER),
    "rv_trace_unit": (c_int, *_BUFFER),
    "rv_sweep": (c_void_p, c_int, POINTER(c_char_p), c_size_t, c_void_p, c_void_p, c_void_p, c_int),
    "rv_valve_begin": (c_void_p, c_double),
    "rv_valve_step": (c_void_p, c_double, c_double, c_double, c_double, c_double),
    "rv_valve_output": (c_void_p, c_int, POINTER(c_double)),
    "rv_valve_dofs": (c_void_p, POINTER(c_int)),
    "rv_valve_state": (c_void_p, POINTER(c_double), c_void_p, c_void_p, POINTER(c_double)),
    "rv_valve_state_size": (c_void_p, POINTER(c_size_t)),
    "rv_valve_state_save": (c_void_p, c_void_p, c_size_t),
    "rv_valve_state_restore": (c_void_p, c_char_p, c_size_t),
}


def candidates() -> list[str]:
    """Where the library may be: as REEDVALVE_LIBRARY says and only there, or in the package, its tree or installed."""
    named = os.environ.get("REEDVALVE_LIBRARY")
    if named:
        return [named]
    here = Path(__file__).parent
    beside = os.path.normpath(here / "../../.." / INSTALLED)  # the package is in lib/python3/dist-packages
    return [str(here / "libreedvalve.so"), beside, INSTALLED]


def load() -> ctypes.CDLL:
    """The first library that can be loaded, with the arguments of its functions declared.

    Raises ImportError, with what was tried, when there is none or when it lacks a function.
    """
    troubles = []
    names = candidates()
    for name in names:
        try:
            library = ctypes.CDLL(name)
            for function, arguments in SIGNATURES.items():
                getattr(library, function).argtypes = arguments
        except (OSError, AttributeError) as trouble:
            troubles.append(str(trouble))
        else:
            return library
    if len(names) == 1:
        raise ImportError(f"REEDVALVE_LIBRARY names '{names[0]}', which cannot be loaded: {troubles[0]}")
    raise ImportError(
        "the library of reedvalve cannot be loaded; REEDVALVE_LIBRARY may name it:\n   " + "\n   ".join(troubles)
    )


def take_text(function: Callable[..., int], *words: Any) -> tuple[int, str]:
    """Call a function that ends in a buffer for a text; its code and the text."""
    buffer = ctypes.create_string_buffer(LONGEST)
    code = function(*words, buffer, LONGEST)
    return code, buffer.value.decode("utf-8", "replace")


LIB = load()
VERSION = take_text(LIB.rv_version_text)[1]
