"""Departures in e of single impacts: it depends on their speed, or the table moves."""

from __future__ import annotations

from math import isfinite

import scipy

from colonnade.identification.restitution.estimators.history_scatter import ScatteredFit
from colonnade.identification.restitution.result import Departure

NAME = "speed-dependent restitution"

LEAST_CHANGE = 0.005
"""Change of e over the speeds of impact seen that is named, if it is sure (`history_scatter.SURE_TREND`); ..."""

LARGEST_CHANGE = 0.05
"""... beyond this one value would mislead, ..."""

SURE = 4.0
"""... but for a refusal more certainty is needed than for a name: standard errors (of a normal distribution)."""

MOVING = "moving table"

LARGEST_SCATTER = 0.01
"""Standard deviation of e from impact to impact above which something else than impacts changes the energy."""

FEWEST_IMPACTS = 5


def found_by_impact(fit: ScatteredFit, *, driven: bool = False) -> tuple[Departure, ...]:
    """
    Look at e of single impacts.

    Parameters
    ----------
    fit : ScatteredFit
    driven : bool, optional
        The motion of the table is in the history already.

    Returns
    -------
    departures : tuple of Departure
        "moving table": its size is the scatter of e from impact to impact beyond the noise, whatever its spectrum;
        threshold `LARGEST_SCATTER`; it refuses. Else "speed-dependent restitution".
    """
    if scatters(fit):
        trend = abs(fit.change) if isfinite(fit.change) and abs(fit.change) > SURE * fit.change_error else 0.0
        if fit.scatter > trend:
            return (_moving(fit, fit.scatter, driven=driven),)
    return speed_dependence(fit)


def scatters(fit: ScatteredFit) -> bool:
    """Whether e of single impacts scatters more than impacts alone explain."""
    return fit.restitution.size >= FEWEST_IMPACTS and min(fit.scatter, _seen_scatter(fit)) > LARGEST_SCATTER


def _seen_scatter(fit: ScatteredFit) -> float:
    """Scatter of the e that were found, each drawn towards the mean as far as noise allows."""
    return float(fit.restitution.std(ddof=1))


def _moving(fit: ScatteredFit, scatter: float, *, driven: bool) -> Departure:
    cause = (
        "the recorded motion of the table does not explain it. Check the gain, sign and clock of its accelerometer."
        if driven
        else "the table moves, or somebody touched the block. No value is given; record the table's acceleration "
        '(on = "table", quantity = "acceleration"), or repeat the test on a table at rest.'
    )
    return Departure(
        MOVING,
        scatter,
        scatter / (2 * fit.restitution.size) ** 0.5,
        "1",
        f"e of single impacts scatters by {scatter:.3f}, from {fit.restitution.min():.3f} to "
        f"{fit.restitution.max():.3f}; up to {LARGEST_SCATTER:g} was expected of impacts alone: {cause}",
        refuses=True,
    )


def speed_dependence(fit: ScatteredFit) -> tuple[Departure, ...]:
    """
    Ask whether e changes with the speed of impact.

    Parameters
    ----------
    fit : ScatteredFit

    Returns
    -------
    departures : tuple of Departure
        None, or one whose size is the change of e over the speeds of impact seen. Threshold: that from which on the
        mean is the one at the mean speed, and `LEAST_CHANGE`. It refuses above `LARGEST_CHANGE`, if it is `SURE`.
    """
    if not fit.has_trend or abs(fit.change) < LEAST_CHANGE:
        return ()
    refuses = abs(fit.change) > LARGEST_CHANGE and fit.change_chance <= 2 * float(scipy.stats.norm.sf(SURE))
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
