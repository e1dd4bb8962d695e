"""The plan of a stability map: block, axes, base motion and the rules by which its limits are found."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from math import pi, tan
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike

from colonnade.arrays import Array
from colonnade.dynamics.block import Block, Sided
from colonnade.dynamics.history import NO_ROCKING_RATIO
from colonnade.dynamics.models.registry import DEFAULT, model_of
from colonnade.dynamics.motion import Motion
from colonnade.dynamics.plane.harmonic.motion import Restitution, restitution_up_to
from colonnade.dynamics.restitution_law import RestitutionLaw
from colonnade.dynamics.rock import DEFAULT_REST_ANGLE
from colonnade.validation import instance, number, samples

if TYPE_CHECKING:
    from colonnade.dynamics.maps.space import InSpace


WIDTH = 0.01
"""In A: narrower intervals of overturning, or of survival, are islands and make no limit."""

EDGE = 1e-4
"""In A: how closely the edges of intervals are found."""

LEAST_EDGE = 1e-9
"""In A: the least edge; a finer one is lost in rounding, so that the search for it would not end."""

MOST_CYCLES = 100_000
"""Of a sine, and of each of its ramps."""

MOST_STEPS = 1_000_000
"""Of the scan over A, and cells of a map; a thousand times what a map has."""

LARGEST_RATIO = 1e6
"""Of Ω and A, and one over their least."""

STEPS_A_WIDTH = 4
"""Scan steps a width, at least: nothing wider than a fourth of a width is passed over."""


@dataclass(frozen=True)
class MapPlan:
    """
    All that the columns of a map have in common.

    Attributes
    ----------
    block : Block
    restitution : tuple of float, or RestitutionLaw
        e of impacts that end an arc at θ < 0, and at θ > 0; or e over the speed of the impact.
    model : str
    frequency_ratio, amplitude_ratio : ndarray
        Ω, shape (n,), and A, shape (m,), both increasing.
    cycles, phase, ramp : float
        Cycles at full amplitude; phase of their beginning, rad; cycles of the rise before and fall after them.
    width, edge : float
        In A, see `WIDTH` and `EDGE`.
    motion : Motion, optional
        A recorded base motion in place of the sine: scaled so that its largest |a| gives A, and stretched in time so
        that `motion_frequency` (Hz) gives Ω.
    motion_frequency : float, optional
    space : InSpace, optional
        Body and law of contact of a model in space, whose restitution they are.
    """

    block: Block
    restitution: Restitution
    model: str
    frequency_ratio: Array
    amplitude_ratio: Array
    cycles: float
    phase: float
    ramp: float
    width: float
    edge: float
    motion: Motion | None
    motion_frequency: float | None
    space: InSpace | None = None

    @property
    def scan(self) -> Array:
        """The A that every column runs: those of the map, and between them as many as make steps of width / 4."""
        parts = []
        for low, high in zip(self.amplitude_ratio[:-1], self.amplitude_ratio[1:], strict=True):
            steps = max(1, int(np.ceil((high - low) / (self.width / STEPS_A_WIDTH) * (1 - 1e-9))))
            parts.append(low + (high - low) / steps * np.arange(steps))
        return np.concatenate([*parts, self.amplitude_ratio[-1:]])

    @property
    def onset(self) -> float:
        """A up to which an undisturbed block does not uplift: 1, but α / tan α for the linear model."""
        positive, negative = 1.0, 1.0
        if self.motion is not None:
            positive = max(float(self.motion.acceleration.max()), 0.0) / self.motion.peak
            negative = max(-float(self.motion.acceleration.min()), 0.0) / self.motion.peak
        limits = []
        for side, share in ((self.block.negative, positive), (self.block.positive, negative)):
            threshold = model_of(self.model).uplift_threshold(side.critical_angle)
            limits.append(threshold / share if share > 0 else np.inf)
        return float(min(limits) / tan(self.block.critical_angle))

    @property
    def options(self) -> dict[str, Any]:
        """Everything else that the result depends on, apart from block and axes, by name."""
        forcing: dict[str, Any]
        if self.motion is None:
            forcing = {"cycles": self.cycles, "phase": self.phase, "ramp": self.ramp}
        else:
            forcing = {"motion_frequency": self.motion_frequency, "motion_samples": self.motion.acceleration.size}
        e: dict[str, Any]
        if isinstance(self.restitution, RestitutionLaw):
            e = {
                "restitution_speeds": self.restitution.speeds.tolist(),
                "restitution_values": self.restitution.values.tolist(),
            }
        else:
            e = dict(zip(("restitution_negative", "restitution_positive"), self.restitution, strict=True))
        return {
            "model": self.model,
            "base_motion": "sine" if self.motion is None else "recorded",
            **forcing,
            **e,
            "width": self.width,
            "edge": self.edge,
            "scan_step": float(np.diff(self.scan).max()),
            "rest_angle": DEFAULT_REST_ANGLE,
            "no_rocking_ratio": NO_ROCKING_RATIO,
            "critical_angle": self.block.critical_angle,
            "p": self.block.p,
            **({} if self.space is None else self.space.options),
        }


def plan_map(
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
    space: InSpace | None = None,
) -> MapPlan:
    """
    Check the arguments of a map and make its plan; arguments as for `stability_map`.

    Raises
    ------
    ValueError
        If an argument is out of its range, an axis does not increase or the model is not known.
    """
    instance("block", block, Block)
    if space is None and model_of(model).in_space:
        raise ValueError(f"The {model} model needs `space`; a model in the plane was expected without it")
    frequencies = _axis("frequency_ratio", frequency_ratio, 1)
    amplitudes = _axis("amplitude_ratio", amplitude_ratio, 2)
    cells = frequencies.size * amplitudes.size
    if cells > MOST_STEPS:
        raise ValueError(f"amplitude_ratio and frequency_ratio make {cells} cells; at most {MOST_STEPS} were expected")
    e = restitution_up_to(block, restitution, float(amplitudes[-1]))
    cycles = number("cycles", cycles, f"at least one cycle and at most {MOST_CYCLES}", low=1.0, high=MOST_CYCLES)
    ramp = number("ramp", ramp, f"a number of cycles from 0 for none to {MOST_CYCLES}", low=0.0, high=MOST_CYCLES)
    phase = number("phase", phase, "a finite angle in rad")
    width, edge = checked_widths(width, edge, float(amplitudes[-1] - amplitudes[0]))
    motion_frequency = _frequency(motion, motion_frequency)
    return MapPlan(
        block,
        e,
        model,
        frequencies,
        amplitudes,
        cycles,
        phase % (2 * pi),
        ramp,
        width,
        edge,
        motion,
        motion_frequency,
        space,
    )


def checked_widths(width: float, edge: float, height: float) -> tuple[float, float]:
    """
    Check the least width of a limit and the closeness of its edges where A goes over `height`.

    Raises
    ------
    ValueError
        If one is so small that the search would not end, or the edge is wider than the width.
    """
    finest = STEPS_A_WIDTH * height / MOST_STEPS
    width = number("width", width, f"a width in A, at least {finest:.3g} for the scan to end,", above=0.0, low=finest)
    edge = number("edge", edge, f"a number in A, at least {LEAST_EDGE:g},", low=LEAST_EDGE)
    if not edge <= width:
        raise ValueError(f"edge is {edge} and width {width}; 0 < edge ≤ width was expected, in units of A")
    return width, edge


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
    axis = samples(name, values, fewest=fewest, finite=False)
    if not (np.isfinite(axis).all() and axis[0] > 0 and (np.diff(axis) > 0).all()):
        raise ValueError(f"{name} has to be positive, finite and increasing")
    if not (axis[0] >= 1 / LARGEST_RATIO and axis[-1] <= LARGEST_RATIO):
        raise ValueError(
            f"{name} goes from {axis[0]:g} to {axis[-1]:g}; {1 / LARGEST_RATIO:g} to {LARGEST_RATIO:g} was expected"
        )
    return axis.copy()
