"""Runs of the contact model over what nobody knows exactly: friction, contact damping, how straight it was let go."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from colonnade.dynamics.block import STANDARD_GRAVITY
from colonnade.dynamics.contact.body import ContactBody
from colonnade.dynamics.contact.calibration import free_restitution
from colonnade.dynamics.contact.law import ContactLaw
from colonnade.dynamics.contact.simulate import plane_block, simulate
from colonnade.dynamics.motion import Motion

Array = NDArray[np.float64]
Range = tuple[float, float]

INPUTS = ("friction", "damping_fraction", "out_of_plane")

LEVELS = (0.05, 0.5, 0.95)
"""Quantiles of the band."""


@dataclass(frozen=True, eq=False)
class ContactPlan:
    """
    All that an ensemble follows from; its members can be run anywhere, in any order.

    Attributes
    ----------
    body : ContactBody
    law : ContactLaw
        Whose friction and damping fraction each member replaces by its own.
    friction, damping_fraction, out_of_plane : pair of float
        Lowest and highest value, all in between equally likely; the rotation about x at the start in rad.
    motion : Motion, optional
        Of the table; without it free rocking for `duration`.
    duration : float, optional
        s.
    theta0 : float
        rad.
    gravity : float
        m/s².
    step : float, optional
        s; as of `simulate`.
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


@dataclass(frozen=True, eq=False)
class Member:
    """
    One run.

    Attributes
    ----------
    friction, damping_fraction, out_of_plane : float
        What it drew.
    restitution : float
        As of `free_restitution`; NaN without an impact.
    peak_ratio, largest_out_of_plane : float
        Largest |θ| and largest rotation about x over the critical angle α; NaN where it overturned.
    overturned : bool
    time, angle : ndarray, shape (n,)
        s, rad.
    """

    friction: float
    damping_fraction: float
    out_of_plane: float
    restitution: float
    peak_ratio: float
    largest_out_of_plane: float
    overturned: bool
    time: Array
    angle: Array


@dataclass(frozen=True, eq=False)
class ContactEnsemble:
    """
    What the members did together.

    Attributes
    ----------
    inputs : ndarray, shape (m, 3)
        Of each member, in the order of `INPUTS`.
    restitution, peak_ratio, largest_out_of_plane : ndarray, shape (m,)
    overturned : ndarray of bool, shape (m,)
    time : ndarray, shape (n,)
        s.
    bands : ndarray, shape (len(LEVELS), n)
        Quantiles of the angle, rad.
    """

    inputs: Array
    restitution: Array
    peak_ratio: Array
    largest_out_of_plane: Array
    overturned: NDArray[np.bool_]
    time: Array
    bands: Array

    def correlations(self) -> dict[str, float]:
        """Rank correlation of the restitution with each input that varies."""
        from scipy.stats import spearmanr

        kept = np.isfinite(self.restitution)
        return {
            name: float(spearmanr(values[kept], self.restitution[kept]).statistic)
            for name, values in zip(INPUTS, self.inputs.T, strict=True)
            if np.ptp(values[kept]) > 0.0
        }


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
        raise IndexError(f"there is no member {member}; one from 0 to {plan.count - 1} was expected")
    draws = np.random.default_rng((plan.seed, member)).uniform(size=len(INPUTS))
    lows, highs = np.array([getattr(plan, name) for name in INPUTS]).T
    friction, fraction, out_of_plane = (float(value) for value in lows + draws * (highs - lows))
    history = simulate(
        plan.body,
        plan.motion,
        law=replace(plan.law, friction=friction, damping_fraction=fraction),
        gravity=plan.gravity,
        duration=plan.duration,
        step=plan.step,
        theta0=plan.theta0,
        out_of_plane=out_of_plane,
    )
    overturned = history.outcome == "overturned"
    alpha = plane_block(plan.body, plan.gravity).critical_angle
    return Member(
        friction=friction,
        damping_fraction=fraction,
        out_of_plane=out_of_plane,
        restitution=free_restitution(history),
        peak_ratio=np.nan if overturned else float(np.abs(history.angle).max() / alpha),
        largest_out_of_plane=np.nan if overturned else float(np.abs(history.out_of_plane).max() / alpha),
        overturned=overturned,
        time=history.time,
        angle=history.angle,
    )


def gather(members: Sequence[Member]) -> ContactEnsemble:
    """
    Put members together.

    Raises
    ------
    ValueError
        If there are none.
    """
    if not members:
        raise ValueError("There are no members; at least one was expected")
    return ContactEnsemble(
        inputs=np.array([[getattr(each, name) for name in INPUTS] for each in members]),
        restitution=np.array([each.restitution for each in members]),
        peak_ratio=np.array([each.peak_ratio for each in members]),
        largest_out_of_plane=np.array([each.largest_out_of_plane for each in members]),
        overturned=np.array([each.overturned for each in members]),
        time=members[0].time,
        bands=np.quantile([each.angle for each in members], LEVELS, axis=0),
    )
