"""Find out what a result holds: which study of the paper, and where its cases are.

A result may sweep more than the paper did (a viscosity, say). The cases that agree in
all such further keys form a variant, and each variant is compared by itself.
"""

from __future__ import annotations

import re
from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from reedpost import paper
from reedpost.results import Result

AXES = ("pressure.inlet_kpa", "film.gap_mm", "pressure.file")  # what the studies sweep
PRESSURE_SWEEP, GAP_STUDY, EXPERIMENT, FIELDS = "pressure sweep", "gap study", "experiment", "fields"
FIELD_GAPS_MM = (0.05, 0.20)  # Figs. 6 and 7; fields at no more gaps than these are not the gap study
RATE_TOLERANCE = 0.5  # Table V prints the fall rates as whole kPa/ms


@dataclass(frozen=True)
class Variant:
    """Cases of one result that differ in model and the studied axes only."""

    result: Result
    cases: np.ndarray  # indices
    label: str  # 'fluid.viscosity_pa_s = 0.02', empty when nothing else is swept

    @property
    def models(self) -> list[str]:
        """Models present, in the order they appear."""
        return list(dict.fromkeys(self.result.model[self.cases].tolist()))

    def cases_of(self, model: str) -> np.ndarray:
        """Indices of the cases of one model."""
        return self.cases[self.result.model[self.cases] == model]

    def axis(self, key: str) -> np.ndarray:
        """The distinct values of a real key among the cases, rising."""
        values = self.result.values(key)[self.cases]
        return np.unique(values[~np.isnan(values)])

    @property
    def is_the_papers(self) -> bool:
        """Whether the valve is the paper's; if not, its points do not belong beside it."""
        return paper.is_the_valve(self.result, int(self.cases[0]))

    @property
    def gap_to_draw(self) -> float:
        """The finite elements' gap [mm], or the narrowest of a result that does not hold it."""
        gaps = self.axis("film.gap_mm")
        if not len(gaps) or np.isclose(gaps, paper.GAP_MM, rtol=1e-6).any():
            return paper.GAP_MM
        return float(gaps[0])

    @property
    def gaps_to_draw(self) -> list[float]:
        """Gaps of a gap study [mm]: all; of too many those of the paper, or some from the narrowest to the widest."""
        gaps, most = self.axis("film.gap_mm"), len(paper.GAP_STUDY_MM)
        if len(gaps) > most:
            own = np.isclose(gaps[:, None], paper.GAP_STUDY_MM, rtol=1e-6).any(axis=1)
            gaps = gaps[own] if own.sum() > 1 else gaps[np.linspace(0, len(gaps) - 1, most).round().astype(int)]
        return gaps.tolist()

    @property
    def pressure_to_draw(self) -> float:
        """Inlet pressure of a gap study [kPa]: the paper's, or the lowest of a result that does not hold it."""
        pressures = self.axis("pressure.inlet_kpa")
        near = np.isclose(pressures, paper.GAP_STUDY_KPA, rtol=1e-6)
        return float(pressures[near][0] if near.any() else pressures[0])

    def find(self, model: str, inlet_kpa: float, gap_mm: float) -> int | None:
        """The case of `model` at a pressure and a gap; None when there is none.

        A result whose models have no film has no gap either: every gap is its own then.
        """
        cases = self.cases_of(model)
        inlet = self.result.values("pressure.inlet_kpa")[cases]
        gap = self.result.values("film.gap_mm")[cases]
        near = np.isclose(inlet, inlet_kpa, rtol=1e-6, atol=0.0)
        near &= np.isnan(gap) | np.isclose(gap, gap_mm, rtol=1e-6, atol=0.0)
        return int(cases[near][0]) if near.any() else None


def variants(result: Result) -> list[Variant]:
    """The cases of a result, grouped by the keys that no study of the paper sweeps."""
    extra = [key for key in result.swept if key not in AXES and key != "run.model"]
    groups: dict[tuple, list[int]] = {}
    for case in range(result.count):
        groups.setdefault(tuple(result.swept[key][case] for key in extra), []).append(case)
    return [
        Variant(
            result,
            np.array(cases),
            ", ".join(
                f"{key} = {value:g}" if isinstance(value, float) else f"{key} = {value}"
                for key, value in zip(extra, values, strict=True)
            ),
        )
        for values, cases in groups.items()
    ]


def studies(variant: Variant) -> list[str]:
    """Which studies of the paper the cases belong to, by what they sweep."""
    if variant.result.effective.get("pressure.kind") == "trace":
        return [EXPERIMENT]
    pressures = variant.axis("pressure.inlet_kpa")
    gaps = variant.axis("film.gap_mm")
    found = [FIELDS] if variant.result.has_fields else []
    if len(pressures) > 1 or (len(gaps) < 2 and not found):
        found.append(PRESSURE_SWEEP)
    if len(gaps) > (len(FIELD_GAPS_MM) if FIELDS in found else 1):
        found.append(GAP_STUDY)
    return found


@dataclass(frozen=True)
class TraceCase:
    """A case under a pressure trace and the condition of Table V it belongs to."""

    case: int
    condition: int | None  # None: no published condition has its fall rate
    rate: float  # mean fall of p_in - p_out after Eq. (28) [kPa/ms]; NaN when not recorded
    file: str  # name of its trace file, empty when unknown


def fall_rate(result: Result, case: int) -> float:
    """Mean fall rate of p_in - p_out of a recorded case, Eq. (28) [kPa/ms]; NaN if unknown."""
    event = result.value("pressure.event_ms", case)
    if not result.has_traces or not isinstance(event, float):
        return np.nan
    time = result.time()
    drop = result.trace("inlet_kpa", case) - result.trace("outlet_kpa", case)
    known = np.isfinite(drop)
    at = np.array([event + paper.RATE_FROM_MS, event + paper.RATE_TO_MS])
    if not known.any() or at[0] < time[known][0] or at[1] > time[known][-1]:
        return np.nan
    early, late = np.interp(at, time[known], drop[known])
    return float((early - late) / (paper.RATE_TO_MS - paper.RATE_FROM_MS))


def trace_case(result: Result, case: int) -> TraceCase:
    """Recognise the condition of Table V: by the fall rate, else by the trace file's name."""
    file = result.value("pressure.file", case)
    file = file if isinstance(file, str) else ""
    rate = fall_rate(result, case)
    condition = None
    if np.isfinite(rate):
        for row in paper.table("table_5_experiment"):
            if abs(rate - row["rate_kpa_per_ms"]) <= RATE_TOLERANCE:
                condition = int(row["condition"])
    elif match := re.search(r"condition[ _-]?([1-3])(?!\d)", file):
        condition = int(match[1])
    return TraceCase(case, condition, rate, file)


def is_monotone_fall(values: np.ndarray) -> bool:
    """Whether each value is below the one before it."""
    return all(later < earlier for earlier, later in pairwise(values))
