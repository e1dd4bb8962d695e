"""All histories of an assessment: records at levels, drawn columns, signs, components; the friction that they need."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from math import ceil, inf

import numpy as np

from colonnade.arrays import Array, Codes, Mask
from colonnade.assessment.real_column import UNCERTAIN, RealColumn, draw, drawn_column
from colonnade.dynamics.assembly import Assembly
from colonnade.dynamics.contact.body import ContactLaw
from colonnade.dynamics.models import NONLINEAR, model_of, plane_model_of
from colonnade.dynamics.motion import Motion
from colonnade.dynamics.plane.reactions import reactions
from colonnade.dynamics.plane.run import OUTCOMES, OVERTURNS, ends_of, expect_usable
from colonnade.dynamics.rock import rock

AXES = ("record", "level", "draw", "sign", "component")
"""Of the arrays of an assessment."""

COMPONENTS = ("x", "y")
"""Horizontal components of a record, each a case in its own plane; vertical motion acts with either."""

NOT_RUN, FALLS_AWAY = -1, -2
"""
Outcomes of a case without a history: its record has no such component, or is not wanted at this level; its base falls
faster than the column, so that no plane model holds.
"""


@dataclass(frozen=True)
class OnContact:
    """
    Several bodies, which the contact model moves in place of the one block of the column.

    Attributes
    ----------
    assembly : Assembly
    law : ContactLaw
        Of all interfaces; a draw has its own friction, if that has a range.
    displaced : float
        m: a body that ends farther from its place than this counts as one that overturned.
    """

    assembly: Assembly
    law: ContactLaw
    displaced: float = inf

    @property
    def is_symmetric(self) -> bool:
        """Whether a motion and its opposite do the same: bodies are symmetric, and each mirrors another or itself."""
        bodies = [(body.block, *body.position) for body in self.assembly.bodies.values()]
        return all(block.is_symmetric and (block, -x, y) in bodies for block, x, y in bodies)

    def end(self, motion: Motion, friction: float) -> tuple[int, float]:
        """Run a motion: index into `OUTCOMES`, and largest lean over α (NaN if it overturns)."""
        # Its engine is compiled on import.
        from colonnade.dynamics.contact.simulate import simulate_assembly

        law = self.law if np.isnan(friction) else replace(self.law, friction=friction)
        history = simulate_assembly(self.assembly, motion, law=law)
        farthest = max(float(np.hypot(x, y)) for x, y, _ in history.residuals.values())
        if history.peak_ratio is None or farthest > self.displaced:
            return OVERTURNS, np.nan
        return OUTCOMES.index(history.outcome), history.peak_ratio


@dataclass(frozen=True)
class Cases:
    """
    All that the histories of an assessment follow from; any part of them can be run anywhere and gives the same.

    Attributes
    ----------
    column : RealColumn
    draws : ndarray, shape (records, draws, 4)
        Made by `draw` for each record; the same at all its levels. Draws of their own make the draws nested in the
        records: what few draws miss shows from record to record.
    motions : tuple of Motion
        Of the records, as recorded; `transverse` is the component y.
    factors : ndarray, shape (records, levels, components)
        What a record's component, and the vertical motion with it, is multiplied by; NaN where it is not run.
    model : str
        A plane one.
    several : OnContact, optional
        What is run in place of the column's block, of which only the drawn friction then counts.

    Raises
    ------
    ValueError
        If a record is too strong or too coarse for the plane models; the message gives its number, from 0.

    Notes
    -----
    A motion and its opposite do the same to a symmetric column: it is run with the sign +1 only.
    """

    column: RealColumn
    draws: Array
    motions: tuple[Motion, ...]
    factors: Array
    model: str = NONLINEAR.name
    several: OnContact | None = None

    def __post_init__(self) -> None:
        plane_model_of(self.model)
        p = self.drawn("p")
        fastest, _ = drawn_column(self.column, self.draws[np.unravel_index(p.argmax(), p.shape)])
        for record, place, plane in components(self.motions):
            largest = np.nanmax(self.factors[record, :, place], initial=0.0)
            try:
                expect_usable(fastest, Motion(largest * plane.acceleration, plane.dt))
            except ValueError as error:
                raise ValueError(f"Record {record}, component {COMPONENTS[place]}: {error}") from None

    @property
    def signs(self) -> tuple[int, ...]:
        """What each case is multiplied by in turn: +1 and −1, or +1 alone."""
        return (1,) if (self.several or self.column).is_symmetric else (1, -1)

    @property
    def shape(self) -> tuple[int, int, int, int, int]:
        """Lengths of `AXES`."""
        records, levels, components = self.factors.shape
        return records, levels, self.draws.shape[1], len(self.signs), components

    def drawn(self, name: str) -> Array:
        """Give one of `UNCERTAIN` of each record and draw, shape (records, draws)."""
        return self.draws[..., UNCERTAIN.index(name)]

    def blocks(self, most: int) -> list[Cases]:
        """Divide the records, in order, into at most so many blocks."""
        size = ceil(len(self.motions) / most)
        parts = [slice(first, first + size) for first in range(0, len(self.motions), size)]
        return [
            replace(self, motions=self.motions[part], draws=self.draws[part], factors=self.factors[part])
            for part in parts
        ]


@dataclass(frozen=True)
class CaseOutcomes:
    """
    How the histories of an assessment end; all arrays have the axes `AXES`.

    Attributes
    ----------
    outcome : ndarray of int8
        Index into `dynamics.plane.run.OUTCOMES`, or `NOT_RUN` or `FALLS_AWAY`.
    peak_ratio : ndarray
        Largest |θ|/α, by the drawn α; NaN if the column overturns or was not run.
    """

    outcome: Codes
    peak_ratio: Array

    @property
    def is_run(self) -> Mask:
        """Whether a case has a history."""
        return np.asarray(self.outcome >= 0)

    def exceeds(self, limit: float = 1.0) -> Mask:
        """Tell which cases overturn or go beyond `limit` α, also if they come back."""
        return np.asarray((self.outcome == OVERTURNS) | (self.peak_ratio > limit))


def factors_at(levels: Array, intensity: Array, power: int = 1) -> Array:
    """
    Give the factors that bring records to levels of a measure.

    Parameters
    ----------
    levels : ndarray, shape (levels,)
    intensity : ndarray, shape (records, components)
        The measure of each as recorded; NaN for a component that is not run.
    power : int, optional
        A record n times as strong has n**power times the measure: 2 of Arias intensity.

    Returns
    -------
    factors : ndarray, shape (records, levels, components)
        As of `Cases`; NaN also where the measure is 0.
    """
    measured = np.where(intensity > 0.0, intensity, np.nan)
    return np.asarray((levels[None, :, None] / measured[:, None, :]) ** (1.0 / power), dtype=np.float64)


def in_plane(motion: Motion, place: int, factor: float) -> Motion | None:
    """Return a horizontal component of a record with its vertical motion, multiplied; None if it is not run."""
    along = (motion.acceleration, motion.transverse)[place]
    if along is None or np.isnan(factor):
        return None
    return Motion(factor * along, motion.dt, None if motion.vertical is None else abs(factor) * motion.vertical)


def components(motions: Sequence[Motion]) -> Iterator[tuple[int, int, Motion]]:
    """Give each horizontal component of records as recorded: number of the record, place in `COMPONENTS`, motion."""
    for record, motion in enumerate(motions):
        for place in range(len(COMPONENTS)):
            if (along := in_plane(motion, place, 1.0)) is not None:
                yield record, place, along


def _planes(cases: Cases) -> Iterator[tuple[tuple[int, ...], Motion]]:
    """Give each plane motion that is run, with its record, level, sign and component."""
    records, levels, _draws, signs, components = cases.shape
    for place in np.ndindex(records, levels, signs, components):
        record, level, sign, component = place
        factor = cases.signs[sign] * float(cases.factors[record, level, component])
        if (plane := in_plane(cases.motions[record], component, factor)) is not None:
            yield place, plane


def run_cases(cases: Cases) -> CaseOutcomes:
    """Run all cases in this process."""
    # The kernels are decorated on import.
    from colonnade.dynamics.plane.sides import sides_of

    found = CaseOutcomes(np.full(cases.shape, NOT_RUN, dtype=np.int8), np.full(cases.shape, np.nan))
    gravity = cases.column.block.gravity
    columns = [[sides_of(*drawn_column(cases.column, values)) for values in draws] for draws in cases.draws]
    for (record, level, sign, component), plane in _planes(cases):
        here = (record, level, slice(None), sign, component)
        if _falls_away(plane, gravity):
            found.outcome[here] = FALLS_AWAY
        elif cases.several is None:
            ends = ends_of(plane, columns[record], gravity=gravity, model=cases.model)
            found.outcome[here], found.peak_ratio[here] = ends
        else:
            several = [cases.several.end(plane, friction) for friction in cases.drawn("friction")[record].tolist()]
            found.outcome[here], found.peak_ratio[here] = zip(*several, strict=True)
    return found


def joined(parts: Sequence[CaseOutcomes]) -> CaseOutcomes:
    """Put the outcomes of blocks of records one behind the other."""
    return CaseOutcomes(*(np.concatenate(each) for each in zip(*(vars(part).values() for part in parts), strict=True)))


def _falls_away(motion: Motion, gravity: float) -> bool:
    return motion.vertical is not None and not motion.vertical.min() > -gravity


LEVELS = 12
"""Levels of an assessment, equally spaced in their logarithm."""

REACH = 50.0
"""Largest factor on the records that is tried, in that from which the first of them uplifts the column."""

TRIALS = 24
"""Levels that are tried, equally spaced in their logarithm, with nothing varied."""


def default_levels(
    column: RealColumn,
    motions: Sequence[Motion],
    intensity: Array,
    *,
    power: int = 1,
    model: str = NONLINEAR.name,
) -> Array:
    """
    Choose levels at which the share of records that overturn goes from 0 to 1.

    Parameters
    ----------
    column : RealColumn
    motions : sequence of Motion
    intensity : ndarray, shape (records, components)
        The measure of each as recorded, at least one positive; NaN for a component that is not run.
    power : int, optional
        As of `factors_at`.
    model : str, optional

    Returns
    -------
    levels : ndarray, shape (`LEVELS`,)
        Rising, in the unit of the measure; from the last trial below the first that overturns the column, to the first
        from which on every record does, or the largest trial. Rounded to three digits.
    """
    # The level from which the first of the records uplifts the column, vertical motion left out.
    lowest = min(
        float(intensity[record, place]) * (column.block.uplift_acceleration / plane.peak) ** power
        for record, place, plane in components(motions)
        if intensity[record, place] > 0.0
    )
    trials = np.geomspace(lowest, REACH**power * lowest, TRIALS)
    draws = np.stack([draw(column, 0)] * len(motions))
    outcomes = run_cases(Cases(column, draws, tuple(motions), factors_at(trials, intensity, power), model))
    run, fell = outcomes.is_run, outcomes.exceeds()
    aside = (0, 2, 3, 4)
    some, every = fell.any(axis=aside), (fell | ~run).all(axis=aside)
    first = int(np.argmax(some)) if some.any() else TRIALS - 1
    standing = np.flatnonzero(~every)
    last = min(int(standing[-1]) + 1 if standing.size else 0, TRIALS - 1)
    ends = trials[max(first - 1, 0)], trials[max(last, first, 1)]
    return np.array([float(f"{level:.3g}") for level in np.geomspace(*ends, LEVELS)])


def friction_needed(cases: Cases) -> Array:
    """
    Find the friction that each record needs at each level, of the column with nothing varied, up to overturning.

    Returns
    -------
    needed : ndarray, shape (records, levels, signs, components)
        Largest |H|/N at rest on the whole base, while it rocks and of the impulses of its impacts; inf where the base
        would have to pull, NaN where it is not run.

    Notes
    -----
    A column at rest needs |a|/(g + v), at most tan α until it uplifts: one with less friction slides instead of
    rocking. Once it rocks, the forces are those of `reactions`.
    """
    records, levels, _draws, signs, components = cases.shape
    block, needed = cases.column.block, np.full((records, levels, signs, components), np.nan)
    at_rest = model_of(cases.model).uplift_threshold(max(side.critical_angle for side in block.sides))
    for place, plane in _planes(cases):
        if _falls_away(plane, block.gravity):
            needed[place] = np.inf
            continue
        history = rock(block, plane, restitution=cases.column.restitution, model=cases.model)
        forces, until = reactions(history, plane), np.fmin(history.overturning_time, np.inf)
        moves = (history.angle != 0.0) | (history.angular_velocity != 0.0)
        # A record that begins with a jump uplifts the column in its first sample: it stands there, but does not rest.
        counts = (forces.time <= until) & (moves | (forces.required_friction <= at_rest))
        impacts = forces.impact_friction[forces.impact_times <= until]
        needed[place] = np.concatenate((forces.required_friction[counts], impacts)).max(initial=0.0)
    return needed
