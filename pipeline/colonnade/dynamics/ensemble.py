"""Many runs of one motion over what is not exactly known: their bands, and how many overturn."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from math import ceil, nan
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from colonnade.arrays import Array
from colonnade.dynamics.block import Block, Sided
from colonnade.dynamics.history import History, capped
from colonnade.dynamics.models import DEFAULT
from colonnade.dynamics.motion import Motion
from colonnade.dynamics.rock import DEFAULT_REST_ANGLE, of_sides, rock
from colonnade.dynamics.uncertainty import (
    INPUTS,
    MotionDraws,
    Uncertainty,
    draw_inputs,
    member_block,
    member_restitution,
)
from colonnade.units.text import Digested
from colonnade.validation import instance, number, whole

if TYPE_CHECKING:
    from colonnade.dynamics.contact.history import AssemblyHistory

Histories = NDArray[np.float32]

LEVELS = (0.025, 0.25, 0.5, 0.75, 0.975)
"""Quantiles of the bands: the middle, half of all members, 95 % of them."""

KEPT = 200
"""Members whose whole histories are kept."""

LONGEST_CLOCK = 25_000
"""Samples of a band; a longer record's band takes every second, third … of its samples."""

MOST_ANGLES = 100_000_000
"""Of all members at all samples of the band, 400 MB; with more members the band has fewer samples."""

MOST_MEMBERS = 10_000_000
LARGEST_SEED = 2**63 - 1


@dataclass(frozen=True, repr=False)
class Ensemble(Digested):
    """
    What all members together say.

    Attributes
    ----------
    time : ndarray, shape (n,)
        s, on the record's clock.
    central : ndarray, shape (n,)
        rad, θ with nothing varied.
    levels : ndarray, shape (q,)
        Shares of the members, 0 to 1, that the bands are for.
    bands : ndarray, shape (q, n)
        rad, quantiles of θ at each time.
    inputs : ndarray, shape (members, inputs)
        Of each member: what is added to e (dimensionless) and θ₀ (rad), and factors on the others.
    peak_ratio : ndarray, shape (members,)
        max |θ|/α of each member up to overturning.
    overturning_time : ndarray, shape (members,)
        s, on the record's clock; NaN for a member that stands.
    histories : ndarray of float32, shape (k, n)
        rad, θ of the first members, at most `KEPT`, up to ±α: one that overturned stays there.
    names : tuple of str
        Of the inputs.

    Examples
    --------
    >>> import numpy as np
    >>> import colonnade
    >>> block = colonnade.Block.prism(width=0.086, depth=0.086, height=0.456, mass=26.10)
    >>> motion = colonnade.Motion(3.0 * np.sin(np.arange(600) * 0.2), 0.005)
    >>> inputs = colonnade.Uncertainty(restitution=0.005, gain=0.02)
    >>> found = colonnade.ensemble(block, motion, restitution=0.95, uncertainty=inputs, count=50)
    >>> found.overturning_probability, found.horizon(0.5 * block.critical_angle)
    (0.0, 2.995)
    >>> found
    <Ensemble: overturning_probability 0, peak_ratio 0.119 to 0.135, time 0 to 3 s>
    """

    _ESSENCE = "overturning_probability, peak_ratio, time s"

    time: Array
    central: Array
    levels: Array
    bands: Array
    inputs: Array
    peak_ratio: Array
    overturning_time: Array
    histories: Histories
    names: tuple[str, ...] = INPUTS

    def horizon(self, width: float) -> float:
        """
        Return the first time at which the widest band is wider than this, else the last one.

        Parameters
        ----------
        width : float
            rad.

        Returns
        -------
        horizon : float
            s, on the record's clock.
        """
        wide = self.bands[-1] - self.bands[0] > number("width", width, "a positive angle in rad", above=0.0)
        return float(self.time[int(np.argmax(wide)) if wide.any() else -1])

    @property
    def overturning_probability(self) -> float:
        """Share of the members that overturn."""
        return float(np.isfinite(self.overturning_time).mean())


