"""Dynamics of cantilever reed valves with squeeze flow.

A :class:`Valve` has the keys of a deck as items, each in the unit its name ends in. It runs whole cases
(:meth:`Valve.run`), many cases side by side (:meth:`Valve.sweep`), and goes step by step under the pressures of another
program (:meth:`Valve.begin`, :meth:`Valve.step`).

>>> import reedvalve
>>> valve = reedvalve.Valve()
>>> valve["film.gap_mm"] = 0.03
>>> f"It closes in {valve.run().closing_ms:.1f} ms."
'It closes in 12.6 ms.'

The models are those of M. Zhang, Y. Zhu, L. Li and J. Ling; docs/theory.md of the source has the equations.
"""

try:
    import numpy as _numpy  # noqa: F401
except ModuleNotFoundError as _trouble:
    raise ImportError("reedvalve needs NumPy: pip install numpy, or apt install python3-numpy") from _trouble

from ._errors import (
    BadInputError,
    DomainError,
    FileError,
    InternalError,
    NotConvergedError,
    ReedvalveError,
    ReedvalveWarning,
    UnknownKeyError,
)
from ._library import VERSION as __version__
from ._names import FACTS, KEYS, MEASURES, TRACES, Key, Kind, unit
from ._result import Result, Status, Traces
from ._sweep import SweepResult, product
from ._valve import Valve

__all__ = [
    "FACTS",
    "KEYS",
    "MEASURES",
    "TRACES",
    "BadInputError",
    "DomainError",
    "FileError",
    "InternalError",
    "Key",
    "Kind",
    "NotConvergedError",
    "ReedvalveError",
    "ReedvalveWarning",
    "Result",
    "Status",
    "SweepResult",
    "Traces",
    "UnknownKeyError",
    "Valve",
    "__version__",
    "product",
    "unit",
]

for _thing in list(globals().values()):
    if getattr(_thing, "__module__", "").startswith(f"{__name__}._"):
        _thing.__module__ = __name__  # where users find it, for tracebacks and help
del _thing
