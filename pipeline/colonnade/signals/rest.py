"""Rest, in which the specimen stands still, and what a record drifts between two rests."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from colonnade.arrays import Array

QUIET = 4.0
"""A stretch is quiet where its standard deviation and its drift stay below this many times the noise."""


@dataclass(frozen=True)
class RestWindow:
    """A stretch (s), and whether all channels are quiet on it."""

    start: float
    stop: float
    quiet: bool


def find_rest(time: Array, channels: dict[str, tuple[Array, float]], *, end: bool, duration: float) -> RestWindow:
    """
    Take the first or last stretch of a record and judge whether it is at rest.

    Parameters
    ----------
    time : ndarray, shape (n,)
        s.
    channels : dict of str to (ndarray of shape (n,), float)
        Values of each channel, and the standard deviation of its noise. NaN is passed over.
    end : bool
        The last stretch instead of the first.
    duration : float
        s.

    Returns
    -------
    window : RestWindow
    """
    start, stop = (max(time[-1] - duration, time[0]), time[-1]) if end else (time[0], min(time[0] + duration, time[-1]))
    inside = (time >= start) & (time <= stop)
    quiet = all(_is_quiet(values[inside], noise) for values, noise in channels.values())
    return RestWindow(float(start), float(stop), quiet)


def _is_quiet(values: Array, noise: float) -> bool:
    stretch = values[np.isfinite(values)]
    if stretch.size < 4:
        return False
    half = stretch.size // 2
    drift = abs(float(stretch[half:].mean() - stretch[:half].mean()))
    return max(float(stretch.std()), drift) <= QUIET * noise


def drift(time: Array, values: Array, *, duration: float, noise: float) -> float:
    """
    Difference of the means of a record's first and last stretch.

    Parameters
    ----------
    time, values : ndarray, shape (n,)
        s; any unit, NaN passed over.
    duration : float
        Of each stretch, s.
    noise : float
        Standard deviation of the noise.

    Returns
    -------
    drift : float
        Its magnitude; 0 where the record is not quiet at both ends or too short to tell.
    """
    channel = {"": (values, noise)}
    windows = [find_rest(time, channel, end=end, duration=duration) for end in (False, True)]
    if not all(window.quiet for window in windows) or windows[0].stop >= windows[1].start:
        return 0.0
    first, last = (values[(time >= window.start) & (time <= window.stop)] for window in windows)
    return abs(float(np.nanmean(last) - np.nanmean(first)))
