"""One valve: whole cases and sweeps, on top of its settings and its stepping."""

from __future__ import annotations

import ctypes
import operator
import warnings
from collections.abc import Mapping
from typing import Any, Callable

import numpy as np
from numpy.typing import ArrayLike

from ._errors import ReedvalveWarning, UnknownKeyError, error_of, warn
from ._library import LIB
from ._names import FACTS, MEASURES, TRACES
from ._result import Result, Status, Traces
from ._settings import Value, encoded
from ._stepping import Stepping
from ._sweep import Plan, SweepResult


class Valve(Stepping):
    """A reed valve with the settings of a deck, or with the defaults, which are the paper's valve.

    Keys are read and set as items, in the unit that their name ends in: ``valve["film.gap_mm"] = 0.03``. Iteration and
    ``dict(valve)`` go over all keys, in the order of docs/decks.md; :data:`reedvalve.KEYS` tells what they mean.
    Results are not kept in the valve; a new setting ends stepping.

    A valve may be used by several threads: their calls wait for each other. Different valves compute at the same time,
    for the interpreter's lock is not held meanwhile. :func:`copy.copy` and :mod:`pickle` make another valve with the
    same settings and state. Memory is given back with :meth:`close`, at the end of a ``with`` block, or with the
    object.

    Args:
        deck: path of a deck of one case; None: the defaults.
        keys: settings on top of it, named ``film_gap_mm`` or, from a dictionary, ``film.gap_mm``.

    Raises:
        BadInputError: the deck has faults (all are told) or more than one case, or a value is not allowed.
        UnknownKeyError: there is no such key.
        FileError: the deck cannot be read.

    >>> valve = Valve(film_gap_mm=0.03)
    >>> valve["pressure.inlet_kpa"] = 30.0
    >>> valve["film.gap_mm"], valve["run.model"], valve["film.modes"], valve["run.traces"]
    (0.03, 'squeeze', 4, False)
    """

    def run(self) -> Result:
        """Run the case under its own pressure history, to ``run.t_end_ms``.

        Raises:
            BadInputError: settings do not go together, or the pressure trace has faults.
            FileError: the pressure trace cannot be read.
            NotConvergedError, DomainError: the case failed; ``error.result`` has what there is of it.

        >>> round(Valve(film_gap_mm=0.03).run().closing_ms, 1)
        12.6
        """
        with self._lock:
            code = LIB.rv_valve_run(self._handle)
            message = self._message()
            status = ctypes.c_int()
            if LIB.rv_valve_status(self._handle, ctypes.byref(status)) != 0:
                raise error_of(code, message)
            measures = {name: self._number(LIB.rv_valve_measure, name) for name in MEASURES}
            facts = {name: self._number(LIB.rv_valve_fact, name) for name in FACTS}
            result = Result(Status(status.value), message, **measures, facts=facts, traces=self._traces())
        if code != 0:
            raise error_of(code, message, result)
        warn(message)
        return result

    def _number(self, function: Callable[..., int], name: str) -> float:
        """A measure or a fact of the last run."""
        value = ctypes.c_double()
        self._check(function(self._handle, encoded(name), ctypes.byref(value)))
        return value.value

    def _traces(self) -> Traces:
        samples = ctypes.c_size_t()
        self._check(LIB.rv_valve_trace_size(self._handle, ctypes.byref(samples)))
        traces = Traces()
        if samples.value == 0:
            return traces
        time = np.empty(samples.value)
        self._check(LIB.rv_valve_trace_times(self._handle, time.ctypes.data, time.size))
        traces["time_ms"] = 1e3 * time
        for i, name in enumerate(list(TRACES)[1:]):
            values = np.empty(samples.value)
            if LIB.rv_valve_trace(self._handle, i, values.ctypes.data, values.size) != 0:
                break  # the lumped models have the first of them only
            traces[name] = values
        return traces

    def sweep(self, keys: Mapping[str, ArrayLike], *, threads: int = 0) -> SweepResult:
        """Run many cases that differ from this valve in some real keys, side by side and without files.

        Cases that fail do not make the call fail: their status says how they ended. All else is as ``reedvalve run``
        does it with a deck of the same cases, to the last bit. The interpreter's lock is not held; a Ctrl-C is looked
        at when the sweep is over.

        Args:
            keys: for each key its values in its unit: arrays that are broadcast against each other, one element a
                case. :func:`reedvalve.product` makes all combinations.
            threads: 0: as many as OpenMP offers. Their number does not change a bit of the results.

        Raises:
            BadInputError: a key cannot vary, a value is not allowed, shapes do not go together; no case is run then.

        >>> Valve().sweep({"film.gap_mm": [0.03, 0.05, 0.07]})["closing_ms"].round(1).tolist()
        [12.6, 4.1, 2.1]
        """
        plan = Plan(keys)
        values = plan.values()
        names = (ctypes.c_char_p * len(plan.arrays))(*map(encoded, plan.arrays))
        measures = np.empty((len(values), len(MEASURES)))
        status = np.empty(len(values), dtype=np.int32)
        with self._lock:
            for name in plan.arrays:
                if name not in self:
                    raise UnknownKeyError(self._advice(name))
            self._check(
                LIB.rv_sweep(self._handle, len(names), names, len(values), values.ctypes.data, measures.ctypes.data,
                             status.ctypes.data, max(-1, min(operator.index(threads), 2**31 - 1)))
            )  # fmt: skip
            message = self._message()
            model = str(self["run.model"])
        warn(message)
        return SweepResult(plan, model, measures, status, message)

    def __reduce__(self) -> tuple[Any, ...]:
        with self._lock:
            state = (self.time, self.state()) if self.is_stepping else None
            return _rebuilt, (type(self), self.settings(), state)


def _rebuilt(kind: type[Valve], settings: dict[str, Value], state: tuple[float, bytes] | None) -> Valve:
    """A valve from its settings and state."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", ReedvalveWarning)  # they were told when the settings were made
        valve = kind(None, **settings)
        if state is not None:
            valve.begin(state[0])
            valve.restore(state[1])
    return valve
