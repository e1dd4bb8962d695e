"""Reliability of the probability of overturning: how often it happens when it is forecast so."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from colonnade.arrays import Array
from colonnade.identification.verification.responses import OVERTURNED, RESAMPLES, Forecast, Response, surrogate_members
from colonnade.validation import number, whole

FEW, FEW_BINS, BINS = 100, 3, 5
"""Bins of fewer tests than the first number, and of more."""


@dataclass(frozen=True)
class Reliability:
    """
    A reliability diagram; bins without a test are left out.

    Attributes
    ----------
    probability : ndarray, shape (k,)
        Mean forecast probability of the tests in a bin.
    frequency : ndarray, shape (k,)
        Share of them that overturned.
    tests : ndarray of int, shape (k,)
    low, high : ndarray, shape (k,)
        Consistency bar: where the frequency is in 95 % (`level`) of the cases if the forecasts are right.
    level : float
    """

    probability: Array
    frequency: Array
    tests: NDArray[np.intp]
    low: Array
    high: Array
    level: float


def reliability(
    forecasts: Sequence[Forecast],
    observed: Sequence[Response],
    campaigns: ArrayLike,
    *,
    bins: int | None = None,
    level: float = 0.95,
    resamples: int = RESAMPLES,
    seed: int = 0,
) -> Reliability:
    """
    Compare forecast probabilities of overturning with what happened.

    Parameters
    ----------
    forecasts : sequence of Forecast, length n
    observed : sequence of Response, length n
    campaigns, resamples, seed
        As of `surrogate_members`.
    bins : int, optional
        Of equal width from 0 to 1. Default: `FEW_BINS` for fewer than `FEW` tests, else `BINS`.
    level : float, optional
        Of each consistency bar.

    Returns
    -------
    diagram : Reliability

    Raises
    ------
    ValueError
        As of `surrogate_members`, or if the lengths differ.

    Notes
    -----
    Consistency bars by resampling (Bröcker and Smith 2007), with two differences: the forecasts are those that were
    made, and surrogate observations of one campaign share what is wrong about it (`surrogates`). A member is held
    against the m − 1 others, as an observation is against m members.
    """
    if len(observed) != len(forecasts):
        raise ValueError(f"there are {len(forecasts)} forecasts and {len(observed)} tests; as many were expected")
    level = number("level", level, "a probability between 0 and 1", above=0.0, below=1.0)
    count = whole("bins", bins, 1, 100) if bins is not None else FEW_BINS if len(forecasts) < FEW else BINS
    members = surrogate_members(forecasts, campaigns, resamples=resamples, seed=seed)
    probability = np.array([each.overturning_probability for each in forecasts])
    happened = np.array([each.outcome == OVERTURNED for each in observed], dtype=np.float64)
    place = np.minimum((probability * count).astype(np.intp), count - 1)
    used, place, tests = np.unique(place, return_inverse=True, return_counts=True)
    mean = np.bincount(place, weights=probability) / tests
    # Of each test, what a surrogate differs by from the share of the other members.
    departures = np.column_stack(
        [
            (forecast.outcomes[chosen] == OVERTURNED) - share
            for forecast, chosen, share in zip(forecasts, members.T, probability, strict=True)
        ]
    ) * np.array([each.outcomes.size / (each.outcomes.size - 1) for each in forecasts])
    in_bin = place[:, None] == np.arange(used.size)
    edges = np.quantile(departures @ in_bin / tests, [(1 - level) / 2, (1 + level) / 2], axis=0)
    low, high = np.clip(mean + edges, 0.0, 1.0)
    return Reliability(mean, np.bincount(place, weights=happened) / tests, tests, low, high, level)
