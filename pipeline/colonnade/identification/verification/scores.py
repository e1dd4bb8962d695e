"""
Proper scores of one forecast: the smaller the better.

`crps` is the main one: it uses the amplitude of every test, whatever its outcome, and was chosen before any result.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import log

import numpy as np
from numpy.typing import ArrayLike

from colonnade.identification.verification.responses import OUTCOMES, OVERTURNED, Forecast, Response
from colonnade.validation import number, samples


@dataclass(frozen=True)
class Scores:
    """
    Scores of one forecast, see the functions of the same names.

    Attributes
    ----------
    crps : float
        Of the amplitude, in units of α.
    ranked_probability : float
        Of the outcome, 0 to 2.
    brier : float
        Of overturning, 0 to 1.
    logarithmic : float
        Of overturning, in nats.
    """

    crps: float
    ranked_probability: float
    brier: float
    logarithmic: float


def score(forecast: Forecast, observed: Response) -> Scores:
    """Score a forecast by what was observed."""
    overturning = int(np.sum(forecast.outcomes == OVERTURNED)), forecast.outcomes.size
    return Scores(
        crps=crps(forecast.amplitudes, observed.amplitude),
        ranked_probability=ranked_probability_score(forecast, observed),
        brier=brier_score(*overturning, happened=observed.outcome == OVERTURNED),
        logarithmic=logarithmic_score(*overturning, happened=observed.outcome == OVERTURNED),
    )


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

    Raises
    ------
    ValueError
        If a number is not finite.

    Notes
    -----
    mean |x − y| − Σᵢ<ⱼ |xᵢ − xⱼ| / (m (m − 1)): the kernel form of Gneiting and Raftery (2007) with m (m − 1)
    for m² (Ferro 2014), so that ensembles of different sizes compare.

    Examples
    --------
    >>> crps([0.25, 0.75], 0.5)
    0.0
    """
    ranked = np.sort(samples("members", members, each="member"))
    truth = number("observed", observed, "a finite number")
    error, size = float(np.abs(ranked - truth).mean()), ranked.size
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
