"""All histories of an assessment: records at levels, drawn columns, signs, components; the friction that they need."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cache
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from colonnade.arrays import Array, Codes, Mask
from colonnade.assessment.prototype import Draws, Prototype, draw, drawn_column
from colonnade.dynamics.block import Block
from colonnade.dynamics.models.nonlinear import NONLINEAR
from colonnade.dynamics.models.registry import model_of, plane_model_of
from colonnade.dynamics.motion import Motion
from colonnade.dynamics.plane.outcomes import OVERTURNS, Ends, ends_of, prepared
from colonnade.dynamics.plane.reactions import reactions
from colonnade.dynamics.plane.run import expect_usable
from colonnade.dynamics.rock import rock
from colonnade.validation import number, whole

if TYPE_CHECKING:
    from colonnade.dynamics.plane.sides import Sides

AXES = ("record", "level", "draw", "sign", "component")
"""Of the arrays of an assessment."""

COMPONENTS = ("x", "y")
"""Horizontal components of a record, each a case in its own plane; vertical motion acts with either."""

NOT_RUN, FALLS_AWAY = -1, -2
"""
Outcomes of a case without a history: its record has no such component, or is not wanted at this level; its base falls
faster than the column, so that no plane model holds.
"""

MOST_POWER = 4
"""Of a measure in the strength of a record; Arias intensity has 2."""


@dataclass(frozen=True)
class Cases:
    """
    All that the histories of an assessment follow from; any part of them can be run anywhere and gives the same.

    Attributes
    ----------
    prototype : Prototype
    draws : tuple of Draws
        Of each record, as many for each; the same at all its levels. Draws of their own make the draws nested in the
        records: what few draws miss shows from record to record.
    motions : tuple of Motion
        Of the records, as recorded; `transverse` is the component y.
    factors : ndarray, shape (records, levels, components)
        What a record's component, and the vertical motion with it, is multiplied by; NaN where it is not run.
    model : str
        A plane one.

    Raises
    ------
    ValueError
        If a record is too strong or too coarse for the plane models; the message gives its number, from 0.

    Notes
    -----
    A motion and its opposite do the same to a symmetric column: it is run with the sign +1 only.
    """

    prototype: Prototype
    draws: tuple[Draws, ...]
    motions: tuple[Motion, ...]
    factors: Array
    model: str = NONLINEAR.name

    def __post_init__(self) -> None:
        plane_model_of(self.model)
        record = int(np.argmax([each.of("p").max() for each in self.draws]))
        fastest, _ = drawn_column(self.prototype, self.draws[record], int(self.draws[record].of("p").argmax()))
        for record, place in np.argwhere(np.isfinite(self.factors).any(axis=1)).tolist():
            largest = float(np.nanmax(self.factors[record, :, place]))
            plane = in_plane(self.motions[record], place, largest)
            if plane is None:
                continue
            try:
                expect_usable(fastest, Motion(plane.acceleration, plane.dt))
            except ValueError as error:
                raise ValueError(f"Record {record}, component {COMPONENTS[place]}: {error}") from None

    @property
    def signs(self) -> tuple[int, ...]:
        """What each case is multiplied by in turn: +1 and −1, or +1 alone."""
        return (1,) if self.prototype.is_symmetric else (1, -1)

    @property
    def shape(self) -> tuple[int, int, int, int, int]:
        """Lengths of `AXES`."""
        records, levels, components = self.factors.shape
        return records, levels, self.draws[0].size, len(self.signs), components

    @property
    def count(self) -> int:
        """Number of cases, each run with all signs; numbered by record, component, level and draw, the last fastest."""
        return self.factors.size * self.draws[0].size

    def drawn(self, name: str) -> Array:
        """Give one of `UNCERTAIN` of each record and draw, shape (records, draws)."""
        return np.stack([each.of(name) for each in self.draws])

    def part(self, chosen: range) -> Part:
        """Take some cases in order, with no more of the records than they need."""
        each = self.count // len(self.motions)
        first, last = chosen.start // each, (chosen.stop - 1) // each + 1
        cases = replace(
            self, motions=self.motions[first:last], draws=self.draws[first:last], factors=self.factors[first:last]
        )
        return Part(cases, range(chosen.start - first * each, chosen.stop - first * each))


@dataclass(frozen=True)
class Part:
    """Some cases, small enough to send to another process: of the records in `cases` those numbered `chosen`."""

    cases: Cases
    chosen: range


@dataclass(frozen=True)
class Outcomes:
    """
    How the histories of an assessment end; all arrays have the axes `AXES`.

    Attributes
    ----------
    outcome : ndarray of int8
        Index into `dynamics.plane.harmonic.OUTCOMES`, or `NOT_RUN` or `FALLS_AWAY`.
    peak_ratio : ndarray
        Largest |θ|/α, by the drawn α; NaN if the column overturns or was not run.
    instant : ndarray
        s, of that peak; if it overturns, when |θ| passed α for good; NaN if it was not run.
    """

    outcome: Codes
    peak_ratio: Array
    instant: Array

    @property
    def is_run(self) -> Mask:
        """Whether a case has a history."""
        return np.asarray(self.outcome >= 0)

    def exceeds(self, limit: float = 1.0) -> Mask:
        """Tell which cases overturn or go beyond `limit` α, also if they come back."""
        limit = number("limit", limit, "a positive multiple of the critical angle", above=0.0)
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

    Raises
    ------
    ValueError
        If the power is not positive: no factor changes such a measure.
    """
    whole("power", power, 1, MOST_POWER, "a measure that grows with the record")
    measured = np.where(intensity > 0.0, intensity, np.nan)
    return np.asarray((levels[None, :, None] / measured[:, None, :]) ** (1.0 / power), dtype=np.float64)


