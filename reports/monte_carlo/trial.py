"""One record through the identification, beside its truth, its bound and the naive way."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from scipy import stats

import colonnade
from monte_carlo.bound import cramer_rao_error
from monte_carlo.design import LEVELS, Draw, draw
from monte_carlo.naive import naive_restitution

NORMAL = float(stats.norm.ppf(0.975))


@dataclass(frozen=True)
class Trial:
    """
    What became of one record.

    Attributes
    ----------
    draw : Draw
    value, low, high : float
        The recommended e and its interval; NaN where refused.
    truth : float
        The mean e: of all impacts that there could be; where e depends on the speed, of those that the value is from.
    sample_error : float
        Standard error of the mean of the true e of the usable impacts; NaN of fewer than two.
    impacts : int
        Usable: between the arcs that stand out of the noise, all others included that a value was taken from.
    naive, bound : float
        e read off naively; the Cramér–Rao error with one e for all impacts.
    estimates : dict of str to (float, float, float)
        Value and interval of every estimator; NaN where it refused.
    recommended, reason : str
        Name of the recommended estimator; why refused.
    departures : tuple of str
        Names of those that were found.
    """

    draw: Draw
    value: float
    low: float
    high: float
    truth: float
    sample_error: float
    impacts: int
    naive: float
    bound: float
    estimates: dict[str, tuple[float, float, float]]
    recommended: str
    reason: str
    departures: tuple[str, ...] = ()

    @property
    def best_width(self) -> float:
        """
        Width of the best 95 % interval that could be had: Student's of the true e of the usable impacts, in quadrature
        with the one of the Cramér–Rao error.
        """
        if self.draw.scatter == 0:
            return 2 * NORMAL * self.bound
        if self.impacts < 2:
            return np.nan
        return 2 * float(np.hypot(stats.t.ppf(0.975, self.impacts - 1) * self.sample_error, NORMAL * self.bound))

    @property
    def width(self) -> float:
        """Of the interval; NaN where refused."""
        return self.high - self.low

    @property
    def error(self) -> float:
        """Of the recommended e."""
        return self.value - self.truth

    @property
    def holds(self) -> bool:
        """Whether the interval holds the truth."""
        return self.low <= self.truth <= self.high

    @property
    def answered(self) -> bool:
        """Whether an e was recommended."""
        return bool(np.isfinite(self.value))


def run(seed: int, number: int, levels: dict[str, tuple[float, ...]] = LEVELS, **changed: float) -> Trial:
    """Draw a record, changed in what is named, identify its e, and keep what is needed to judge that."""
    return tried(replace(draw(seed, number, levels), **changed))


def tried(drawn: Draw) -> Trial:
    """Identify e from one record, and keep what is needed to judge that."""
    time, angle = drawn.record()
    found = colonnade.identify_restitution(time, angle, drawn.block, lowpass=drawn.cutoff)
    true = true_restitutions(drawn, time, found)
    return Trial(
        drawn,
        *(_number(value) for value in (found.value, found.low, found.high)),
        float(true.mean()) if drawn.by_speed and true.size else drawn.restitution,
        float(true.std(ddof=1) / np.sqrt(true.size)) if true.size > 1 else np.nan,
        true.size,
        naive_restitution(angle, drawn.block.critical_angle),
        cramer_rao_error(drawn),
        {each.name: tuple(_number(value) for value in (each.value, each.low, each.high)) for each in found.estimates},
        found.recommended,
        found.reason,
        tuple(each.name for each in found.departures),
    )


def true_restitutions(drawn: Draw, time: np.ndarray, found: colonnade.Restitution) -> np.ndarray:
    """Return e of the usable impacts: those beside an arc that stands out, and those of the history laid through."""
    _, impacts, restitutions = drawn.motion(time)
    peaks = found.peaks.time[found.peaks.used]
    first, last = (peaks[0], peaks[-1]) if peaks.size else (np.inf, -np.inf)
    if found.recommended != "peaks" and found.history is not None:
        first, last = min(first, found.history.time[0]), max(last, found.history.time[-1])
    return restitutions[(impacts > first) & (impacts < last)]


def _number(value: float | None) -> float:
    return np.nan if value is None else value
