"""Quality of a record: small checks that return what they flag with the reason; values are never changed."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from enum import IntEnum

import numpy as np
from numpy.typing import NDArray
from scipy.ndimage import maximum_filter, percentile_filter

Array = NDArray[np.float64]
Mask = NDArray[np.bool_]


class Flag(IntEnum):
    """Quality of a sample: good and suspect samples are used, failed and missing ones are bridged."""

    GOOD = 1
    NOT_EVALUATED = 2
    SUSPECT = 3
    FAIL = 4
    MISSING = 9


@dataclass(frozen=True)
class Verdict:
    """A check's flag, the samples it applies to (shape (n,)), and the reason, empty where all is good."""

    flag: Flag
    where: Mask
    reason: str

    @classmethod
    def good(cls, size: int) -> Verdict:
        """Verdict that flags nothing."""
        return cls(Flag.GOOD, np.zeros(size, dtype=bool), "")


def combine(verdicts: Iterable[Verdict], size: int) -> tuple[NDArray[np.int8], list[str]]:
    """
    Merge verdicts into one flag a sample, the worst one, and the list of reasons.

    Returns
    -------
    flags : ndarray of int8, shape (size,)
    reasons : list of str
    """
    flags = np.full(size, Flag.GOOD, dtype=np.int8)
    reasons = []
    for verdict in verdicts:
        flags[verdict.where] = np.maximum(flags[verdict.where], np.int8(verdict.flag))
        if verdict.reason:
            reasons.append(verdict.reason)
    return flags, reasons


def check_missing(time: Array, values: Array) -> Verdict:
    """Flag samples without a value or a time."""
    where = ~(np.isfinite(values) & np.isfinite(time))
    if not where.any():
        return Verdict.good(values.size)
    return Verdict(Flag.MISSING, where, f"{_counted(where)} without a value{_at(time, where)}")


def check_clipping(time: Array, values: Array, *, full_scale: float) -> Verdict:
    """
    Flag samples at the end of the range.

    Parameters
    ----------
    time, values : ndarray, shape (n,)
        s; in the unit of `full_scale`.
    full_scale : float
        Largest magnitude that the recorder or transducer can give. The last of 16 bits counts as reached.
    """
    where = np.abs(values) >= full_scale * (1 - 2.0**-14)
    if not where.any():
        return Verdict.good(values.size)
    reason = f"{_counted(where)} at the end of the range (±{full_scale:g}){_at(time, where)}: the value was larger"
    return Verdict(Flag.SUSPECT, where, reason)


def check_flat(time: Array, values: Array, *, duration: float) -> Verdict:
    """Flag stretches on which the value stays exactly the same for longer than `duration` (s)."""
    edges = np.flatnonzero(np.diff(values) != 0)
    starts, stops = np.concatenate(([0], edges + 1)), np.concatenate((edges, [values.size - 1]))
    long = np.isfinite(values[starts]) & (time[stops] - time[starts] > duration)
    if not long.any():
        return Verdict.good(values.size)
    where = np.zeros(values.size, dtype=bool)
    for start, stop in zip(starts[long], stops[long], strict=True):
        where[start : stop + 1] = True
    if where.all():
        return Verdict(Flag.SUSPECT, where, f"the channel is dead: every sample is {values[0]:g}")
    return Verdict(Flag.SUSPECT, where, f"{_counted(where)} flat for more than {duration:g} s{_at(time, where)}")


def check_spikes(time: Array, values: Array, *, threshold: float) -> Verdict:
    """
    Flag spikes of one or two samples.

    Parameters
    ----------
    time, values : ndarray, shape (n,)
        s; any unit.
    threshold : float
        In robust standard deviations, of the whole record and of the neighbourhood, whichever is larger.

    Notes
    -----
    A sample stands out by its distance from the median of the second to fourth neighbours on both sides (a Hampel
    identifier that leaves out what a spike of two samples touches): on a steep flank that median is the flank's own
    height, and two bad samples among six do not move it. A step makes a run of samples stand out, and passes.
    """
    finite = np.isfinite(values)
    if finite.sum() < 15:
        return Verdict.good(values.size)
    filled = np.interp(np.arange(values.size), np.flatnonzero(finite), values[finite])
    padded = np.pad(filled, 4, mode="reflect")
    neighbours = [padded[4 + shift : 4 + shift + filled.size] for shift in (-4, -3, -2, 2, 3, 4)]
    distance = np.abs(filled - np.median(neighbours, axis=0))
    # The upper tenth, not the median: a motion recorded at few samples a period is rough now and then all along.
    local = percentile_filter(distance, 90, size=min(201, values.size), mode="nearest") / 1.645
    steps = np.abs(np.diff(filled))
    # A coarse converter gives mostly zeros: its step is then the least that can be told.
    resolution = float(steps[steps > 0].min()) if (steps > 0).any() else 0.0
    typical = 1.4826 * float(np.median(distance))
    where = finite & (distance > threshold * np.maximum(local, max(typical, resolution)))
    # Beside a spike its neighbours stand out a little as well.
    where &= distance > 0.5 * maximum_filter(distance, size=9, mode="nearest")
    where &= _isolated(filled, where)
    if not where.any():
        return Verdict.good(values.size)
    return Verdict(Flag.FAIL, where, f"spikes on {_counted(where)}{_at(time, where)}")


