"""How many blocks end under one sampled base motion: outcome, largest angle and when, without their histories."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from colonnade.arrays import Array, Codes
from colonnade.dynamics.block import Block, Sided
from colonnade.dynamics.history import NO_ROCKING_RATIO
from colonnade.dynamics.models.registry import plane_model_of
from colonnade.dynamics.motion import Motion
from colonnade.dynamics.plane.harmonic.motion import OUTCOMES
from colonnade.dynamics.plane.run import series_of
from colonnade.dynamics.rock import DEFAULT_REST_ANGLE
from colonnade.validation import sided

if TYPE_CHECKING:
    from colonnade.dynamics.plane.sides import Sides

STANDS, ROCKS, OVERTURNS = range(len(OUTCOMES))
"""Indices into `OUTCOMES`."""


class Ends(NamedTuple):
    """
    How the histories of n blocks end.

    Attributes
    ----------
    outcome : ndarray of int8, shape (n,)
        Index into `OUTCOMES`.
    peak_ratio : ndarray, shape (n,)
        Largest |θ|/α at the samples; NaN if the block overturns.
    instant : ndarray, shape (n,)
        s, of that peak, 0 without rocking; if the block overturns, when |θ| passed α for good.
    """

    outcome: Codes
    peak_ratio: Array
    instant: Array


def prepared(block: Block, restitution: Sided) -> Sides:
    """
    Put a block and its e into the form that the kernels take; once, as it may run under many motions.

    Raises
    ------
    ValueError
        If e is not between 0 and 1.
    """
    from colonnade.dynamics.plane.sides import sides_of

    e = sided("restitution", restitution, "a number between 0 and 1", low=0.0, high=1.0)
    return sides_of(block, e, DEFAULT_REST_ANGLE)


def ends_of(motion: Motion, blocks: Sequence[Sides], *, gravity: float, model: str) -> Ends:
    """
    Run blocks from rest under one motion.

    Parameters
    ----------
    motion : Motion
        Along x and, if given, z; usable as `run.expect_usable` says.
    blocks : sequence of Sides
        Each `prepared`.
    gravity : float
        m/s².
    model : str
        A plane one.

    Returns
    -------
    ends : Ends
        The same, to the last bit, as outcome, `peak_ratio` and `peak_time` of `rock`.

    Notes
    -----
    A block that the motion cannot uplift is not run: with a vertical component none is left out.
    """
    from colonnade.dynamics.plane.sampled_march import propagate
    from colonnade.dynamics.plane.uplift import uplift_threshold

    chosen = plane_model_of(model)
    base, series = motion.acceleration / gravity, series_of(chosen, motion, gravity)
    largest = np.inf if series is not None and series.vertical.any() else float(np.abs(base).max())
    codes = np.full(len(blocks), STANDS, dtype=np.int8)
    peaks, instants = np.zeros(len(blocks)), np.zeros(len(blocks))
    for number, sides in enumerate(blocks):
        if largest <= uplift_threshold(min(sides.critical), chosen.is_linearised):
            continue
        angles, _, _, _, overturning_time = propagate(base, motion.dt, sides, 0.0, 0.0, series)
        if np.isfinite(overturning_time):
            codes[number], peaks[number], instants[number] = OVERTURNS, np.nan, overturning_time
            continue
        low, high = int(angles.argmin()), int(angles.argmax())
        sizes = -angles[low] / sides.critical[0], angles[high] / sides.critical[1]
        peaks[number] = max(sizes)
        instants[number] = motion.dt * (low if sizes[0] > sizes[1] else high)
        codes[number] = ROCKS if peaks[number] > NO_ROCKING_RATIO else STANDS
    return Ends(codes, peaks, instants)
