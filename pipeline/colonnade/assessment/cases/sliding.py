"""Whether a real column rocks without sliding: the friction that its histories need, against that which is given."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from colonnade.arrays import Array, Mask
from colonnade.assessment.cases.cases import Cases, in_plane
from colonnade.dynamics.block import Block
from colonnade.dynamics.models.registry import model_of
from colonnade.dynamics.motion import Motion
from colonnade.dynamics.plane.reactions import reactions
from colonnade.dynamics.rock import rock


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
