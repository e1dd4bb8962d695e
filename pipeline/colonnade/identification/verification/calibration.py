"""Whether observed amplitudes are spread among the members of their forecasts as they should be."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from colonnade.arrays import Array
from colonnade.dynamics.ensembles.ensemble import LARGEST_SEED
from colonnade.identification.verification.responses import RESAMPLES, Forecast, Response, surrogate_members
from colonnade.validation import samples, whole

BANDS = (0.5, 0.8, 0.95)
"""Central bands whose coverage is given."""


@dataclass(frozen=True)
class Coverage:
    """
    Share of the tests whose amplitude is in central bands of their forecasts.

    Attributes
    ----------
    band : ndarray, shape (b,)
        Nominal shares.
    share : ndarray, shape (b,)
    low, high : ndarray, shape (b,)
        95 % of such shares if the forecasts are right.
    """

    band: Array
    share: Array
    low: Array
    high: Array


def randomised_pit(forecasts: Sequence[Forecast], observed: Sequence[Response], *, seed: int = 0) -> Array:
    """
    Give the probability integral transform of observed amplitudes, randomised at atoms.

    Parameters
    ----------
    forecasts : sequence of Forecast, length n
    observed : sequence of Response, length n
    seed : int, optional
        The same seed gives the same values.

    Returns
    -------
    pit : ndarray, shape (n,)
        Between 0 and 1, and evenly spread if the forecasts are right.

    Raises
    ------
    ValueError
        If the lengths differ.

    Notes
    -----
    (b + v (t + 1)) / (m + 1) with b members below, t equal to the observed amplitude, and v even between 0 and 1:
    Czado, Gneiting and Held (2009) for an ensemble of m. If the observed amplitude is drawn as the members are,
    it is exactly even, whatever m and whatever share does not rock (amplitude 0) or overturns (1).
    """
    random = np.random.default_rng(whole("seed", seed, 0, LARGEST_SEED)).random(len(forecasts))
    pairs = zip(forecasts, observed, random, strict=True)
    return np.array([_pit(forecast.amplitudes, response.amplitude, v) for forecast, response, v in pairs])


def coverage(
    pit: ArrayLike,
    forecasts: Sequence[Forecast],
    campaigns: ArrayLike,
    *,
    bands: Sequence[float] = BANDS,
    resamples: int = RESAMPLES,
    seed: int = 0,
) -> Coverage:
    """
    Count the tests whose amplitude is in central bands of their forecasts.

    Parameters
    ----------
    pit : array_like, shape (n,)
        As of `randomised_pit`: at the edge of a band that is an atom, its share of the tests counts.
    forecasts : sequence of Forecast, length n
    campaigns, resamples, seed
        As of `surrogate_members`, for the interval.
    bands : sequence of float, optional
        Nominal shares.

    Returns
    -------
    coverage : Coverage

    Raises
    ------
    ValueError
        As of `surrogate_members`.
    """
    nominal, values = samples("bands", bands), samples("pit", pit, each="test")
    if values.size != len(forecasts):
        raise ValueError(f"pit has {values.size} tests; {len(forecasts)} were expected, as many as forecasts")
    members = surrogate_members(forecasts, campaigns, resamples=resamples, seed=seed)
    random = np.random.default_rng((seed, 1))
    drawn = np.column_stack(
        [
            _pits_of_members(forecast.amplitudes, random)[chosen]
            for forecast, chosen in zip(forecasts, members.T, strict=True)
        ]
    )
    low, high = np.quantile(_shares(drawn, nominal), [0.025, 0.975], axis=0)
    return Coverage(nominal, _shares(values[None], nominal)[0], low, high)


def _shares(pit: Array, bands: Array) -> Array:
    """Share of the tests in each band, shape (r, b), of values of shape (r, n)."""
    return np.asarray(np.mean(np.abs(pit[:, None, :] - 0.5) <= bands[:, None] / 2, axis=2))


def _pit(members: Array, value: float, v: float) -> float:
    return float((np.sum(members < value) + v * (np.sum(members == value) + 1)) / (members.size + 1))


def _pits_of_members(members: Array, random: np.random.Generator) -> Array:
    """Of each member among all others, shape (m,)."""
    return np.array([_pit(np.delete(members, k), members[k], v) for k, v in enumerate(random.random(members.size))])
