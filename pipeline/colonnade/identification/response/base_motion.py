"""Whether the table moves under a free vibration: the one rule for what drives identification and prediction."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from colonnade.dynamics.block import Block

LEAST_MOTION = 0.003
"""Share of p α, the RMS change of the block's angular velocity by the base above which the table moves."""


def base_velocity(acceleration: ArrayLike, interval: float, block: Block) -> float:
    """
    Size of a base motion as a rocking block feels it.

    Parameters
    ----------
    acceleration : array_like, shape (n,)
        Of the base along x, m/s², at equal steps; missing samples are NaN and count as no motion.
    interval : float
        s.
    block : Block

    Returns
    -------
    share : float
        RMS change of the angular velocity that the motion causes within about 1/p, as a share of p α.

    Notes
    -----
    Between impacts θ̈ = p² (θ ∓ α − a/g): an acceleration of frequency ω changes the angular velocity by
    p (a/g) / sqrt(1 + (ω/p)²). This weighs what matters to the block, and little of the white noise of an
    accelerometer. The mean is not counted: it is an accelerometer's bias or a tilt, not a motion.
    """
    values = np.asarray(acceleration, dtype=np.float64)
    if not np.isfinite(values).any():
        return 0.0
    values = np.nan_to_num(values - np.nanmean(values))
    # Twice the length, so that the end of the record does not act on its start.
    size = 2 * values.size
    frequency = 2 * np.pi * np.fft.rfftfreq(size, interval) / block.p
    felt = np.fft.irfft(np.fft.rfft(values, size) / np.sqrt(1 + frequency**2), size)[: values.size]
    return float(np.sqrt(np.mean(felt**2)) / (block.gravity * block.critical_angle))


def table_moves(acceleration: ArrayLike, interval: float, block: Block) -> bool:
    """
    Decide whether the table moves under a free vibration; arguments as for `base_velocity`.

    Notes
    -----
    Above `LEAST_MOTION` the recorded acceleration drives identification and prediction; below it the table is at rest.
    """
    return base_velocity(acceleration, interval, block) > LEAST_MOTION
