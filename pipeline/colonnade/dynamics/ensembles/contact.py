"""Ensembles of the contact model over friction, contact damping and the position at release."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from colonnade.arrays import Array
from colonnade.dynamics.block import STANDARD_GRAVITY
from colonnade.dynamics.contact.body import ContactBody
from colonnade.dynamics.contact.calibration import free_restitution
from colonnade.dynamics.contact.history import ContactHistory
from colonnade.dynamics.contact.law import ContactLaw
from colonnade.dynamics.contact.simulate import plane_block, simulate
from colonnade.dynamics.ensembles.ensemble import stride_of
from colonnade.dynamics.ensembles.outcome import KEPT, LEVELS, Ensemble
from colonnade.dynamics.history import capped
from colonnade.dynamics.motion import Motion, at_rest

Range = tuple[float, float]

INPUTS = ("friction", "damping_fraction", "out_of_plane")


@dataclass(frozen=True, eq=False)
class ContactPlan:
    """
    All that an ensemble follows from; its members can be run anywhere, in any order.

    Attributes
    ----------
    body : ContactBody
    law : ContactLaw
        Whose friction and damping fraction each member replaces by its own; of the central run as it is.
    friction, damping_fraction, out_of_plane : pair of float
        Lowest and highest value, all in between equally likely; the rotation about x at the start in rad.
    motion : Motion, optional
        Of the table; without it free rocking for `duration`.
    duration : float, optional
        s.
    theta0, omega0 : float
        rad, rad/s.
    gravity : float
        m/s².
    step : float, optional
        s; see `simulate`.
    count : int
        Members.
    seed : int
        Member k draws from a stream of its own, of (seed, k).
    """

    body: ContactBody
    law: ContactLaw
    friction: Range
    damping_fraction: Range
    out_of_plane: Range = (0.0, 0.0)
    motion: Motion | None = None
    duration: float | None = None
    theta0: float = 0.0
    omega0: float = 0.0
    gravity: float = STANDARD_GRAVITY
    step: float | None = None
    count: int = 100
    seed: int = 0

    def __post_init__(self) -> None:
        if self.count < 1:
            raise ValueError(f"count is {self.count}; at least one member was expected")
        for name in INPUTS:
            low, high = getattr(self, name)
            if not low <= high:
                raise ValueError(f"{name} is ({low}, {high}); the lowest value and then the highest were expected")

    @property
    def table(self) -> Motion:
        """Motion of the table; at rest if none was given."""
        if self.motion is not None:
            return self.motion
        return at_rest(plane_block(self.body, self.gravity), self.duration)

    def central(self) -> ContactHistory:
        """Run the model with its law and the middle rotation out of the plane."""
        return self.run(self.law, sum(self.out_of_plane) / 2)

    def run(self, law: ContactLaw, out_of_plane: float) -> ContactHistory:
        """Run the model with a law and a rotation about x at the start, rad."""
        return simulate(
            self.body,
            self.table,
            law=law,
            gravity=self.gravity,
            step=self.step,
            theta0=self.theta0,
            omega0=self.omega0,
            out_of_plane=out_of_plane,
        )


@dataclass(frozen=True, eq=False)
class Member:
    """
    One run.

    Attributes
    ----------
    inputs : ndarray, shape (3,)
        What it drew, in the order of `INPUTS`.
    restitution : float
        As of `free_restitution`; NaN without an impact.
    peak_ratio, largest_out_of_plane : float
        Largest |θ| and largest rotation about x over the critical angle α; NaN where it overturned.
    overturning_time : float
        s; NaN where it stands.
    angle : ndarray, shape (n,)
        rad, at each `stride_of` samples of the motion.
    """

    inputs: Array
    restitution: float
    peak_ratio: float
    largest_out_of_plane: float
    overturning_time: float
    angle: Array


@dataclass(frozen=True, eq=False, kw_only=True)
class ContactEnsemble(Ensemble):
    """
    What the members did together.

    Attributes
    ----------
    restitution, largest_out_of_plane : ndarray, shape (members,)
        As of `Member`.
    """

    restitution: Array
    largest_out_of_plane: Array
    names: tuple[str, ...] = INPUTS


def run_member(plan: ContactPlan, member: int) -> Member:
    """
    Draw the inputs of one member and run it.

    Raises
    ------
    IndexError
        If the plan has no such member.
    ValueError
        As of `simulate`.
    """
    if not 0 <= member < plan.count:
        raise IndexError(f"member is {member}; a number from 0 to {plan.count - 1} was expected")
    draws = np.random.default_rng((plan.seed, member)).uniform(size=len(INPUTS))
    lows, highs = np.array([getattr(plan, name) for name in INPUTS]).T
    inputs = lows + draws * (highs - lows)
    friction, fraction, out_of_plane = inputs.tolist()
    history = plan.run(replace(plan.law, friction=friction, damping_fraction=fraction), out_of_plane)
    stands = history.outcome != "overturned"
    alpha = history.block.critical_angle
    return Member(
        inputs=inputs,
        restitution=free_restitution(history),
        peak_ratio=float(np.abs(history.angle).max() / alpha) if stands else np.nan,
        largest_out_of_plane=float(np.abs(history.out_of_plane).max() / alpha) if stands else np.nan,
        overturning_time=history.overturning_time,
        angle=history.angle[:: stride_of(plan.table)],
    )


def gather(plan: ContactPlan, members: Sequence[Member]) -> ContactEnsemble:
    """
    Put all members of a plan together, and run what they vary about.

    Raises
    ------
    ValueError
        If their number is not that of the plan.
    """
    if len(members) != plan.count:
        raise ValueError(f"there are {len(members)} members; {plan.count} were expected")
    stride, block = stride_of(plan.table), plane_block(plan.body, plan.gravity)
    return ContactEnsemble(
        time=plan.table.time[::stride],
        central=plan.central().angle[::stride],
        levels=np.asarray(LEVELS),
        bands=np.quantile([each.angle for each in members], LEVELS, axis=0),
        inputs=np.array([each.inputs for each in members]),
        peak_ratio=np.array([each.peak_ratio for each in members]),
        overturning_time=np.array([each.overturning_time for each in members]),
        histories=np.array(
            [capped(plan.table.time[::stride], each.angle, each.overturning_time, block) for each in members[:KEPT]],
            dtype=np.float32,
        ),
        restitution=np.array([each.restitution for each in members]),
        largest_out_of_plane=np.array([each.largest_out_of_plane for each in members]),
    )
