"""One harmonic base motion on one block, by the kernels of either model."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from importlib import import_module
from math import inf, isfinite, pi, tan
from typing import Any

import numpy as np
from numpy.typing import NDArray

from colonnade.dynamics.block import Block
from colonnade.dynamics.history import NO_ROCKING_RATIO
from colonnade.dynamics.rock import DEFAULT_REST_ANGLE
from colonnade.errors import nearest

Array = NDArray[np.float64]
Codes = NDArray[np.int8]

KERNELS = {"linear": "colonnade.dynamics.harmonic", "nonlinear": "colonnade.dynamics.harmonic_nonlinear"}
"""Where the kernels of each model stand; they are compiled on import, so only those asked for are."""

OUTCOMES = ("no-rocking", "rocking", "overturned")
"""What the codes 0, 1 and 2 mean."""


@dataclass(frozen=True)
class Harmonic:
    """
    A base motion a(t) = A g tan α · l(t) sin(ω t + phase), from rest at t = 0 and followed by none.

    Attributes
    ----------
    omega : float
        ω, rad/s.
    phase : float
        rad.
    edges : tuple of float
        s: end of the linear rise of l from 0 to 1, of its constant part, and of its linear fall; equal ones leave a
        part out.
    """

    omega: float
    phase: float
    edges: tuple[float, float, float]

    @classmethod
    def cycles(cls, omega: float, cycles: float, *, phase: float = 0.0, ramp: float = 0.0) -> Harmonic:
        """Whole or broken cycles at full amplitude between a rise and a fall of `ramp` cycles each."""
        period = 2 * pi / omega
        return cls(omega, phase, (ramp * period, (ramp + cycles) * period, (2 * ramp + cycles) * period))


@dataclass(frozen=True)
class HarmonicRun:
    """
    What one run gives.

    Attributes
    ----------
    outcome : str
        Of `OUTCOMES`.
    peak_ratio : float
        Largest |θ|/α under the motion up to overturning, from the time asked for on.
    angle, angular_velocity : ndarray, shape (n,)
        rad, rad/s, at the samples asked for.
    impact_times, impact_velocities : ndarray, shape (m,)
        s; rad/s just before each impact.
    """

    outcome: str
    peak_ratio: float
    angle: Array
    angular_velocity: Array
    impact_times: Array
    impact_velocities: Array


def check_model(model: str) -> None:
    """
    Refuse a model without kernels for harmonic motion.

    Raises
    ------
    ValueError
        Naming the nearest one.
    """
    if model not in KERNELS:
        raise ValueError(f'There is no model "{model}" for harmonic motion.{nearest(model, list(KERNELS))}')


def harmonic_run(
    block: Block,
    motion: Harmonic,
    amplitude_ratio: float,
    restitution: Sequence[float],
    *,
    model: str = "linear",
    samples: int = 0,
    interval: float = 1.0,
    peaks_from: float = 0.0,
    largest_count: int = 4096,
) -> HarmonicRun:
    """
    Run a block from rest under a harmonic motion, without sampling that motion.

    Parameters
    ----------
    block : Block
    motion : Harmonic
    amplitude_ratio : float
        A = a / (g tan α).
    restitution : pair of float
        e of impacts that end an arc at θ < 0, and at θ > 0.
    model : {"linear", "nonlinear"}
    samples : int, optional
        Number of samples of the history wanted, at `interval` (s) from time 0.
    interval : float, optional
    peaks_from : float, optional
        s, from when on `peak_ratio` counts.
    largest_count : int, optional
        Impacts kept.

    Raises
    ------
    ValueError
        If A is not positive or the model is not known.
    """
    check_model(model)
    if not (isfinite(amplitude_ratio) and amplitude_ratio > 0):
        raise ValueError(f"amplitude_ratio is {amplitude_ratio}; a positive number was expected")
    history, impacts = np.zeros((samples, 2)), np.zeros((largest_count, 2))
    overturned, peak, count = _kernels(model).run(
        (motion.omega, motion.phase, amplitude_ratio * tan(block.critical_angle)),
        np.array(motion.edges),
        _sides(block, restitution),
        DEFAULT_REST_ANGLE,
        (peaks_from, inf, interval),
        history,
        impacts,
    )
    outcome = OUTCOMES[2 if overturned else 1 if peak > NO_ROCKING_RATIO else 0]
    kept = impacts[: min(count, largest_count)]
    return HarmonicRun(outcome, peak, history[:, 0], history[:, 1], kept[:, 0], kept[:, 1])


def harmonic_outcomes(
    block: Block, motion: Harmonic, amplitude_ratio: Array, restitution: Sequence[float], model: str
) -> Codes:
    """Outcomes of many A under one motion, indices into `OUTCOMES`, shape (n,)."""
    check_model(model)
    outcomes: Codes = _kernels(model).column(
        motion.omega,
        motion.phase,
        amplitude_ratio * tan(block.critical_angle),
        np.array(motion.edges),
        _sides(block, restitution),
        DEFAULT_REST_ANGLE,
        NO_ROCKING_RATIO,
    )
    return outcomes


def _kernels(model: str) -> Any:
    return import_module(KERNELS[model])


def _sides(block: Block, restitution: Sequence[float]) -> Array:
    sides = (block.negative, block.positive)
    return np.array([[side.critical_angle for side in sides], [block.side_p(side) for side in sides], restitution])
