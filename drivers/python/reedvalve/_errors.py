"""What goes wrong, as exceptions. Each is also one of Python's own, for callers that know no other."""

from __future__ import annotations

import os
import re
import sys
import warnings
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from ._result import Result


class ReedvalveWarning(UserWarning):
    """Something is allowed but unusual: a value that looks like another unit, a key without effect on the model, a
    case outside the range of a formula."""


class ReedvalveError(Exception):
    """Something failed.

    Attributes:
        code: the library's error code, an ``rv_code`` of ``reedvalve.h``.
        message: what, where, and with which numbers.
        result: of a case that failed in :meth:`Valve.run`, what there is of it; else None.
    """

    code = 5

    def __init__(self, message: str = "", result: Result | None = None) -> None:
        super().__init__(message)
        self.message = message
        self.result = result

    def __str__(self) -> str:
        return self.message  # KeyError would put it in quotes


class BadInputError(ReedvalveError, ValueError):
    """A value is not allowed, keys do not go together, or a call is out of order (code 1)."""

    code = 1


class UnknownKeyError(BadInputError, KeyError):
    """There is no such key (code 1)."""


class FileError(ReedvalveError, OSError):
    """A deck or a pressure trace cannot be read (code 2)."""

    code = 2


class NotConvergedError(ReedvalveError, ArithmeticError):
    """The time integration gave up (code 3)."""

    code = 3


class DomainError(ReedvalveError, ArithmeticError):
    """The case left the model's domain: the film closed, or a number is not finite (code 4)."""

    code = 4


class InternalError(ReedvalveError, RuntimeError):
    """A fault of the library (code 5)."""

    code = 5


_KINDS = {kind.code: kind for kind in (BadInputError, FileError, NotConvergedError, DomainError, InternalError)}


def error_of(code: int, message: str, result: Result | None = None) -> ReedvalveError:
    """The exception of an error code."""
    return _KINDS.get(code, InternalError)(message, result)


def warn(message: str) -> None:
    """A warning of the library, if there is one, at the line that called the package; that it is one its kind says."""
    if not message:
        return
    level, frame, folder = 1, sys._getframe(), os.path.dirname(__file__)
    while frame.f_back is not None and os.path.dirname(frame.f_code.co_filename) == folder:
        level, frame = level + 1, frame.f_back
    warnings.warn(re.sub(r"^warning: ", "", message, flags=re.MULTILINE), ReedvalveWarning, stacklevel=level)
