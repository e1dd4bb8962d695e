"""An assessment from the records to the answer: measured and scaled, run by whoever has the cores, judged."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from math import inf

import numpy as np
from numpy.typing import ArrayLike

from colonnade.arrays import Array
from colonnade.assessment.cases import (
    COMPONENTS,
    CaseOutcomes,
    Cases,
    OnContact,
    components,
    default_levels,
    factors_at,
    run_cases,
)
from colonnade.assessment.fragility import Fragility
from colonnade.assessment.ground import LARGEST_DRIFT, NONE, Ground, correction_of
from colonnade.assessment.hazard import Hazard, hazard_curve
from colonnade.assessment.intervals import LEVEL, RESAMPLES, Resampling
from colonnade.assessment.measures import MEASURES, Measure, measure_of, measured, measures_of
from colonnade.assessment.outcomes import gather
from colonnade.assessment.real_column import MOST_DRAWS, Limits, RealColumn, draw
from colonnade.dynamics.assembly import Assembly, as_one
from colonnade.dynamics.block import Block, Sided
from colonnade.dynamics.contact.body import ContactLaw
from colonnade.dynamics.models import NONLINEAR
from colonnade.dynamics.motion import Motion
from colonnade.dynamics.plane.run import OVERTURNS
from colonnade.validation import described, instance, number, samples, whole

DRAWS = 8
"""Columns that are drawn besides the one with nothing varied."""


@dataclass(frozen=True)
class Study:
    """
    What is run, and what is known of the records.

    Attributes
    ----------
    names : tuple of str
        Of the records that are run.
    cases : Cases
    measure : Measure
        Over which the records are scaled.
    levels : ndarray, shape (levels,)
        Of it, SI, rising.
    values : dict of str to ndarray, shape (records, components)
        Measures of the records as recorded, SI, by id; NaN of a component that is not there or has none.
    drift : ndarray, shape (records,)
        Largest velocity at the end of a component over its peak velocity.
    left_out : dict of str to str
        Components of records that cannot be scaled over the measure, and why.
    """

    names: tuple[str, ...]
    cases: Cases
    measure: Measure
    levels: Array
    values: dict[str, Array]
    drift: Array
    left_out: dict[str, str]

    def of(self, column: RealColumn) -> Study:
        """Return the study of another column with nothing varied, on the same records at the same levels."""
        draws = np.stack([draw(column, 0)] * len(self.names))
        return replace(self, cases=replace(self.cases, column=column, draws=draws))


def plan_study(
    column: RealColumn,
    motions: Mapping[str, Motion],
    *,
    measure: str = "pgv",
    levels: ArrayLike | None = None,
    measures: Sequence[str] | None = None,
    draws: int = DRAWS,
    model: str = NONLINEAR.name,
    drift: float = LARGEST_DRIFT,
    baseline: str = NONE,
    seed: int = 0,
    several: OnContact | None = None,
) -> Study:
    """
    Measure the records, scale them, and plan the histories.

    Parameters
    ----------
    column : RealColumn
    motions : mapping of str to Motion
        Records by name; `transverse` is their second horizontal component.
    measure : str, optional
        Id of the measure over which they are scaled.
    levels : array_like, optional
        Of it, SI; chosen so that the share of records that overturn goes from 0 to 1 if not given.
    measures : sequence of str, optional
        Ids of the measures that are compared with it; default all but spectral accelerations.
    draws : int, optional
        Columns that are drawn for each record, the same at all its levels.
    model : str, optional
        A plane one.
    drift, baseline : optional
        As of `intensity_measures`; a correction applies to the motions that are run.
    seed : int, optional
    several : OnContact, optional
        As of `Cases`; `levels` are then needed.

    Returns
    -------
    study : Study

    Raises
    ------
    ValueError
        If an argument is out of its range, or no record has the measure.
    """
    scaled_over, block = measure_of(measure), column.block
    if not scaled_over.power:
        raise ValueError(f"{scaled_over.id} does not grow with a motion; a measure that does was expected")
    drift = number("drift", drift, "a positive share of the peak velocity", above=0.0)
    compared = [scaled_over, *measures_of(list(MEASURES) if measures is None else measures)]
    corrected = {name: _corrected(motion, baseline) for name, motion in motions.items()}
    values, drifts, reasons = _measured(corrected, compared, block, drift)
    runs = np.asarray((values[scaled_over.id] > 0.0).any(axis=1))
    if not runs.any():
        why = next(iter(reasons.values()), "there is no record")
        raise ValueError(f"No record has a {scaled_over.name}: {why}")
    values = {name: each[runs] for name, each in values.items()}
    kept = {name: motion for (name, motion), is_run in zip(corrected.items(), runs, strict=True) if is_run}
    intensity, power, recorded = values[scaled_over.id], scaled_over.power, tuple(kept.values())
    if levels is None and several is not None:
        raise ValueError(f"levels are needed for several bodies: levels of the {scaled_over.name} were expected")
    usual = default_levels(column, recorded, intensity, power=power, model=model) if levels is None else levels
    found = np.unique(samples("levels", usual))
    if not found[0] > 0.0:
        raise ValueError(f"levels begin at {found[0]:g}; positive levels of the {scaled_over.name} were expected")
    drawn = np.stack([draw(column, draws, seed, record=number) for number in range(len(kept))])
    cases = Cases(column, drawn, recorded, factors_at(found, intensity, power), model, several)
    return Study(tuple(kept), cases, scaled_over, found, values, drifts[runs], reasons)


def _measured(
    motions: Mapping[str, Motion], compared: Sequence[Measure], block: Block, drift: float
) -> tuple[dict[str, Array], Array, dict[str, str]]:
    """
    Measure each horizontal component of the records.

    Returns the values by measure, shape (records, components), the largest drift of each record, and by its name why a
    component cannot be scaled over the first of the measures.
    """
    values = {each.id: np.full((len(motions), len(COMPONENTS)), np.nan) for each in compared}
    names, drifts, reasons = list(motions), np.zeros(len(motions)), dict[str, str]()
    for row, place, along in components(list(motions.values())):
        ground = Ground(along.acceleration, along.dt, block.gravity)
        drifts[row] = max(drifts[row], ground.drift)
        for each in compared:
            values[each.id][row, place], why = measured(each, ground, drift)
            if each is compared[0] and not values[each.id][row, place] > 0.0:
                reasons[f"{names[row]}, component {COMPONENTS[place]}"] = why or "it does not move"
    return values, drifts, reasons


def judge(
    study: Study,
    outcomes: CaseOutcomes,
    resampling: Resampling,
    *,
    overturned: float = 1.0,
    hazard: Hazard | None = None,
    magnitude: Array | None = None,
    distance: Array | None = None,
) -> Fragility:
    """
    Judge the outcomes of a study.

    Parameters
    ----------
    study : Study
    outcomes : CaseOutcomes
        Of its cases.
    resampling : Resampling
    overturned : float, optional
        A largest |θ|/α above this counts as overturned.
    hazard : Hazard, optional
        Of the study's measure.
    magnitude, distance : ndarray, shape (records,), optional
        Of the earthquakes; NaN if not known.

    Returns
    -------
    fragility : Fragility
        Signs and components are its directions.

    Raises
    ------
    ValueError
        If an argument is out of its range, or there are too few records.
    """
    records, levels, draws, signs, components = outcomes.outcome.shape
    if not outcomes.is_run.any():
        raise ValueError("No record can be run: their bases fall faster than the column; lower levels are needed")
    # NaN counts as not run.
    peak = np.where(outcomes.outcome == OVERTURNS, np.inf, outcomes.peak_ratio)
    by_direction = (
        each[:, :, counted_draws(draws)].reshape(records, levels, -1, signs * components)
        for each in (peak, outcomes.exceeds(overturned))
    )
    gathered = gather(study.names, study.levels, *by_direction)
    return Fragility(gathered, resampling, hazard, _scaled(study, signs), magnitude, distance, study.measure.id)


def counted_draws(draws: int) -> slice:
    """Give the draws that count: the first, with nothing varied, only if it is the only one."""
    return slice(1 if draws > 1 else 0, None)


def _corrected(motion: Motion, baseline: str) -> Motion:
    correct = correction_of(baseline)
    others = (None if part is None else correct(part, motion.dt) for part in (motion.vertical, motion.transverse))
    return Motion(correct(motion.acceleration, motion.dt), motion.dt, *others)


def _scaled(study: Study, signs: int) -> dict[str, Array]:
    """Measures of the scaled records that all of them have, shape (records, levels, directions)."""
    found, runs = {}, np.isfinite(study.cases.factors).any(axis=1)
    for name, recorded in study.values.items():
        if np.isfinite(recorded[runs]).all():
            values = recorded[:, None, :] * study.cases.factors ** measure_of(name).power
            # What is not run has no say.
            found[name] = np.tile(np.where(np.isfinite(study.cases.factors), values, 1.0), (1, 1, signs))
    return found


def fragility(
    block: Block | Assembly,
    motions: Mapping[str, Motion] | Sequence[Motion],
    *,
    restitution: Sided | None = None,
    measure: str = "pgv",
    levels: ArrayLike | None = None,
    restitution_range: Limits | None = None,
    critical_angle_range: Limits | None = None,
    p_range: Limits | None = None,
    contact: ContactLaw | None = None,
    friction_range: Limits | None = None,
    displaced: float = inf,
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
    block : Block or Assembly
        The real column; several bodies are moved by the contact model, a minute or more for each history.
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
    contact, friction_range, displaced : optional
        Of several bodies: the law of their contacts, the limits between which its friction is drawn, and how far from
        its place, m, a body may end; one that ends farther counts as one that overturned.
    draws : int, optional
    overturned : float, optional
        A largest |θ|/α above this counts as overturned.
    hazard : pair of array_like, optional
        Levels of the measure, SI, and the annual rates at which they are exceeded.
    measures : sequence of str, optional
        Ids of the measures that are compared; default all but spectral accelerations.
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
    >>> found.reaches(0.5).value < 4.0, len(found.outcomes.records)
    (True, 4)
    """
    several = _several(block, contact, friction_range, displaced)
    block = as_one(block) if isinstance(block, Assembly) else block
    instance("block", block, Block)
    named = _named(motions)
    whole("draws", draws, 1, MOST_DRAWS)
    number("overturned", overturned, "a positive share of the critical angle", above=0.0)
    resampling = Resampling(resamples, seed, level)
    curve = _curve(hazard)
    column = RealColumn(
        block,
        block.restitution if restitution is None else restitution,
        None if several is None else several.law.friction,
        restitution_range=restitution_range,
        critical_angle_range=critical_angle_range,
        p_range=p_range,
        friction_range=friction_range,
    )
    study = plan_study(
        column,
        named,
        measure=measure,
        levels=levels,
        measures=measures,
        draws=draws,
        model=model,
        drift=drift,
        baseline=baseline,
        seed=seed,
        several=several,
    )
    return judge(study, run_cases(study.cases), resampling, overturned=overturned, hazard=curve)


def _several(
    block: Block | Assembly, contact: ContactLaw | None, friction_range: Limits | None, displaced: float
) -> OnContact | None:
    """Check what is said of several bodies, and put it together; None of one block."""
    limit = number("displaced", displaced, "a positive distance in m", above=0.0, finite=False)
    if isinstance(block, Assembly):
        law = ContactLaw() if contact is None else instance("contact", contact, ContactLaw)
        return OnContact(block, law, limit)
    if contact is not None or friction_range is not None or limit != inf:
        raise ValueError("contact, friction_range and displaced are for an Assembly; a Block was found")
    return None


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
    return hazard_curve(*hazard)
