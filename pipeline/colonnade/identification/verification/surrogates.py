"""
Observations that forecasts themselves could have given: what scatter remains if every forecast is right.

What is wrong about a campaign (its e, its calibration) is wrong in all its tests. Member k of each ensemble draws the
same errors (`dynamics.ensembles`), so that one member of all tests of a campaign is a campaign that could have been.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import ArrayLike, NDArray

from colonnade.dynamics.ensembles.ensemble import LARGEST_SEED
from colonnade.identification.verification.responses import Forecast
from colonnade.validation import described, whole

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
