"""What is no motion in a record: rest, in which the specimen stands still, and a single shock."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from colonnade.arrays import Array
from colonnade.signals.samples import stretches

QUIET = 4.0
"""A stretch is quiet where its standard deviation and its drift stay below this many times the noise."""

STANDS_OUT = 3.0
"""Times the largest value elsewhere from which on a peak is a shock."""

LONGEST = 0.025
"""s above half the peak; what lasts longer is a motion."""

AROUND = 0.1
"""s on both sides of the peak that belong to it: filters ring, structures too."""


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


@dataclass(frozen=True)
class Shock:
    """When (s from the first sample), how large, how long (s, above half of it), and the largest value elsewhere."""

    time: float
    peak: float
    duration: float
    elsewhere: float


def single_shock(values: Array, interval: float) -> Shock | None:
    """
    Find a single shock.

    Parameters
    ----------
    values : ndarray, shape (n,)
        Any unit; NaN where missing.
    interval : float
        s.

    Returns
    -------
    shock : Shock or None
        None if the largest value is one of several alike, or lasts.

    Examples
    --------
    >>> motion = np.sin(np.arange(1000) * 0.05)
    >>> motion[500:503] += 5.0
    >>> shock = single_shock(motion, 0.005)
    >>> round(shock.time, 3), round(shock.duration, 3), round(shock.elsewhere, 2)
    (2.51, 0.015, 1.0)
    >>> single_shock(np.sin(np.arange(1000) * 0.05), 0.005) is None
    True
    """
    size = np.abs(np.nan_to_num(values))
    if size.size == 0:
        return None
    at = int(size.argmax())
    reach = max(round(AROUND / interval), 1)
    elsewhere = max(size[: max(at - reach, 0)].max(initial=0.0), size[at + reach + 1 :].max(initial=0.0))
    peak = float(size[at])
    if not peak > STANDS_OUT * elsewhere > 0:
        return None
    starts, stops = stretches(size > 0.5 * peak)
    around = int(np.searchsorted(starts, at, side="right")) - 1
    duration = float(stops[around] - starts[around]) * interval
    return Shock(at * interval, float(values[at]), duration, float(elsewhere)) if duration <= LONGEST else None
