"""The stability map of a block over frequency and amplitude of its base motion: its plan, its columns, the whole."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from math import pi, tan
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from colonnade.arrays import Array, Codes
from colonnade.dynamics.block import Block, Sided
from colonnade.dynamics.contact.body import InSpace
from colonnade.dynamics.history import NO_ROCKING_RATIO
from colonnade.dynamics.models import DEFAULT, model_of, plane_model_of
from colonnade.dynamics.motion import Motion
from colonnade.dynamics.plane.run import SAMPLES_A_CYCLE, Harmonic, restitution_up_to
from colonnade.dynamics.restitution_law import Given, Restitution, RestitutionLaw
from colonnade.dynamics.rock import DEFAULT_REST_ANGLE
from colonnade.dynamics.search import (
    MOST_STEPS,
    WIDTH,
    Limits,
    OverFrequency,
    Runs,
    checked_ratios,
    checked_widths,
    in_threads,
    limits_of,
    onset_of,
    over_frequency,
    restitution_options,
    runs_of,
    scan_over,
)
from colonnade.validation import instance, number

EDGE = 1e-4
"""In A: how closely the edges of intervals are found."""

MOST_CYCLES = 100_000
"""Of a sine, and of each of its ramps."""


class MapPlan:
    """
    All that the columns of a map have in common; arguments as for `stability_map`, whose values it checks.

    Parameters
    ----------
    space : InSpace, optional
        Body and law of contact of a model in space, whose restitution they are.

    Raises
    ------
    ValueError
        If an argument is out of its range, an axis does not increase or the model is not known.
    """

    def __init__(
        self,
        block: Block,
        *,
        frequency_ratio: ArrayLike,
        amplitude_ratio: ArrayLike,
        restitution: Given = None,
        cycles: float = 20,
        phase: float = 0.0,
        ramp: float = 0,
        model: str = DEFAULT,
        width: float = WIDTH,
        edge: float = EDGE,
        motion: Motion | None = None,
        motion_frequency: float | None = None,
        space: InSpace | None = None,
    ) -> None:
        instance("block", block, Block)
        if space is None and model_of(model).in_space:
            raise ValueError(f"The {model} model needs `space`; a model in the plane was expected without it")
        if space is None:
            plane_model_of(model)
        self.block, self.model, self.space, self.motion = block, model, space, motion
        self.frequency_ratio = _axis("frequency_ratio", frequency_ratio, 1)
        self.amplitude_ratio = amplitudes = _axis("amplitude_ratio", amplitude_ratio, 2)
        cells = self.frequency_ratio.size * amplitudes.size
        if cells > MOST_STEPS:
            raise ValueError(
                f"amplitude_ratio and frequency_ratio make {cells} cells; at most {MOST_STEPS} were expected"
            )
        self.restitution: Restitution = restitution_up_to(block, restitution, float(amplitudes[-1]))
        expected = f"at least one cycle and at most {MOST_CYCLES}"
        self.cycles = number("cycles", cycles, expected, low=1.0, high=MOST_CYCLES)
        expected = f"a number of cycles from 0 for none to {MOST_CYCLES}"
        self.ramp = number("ramp", ramp, expected, low=0.0, high=MOST_CYCLES)
        self.phase = number("phase", phase, "a finite angle in rad") % (2 * pi)
        self.width, self.edge = checked_widths(width, edge, float(amplitudes[-1] - amplitudes[0]))
        self.motion_frequency = _frequency(motion, motion_frequency)

    @property
    def scan(self) -> Array:
        """The A that every column runs: those of the map, and between them as many as make steps of width / 4."""
        return scan_over(self.amplitude_ratio, self.width)

    @property
    def onset(self) -> float:
        """A up to which an undisturbed block does not uplift: 1, but α / tan α for the linear model."""
        # What uplifts to θ < 0 is the largest acceleration to +x, and the reverse.
        shares = [1.0, 1.0]
        if self.motion is not None:
            shares = [
                float(each.max()) / self.motion.peak for each in (self.motion.acceleration, -self.motion.acceleration)
            ]
        thresholds = [model_of(self.model).uplift_threshold(side.critical_angle) for side in self.block.sides]
        limits = [threshold / share for threshold, share in zip(thresholds, shares, strict=True) if share > 0]
        return min(limits) / tan(self.block.critical_angle)

    @property
    def options(self) -> dict[str, Any]:
        """Everything else that the result depends on, apart from block and axes, by name."""
        forcing: dict[str, Any]
        if self.motion is None:
            forcing = {"cycles": self.cycles, "phase": self.phase, "ramp": self.ramp}
        else:
            forcing = {"motion_frequency": self.motion_frequency, "motion_samples": self.motion.acceleration.size}
        return {
            "model": self.model,
            "base_motion": "sine" if self.motion is None else "recorded",
            **forcing,
            **restitution_options(self.restitution),
            "width": self.width,
            "edge": self.edge,
            "scan_step": float(np.diff(self.scan).max()),
            "rest_angle": DEFAULT_REST_ANGLE,
            "no_rocking_ratio": NO_ROCKING_RATIO,
            "critical_angle": self.block.critical_angle,
            "p": self.block.p,
            **({} if self.space is None else self.space.options | {"samples_a_cycle": SAMPLES_A_CYCLE}),
        }


def _frequency(motion: Motion | None, frequency: float | None) -> float | None:
    """Check a recorded base motion and its frequency, Hz; None without a motion."""
    if motion is not None:
        instance("motion", motion, Motion)
    if (motion is None) != (frequency is None):
        raise ValueError("A motion needs its motion_frequency (Hz), and the reverse; only one of the two was given")
    if motion is None:
        return None
    if not motion.peak > 0:
        raise ValueError("The motion has no acceleration at all, so it cannot be scaled to an A")
    return number("motion_frequency", frequency, "a positive number of Hz", above=0.0)


def _axis(name: str, values: ArrayLike, fewest: int) -> Array:
    axis = checked_ratios(name, values, fewest=fewest)
    if not (np.diff(axis) > 0).all():
        raise ValueError(f"{name} has to be increasing")
    return axis.copy()


def map_part(plan: MapPlan, columns: Sequence[int], threads: int = 1) -> StabilityMap:
    """
    Compute some columns of a map.

    Parameters
    ----------
    plan : MapPlan
    columns : sequence of int
        By their Ω in the plan.
    threads : int, optional
        Columns computed at a time.

    Returns
    -------
    chart : StabilityMap
        Of these Ω; the same to the last bit, whatever the order and the process in which columns are computed.
    """
    scan = plan.scan
    chosen = np.searchsorted(scan, plan.amplitude_ratio)

    def column(index: int) -> tuple[Codes, float, Limits]:
        runs = _runs(plan, float(plan.frequency_ratio[index]))
        codes = runs(scan)
        onset = plan.onset if plan.space is None else onset_of(scan, codes, runs, edge=plan.edge)
        return codes[chosen], onset, limits_of(scan, codes, runs, width=plan.width, edge=plan.edge)

    outcomes, onsets, limits = zip(*in_threads(column, columns, threads), strict=True)
    return StabilityMap(
        **over_frequency(plan.frequency_ratio[list(columns)], limits),
        options=plan.options,
        amplitude_ratio=plan.amplitude_ratio,
        outcome=np.stack(outcomes),
        overturning_fraction=np.stack([_fraction(plan.amplitude_ratio, each.intervals) for each in limits]),
        no_rocking=np.array(onsets),
    )


def _runs(plan: MapPlan, frequency_ratio: float) -> Runs:
    block, omega = plan.block, frequency_ratio * plan.block.p
    motion: Harmonic | tuple[Array, float] = Harmonic.cycles(omega, plan.cycles, phase=plan.phase, ramp=plan.ramp)
    if plan.motion is not None and plan.motion_frequency is not None:
        unit = plan.motion.acceleration * (block.uplift_acceleration / plan.motion.peak)
        motion = unit, plan.motion.dt * plan.motion_frequency * 2 * pi / omega

    return runs_of(block, motion, plan.restitution, plan.model, plan.space)


def _fraction(amplitudes: Array, intervals: Array) -> Array:
    """Share of the cells around the amplitudes that the intervals cover, shape (m,)."""
    middles = 0.5 * (amplitudes[1:] + amplitudes[:-1])
    edges = np.concatenate([amplitudes[:1], middles, amplitudes[-1:]])
    if intervals.size == 0:
        return np.zeros(amplitudes.size)
    lengths = np.cumsum(intervals[:, 1] - intervals[:, 0])
    knots = intervals.ravel()
    covered = np.column_stack([np.concatenate([[0.0], lengths[:-1]]), lengths]).ravel()
    share: Array = np.diff(np.interp(edges, knots, covered)) / np.diff(edges)
    return np.clip(share, 0.0, 1.0, out=share)


@dataclass(frozen=True, repr=False, kw_only=True)
class StabilityMap(OverFrequency):
    """
    Outcomes over Ω and A, and the limits between them.

    Attributes
    ----------
    frequency_ratio, amplitude_ratio : ndarray, shape (n,) and (m,)
        Ω = ω / p and A = a / (g tan α).
    outcome : ndarray of int8, shape (n, m)
        0 no-rocking, 1 rocking, 2 overturned.
    overturning_fraction : ndarray, shape (n, m)
        Share of the cell around each A that overturns.
    no_rocking, lower, upper : ndarray, shape (n,)
        A up to which the block does not uplift, in space searched to the plan's `edge`; from which it first overturns
        over at least `width`; up to which it last survives over at least `width`. NaN if there is no such limit up to
        the largest A.
    interval_frequency_ratio, interval_start, interval_end : ndarray, shape (k,)
        Every interval of A that overturns, islands included, by its Ω.
    options : dict
        All that the limits depend on: model, cycles, phase, ramp, scan step, width, edge,
        restitution, rest rule.

    Examples
    --------
    >>> import colonnade
    >>> block = colonnade.Block.prism(width=0.086, depth=0.086, height=0.456, mass=26.10)
    >>> chart = colonnade.stability_map(block, frequency_ratio=[2.0, 4.0], amplitude_ratio=[0.5, 2.0, 4.0])
    >>> chart.no_rocking.round(2).tolist(), chart.islands.shape[1]
    ([0.99, 0.99], 3)
    >>> chart.digest()["Ω"]
    '2 to 4 in 2'
    """

    amplitude_ratio: Array
    outcome: Codes
    overturning_fraction: Array
    no_rocking: Array

    def digest(self) -> dict[str, str]:
        """
        Return model, axes, and the range of the lower limit.

        Returns
        -------
        digest : dict of str to str
            Names and values with their units, as a notebook shows them.
        """
        amplitudes = self.amplitude_ratio
        levels = f"{amplitudes[0]:.3g} to {amplitudes[-1]:.3g} in {amplitudes.size}"
        return {"model": str(self.options["model"]), "A": levels} | self._limits_digest()


def stability_map(
    block: Block,
    *,
    frequency_ratio: ArrayLike,
    amplitude_ratio: ArrayLike,
    restitution: Sided | RestitutionLaw | Callable[[float], float] | None = None,
    cycles: float = 20,
    phase: float = 0.0,
    ramp: float = 0,
    model: str = DEFAULT,
    width: float = WIDTH,
    edge: float = EDGE,
    motion: Motion | None = None,
    motion_frequency: float | None = None,
    threads: int = 1,
) -> StabilityMap:
    """
    Compute the stability map of a block, from rest, under a harmonic or a stretched recorded base motion.

    Parameters
    ----------
    block : Block
    frequency_ratio, amplitude_ratio : array_like, shape (n,) and (m,)
        Ω = ω / p and A = a / (g tan α), positive and increasing.
    restitution : float, pair of float, RestitutionLaw or function, optional
        e, see `rock`; default the rigid-body value.
    cycles : float, optional
        Number of cycles at full amplitude, at least 1.
    phase : float, optional
        rad: the base acceleration is a sin(ω t + phase).
    ramp : float, optional
        Number of cycles over which the amplitude rises before, and falls after.
    model : str, optional
        A plane one.
    width : float, optional
        In A: intervals narrower than this make no limit.
    edge : float, optional
        In A: how closely the edges of intervals are found.
    motion : Motion, optional
        A recorded base motion in place of the sine: scaled to A, stretched to Ω. `cycles`, `phase` and ramps are then
        those of the recording.
    motion_frequency : float, optional
        Hz, the frequency of the recorded motion that Ω stretches.
    threads : int, optional
        Columns computed at a time. The result is the same to the last bit.

    Returns
    -------
    chart : StabilityMap

    Raises
    ------
    ValueError
        If an argument is out of its range, an axis does not increase or the model is not known.

    Examples
    --------
    >>> block = Block.prism(width=0.086, depth=0.086, height=0.456, mass=26.10)
    >>> chart = stability_map(block, restitution=0.976, frequency_ratio=[2.0, 6.0], amplitude_ratio=[0.5, 1.5, 3.0])
    >>> chart.outcome.tolist()
    [[0, 2, 2], [0, 1, 1]]
    """
    plan = MapPlan(
        block,
        frequency_ratio=frequency_ratio,
        amplitude_ratio=amplitude_ratio,
        restitution=restitution,
        cycles=cycles,
        phase=phase,
        ramp=ramp,
        model=model,
        width=width,
        edge=edge,
        motion=motion,
        motion_frequency=motion_frequency,
    )
    return map_part(plan, range(plan.frequency_ratio.size), threads)