def in_plane(motion: Motion, place: int, factor: float) -> Motion | None:
    """Return a horizontal component of a record with its vertical motion, multiplied; None if it has none such."""
    along = (motion.acceleration, motion.transverse)[place]
    if along is None:
        return None
    return Motion(factor * along, motion.dt, None if motion.vertical is None else abs(factor) * motion.vertical)


def run_part(part: Part) -> dict[str, NDArray[Any]]:
    """
    Run some cases.

    Returns
    -------
    arrays : dict of ndarray, shape (cases, signs)
        By the names of `Outcomes`.
    """
    cases, chosen = part.cases, part.chosen
    _records, levels, draws, signs, components = cases.shape

    @cache
    def column(record: int, draw: int) -> Sides:
        return prepared(*drawn_column(cases.prototype, cases.draws[record], draw))

    arrays: dict[str, NDArray[Any]] = {
        "outcome": np.full((len(chosen), signs), NOT_RUN, dtype=np.int8),
        "peak_ratio": np.full((len(chosen), signs), np.nan),
        "instant": np.full((len(chosen), signs), np.nan),
    }
    # Draws of one component of a record at one level follow each other, and share its motion.
    for first in range(chosen.start - chosen.start % draws, chosen.stop, draws):
        row, low, high = first // draws, max(first, chosen.start), min(first + draws, chosen.stop)
        record, place, level = row // (levels * components), row // levels % components, row % levels
        drawn = [column(record, draw) for draw in range(low - first, high - first)]
        here = slice(low - chosen.start, high - chosen.start)
        for side, sign in enumerate(cases.signs):
            ends = _ends(cases, record, place, sign * float(cases.factors[record, level, place]), drawn)
            if isinstance(ends, int):
                arrays["outcome"][here, side] = ends
                continue
            for name, values in ends._asdict().items():
                arrays[name][here, side] = values
    return arrays


def gather(cases: Cases, parts: Iterable[Mapping[str, NDArray[Any]]]) -> Outcomes:
    """Put what `run_part` gave of all cases, in order, onto the axes of an assessment."""
    kept = list(parts)
    records, levels, draws, signs, components = cases.shape
    joined = {
        name: np.concatenate([each[name] for each in kept]).reshape(records, components, levels, draws, signs)
        for name in ("outcome", "peak_ratio", "instant")
    }
    return Outcomes(**{name: np.moveaxis(values, 1, -1) for name, values in joined.items()})


