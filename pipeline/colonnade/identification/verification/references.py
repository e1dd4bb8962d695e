"""What a forecast has to beat: the base rate of its campaign, or any other forecast; and by how much it does."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import scipy
from numpy.typing import ArrayLike

from colonnade.arrays import Array
from colonnade.dynamics.ensembles.ensemble import LARGEST_SEED
from colonnade.identification.verification.responses import MOST_RESAMPLES, Forecast, Response
from colonnade.validation import number, samples, whole

FEWEST_CAMPAIGNS = 6
"""Of an interval: of fewer no resampling shows how much campaigns differ."""


def base_rates(observed: Sequence[Response]) -> list[Forecast]:
    """
    Forecast each test of a campaign by what was observed in all others.

    Parameters
    ----------
    observed : sequence of Response, length n
        Of all tests of one campaign.

    Returns
    -------
    forecasts : list of Forecast, length n
        Of n − 1 members each. The score of their fair form is that of the base rate itself, not of its finite sample.

    Raises
    ------
    ValueError
        If there are fewer than two tests.
    """
    if len(observed) < 2:
        raise ValueError(
            f"observed has {len(observed)} tests; at least two were expected, to forecast one by the others"
        )
    outcomes = np.array([each.outcome for each in observed], dtype=np.int8)
    amplitudes = np.array([each.amplitude for each in observed])
    return [Forecast(np.delete(outcomes, test), np.delete(amplitudes, test)) for test in range(len(observed))]


def skill(scores: ArrayLike, reference: ArrayLike) -> float:
    """
    Give the skill of forecasts over that of others for the same tests.

    Parameters
    ----------
    scores, reference : array_like, shape (n,)

    Returns
    -------
    skill : float
        1 − mean score / mean score of the reference: 1 is perfect, 0 as good as the reference. NaN if the reference
        leaves nothing to improve (its mean is zero or less).

    Raises
    ------
    ValueError
        If a score is not finite or the lengths differ.
    """
    own, other = _paired(scores, reference)
    return 1.0 - float(own.mean() / other.mean()) if other.mean() > 0.0 else np.nan


@dataclass(frozen=True)
class Difference:
    """Mean difference of scores per test, with its interval at `level`."""

    value: float
    low: float
    high: float
    level: float


def score_difference(
    scores: ArrayLike,
    reference: ArrayLike,
    campaigns: ArrayLike,
    *,
    level: float = 0.95,
    resamples: int = 9999,
    seed: int = 0,
) -> Difference:
    """
    Give the mean difference of the scores of two forecasts, and its interval over campaigns.

    Parameters
    ----------
    scores, reference : array_like, shape (n,)
        Of the same tests.
    campaigns : array_like, shape (n,)
        Number of the campaign of each test. Tests of one campaign share its specimens and what is wrong about them.
    level : float, optional
        Of the interval.
    resamples, seed : int, optional
        The same seed gives the same interval.

    Returns
    -------
    difference : Difference
        Of score − reference: below zero if the scores are better than the reference.

    Raises
    ------
    ValueError
        If a score is not finite, the lengths differ, or there are fewer than `FEWEST_CAMPAIGNS` campaigns.

    Notes
    -----
    Bootstrap of whole campaigns (Efron and Tibshirani 1993). Quantiles of few campaigns are too close:
    they are taken as far out as Student's t is for that number of campaigns (Hesterberg 2015).
    """
    own, other = _paired(scores, reference)
    groups = np.asarray(campaigns)
    if groups.shape != own.shape:
        raise ValueError(f"campaigns has shape {groups.shape}; {own.shape} was expected, one for each score")
    level = number("level", level, "a probability between 0 and 1", above=0.0, below=1.0)
    names, place = np.unique(groups, return_inverse=True)
    if names.size < FEWEST_CAMPAIGNS:
        raise ValueError(f"there are {names.size} campaigns; at least {FEWEST_CAMPAIGNS} were expected for an interval")
    totals, tests = np.bincount(place, weights=own - other), np.bincount(place)
    drawn = np.random.default_rng(whole("seed", seed, 0, LARGEST_SEED)).integers(
        names.size, size=(whole("resamples", resamples, 1, MOST_RESAMPLES), names.size)
    )
    means = totals[drawn].sum(axis=1) / tests[drawn].sum(axis=1)
    reach = np.sqrt(names.size / (names.size - 1)) * scipy.stats.t.ppf((1 + level) / 2, names.size - 1)
    outside = scipy.stats.norm.sf(reach)
    low, high = np.quantile(means, [outside, 1 - outside])
    return Difference(float(totals.sum() / tests.sum()), float(low), float(high), level)


def _paired(scores: ArrayLike, reference: ArrayLike) -> tuple[Array, Array]:
    own, other = samples("scores", scores, each="score"), samples("reference", reference, each="score")
    if own.size != other.size:
        raise ValueError(f"scores has {own.size} tests and reference {other.size}; the same tests were expected")
    return own, other
