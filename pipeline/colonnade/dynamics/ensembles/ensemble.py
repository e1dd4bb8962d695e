"""Thousands of runs of one recorded motion over uncertain inputs: bands, overturning, sensitivity."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from math import ceil

import numpy as np

from colonnade.arrays import Array
from colonnade.dynamics.block import Block, Sided
from colonnade.dynamics.ensembles.bands import Counts, band, count, empty_counts
from colonnade.dynamics.ensembles.outcome import KEPT, LEVELS, Ensemble, Histories
from colonnade.dynamics.ensembles.uncertainty import (
    INPUTS,
    MotionDraws,
    Uncertainty,
    draw_inputs,
    member_block,
    member_restitution,
)
from colonnade.dynamics.history import History, capped
from colonnade.dynamics.models.registry import DEFAULT
from colonnade.dynamics.motion import Motion
from colonnade.dynamics.rock import DEFAULT_REST_ANGLE, rock
from colonnade.validation import instance, sided, whole

LONGEST_CLOCK = 25_000
"""Samples of a band; a longer record's band takes every second, third … of its samples."""

MOST_MEMBERS = 10_000_000
LARGEST_SEED = 2**63 - 1

_BATCH = 128
"""Members that are run before they are counted together."""


@dataclass(frozen=True)
class Plan:
    """
    All that an ensemble follows from; any part of its members can be run anywhere and gives the same.

    Attributes
    ----------
    block : Block
    motion : Motion
        As recorded.
    restitution : float or pair of float
    uncertainty : Uncertainty
    count : int
        Members.
    seed : int
        Member k draws from a stream of its own, of (seed, k).
    model : str
    theta0, omega0 : float
        rad, rad/s.
    rest_angle : float
        As of `rock`.
    """

    block: Block
    motion: Motion
    restitution: Sided
    uncertainty: Uncertainty
    count: int = 1000
    seed: int = 0
    model: str = DEFAULT
    theta0: float = 0.0
    rest_angle: float = DEFAULT_REST_ANGLE
    omega0: float = 0.0

    def __post_init__(self) -> None:
        instance("block", self.block, Block)
        instance("motion", self.motion, Motion)
        instance("uncertainty", self.uncertainty, Uncertainty)
        sided("restitution", self.restitution, "a number between 0 and 1", low=0.0, high=1.0)
        whole("count", self.count, 1, MOST_MEMBERS, f"at least one member, and at most {MOST_MEMBERS},")
        whole("seed", self.seed, 0, LARGEST_SEED)

    @property
    def stride(self) -> int:
        """Samples of the record to each of the band."""
        return stride_of(self.motion)

    def central(self) -> History:
        """Run the model on what was recorded, nothing varied."""
        return rock(
            self.block,
            self.motion,
            restitution=self.restitution,
            model=self.model,
            theta0=self.theta0,
            omega0=self.omega0,
            rest_angle=self.rest_angle,
        )


@dataclass(frozen=True)
class Part:
    """
    Some members of an ensemble, in order.

    Attributes
    ----------
    start : int
        Number of the first.
    inputs : ndarray, shape (members, 7)
        What each drew, by `INPUTS`.
    peak_ratio : ndarray, shape (members,)
        max |θ|/α, by the member's own α; NaN where it overturned.
    overturning_time : ndarray, shape (members,)
        s on the record's clock; NaN where it stands.
    counts : ndarray, shape (samples, BINS)
        Of the deviations from the central history.
    histories : ndarray of float32, shape (kept members, samples)
        As of `Ensemble`, of those of its members that are among the first `KEPT`.
    """

    start: int
    inputs: Array
    peak_ratio: Array
    overturning_time: Array
    counts: Counts
    histories: Histories


def ensemble(
    block: Block,
    motion: Motion,
    *,
    uncertainty: Uncertainty,
    restitution: Sided | None = None,
    count: int = 1000,
    seed: int = 0,
    model: str = DEFAULT,
    theta0: float = 0.0,
    rest_angle: float = DEFAULT_REST_ANGLE,
) -> Ensemble:
    """
    Re-run a recorded motion over the uncertainty of the block, of e and of the motion itself.

    Parameters
    ----------
    block : Block
    motion : Motion
        As recorded.
    uncertainty : Uncertainty
        What is not exactly known, and how well it is.
    restitution : float or pair of float, optional
        Mean of e. Default: the rigid-body value.
    count : int, optional
        Members.
    seed : int, optional
        The same seed gives the same members, however many there are.
    model, theta0, rest_angle : optional
        As of `rock`.

    Returns
    -------
    ensemble : Ensemble

    Raises
    ------
    ValueError
        If an argument is out of its range.

    Examples
    --------
    >>> block = Block.prism(width=0.086, depth=0.086, height=0.456, mass=26.10)
    >>> motion = Motion(3.0 * np.sin(np.arange(600) * 0.2), 0.005)
    >>> result = ensemble(block, motion, restitution=0.976, uncertainty=Uncertainty(restitution=0.002), count=50)
    >>> result.bands.shape, result.overturning_probability
    ((5, 600), 0.0)
    """
    e = instance("block", block, Block).restitution if restitution is None else restitution
    plan = Plan(block, motion, e, uncertainty, count, seed, model, theta0, rest_angle)
    return gather(plan, [run_members(plan, 0, count)])


