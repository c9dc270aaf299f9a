"""Many cases: their plan before the sweep, their columns after it."""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ._errors import BadInputError
from ._names import KEYS, MEASURES
from ._result import Status

_WORDS = np.array([status.word for status in Status])


def product(keys: Mapping[str, ArrayLike]) -> dict[str, NDArray[np.float64]]:
    """All combinations of the values of some keys, for :meth:`Valve.sweep`; the last key varies fastest.

    Each array gets an axis of its own, as :func:`numpy.ix_` does it, so that further keys can be added that vary along
    several of them.

    Args:
        keys: values of each key, one-dimensional, or a single one.

    Raises:
        BadInputError: a key's values are no numbers or have more than one axis.

    >>> plan = product({"pressure.inlet_kpa": [10.0, 20.0], "film.gap_mm": [0.03, 0.05, 0.07]})
    >>> [array.shape for array in plan.values()]
    [(2, 1), (1, 3)]
    """
    arrays = {name: _numbers(name, values) for name, values in keys.items()}
    for name, array in arrays.items():
        if array.ndim > 1:
            raise BadInputError(f"{name}: product takes values along one axis, not an array of shape {array.shape}")
    return dict(zip(arrays, np.ix_(*map(np.atleast_1d, arrays.values()))))


def _numbers(name: str, values: ArrayLike) -> NDArray[np.float64]:
    try:
        return np.asarray(values, dtype=np.float64)
    except (TypeError, ValueError):
        raise BadInputError(f"{name}: a sweep takes numbers, not {values!r:.60}") from None


class Plan:
    """The cases of a sweep: arrays of keys, broadcast against each other."""

    def __init__(self, keys: Mapping[str, ArrayLike]) -> None:
        self.arrays = {name: _numbers(name, values) for name, values in keys.items()}
        try:
            self.shape = np.broadcast_shapes(*(array.shape for array in self.arrays.values())) or (1,)
        except ValueError:
            shapes = ", ".join(f"{name} {array.shape}" for name, array in self.arrays.items())
            raise BadInputError(f"these arrays do not go together: {shapes}; see reedvalve.product") from None

    def values(self) -> NDArray[np.float64]:
        """One row a case, one column a key."""
        columns = [np.broadcast_to(array, self.shape).ravel() for array in self.arrays.values()]
        return np.stack(columns, axis=-1) if columns else np.empty((0, 0))

    def dims(self) -> tuple[str, ...]:
        """A name for each axis: the key that varies along it and nowhere else, if there is just one."""
        found = []
        for axis, length in enumerate(self.shape):
            alone = [name for name, array in self.arrays.items() if self._is_along(array, axis, length)]
            other = "case" if len(self.shape) == 1 else f"axis_{axis}"
            found.append(alone[0] if len(alone) == 1 and alone[0] not in found else other)
        return tuple(found)

    def _is_along(self, array: NDArray[np.float64], axis: int, length: int) -> bool:
        place = axis - len(self.shape) + array.ndim
        return 0 <= place < array.ndim and array.shape[place] == length == array.size


class SweepResult(dict[str, NDArray[Any]]):
    """Columns of all cases by name, those of summary.csv but for the message; each has one element a case.

    ``case`` counts from 1, ``model`` and ``status`` are words, then come the swept keys and the measures, NaN where
    something did not happen. ``pandas.DataFrame(result)`` takes it as it is, ``xarray.Dataset(result.variables())``
    with units, axes and coordinates.

    Attributes:
        shape: of the broadcast arrays of the sweep; columns run through it with the last axis fastest.
        dims: a name for each axis: the key that varies along it, else ``"case"`` or ``"axis_0"``, ``"axis_1"``, ...
        message: what the library warns of; empty: nothing.
    """

    shape: tuple[int, ...]
    dims: tuple[str, ...]
    message: str

    def __init__(
        self, plan: Plan, model: str, measures: NDArray[np.float64], status: NDArray[np.int32], message: str
    ) -> None:
        count = len(status)
        super().__init__(case=np.arange(1, count + 1), model=np.full(count, model))
        for name, array in plan.arrays.items():
            self[name.lower()] = np.broadcast_to(array, plan.shape).flatten()
        self.update(zip(MEASURES, measures.T.copy()))
        self["status"] = _WORDS[status]
        self.shape, self.dims, self.message = plan.shape, tuple(map(str.lower, plan.dims())), message

    @property
    def ok(self) -> NDArray[np.bool_]:
        """Which cases came to their end."""
        return np.asarray(self["status"] == Status.OK.word)

    def grid(self, name: str) -> NDArray[Any]:
        """A column in the sweep's shape."""
        return self[name].reshape(self.shape)

    def variables(self) -> dict[str, tuple[tuple[str, ...], NDArray[Any], dict[str, str]]]:
        """Dimensions, values and units of every column, as ``xarray.Dataset`` takes them.

        A key that alone varies along an axis is the coordinate of it.
        """
        made = {}
        for name in self:
            units = KEYS[name].unit if name in KEYS else MEASURES.get(name, "")
            values, dims = self.grid(name), self.dims
            if name in self.dims:
                axis = self.dims.index(name)
                values, dims = np.moveaxis(values, axis, 0).reshape(self.shape[axis], -1)[:, 0], (name,)
            made[name] = (dims, values, {"units": units} if units else {})
        return made

    def __repr__(self) -> str:
        failed = Counter(self["status"][~self.ok].tolist())
        tail = "none failed" if not failed else ", ".join(f"{count} {word}" for word, count in failed.items())
        shape = " x ".join(map(str, self.shape))
        return f"SweepResult({shape} cases, {tail}; columns {', '.join(self)})"
