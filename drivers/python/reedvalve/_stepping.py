"""A valve stepped under the pressures of another program; all in SI."""

from __future__ import annotations

import ctypes
import numbers
from typing import Any, Union

import numpy as np
from numpy.typing import NDArray

from ._errors import BadInputError, warn
from ._library import LIB
from ._settings import Settings

Pressure = Union[float, tuple[float, float]]


class Stepping(Settings):
    """Time, outputs and state of a valve that is stepped; see Valve."""

    def begin(self, t: float = 0.0) -> None:
        """Begin stepping at a time, at rest; with ``run.start = 'equilibrium'`` at the equilibrium under the first
        step's first pressures.

        The tolerance ``solver.rtol`` is relative to the motion under the largest pressure difference of the valve's own
        pressure history: set ``pressure.inlet_kpa`` and ``pressure.outlet_kpa`` to what is to be expected.

        Args:
            t: time [s].

        Raises:
            BadInputError: the time is not finite, or settings do not go together.
            DomainError: the film is closed from the start.
        """
        with self._lock:
            self._check(LIB.rv_valve_begin(self._handle, float(t)))
            warn(self._message())

    def step(self, t_end: float, p_in: Pressure, p_out: Pressure = 0.0) -> None:
        """Go on to a later time under pressures that are constant or straight lines over the step.

        Args:
            t_end: time to go to [s].
            p_in: inlet pressure [Pa]; or a pair, of now and of t_end.
            p_out: outlet pressure [Pa], likewise.

        Raises:
            BadInputError: time does not go on, a number is not finite, stepping was not begun or has failed. All is
                then as it was.
            NotConvergedError, DomainError: the integration failed; only :meth:`restore` or :meth:`begin` lead on.
        """
        with self._lock:
            self._check(LIB.rv_valve_step(self._handle, float(t_end), *_pair(p_in), *_pair(p_out)))

    @property
    def is_stepping(self) -> bool:
        """Whether stepping was begun since the last setting."""
        dofs = ctypes.c_int()
        with self._lock:
            return bool(LIB.rv_valve_dofs(self._handle, ctypes.byref(dofs)) == 0)

    @property
    def time(self) -> float:
        """Time reached [s]."""
        t = ctypes.c_double()
        with self._lock:
            self._check(LIB.rv_valve_state(self._handle, ctypes.byref(t), None, None, None))
        return t.value

    @property
    def displacement(self) -> float:
        """Displacement of the tip [m], positive when open."""
        return self._output(0)

    @property
    def velocity(self) -> float:
        """Velocity of the tip [m/s]."""
        return self._output(1)

    @property
    def inlet(self) -> float:
        """Inlet pressure [Pa]; NaN before the first step, as all that follow."""
        return self._output(2)

    @property
    def outlet(self) -> float:
        """Outlet pressure [Pa]."""
        return self._output(3)

    @property
    def film_force(self) -> float:
        """Force of the film against the motion, referred to the tip [N]; positive against closing."""
        return self._output(4)

    @property
    def part_a(self) -> float:
        """Pressure force on the land between clamp and hole [N]; NaN without a film model, as all that follow."""
        return self._output(5)

    @property
    def part_b(self) -> float:
        """Pressure force on the rest of the land [N]."""
        return self._output(6)

    @property
    def part_c(self) -> float:
        """Pressure force over the hole [N]."""
        return self._output(7)

    @property
    def leakage(self) -> float:
        """Flow out of the film at the free edges [m3/s]."""
        return self._output(8)

    @property
    def film_low(self) -> float:
        """Lowest pressure in the film [Pa]."""
        return self._output(9)

    def _output(self, which: int) -> float:
        value = ctypes.c_double()
        with self._lock:
            self._check(LIB.rv_valve_output(self._handle, which, ctypes.byref(value)))
        return value.value

    @property
    def coordinates(self) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        """Displacement [m] and velocity [m/s] of every degree of freedom: one, or one a mode of the film model."""
        dofs = ctypes.c_int()
        with self._lock:
            self._check(LIB.rv_valve_dofs(self._handle, ctypes.byref(dofs)))
            q, v = np.empty(dofs.value), np.empty(dofs.value)
            self._check(LIB.rv_valve_state(self._handle, None, q.ctypes.data, v.ctypes.data, None))
        return q, v

    def state(self) -> bytes:
        """The state as bytes, for valves of the same model and size on the same kind of machine."""
        size = ctypes.c_size_t()
        with self._lock:
            self._check(LIB.rv_valve_state_size(self._handle, ctypes.byref(size)))
            room = ctypes.create_string_buffer(size.value)
            self._check(LIB.rv_valve_state_save(self._handle, room, size.value))
        return room.raw

    def restore(self, state: bytes) -> None:
        """Go back to a state; steps from there give the same bits.

        Raises:
            BadInputError: stepping was not begun, or these are not the bytes of a state of such a valve.
        """
        kept = memoryview(state).tobytes()
        with self._lock:
            self._check(LIB.rv_valve_state_restore(self._handle, kept, len(kept)))


def _pair(pressure: Pressure) -> tuple[float, float]:
    """Pressures at the start and at the end of a step."""
    given: Any = pressure
    try:
        is_one = isinstance(given, numbers.Real) or np.ndim(given) == 0
        start, end = (given, given) if is_one else given
        return float(start), float(end)
    except (TypeError, ValueError):
        raise BadInputError(f"a pressure is a number or a pair of numbers, not {pressure!r:.60}") from None