def _isolated(values: Array, candidates: Mask) -> Mask:
    """Keep runs of at most two candidates whose neighbours on either side agree within half of the jump."""
    kept = np.zeros_like(candidates)
    edges = np.flatnonzero(np.diff(np.concatenate(([0], candidates.astype(np.int8), [0]))))
    for start, stop in zip(edges[::2], edges[1::2], strict=True):
        before, after = values[max(start - 1, 0)], values[min(stop, values.size - 1)]
        jump = np.abs(values[start:stop] - 0.5 * (before + after)).min()
        kept[start:stop] = stop - start <= 2 and abs(after - before) < 0.5 * jump
    return kept


def check_gaps(time: Array, *, interval: float, factor: float) -> Verdict:
    """Flag the samples on either side of a step of the clock longer than `factor` intervals (s)."""
    steps = np.diff(time)
    after = np.flatnonzero(steps > factor * interval)
    if after.size == 0:
        return Verdict.good(time.size)
    where = np.zeros(time.size, dtype=bool)
    where[after] = where[after + 1] = True
    lost = int(np.rint(steps[after] / interval - 1).sum())
    reason = f"{after.size} gap{'s' if after.size > 1 else ''} in time, about {lost} samples lost{_at(time, where)}"
    return Verdict(Flag.SUSPECT, where, reason)


def check_order(time: Array) -> Verdict:
    """Flag samples whose time is not later than that of all samples before."""
    latest = np.fmax.accumulate(time)
    where = np.zeros(time.size, dtype=bool)
    where[1:] = time[1:] <= latest[:-1]
    if not where.any():
        return Verdict.good(time.size)
    return Verdict(Flag.FAIL, where, f"{_counted(where)} whose time does not increase{_at(time, where)}")


def check_jitter(time: Array, *, interval: float, share: float, factor: float) -> Verdict:
    """Flag samples whose step differs from the interval (s) by more than `share` of it, gaps (`factor`) apart."""
    steps = np.diff(time)
    uneven = (np.abs(steps - interval) > share * interval) & (steps <= factor * interval) & (steps > 0)
    if not uneven.any():
        return Verdict.good(time.size)
    where = np.concatenate(([False], uneven))
    spread = float(np.abs(steps[uneven] - interval).max())
    reason = f"{_counted(where)} up to {1e3 * spread:.3g} ms off an even clock of {1e3 * interval:.6g} ms"
    return Verdict(Flag.SUSPECT, where, reason)


def check_dead(values: Array, reference: Array, *, share: float) -> Verdict:
    """
    Flag a whole channel that hardly moves while a comparable one does.

    Parameters
    ----------
    values, reference : ndarray, shapes (n,) and (m,)
        Same quantity and unit, as the acceleration of the specimen and of its table.
    share : float
        Smallest standard deviation over that of the reference.
    """
    spread, expected = float(np.nanstd(values)), float(np.nanstd(reference))
    if not spread < share * expected:
        return Verdict.good(values.size)
    reason = (
        f"the channel is practically dead: its standard deviation is {spread:.3g}, that of the table's {expected:.3g} "
        "in the same unit; look at its cable, sensor and range"
    )
    return Verdict(Flag.SUSPECT, np.ones(values.size, dtype=bool), reason)


def _counted(where: Mask) -> str:
    count = int(where.sum())
    return f"{count} sample{'s' if count > 1 else ''}"


def _at(time: Array, where: Mask) -> str:
    known = time[where & np.isfinite(time)]
    return f", the first at {known[0]:.4g} s" if known.size else ""