@dataclass(frozen=True, kw_only=True)
class Plan(ABC):
    """
    All that an ensemble follows from; each member can be run alone, and is the same whatever their number.

    Attributes
    ----------
    block : Block
    motion : Motion
        As recorded.
    theta0, omega0 : float
        rad, rad/s.
    count : int
        Members.
    seed : int
        Member k draws from a stream of its own, of (seed, k).
    """

    block: Block
    motion: Motion
    theta0: float = 0.0
    omega0: float = 0.0
    count: int = 1000
    seed: int = 0

    def __post_init__(self) -> None:
        instance("block", self.block, Block)
        instance("motion", self.motion, Motion)
        whole("count", self.count, 1, MOST_MEMBERS, f"at least one member, and at most {MOST_MEMBERS},")
        whole("seed", self.seed, 0, LARGEST_SEED)

    @property
    def names(self) -> tuple[str, ...]:
        """Of the inputs."""
        return INPUTS

    @abstractmethod
    def central(self) -> History | AssemblyHistory:
        """Run the model with nothing varied."""

    @abstractmethod
    def follow(self, random: np.random.Generator) -> tuple[Array, History | AssemblyHistory]:
        """Draw what one member takes, in the order of `names`, and run the model with it."""

    def member(self, member: int) -> tuple[Array, History | AssemblyHistory]:
        """Run one member alone: what it drew, and its history on its own clock."""
        return self.follow(np.random.default_rng(np.random.SeedSequence(self.seed, spawn_key=(member,))))

    def ends(self, history: Any) -> dict[str, Array]:
        """What else is kept of the end of one member's history, by name."""
        return {}

    def run(self) -> Ensemble:
        """Run all members."""
        central = self.central_angle()
        return self.gather(central, [self.members(central, range(self.count))])

    def central_angle(self) -> Array:
        """Give the angle with nothing varied, on the clock of the bands."""
        return self.central().angle[:: self._stride]

    @property
    def _stride(self) -> int:
        size = self.motion.acceleration.size
        return max(ceil(size / LONGEST_CLOCK), ceil(size * self.count / MOST_ANGLES))

    def members(self, central: Array, members: range) -> dict[str, NDArray[Any]]:
        """
        Run some of the members.

        Parameters
        ----------
        central : ndarray, shape (n,)
            rad, of `central_angle`.
        members : range
            Their numbers, rising.

        Returns
        -------
        found : dict of str to ndarray
            By member `inputs`, `peak_ratio`, `overturning_time` (s), `deviation` from the central angle (rad), and
            those of `ends`; `histories` (rad) of those among the first `KEPT`. The same whoever runs them.
        """
        size = len(members)
        found: dict[str, NDArray[Any]] = {
            "inputs": np.empty((size, len(self.names))),
            "peak_ratio": np.empty(size),
            "overturning_time": np.empty(size),
            "deviation": np.empty((size, central.size), dtype=np.float32),
            "histories": np.empty((len(range(KEPT)[members.start : members.stop]), central.size), dtype=np.float32),
        }
        ends = []
        for row, member in enumerate(members):
            found["inputs"][row], history = self.member(member)
            found["peak_ratio"][row] = nan if history.peak_ratio is None else history.peak_ratio
            found["overturning_time"][row] = history.overturning_time * (self.motion.time[-1] / history.time[-1])
            found["deviation"][row] = history.angle[:: self._stride] - central
            if member < KEPT:
                standing = capped(history.time, history.angle, history.overturning_time, self.block)
                found["histories"][row] = standing[:: self._stride]
            ends.append(self.ends(history))
        return found | {name: np.array([each[name] for each in ends]) for name in ends[0]}

    def gather(self, central: Array, parts: Sequence[Mapping[str, NDArray[Any]]]) -> Ensemble:
        """Put what `members` gave of all of them, in their order, into an ensemble."""
        inputs, peaks, overturned, deviations, histories = (
            parts[0][name] if len(parts) == 1 else np.concatenate([part[name] for part in parts])
            for name in ("inputs", "peak_ratio", "overturning_time", "deviation", "histories")
        )
        bands = central + np.quantile(deviations, LEVELS, axis=0, overwrite_input=True)
        time = self.motion.time[:: self._stride]
        return Ensemble(time, central, np.asarray(LEVELS), bands, inputs, peaks, overturned, histories, self.names)


@dataclass(frozen=True, kw_only=True)
class PlanePlan(Plan):
    """
    Of a model in the plane, over the block, e and the motion.

    Attributes
    ----------
    restitution : float or pair of float
    uncertainty : Uncertainty
    model : str
    rest_angle : float
        As of `rock`.
    """

    restitution: Sided
    uncertainty: Uncertainty
    model: str = DEFAULT
    rest_angle: float = DEFAULT_REST_ANGLE

    def __post_init__(self) -> None:
        super().__post_init__()
        instance("uncertainty", self.uncertainty, Uncertainty)

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

    def follow(self, random: np.random.Generator) -> tuple[Array, History]:
        """Draw what one member takes, in the order of `INPUTS`, and a motion, and run the model with it."""
        inputs = draw_inputs(self.uncertainty, random)
        e, critical_angle, p, gain, clock, cutoff, theta0 = inputs.tolist()
        drawn = replace(
            self,
            block=member_block(self.block, critical_angle, p),
            motion=self._motions.draw(random, gain=gain, clock=clock, cutoff=cutoff),
            restitution=member_restitution(self.restitution, e),
            theta0=self.theta0 + theta0,
        )
        return inputs, drawn.central()

    @cached_property
    def _motions(self) -> MotionDraws:
        return MotionDraws(self.motion, self.uncertainty)


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
    model, theta0 : optional
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
    plan = PlanePlan(
        block=block,
        motion=motion,
        restitution=of_sides(instance("block", block, Block), restitution),
        uncertainty=uncertainty,
        count=count,
        seed=seed,
        model=model,
        theta0=theta0,
    )
    return plan.run()
