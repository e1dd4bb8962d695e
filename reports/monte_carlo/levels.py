"""Bias, scatter, coverage and refusals of many trials, level by level."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from itertools import pairwise, product

import numpy as np

from monte_carlo.design import LEVELS
from monte_carlo.trial import Trial

BOUNDS = (0.0, 0.001, 0.003, float("inf"))
"""Cramér–Rao errors of e between which refusals are counted: below the first a value is wanted, above the last none."""


EIGHT = 8
"""Usable impacts with which at most 5 % of the records may be refused."""

Condition = Callable[[Trial], bool]

SCATTERS: dict[str, Condition] = {
    "0": lambda trial: trial.draw.scatter == 0,
    "0–0.001": lambda trial: 0 < trial.draw.scatter <= 0.001,
    "0.001–0.002": lambda trial: 0.001 < trial.draw.scatter <= 0.002,
    "0.002–0.005": lambda trial: trial.draw.scatter > 0.002,
}
COLOURS: dict[str, Condition] = {
    "white": lambda trial: trial.draw.pink == 0,
    "1/f": lambda trial: trial.draw.pink > 0,
}
FILTERS: dict[str, Condition] = {
    "without": lambda trial: not trial.draw.filtered,
    "with": lambda trial: trial.draw.filtered,
}
LENGTHS: dict[str, Condition] = {
    "5–9 impacts": lambda trial: trial.draw.impacts < 10,
    "10–60 impacts": lambda trial: trial.draw.impacts >= 10,
}
"""Levels of what has none in `LEVELS`, by name."""


@dataclass(frozen=True)
class Judged:
    """
    Trials of one level, or of all.

    Attributes
    ----------
    factor, level : str
    records, recommended : int
    bias, bias_error, scatter : float
        Mean of recommended − true e, its standard error, and the root mean square.
    coverage, coverage_error : float
        Share of the 95 % intervals that hold the truth, and its binomial standard error.
    held_of_all : float
        The same share of all records: a refusal does not hold the truth.
    refused : float
        Share without a value.
    eight, refused_of_eight : int, float
        Records with eight usable impacts or more, and the share of them without a value.
    width, best_width : float
        Median width of the intervals, and of the best that could be had of the same records.
    naive_answers : int
        Recommended records that the naive way gives a value for.
    naive_bias, naive_scatter : float
        Of the naive way on those.
    margin : float
        Scatter of the naive way over ours, on those.
    """

    factor: str
    level: str
    records: int
    recommended: int
    bias: float
    bias_error: float
    scatter: float
    coverage: float
    coverage_error: float
    held_of_all: float
    refused: float
    eight: int
    refused_of_eight: float
    width: float
    best_width: float
    naive_answers: int
    naive_bias: float
    naive_scatter: float
    margin: float


def judge(trials: list[Trial], factor: str = "all", level: str = "all") -> Judged:
    """Take the figures of these trials; they are NaN where there is too little to take them from."""
    answered = [trial for trial in trials if trial.answered]
    errors = np.array([trial.error for trial in answered])
    naive = np.array([trial.naive - trial.truth for trial in answered])
    both = np.isfinite(naive)
    count = len(answered)
    coverage = float(np.mean([trial.holds for trial in answered])) if count else float("nan")
    eight = [trial for trial in trials if trial.impacts >= EIGHT]
    ours, theirs = _root_mean_square(errors[both]), _root_mean_square(naive[both])
    return Judged(
        factor,
        level,
        len(trials),
        count,
        float(errors.mean()) if count else float("nan"),
        float(errors.std(ddof=1) / np.sqrt(count)) if count > 1 else float("nan"),
        _root_mean_square(errors),
        coverage,
        float(np.sqrt(coverage * (1 - coverage) / count)) if count else float("nan"),
        sum(trial.holds for trial in answered) / len(trials) if trials else float("nan"),
        1 - count / len(trials) if trials else float("nan"),
        len(eight),
        float(np.mean([not trial.answered for trial in eight])) if eight else float("nan"),
        float(np.median([trial.width for trial in answered])) if count else float("nan"),
        float(np.nanmedian([trial.best_width for trial in answered])) if count else float("nan"),
        int(both.sum()),
        float(naive[both].mean()) if both.any() else float("nan"),
        theirs,
        theirs / ours if both.any() and ours > 0 else float("nan"),
    )


def judge_levels(trials: list[Trial]) -> list[Judged]:
    """Judge all trials, then each level of each factor, with and without filter, and each recommended estimator."""
    found = [judge(trials)]
    for factor, edges in LEVELS.items():
        if factor == "scatter":
            continue
        for low, high in pairwise(edges):
            inside = [trial for trial in trials if low <= getattr(trial.draw, factor) < high]
            last = high - 1 if factor == "impacts" else high
            found.append(judge(inside, factor, f"{low:g}–{last:g}"))
    for name, has in SCATTERS.items():
        found.append(judge([trial for trial in trials if has(trial)], "scatter", name))
    for name, has in COLOURS.items():
        found.append(judge([trial for trial in trials if has(trial)], "colour", name))
    for name, has in FILTERS.items():
        found.append(judge([trial for trial in trials if has(trial)], "low-pass", name))
    for name in sorted({trial.recommended for trial in trials if trial.answered}):
        found.append(judge([trial for trial in trials if trial.recommended == name], "recommended", name or "unnamed"))
    return found


def judge_kinds(trials: list[Trial]) -> list[Judged]:
    """Judge by scatter of e, noise and filter together, then by scatter and length."""
    found = []
    for scatter, first in SCATTERS.items():
        for parts in (product(COLOURS.items(), FILTERS.items()), ((each,) for each in LENGTHS.items())):
            for chosen in parts:
                inside = [trial for trial in trials if first(trial) and all(has(trial) for _, has in chosen)]
                found.append(judge(inside, f"scatter {scatter}", ", ".join(name for name, _ in chosen)))
    return found


def judge_bounds(trials: list[Trial], factor: str) -> list[Judged]:
    """Judge the trials apart by the Cramér–Rao error of e; `factor` says which trials they are."""
    return [
        judge([trial for trial in trials if low <= trial.bound < high], factor, _between(low, high))
        for low, high in pairwise(BOUNDS)
    ]


def judge_estimators(trials: list[Trial]) -> list[Judged]:
    """Judge every estimator on its own, wherever it gives a value."""
    found = []
    for name in sorted({name for trial in trials for name in trial.estimates}):
        own = [
            replace(each, **dict(zip(("value", "low", "high"), each.estimates[name], strict=True)), recommended=name)
            for each in trials
            if name in each.estimates
        ]
        found.append(judge(own, "estimator", name))
    return found


def _between(low: float, high: float) -> str:
    if low == 0:
        return f"below {high:g}"
    return f"above {low:g}" if np.isinf(high) else f"{low:g}–{high:g}"


def _root_mean_square(values: np.ndarray) -> float:
    return float(np.sqrt(np.mean(values**2))) if values.size else float("nan")
