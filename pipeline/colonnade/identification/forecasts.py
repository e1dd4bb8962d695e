"""
What a forecast says of a test, what was observed in it, its proper scores (the smaller the better), and coverage.

`crps` is the main one: it uses the amplitude of every test, whatever its outcome, and was chosen before any result.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from math import log, nan
from typing import get_args

import numpy as np
from numpy.typing import ArrayLike

from colonnade.arrays import Array, Codes
from colonnade.dynamics.history import NO_ROCKING_RATIO, Outcome

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
    def observed(cls, outcome: str, peak_ratio: float = nan) -> Response:
        """Take an outcome and, if the specimen rocked and stands, its max |θ|/α."""
        place = OUTCOMES.index(outcome)
        return cls(place, min(peak_ratio, 1.0) if place == ROCKING else float(place == OVERTURNED))


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


def forecast_of(peak_ratio: Sequence[float | None] | Array) -> Forecast:
    """
    Take the members of an ensemble of a model as a forecast.

    Parameters
    ----------
    peak_ratio : array_like, shape (m,)
        max |θ|/α; NaN or None of a member that overturned.

    Returns
    -------
    forecast : Forecast

    Examples
    --------
    >>> forecast = forecast_of([0.0002, 0.4, None])
    >>> forecast.outcomes.tolist(), forecast.amplitudes.tolist()
    ([0, 1, 2], [0.0, 0.4, 1.0])
    """
    peaks = np.asarray(peak_ratio, dtype=np.float64)
    overturned = np.isnan(peaks)
    rocked = overturned | (peaks > NO_ROCKING_RATIO)
    amplitudes = np.where(overturned, 1.0, np.where(rocked, np.minimum(peaks, 1.0), 0.0))
    return Forecast(rocked.astype(np.int8) + overturned, amplitudes)


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
    """
    outcomes = np.array([each.outcome for each in observed], dtype=np.int8)
    amplitudes = np.array([each.amplitude for each in observed])
    return [Forecast(np.delete(outcomes, test), np.delete(amplitudes, test)) for test in range(len(observed))]


def score(forecast: Forecast, observed: Response) -> dict[str, float]:
    """
    Score a forecast by what was observed.

    Returns
    -------
    scores : dict of str to float
        `crps` of the amplitude, in units of α; `ranked_probability` of the outcome, 0 to 2; of overturning `brier`, 0
        to 1, and `logarithmic`, in nats. See the functions of these names.
    """
    overturning = int(np.sum(forecast.outcomes == OVERTURNED)), forecast.outcomes.size
    return {
        "crps": crps(forecast.amplitudes, observed.amplitude),
        "ranked_probability": ranked_probability_score(forecast, observed),
        "brier": brier_score(*overturning, happened=observed.outcome == OVERTURNED),
        "logarithmic": logarithmic_score(*overturning, happened=observed.outcome == OVERTURNED),
    }


def crps(members: ArrayLike, observed: float) -> float:
    """
    Continuous ranked probability score of an ensemble, in its fair form.

    Parameters
    ----------
    members : array_like, shape (m,)
    observed : float

    Returns
    -------
    score : float
        In the unit of the members. A single member, or many equal ones, give |member − observed|. With few members it
        can be slightly negative; its mean over many tests is that of an ensemble without end.

    Notes
    -----
    mean |x − y| − Σᵢ<ⱼ |xᵢ − xⱼ| / (m (m − 1)): the kernel form of Gneiting and Raftery (2007) with m (m − 1)
    for m² (Ferro 2014), so that ensembles of different sizes compare.

    Examples
    --------
    >>> crps([0.25, 0.75], 0.5)
    0.0
    """
    ranked = np.sort(members)
    error, size = float(np.abs(ranked - observed).mean()), ranked.size
    if size == 1:
        return error
    # The gap above the k-th of m members is in the differences of all k (m − k) pairs across it.
    below = np.arange(1, size)
    differences = float((below * (size - below)) @ np.diff(ranked))
    return error - differences / (size * (size - 1))


