"""What comes out of one case."""

from __future__ import annotations

import enum
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from ._errors import BadInputError
from ._names import MEASURES


class Status(enum.IntEnum):
    """How a case ended; :attr:`word` is what summary.csv says."""

    OK = 0
    STEP_TOO_SMALL = 1
    FILM_CLOSED = 2
    NOT_FINITE = 3
    TOO_MANY_STEPS = 4
    NO_CONVERGENCE = 5
    BAD_CASE = 6

    @property
    def word(self) -> str:
        """The name in lower case, ``"film_closed"``."""
        return self.name.lower()


class Traces(dict[str, NDArray[np.float64]]):
    """Histories by name, all of one length, ``time_ms`` first; ``pandas.DataFrame(traces)`` takes them as they are."""

    def __missing__(self, name: str) -> NDArray[np.float64]:
        if not self:
            raise BadInputError(f"{name!r}: there are no traces; set run.traces to True before the run")
        raise KeyError(name)


@dataclass(frozen=True, repr=False, eq=False)
class Result:
    """One case: how it ended, its measures and, if ``run.traces`` was set, its histories.

    A measure that did not happen, such as the closing of a valve that never opened, is NaN.

    Attributes:
        status: how the case ended.
        message: what the library warns of, or why the case failed; empty: nothing.
        steady_mm: static tip displacement under the pressure at the start of the closing event [mm].
        rise_ms: rise from 10 to 90 % of it [ms].
        opening_ms: from the start of the run to 98 % of it [ms].
        overshoot_mm: largest displacement above it before the closing event [mm], >= 0.
        fall_ms: fall from 90 to 10 % of it [ms].
        closing_ms: from the closing event to 2 % of it [ms].
        zero_ms: from the closing event to zero displacement [ms].
        undershoot_mm: largest displacement below the rest position after the closing event [mm], >= 0.
        peak_squeeze_n: largest force of the film against closing [N].
        facts: the model's numbers behind the case by name, see :data:`reedvalve.FACTS`: stiffness, masses, damping,
            frequency; ``solver_method`` is 1 after an implicit integration, 2 after an explicit one.
        traces: arrays by name, see :data:`reedvalve.TRACES`; NaN where the case did not get to.
    """

    status: Status
    message: str
    steady_mm: float
    rise_ms: float
    opening_ms: float
    overshoot_mm: float
    fall_ms: float
    closing_ms: float
    zero_ms: float
    undershoot_mm: float
    peak_squeeze_n: float
    facts: dict[str, float] = field(default_factory=dict)
    traces: Traces = field(default_factory=Traces)

    @property
    def measures(self) -> dict[str, float]:
        """The measures by name, in the order of summary.csv; :data:`reedvalve.MEASURES` has their units."""
        return {name: getattr(self, name) for name in MEASURES}

    def __repr__(self) -> str:
        words = [f"{name}={value:.6g}" for name, value in self.measures.items()]
        if self.traces:
            words.append(f"traces={len(self.traces)} of {len(self.traces['time_ms'])} samples")
        return f"Result({self.status.word}, {', '.join(words)})"
