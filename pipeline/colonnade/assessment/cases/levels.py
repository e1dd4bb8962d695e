"""Levels of an assessment that nobody gave: from where nothing overturns to where everything does."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from colonnade.arrays import Array
from colonnade.assessment.cases.cases import COMPONENTS, Cases, factors_at, in_plane, run_cases
from colonnade.assessment.cases.prototype import Prototype, draw
from colonnade.dynamics.models.nonlinear import NONLINEAR
from colonnade.dynamics.motion import Motion

LEVELS = 12
"""Levels of an assessment, equally spaced in their logarithm."""

REACH = 50.0
"""Largest factor on the records that is tried, in that from which the first of them uplifts the column."""

TRIALS = 24
"""Levels that are tried, equally spaced in their logarithm, with nothing varied."""


def default_levels(
    prototype: Prototype,
    motions: Sequence[Motion],
    intensity: Array,
    *,
    power: int = 1,
    count: int = LEVELS,
    model: str = NONLINEAR.name,
) -> Array:
    """
    Choose levels at which the share of records that overturn goes from 0 to 1.

    Parameters
    ----------
    prototype : Prototype
    motions : sequence of Motion
    intensity : ndarray, shape (records, components)
        The measure of each as recorded; NaN for a component that is not run.
    power : int, optional
        As of `factors_at`.
    count : int, optional
    model : str, optional

    Returns
    -------
    levels : ndarray, shape (count,)
        Rising, in the unit of the measure; from the last trial below the first that overturns the column, to the first
        from which on every record does, or the largest trial. Rounded to three digits.

    Raises
    ------
    ValueError
        If no record has the component and a positive measure.
    """
    lowest = _first_uplift(prototype, motions, intensity, power)
    trials = np.geomspace(lowest, REACH**power * lowest, TRIALS)
    cases = Cases(
        prototype, (draw(prototype, 0),) * len(motions), tuple(motions), factors_at(trials, intensity, power), model
    )
    outcomes = run_cases(cases)
    run, fell = outcomes.is_run, outcomes.exceeds()
    aside = (0, 2, 3, 4)
    some, every = fell.any(axis=aside), (fell | ~run).all(axis=aside)
    first = int(np.argmax(some)) if some.any() else TRIALS - 1
    standing = np.flatnonzero(~every)
    last = min(int(standing[-1]) + 1 if standing.size else 0, TRIALS - 1)
    ends = trials[max(first - 1, 0)], trials[max(last, first, 1)]
    return np.array([float(f"{level:.3g}") for level in np.geomspace(*ends, count)])


def _first_uplift(prototype: Prototype, motions: Sequence[Motion], intensity: Array, power: int) -> float:
    """Give the level from which the first of the records uplifts the column, vertical motion left out."""
    found = [
        float(intensity[record, place]) * (prototype.block.uplift_acceleration / plane.peak) ** power
        for record, motion in enumerate(motions)
        for place in range(len(COMPONENTS))
        if (plane := in_plane(motion, place, 1.0)) is not None and plane.peak > 0.0 and intensity[record, place] > 0.0
    ]
    if not found:
        raise ValueError("no record has a component with a positive measure; a record that moves was expected")
    return min(found)
