"""The samples that a whole-history fit follows: as few as hold the record's information without bias."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from colonnade.arrays import Array
from colonnade.dynamics.block import Block

STEP = 0.02
"""Longest step of the samples fitted, in p t: the lowest arc of interest, of 0.02 α, has twenty."""

UNEVEN = 1e-3
"""Steps that differ by more than this share are not of one clock: neither averaged nor held against a spectrum."""


@dataclass(frozen=True)
class AngleSamples:
    """Times (s) and angles (rad, NaN where missing), shape (n,); their step (s), None if uneven; samples in each."""

    time: Array
    angle: Array
    interval: float | None
    group: int = 1


def thinned(time: Array, angle: Array, block: Block) -> AngleSamples:
    """
    Average samples in groups, as long as free rocking hardly bends in one.

    Parameters
    ----------
    time, angle : ndarray, shape (n,)
        s, increasing; rad, about the rest position. Missing samples are NaN.
    block : Block

    Returns
    -------
    samples : AngleSamples

    Notes
    -----
    The mean of a curve over a group of m samples differs from its middle by (m² − 1) dt² θ̈ / 24; θ̈ is known from the
    angle itself, so this is taken off. White noise stays white.
    """
    if time.size < 2:
        return AngleSamples(time, angle, None)
    steps = np.diff(time)
    interval = float(np.median(steps))
    if np.abs(steps - interval).max() > UNEVEN * interval:
        return AngleSamples(time, angle, None)
    interval = float(time[-1] - time[0]) / steps.size
    p = max(map(block.side_p, block.sides))
    group = min(int(STEP / (p * interval)), time.size // 8)
    if group <= 1:
        return AngleSamples(time, angle, interval)
    whole = group * (time.size // group)
    times = time[:whole].reshape(-1, group).mean(axis=1)
    angles = angle[:whole].reshape(-1, group).mean(axis=1)
    critical = block.critical_angle_at(angles)
    acceleration = -(block.p_at(angles) ** 2) * np.sin(np.where(angles < 0, -critical, critical) - angles)
    bend = (group**2 - 1) * interval**2 / 24 * np.where(np.abs(angles) < 1.5 * critical, acceleration, 0.0)
    return AngleSamples(times, angles - bend, group * interval, group)