def run_cases(cases: Cases) -> Outcomes:
    """Run all cases in this process."""
    return gather(cases, [run_part(Part(cases, range(cases.count)))])


def _ends(cases: Cases, record: int, place: int, factor: float, drawn: list[Sides]) -> Ends | int:
    """Run drawn columns under one motion; a code if it cannot be run."""
    motion = None if np.isnan(factor) else in_plane(cases.motions[record], place, factor)
    if motion is None:
        return NOT_RUN
    gravity = cases.prototype.block.gravity
    if motion.vertical is not None and not motion.vertical.min() > -gravity:
        return FALLS_AWAY
    return ends_of(motion, drawn, gravity=gravity, model=cases.model)


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


class FrictionNeeded(NamedTuple):
    """
    Largest |H|/N of the column with nothing varied, up to overturning; NaN where it is not run.

    Attributes
    ----------
    standing, rocking, impact : ndarray, shape (records, levels, signs, components)
        While it rests on its whole base, before uplift and between; while it rocks; of the impulses of its impacts.
        0 if it never does; inf where the base would have to pull.
    """

    standing: Array
    rocking: Array
    impact: Array

    @property
    def largest(self) -> Array:
        """Largest of the three, of the same shape."""
        return np.maximum(np.maximum(self.standing, self.rocking), self.impact)


def friction_needed(cases: Cases) -> FrictionNeeded:
    """
    Find the friction that each record needs at each level.

    Returns
    -------
    needed : FrictionNeeded

    Notes
    -----
    A column at rest needs |a|/(g + v), at most tan α until it uplifts: one with less friction slides instead of
    rocking. Once it rocks, the forces are those of `reactions`.
    """
    records, levels, _draws, signs, components = cases.shape
    needed = np.full((3, records, levels, signs, components), np.nan)
    for record, level, sign, place in np.ndindex(needed.shape[1:]):
        factor = float(cases.factors[record, level, place])
        motion = None if np.isnan(factor) else in_plane(cases.motions[record], place, cases.signs[sign] * factor)
        if motion is not None:
            needed[:, record, level, sign, place] = _needed(cases, motion)
    return FrictionNeeded(*needed)


def holds(needed: FrictionNeeded, friction: Array) -> Mask:
    """
    Tell in which cases the column does not slide.

    Parameters
    ----------
    needed : FrictionNeeded
    friction : ndarray, shape (records, draws)
        Drawn coefficients; not of a column without friction.

    Returns
    -------
    holds : ndarray of bool, shape (records, levels, draws, signs, components)
        False also where nothing was run.
    """
    return np.asarray(needed.largest[:, :, None] <= friction[:, None, :, None, None])


def _needed(cases: Cases, motion: Motion) -> tuple[float, float, float]:
    block = cases.prototype.block
    if motion.vertical is not None and not motion.vertical.min() > -block.gravity:
        return 0.0, np.inf, 0.0
    history = rock(block, motion, restitution=cases.prototype.restitution, model=cases.model)
    forces = reactions(history, motion)
    until = history.overturning_time if np.isfinite(history.overturning_time) else np.inf
    upright = (history.angle == 0.0) & (history.angular_velocity == 0.0)
    # A record that begins with a jump uplifts the column in its first sample: it stands there, but does not rest.
    rests = upright & (forces.required_friction <= model_of(cases.model).uplift_threshold(_widest(block)))
    before, landed = forces.time <= until, forces.impact_times <= until
    return (
        float(forces.required_friction[before & rests].max(initial=0.0)),
        float(forces.required_friction[before & ~upright].max(initial=0.0)),
        float(forces.impact_friction[landed].max(initial=0.0)),
    )


def _widest(block: Block) -> float:
    return max(side.critical_angle for side in block.sides)
