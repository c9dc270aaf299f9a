"""One folder of results, read from its results.nc.

Everything is kept in the file's units (ms, mm, kPa, N). Displacement traces stay on
disk until one case's is asked for, so large sweeps can be read.
"""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import numpy as np
import xarray as xr

from reedpost.namelist import Value, flat_values

FILE_NAME = "results.nc"
NEEDED = ("model", "status", "steady_mm", "fall_ms", "closing_ms", "zero_ms", "undershoot_mm")
EFFECTIVE = "effective_values"


class ResultError(Exception):
    """A folder whose results cannot be used; the text says which and why."""


def _words(variable: xr.DataArray) -> np.ndarray:
    """Names of a CF flag variable's values, one for each case."""
    meaning = dict(
        zip(
            np.atleast_1d(variable.attrs["flag_values"]).tolist(),
            str(variable.attrs["flag_meanings"]).split(),
            strict=True,
        )
    )
    codes = variable.values.astype(int)
    return np.array([meaning.get(code, f"code_{code}") for code in codes.tolist()], dtype=object)


def _text(value: bytes | str) -> str:
    """Characters of a NetCDF text, without padding."""
    text = value.decode("utf-8", "replace") if isinstance(value, bytes) else str(value)
    return text.rstrip("\0 ")


@dataclass(frozen=True)
class Result:
    """The cases of one run. Cases are counted from 0 here, from 1 in what users read."""

    folder: Path
    dataset: xr.Dataset
    effective: dict[str, Value | list[Value]]  # base values, `group.key` -> deck's unit
    model: np.ndarray  # name of each case's model
    status: np.ndarray  # 'ok', or why a case failed
    swept: dict[str, np.ndarray]  # `group.key` -> each case's value, deck's unit

    @property
    def count(self) -> int:
        """Number of cases."""
        return len(self.model)

    @property
    def models(self) -> list[str]:
        """Models present, in the order they appear."""
        return list(dict.fromkeys(self.model.tolist()))

    @property
    def has_traces(self) -> bool:
        """Whether displacement histories were stored."""
        return "time_ms" in self.dataset and "displacement_mm" in self.dataset

    @property
    def has_fields(self) -> bool:
        """Whether pressure fields of the film were stored."""
        return "film_pressure_kpa" in self.dataset

    def has_parts(self, case: int) -> bool:
        """Whether the forces on the reed's parts were stored; lumped models have none."""
        name = "part_a_n"
        return self.has_traces and name in self.dataset and bool(np.isfinite(self.trace(name, case)).any())

    def value(self, key: str, case: int) -> Value | list[Value] | None:
        """Effective value of a key in one case, in the deck's unit; None if unknown."""
        if key in self.swept:
            return self.swept[key][case]
        return self.effective.get(key)

    def values(self, key: str) -> np.ndarray:
        """A real key's value in every case, in the deck's unit; NaN if unknown."""
        if key in self.swept:
            return self.swept[key]
        base = self.effective.get(key)
        return np.full(self.count, base if isinstance(base, float) else np.nan)

    def measure(self, name: str) -> np.ndarray:
        """A measure of every case, in the unit its name ends in; NaN where it did not happen."""
        return self.dataset[name].values.astype(float)

    def message(self, case: int) -> str:
        """Why a case failed, or what it warns of; empty when all is well."""
        if "message" not in self.dataset:
            return ""
        return _text(self.dataset["message"].isel(case=case).values.item())

    def warnings(self) -> list[str]:
        """Names of the warnings that cases may carry."""
        return list(self._masks())

    def warned(self, name: str) -> np.ndarray:
        """Which cases carry a warning."""
        mask = self._masks().get(name, 0)
        return (self.measure("warnings").astype(int) & mask) != 0 if mask else np.zeros(self.count, bool)

    def _masks(self) -> dict[str, int]:
        if "warnings" not in self.dataset:
            return {}
        attributes = self.dataset["warnings"].attrs
        masks = np.atleast_1d(attributes.get("flag_masks", [])).astype(int)
        return dict(zip(str(attributes.get("flag_meanings", "")).split(), masks.tolist(), strict=False))

    def time(self) -> np.ndarray:
        """Times of the traces [ms]."""
        return self.dataset["time_ms"].values.astype(float)

    def trace(self, name: str, case: int) -> np.ndarray:
        """One case's trace in the unit its name ends in; NaN after the case's end."""
        return self.dataset[name].isel(case=case).values.astype(float)

    def attribute(self, name: str) -> str:
        """A global attribute as text; empty when there is none."""
        return _text(self.dataset.attrs.get(name, ""))

    def failures(self) -> list[tuple[int, str, str]]:
        """(case counted from 1, status, message) of every case that failed."""
        bad = np.flatnonzero(self.status != "ok")
        return [(int(i) + 1, str(self.status[i]), self.message(int(i))) for i in bad]


def _swept(dataset: xr.Dataset) -> dict[str, np.ndarray]:
    """The variables named like keys of a deck, one value a case."""
    swept = {}
    for name, variable in dataset.variables.items():
        if "." not in str(name) or variable.dims != ("case",):
            continue
        if variable.dtype.kind in "SUO":
            swept[str(name)] = np.array([_text(v) for v in variable.values], dtype=object)
        elif "flag_meanings" in variable.attrs:
            swept[str(name)] = _words(dataset[name])
        else:
            swept[str(name)] = variable.values.astype(float)
    return swept


def read_result(folder: str | Path) -> Result:
    """Open the results of one run. Raises ResultError when they cannot be used."""
    folder = Path(folder)
    path = folder / FILE_NAME
    if not folder.is_dir():
        raise ResultError(f"{folder}: no such folder")
    if not path.is_file():
        raise ResultError(f"{folder}: no {FILE_NAME} in it (an unfinished run?)")
    try:
        # Units like 'ms' are durations to xarray unless told otherwise.
        dataset = xr.open_dataset(path, engine="netcdf4", decode_times=False, decode_timedelta=False)
    except (OSError, ValueError) as error:
        raise ResultError(f"{path}: not a NetCDF file that can be read ({error})") from error
    lacking = [name for name in NEEDED if name not in dataset]
    if lacking:
        raise ResultError(f"{path}: not a result of reedvalve, it lacks {', '.join(lacking)}")
    if EFFECTIVE not in dataset.attrs:
        raise ResultError(f"{path}: the attribute {EFFECTIVE} is missing")
    try:
        effective = flat_values(str(dataset.attrs[EFFECTIVE]))
        model, status = _words(dataset["model"]), _words(dataset["status"])
    except (ValueError, KeyError) as error:
        raise ResultError(f"{path}: {error}") from error
    if not len(model):
        raise ResultError(f"{path}: holds no case")
    return Result(folder, dataset, effective, model, status, _swept(dataset))
