"""Whether amplitudes turn out as often as they were forecast to: where they are among members."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from colonnade.arrays import Array
from colonnade.identification.forecasts import Forecast, Response

RESAMPLES = 1000

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

    Notes
    -----
    (b + v (t + 1)) / (m + 1) with b members below, t equal to the observed amplitude, and v even between 0 and 1:
    Czado, Gneiting and Held (2009) for an ensemble of m. If the observed amplitude is drawn as the members are,
    it is exactly even, whatever m and whatever share does not rock (amplitude 0) or overturns (1).
    """
    random = np.random.default_rng(seed).random(len(forecasts))
    found = []
    for forecast, response, v in zip(forecasts, observed, random, strict=True):
        below, equal = (np.sum(compared(forecast.amplitudes, response.amplitude)) for compared in (np.less, np.equal))
        found.append(float(below + v * (equal + 1)) / (forecast.amplitudes.size + 1))
    return np.array(found)


def coverage(pit: Array, forecasts: Sequence[Forecast], campaigns: ArrayLike) -> Coverage:
    """
    Count the tests whose amplitude is in central bands of their forecasts.

    Parameters
    ----------
    pit : ndarray, shape (n,)
        As of `randomised_pit`: at the edge of a band that is an atom, its share of the tests counts.
    forecasts : sequence of Forecast, length n
    campaigns : array_like, shape (n,)
        As of `surrogate_members`, for the interval.

    Returns
    -------
    coverage : Coverage

    Raises
    ------
    ValueError
        As of `surrogate_members`.
    """
    random = np.random.default_rng((0, 1))
    members = surrogate_members(forecasts, campaigns)
    drawn = np.column_stack(
        [
            _pits_of_members(forecast.amplitudes, random)[chosen]
            for forecast, chosen in zip(forecasts, members.T, strict=True)
        ]
    )
    low, high = np.quantile(_shares(drawn), [0.025, 0.975], axis=0)
    return Coverage(np.array(BANDS), _shares(pit[None])[0], low, high)


def _shares(pit: Array) -> Array:
    """Share of the tests in each of `BANDS`, shape (r, b), of values of shape (r, n)."""
    return np.asarray(np.mean(np.abs(pit[:, None, :] - 0.5) <= np.array(BANDS)[:, None] / 2, axis=2))


def _pits_of_members(members: Array, random: np.random.Generator) -> Array:
    """Of each member among all others, shape (m,)."""
    ranked = np.sort(members)
    below, most = (np.searchsorted(ranked, members, side) for side in ("left", "right"))
    return np.asarray((below + random.random(members.size) * (most - below)) / members.size)


def surrogate_members(forecasts: Sequence[Forecast], campaigns: ArrayLike) -> NDArray[np.intp]:
    """
    Draw a member of each forecast that is taken as if it had been observed.

    Parameters
    ----------
    forecasts : sequence of Forecast, length n
    campaigns : array_like, shape (n,)
        Number of the campaign of each test.

    Returns
    -------
    members : ndarray of int, shape (RESAMPLES, n)
        The same member in all tests of a campaign; if members of two tests share nothing, that is as good as any two.
    """
    sizes = np.array([each.outcomes.size for each in forecasts])
    names, place = np.unique(np.asarray(campaigns), return_inverse=True)
    drawn = np.random.default_rng(0).random((RESAMPLES, names.size))
    return np.asarray(drawn[:, place] * sizes, dtype=np.intp)