def stride_of(motion: Motion) -> int:
    """Give the samples of a record to each of a band."""
    return ceil(motion.acceleration.size / LONGEST_CLOCK)


def run_members(plan: Plan, start: int, stop: int) -> Part:
    """Run the members from `start` up to, not including, `stop`."""
    central = plan.central().angle[:: plan.stride]
    draws = MotionDraws(plan.motion, plan.uncertainty)
    number = stop - start
    inputs, peaks, overturned = np.empty((number, len(INPUTS))), np.empty(number), np.empty(number)
    counts = empty_counts(central.size)
    deviations = np.empty((_BATCH, central.size), dtype=np.float32)
    histories = np.empty((max(min(stop, KEPT) - start, 0), central.size), dtype=np.float32)
    for place in range(number):
        inputs[place], history = _member(plan, draws, start + place)
        peak = history.peak_ratio
        peaks[place] = np.nan if peak is None else peak
        overturned[place] = history.overturning_time / inputs[place, INPUTS.index("clock")]
        if place < len(histories):
            standing = capped(history.time, history.angle, history.overturning_time, plan.block)
            histories[place] = standing[:: plan.stride]
        batched = place % _BATCH
        deviations[batched] = (history.angle[:: plan.stride] - central) / plan.block.critical_angle
        if batched == _BATCH - 1 or place == number - 1:
            count(counts, deviations[: batched + 1])
    return Part(start, inputs, peaks, overturned, counts, histories)


def gather(plan: Plan, parts: Iterable[Part], levels: Sequence[float] = LEVELS) -> Ensemble:
    """
    Put the parts of an ensemble together, in whatever order they come; only one is held at a time.

    Raises
    ------
    ValueError
        If a member is missing or is there twice.
    """
    central = plan.central().angle[:: plan.stride]
    counts = empty_counts(central.size)
    members: dict[int, tuple[Array, Array, Array, Histories]] = {}
    for part in parts:
        counts += part.counts
        members[part.start] = (part.inputs, part.peak_ratio, part.overturning_time, part.histories)
    expected = 0
    for start in sorted(members):
        if start != expected:
            raise ValueError(f"a part starts with member {start}; {expected} was expected")
        expected += members[start][1].size
    if expected != plan.count:
        raise ValueError(f"the parts hold {expected} members; {plan.count} were expected")
    joined = (np.concatenate(each) for each in zip(*(members[start] for start in sorted(members)), strict=True))
    inputs, peak_ratio, overturning_time, histories = joined
    return Ensemble(
        time=plan.motion.time[:: plan.stride],
        central=central,
        levels=np.asarray(levels, dtype=np.float64),
        bands=central + plan.block.critical_angle * band(counts, levels),
        inputs=inputs,
        peak_ratio=peak_ratio,
        overturning_time=overturning_time,
        histories=histories,
    )


def run_member(plan: Plan, member: int) -> tuple[Array, History]:
    """Run one member alone: what it drew, and its history on its own clock."""
    return _member(plan, MotionDraws(plan.motion, plan.uncertainty), member)


def _member(plan: Plan, draws: MotionDraws, member: int) -> tuple[Array, History]:
    random = np.random.default_rng(np.random.SeedSequence(plan.seed, spawn_key=(member,)))
    inputs = draw_inputs(plan.uncertainty, random)
    drawn = dict(zip(INPUTS, inputs.tolist(), strict=True))
    history = rock(
        member_block(plan.block, drawn["critical_angle"], drawn["p"]),
        draws.draw(random, gain=drawn["gain"], clock=drawn["clock"], cutoff=drawn["cutoff"]),
        restitution=member_restitution(plan.restitution, drawn["restitution"]),
        model=plan.model,
        theta0=plan.theta0 + drawn["theta0"],
        omega0=plan.omega0,
        rest_angle=plan.rest_angle,
    )
    return inputs, history
