"""What a forecast says of a test and what was observed in it: outcome and amplitude."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import get_args

import numpy as np
from numpy.typing import ArrayLike, NDArray

from colonnade.arrays import Array, Codes
from colonnade.dynamics.ensembles.ensemble import LARGEST_SEED
from colonnade.dynamics.history import NO_ROCKING_RATIO, Outcome
from colonnade.validation import described, number, samples, whole

OUTCOMES: tuple[Outcome, ...] = get_args(Outcome)
"""In order: each is more than the one before it."""

ROCKING, OVERTURNED = OUTCOMES.index("rocking"), OUTCOMES.index("overturned")


@dataclass(frozen=True)
class Response:
    """
    What was observed in one test.

    Attributes
    ----------
    outcome : int
        Place in `OUTCOMES`.
    amplitude : float
        min(max |θ|, α)/α: 0 if the specimen did not rock, 1 if it overturned.
    """

    outcome: int
    amplitude: float

    @classmethod
    def observed(cls, outcome: str, peak_ratio: float | None = None) -> Response:
        """
        Take an outcome and, if the specimen rocked and stands, its max |θ|/α.

        Raises
        ------
        ValueError
            If the outcome is not one of `OUTCOMES`, or the max |θ|/α is needed and missing.
        """
        if outcome not in OUTCOMES:
            raise ValueError(f"outcome is {described(outcome)}; one of {', '.join(OUTCOMES)} was expected")
        place = OUTCOMES.index(outcome)
        if place != ROCKING:
            return cls(place, float(place == OVERTURNED))
        ratio = number("peak_ratio", peak_ratio, "max |θ|/α, zero or more, of a specimen that rocked", low=0.0)
        return cls(place, min(ratio, 1.0))


@dataclass(frozen=True, eq=False)
class Forecast:
    """
    An ensemble of responses, all equally likely.

    Attributes
    ----------
    outcomes : ndarray of int, shape (m,)
        Of each member, its place in `OUTCOMES`.
    amplitudes : ndarray, shape (m,)
        Of each member, as of `Response`.
    """

    outcomes: Codes
    amplitudes: Array

    @property
    def overturning_probability(self) -> float:
        """Share of the members that overturn."""
        return float(np.mean(self.outcomes == OVERTURNED))


def forecast_of(peak_ratio: ArrayLike, overturning_time: ArrayLike) -> Forecast:
    """
    Take the members of an ensemble of a model as a forecast.

    Parameters
    ----------
    peak_ratio, overturning_time : array_like, shape (m,)
        As of `dynamics.ensembles`: max |θ|/α; s, NaN for a member that stands. The peak of one that overturned does
        not count.

    Returns
    -------
    forecast : Forecast

    Raises
    ------
    ValueError
        If the lengths differ, or a member stands and has no peak.

    Examples
    --------
    >>> forecast = forecast_of([0.0002, 0.4, float("nan")], [float("nan"), float("nan"), 3.1])
    >>> forecast.outcomes.tolist(), forecast.amplitudes.tolist()
    ([0, 1, 2], [0.0, 0.4, 1.0])
    """
    peaks = samples("peak_ratio", peak_ratio, gaps=True, each="member")
    times = samples("overturning_time", overturning_time, gaps=True, each="member")
    if peaks.size != times.size:
        raise ValueError(
            f"peak_ratio has {peaks.size} members and overturning_time {times.size}; one number was expected"
        )
    overturned = np.isfinite(times)
    if np.isnan(peaks[~overturned]).any():
        raise ValueError("a member stands and its peak_ratio is NaN; its max |θ|/α was expected")
    rocked = overturned | (peaks > NO_ROCKING_RATIO)
    outcomes = rocked.astype(np.int8) + overturned
    return Forecast(outcomes, np.where(overturned, 1.0, np.where(rocked, np.minimum(peaks, 1.0), 0.0)))


def forecast_of_peaks(peak_ratio: Sequence[float | None]) -> Forecast:
    """
    Take members that are known by max |θ|/α alone, None for one that overturned, as a forecast.

    Examples
    --------
    >>> forecast_of_peaks([0.0002, 0.4, None]).amplitudes.tolist()
    [0.0, 0.4, 1.0]
    """
    peaks = np.array([np.nan if peak is None else peak for peak in peak_ratio])
    return forecast_of(peaks, np.where(np.isnan(peaks), 1.0, np.nan))


RESAMPLES, MOST_RESAMPLES = 1000, 100_000


def surrogate_members(
    forecasts: Sequence[Forecast], campaigns: ArrayLike, *, resamples: int = RESAMPLES, seed: int = 0
) -> NDArray[np.intp]:
    """
    Draw a member of each forecast that is taken as if it had been observed.

    Parameters
    ----------
    forecasts : sequence of Forecast, length n
    campaigns : array_like, shape (n,)
        Number of the campaign of each test.
    resamples, seed : int, optional
        The same seed draws the same members.

    Returns
    -------
    members : ndarray of int, shape (resamples, n)
        The same member in all tests of a campaign; if members of two tests share nothing, that is as good as any two.

    Raises
    ------
    ValueError
        If there is no forecast, one has fewer than two members, or `campaigns` does not have one number for each.
    """
    groups = np.asarray(campaigns)
    if not forecasts or groups.shape != (len(forecasts),):
        raise ValueError(
            f"campaigns is {described(campaigns)} and there are {len(forecasts)} forecasts; at least one forecast, and "
            "one campaign for each, was expected"
        )
    sizes = np.array([each.outcomes.size for each in forecasts])
    if sizes.min() < 2:
        raise ValueError("a forecast has a single member; at least two were expected, to hold one against the others")
    names, place = np.unique(groups, return_inverse=True)
    random = np.random.default_rng(whole("seed", seed, 0, LARGEST_SEED))
    drawn = random.random((whole("resamples", resamples, 1, MOST_RESAMPLES), names.size))
    return np.asarray(drawn[:, place] * sizes, dtype=np.intp)
