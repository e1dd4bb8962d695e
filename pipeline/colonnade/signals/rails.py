"""Rails: a channel that saturates although no range is given stays at one extreme value between two steep flanks."""

from __future__ import annotations

import numpy as np

from colonnade.arrays import Array
from colonnade.signals.quality import Flag, Verdict, counted, first_at
from colonnade.signals.stretches import filled_in, stretches

BAND = 8.0
"""Standard deviations of the noise, below the extreme value, within which samples are at it."""

STEEP = 6.0
"""Bands by which a flank of half as many samples has to leave it: a parabola leaves it by three."""

FEWEST = 6
"""Samples at one value."""

AWAY = 0.3
"""Of all that the channel moves: an extreme value nearer to one at which it begins or ends is where it rests."""

FIRST = 10
"""Samples that it begins and ends with."""


def check_rails(time: Array, values: Array) -> Verdict:
    """
    Flag samples at a value that the channel does not exceed although it moves fast before and after.

    Parameters
    ----------
    time, values : ndarray, shape (n,)
        s; any unit.

    Notes
    -----
    The top of a parabola fills the band of 8 σ and leaves it slowly. Saturation is flat but for the noise σ, and its
    flanks are steep.
    """
    where = np.zeros(values.size, dtype=bool)
    if np.isfinite(values).sum() < 4 * FIRST:
        return Verdict.good(values.size)
    filled = filled_in(values)
    noise = 1.4826 * float(np.median(np.abs(np.diff(filled, 2)))) / np.sqrt(6.0)
    steps = np.abs(np.diff(filled))
    noise = max(noise, 0.3 * float(steps[steps > 0].min(initial=np.inf)) if steps.any() else 0.0)
    resting = (float(filled[:FIRST].mean()), float(filled[-FIRST:].mean()))
    for sign in (1.0, -1.0):
        signed = sign * filled
        top = float(signed.max())
        if not top - max(sign * rest for rest in resting) > AWAY * float(np.ptp(filled)):
            continue
        for start, stop in zip(*stretches(signed > top - BAND * noise), strict=True):
            half = (stop - start) // 2
            if stop - start < FEWEST or start < half or stop + half > signed.size:
                continue
            left, right = top - signed[start - half], top - signed[stop + half - 1]
            if min(left, right) > STEEP * BAND * noise:
                where[start:stop] = True
    if not where.any():
        return Verdict.good(values.size)
    level = float(np.abs(values[where]).max())
    reason = (
        f"{counted(where)} stay at {level:.4g} (as recorded){first_at(time, where)}, between steep flanks: the channel "
        "saturates, and the value was larger. Its peaks are lower bounds. Choose a larger range"
    )
    return Verdict(Flag.SUSPECT, where, reason, "end of the range")
