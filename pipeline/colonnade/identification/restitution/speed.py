"""An e that depends on the speed of impact: a property of the block, that one number does not tell."""

from __future__ import annotations

from math import isfinite

from scipy import stats

from colonnade.identification.restitution.departure import Departure
from colonnade.identification.restitution.each_impact import EachImpact

NAME = "speed-dependent restitution"

SURE = 4.0
"""Standard errors (of a normal distribution) from which on a change is named, ..."""

LEAST_CHANGE = 0.005
"""... if e changes by more than this over the speeds of impact seen; ..."""

LARGEST_CHANGE = 0.05
"""... beyond this one value would mislead."""


def speed_dependence(fit: EachImpact) -> tuple[Departure, ...]:
    """
    Ask whether e changes with the speed of impact.

    Parameters
    ----------
    fit : EachImpact

    Returns
    -------
    departures : tuple of Departure
        None, or one whose size is the change of e over the speeds of impact seen; it refuses above `LARGEST_CHANGE`.
        Threshold: `SURE` standard errors by Student's t, and `LEAST_CHANGE`.
    """
    if not (isfinite(fit.change) and fit.change_error > 0):
        return ()
    chance = 2 * float(stats.t.sf(abs(fit.change) / fit.change_error, fit.restitution.size - 2))
    if chance > 2 * float(stats.norm.sf(SURE)) or abs(fit.change) < LEAST_CHANGE:
        return ()
    refuses = abs(fit.change) > LARGEST_CHANGE
    end = "one value would mislead." if refuses else "the value given is the mean over the impacts seen."
    return (
        Departure(
            NAME,
            fit.change,
            fit.change_error,
            "1",
            f"e is not constant: it changes by {fit.change:+.4f} ± {fit.change_error:.4f} from the slowest to the "
            f"fastest impact; {end}",
            refuses=refuses,
        ),
    )
