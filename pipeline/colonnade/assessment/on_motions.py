"""Fragility of a block on a set of motions, for the library: without a campaign and without files."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from numpy.typing import ArrayLike

from colonnade.assessment.cases import run_cases
from colonnade.assessment.fragility import Fragility
from colonnade.assessment.ground import LARGEST_DRIFT, NONE
from colonnade.assessment.hazard import Hazard, hazard_curve
from colonnade.assessment.intervals import LEVEL, RESAMPLES, checked_level
from colonnade.assessment.prototype import MOST_DRAWS, Limits, Prototype
from colonnade.assessment.study import DRAWS, judge, plan_study
from colonnade.dynamics.block import Block, Sided
from colonnade.dynamics.models.nonlinear import NONLINEAR
from colonnade.dynamics.motion import Motion
from colonnade.validation import described, instance, number, whole


def fragility(
    block: Block,
    motions: Mapping[str, Motion] | Sequence[Motion],
    *,
    restitution: Sided | None = None,
    measure: str = "pgv",
    levels: ArrayLike | None = None,
    restitution_range: Limits | None = None,
    critical_angle_range: Limits | None = None,
    p_range: Limits | None = None,
    draws: int = DRAWS,
    overturned: float = 1.0,
    hazard: tuple[ArrayLike, ArrayLike] | None = None,
    measures: Sequence[str] | None = None,
    model: str = NONLINEAR.name,
    drift: float = LARGEST_DRIFT,
    baseline: str = NONE,
    level: float = LEVEL,
    resamples: int = RESAMPLES,
    seed: int = 0,
) -> Fragility:
    """
    Find how probably a block overturns on a set of motions, over a measure of their intensity.

    Parameters
    ----------
    block : Block
        The real column.
    motions : mapping of str to Motion, or sequence of Motion
        Records, by name or numbered from 1. Both horizontal components are cases in the plane, with vertical motion.
    restitution : float or pair of float, optional
        e; default the rigid-body value.
    measure : str, optional
        Id of the measure over which the records are scaled: "pgv", "pga", "sa(0.5 s)" …
    levels : array_like, optional
        Of it, SI; chosen so that the share of records that overturn goes from 0 to 1 if not given.
    restitution_range, critical_angle_range, p_range : pair of float, optional
        Limits between which e, α (rad) and p (rad/s) are drawn for each record; known exactly if not given.
    draws : int, optional
    overturned : float, optional
        A largest |θ|/α above this counts as overturned.
    hazard : pair of array_like, optional
        Levels of the measure, SI, and the annual rates at which they are exceeded.
    measures : sequence of str, optional
        Ids of the measures that are compared; default all that need no block.
    model : str, optional
        A plane one.
    drift, baseline : optional
        As of `intensity_measures`.
    level, resamples, seed : optional
        Of the intervals: their level, how often the records are drawn again, and the seed of all that is drawn.

    Returns
    -------
    fragility : Fragility

    Raises
    ------
    ValueError
        If an argument is out of its range, or there are too few records.

    Notes
    -----
    Binomial likelihood on stripes (Baker 2015). Records at several levels are one record: intervals resample records.

    Examples
    --------
    >>> import numpy as np
    >>> block = Block.prism(width=1.7, depth=1.7, height=9.1, mass=40e3)
    >>> time = np.arange(0.0, 6.0, 0.02)
    >>> taper = np.sin(np.pi * time / 6.0) ** 2
    >>> motions = [Motion(3.0 * taper * np.sin(2 * np.pi * f * (time - 3.0)), 0.02) for f in (0.4, 0.5, 0.6, 0.7)]
    >>> found = fragility(block, motions, restitution=0.95, levels=[0.5, 1.0, 2.0, 4.0], draws=1, resamples=100)
    >>> found.lognormal.rises[0] < 4.0, len(found.outcomes.records)
    (True, 4)
    """
    instance("block", block, Block)
    named = _named(motions)
    whole("draws", draws, 1, MOST_DRAWS)
    number("overturned", overturned, "a positive share of the critical angle", above=0.0)
    checked_level(level)
    curve = _curve(hazard)
    prototype = Prototype(
        block,
        max(block.restitution, 0.0) if restitution is None else restitution,
        restitution_range=restitution_range,
        critical_angle_range=critical_angle_range,
        p_range=p_range,
    )
    study = plan_study(
        prototype,
        named,
        measure=measure,
        levels=levels,
        measures=measures,
        draws=draws,
        model=model,
        drift=drift,
        baseline=baseline,
        seed=seed,
    )
    outcomes = run_cases(study.cases)
    return judge(study, outcomes, overturned=overturned, hazard=curve, level=level, resamples=resamples, seed=seed)


def _named(motions: Mapping[str, Motion] | Sequence[Motion]) -> dict[str, Motion]:
    """Give the motions by name; numbered from 1 if they have none."""
    if not isinstance(motions, (Mapping, Sequence)) or isinstance(motions, str):
        raise ValueError(f"motions is {described(motions)}; a list of motions, or motions by name, was expected")
    named = dict(motions) if isinstance(motions, Mapping) else {str(n): each for n, each in enumerate(motions, 1)}
    for name, motion in named.items():
        instance(f"motions[{name!r}]", motion, Motion)
    return named


def _curve(hazard: tuple[ArrayLike, ArrayLike] | None) -> Hazard | None:
    if hazard is None:
        return None
    if not isinstance(hazard, (tuple, list)) or len(hazard) != 2:
        raise ValueError(f"hazard is {described(hazard)}; a pair of levels and of annual rates was expected")
    try:
        return hazard_curve(*hazard)
    except ValueError as error:
        raise ValueError(f"hazard: {error}") from None