def brier_score(count: int, members: int, *, happened: bool) -> float:
    """
    Score the probability of an event (Brier 1950) by whether it happened, in the fair form.

    Parameters
    ----------
    count, members : int
        Members with the event, of how many.
    happened : bool

    Returns
    -------
    score : float
        (k/m − y)² − k (m − k) / (m² (m − 1)), Ferro (2014): its mean is that of an ensemble without end, and it
        can be slightly negative. No second term for a single member.
    """
    share = count / members
    spread = share * (1.0 - share) / (members - 1) if members > 1 else 0.0
    return (share - happened) ** 2 - spread


def ranked_probability_score(forecast: Forecast, observed: Response) -> float:
    """
    Score the probabilities of the three ordered outcomes (Epstein 1969), in the fair form.

    Returns
    -------
    score : float
        Sum of the Brier scores of "at least rocking" and "overturned" (Murphy 1971), not divided by their number: 0 to
        2, and slightly negative where they are.
    """
    size = forecast.outcomes.size
    return sum(
        brier_score(int(np.sum(forecast.outcomes >= place)), size, happened=observed.outcome >= place)
        for place in range(1, len(OUTCOMES))
    )


def logarithmic_score(count: int, members: int, *, happened: bool) -> float:
    """
    Score the probability of an event by the logarithm of the probability of what happened (Good 1952).

    Parameters
    ----------
    count, members : int
        Members with the event, of how many.
    happened : bool

    Returns
    -------
    score : float
        −ln of the probability, in nats.

    Notes
    -----
    The probability is (k + ½)/(m + 1), the mean under Jeffreys's prior: an event that no member, or each, has keeps a
    probability of 1/(2 m + 2), so that the score is never infinite. Of 100 members it is at most 5.3.
    """
    probability = (count + 0.5) / (members + 1)
    return -log(probability if happened else 1.0 - probability)


def skill(scores: Array, reference: Array) -> float:
    """
    Give the skill of forecasts over that of others for the same tests.

    Parameters
    ----------
    scores, reference : ndarray, shape (n,)

    Returns
    -------
    skill : float
        1 − mean score / mean score of the reference: 1 is perfect, 0 as good as the reference. NaN if the reference
        leaves nothing to improve (its mean is zero or less).
    """
    return 1.0 - float(scores.mean() / reference.mean()) if reference.mean() > 0.0 else nan


RESAMPLES = 1000

BANDS = (0.5, 0.8, 0.95)
"""Central bands whose coverage is given."""


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


def coverage(pit: Array, forecasts: Sequence[Forecast], campaigns: ArrayLike) -> dict[str, Array]:
    """
    Count the tests whose amplitude is in central bands of their forecasts.

    Parameters
    ----------
    pit : ndarray, shape (n,)
        As of `randomised_pit`: at the edge of a band that is an atom, its share of the tests counts.
    forecasts : sequence of Forecast, length n
    campaigns : array_like, shape (n,)
        Number of the campaign of each test: for the interval, the same member is taken as observed in all its tests. If
        members of two tests share nothing, that is as good as any two.

    Returns
    -------
    coverage : dict of str to ndarray, shape (b,)
        `band`, the nominal shares; `share`; `low` and `high`: 95 % of such shares if the forecasts are right.
    """
    random = np.random.default_rng((0, 1))
    names, place = np.unique(np.asarray(campaigns), return_inverse=True)
    drawn = np.random.default_rng(0).random((RESAMPLES, names.size))[:, place]
    pits = np.empty(drawn.shape)
    for test, forecast in enumerate(forecasts):
        members = forecast.amplitudes
        # Of each member among all others.
        below, most = (np.searchsorted(np.sort(members), members, side) for side in ("left", "right"))
        of_member = (below + random.random(members.size) * (most - below)) / members.size
        pits[:, test] = of_member[(drawn[:, test] * members.size).astype(np.intp)]
    low, high = np.quantile(_shares(pits), [0.025, 0.975], axis=0)
    return {"band": np.array(BANDS), "share": _shares(pit[None])[0], "low": low, "high": high}


def _shares(pit: Array) -> Array:
    """Share of the tests in each of `BANDS`, shape (r, b), of values of shape (r, n)."""
    return np.asarray(np.mean(np.abs(pit[:, None, :] - 0.5) <= np.array(BANDS)[:, None] / 2, axis=2))
