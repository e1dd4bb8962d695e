"""One channel's record, first on its own even clock, then on the clock of the test."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from colonnade.arrays import Array, Codes, Mask
from colonnade.signals.filters import lowpass, noise_below
from colonnade.signals.quality import Flag
from colonnade.signals.timing import LONGEST_BRIDGE, read_clock, resample, uniform_clock

EMPTIEST = 100
"""Intervals a sample; a clock with fewer samples is not worth to be made even (nor would it fit into memory)."""


THINNED = 4
"""Samples of a smoothed record for each of a slower clock that it is brought to."""


@dataclass(frozen=True)
class Record:
    """
    A channel on an even clock.

    Attributes
    ----------
    time, values : ndarray, shape (n,)
        s, at equal steps; any unit. Short runs of bad samples are bridged, those at the ends held.
    missing : ndarray of bool, shape (n,)
        Samples in runs too long to be bridged; their values are straight lines that keep filters quiet.
    interval : float
        s.
    stamps, flags : ndarray, shape (m,)
        Times (s) and quality of the samples as recorded.
    bad : ndarray of bool, shape (m,)
        Which of them were not used.
    """

    time: Array
    values: Array
    missing: Mask
    interval: float
    stamps: Array
    flags: Codes
    bad: Mask


def even_record(stamps: Array, values: Array, flags: Codes) -> Record:
    """
    Put a channel on an even clock.

    Parameters
    ----------
    stamps, values : ndarray, shape (n,)
        s, as in the file; any unit; NaN where missing.
    flags : ndarray of int8, shape (n,)

    Raises
    ------
    ValueError
        If fewer than two samples are usable, or the times are too far apart; the message completes "channel x ".
    """
    clock = read_clock(stamps)
    timed = np.isfinite(clock.time)
    bad = _where(timed, (flags >= Flag.FAIL) | ~np.isfinite(values))
    if (~bad).sum() < 2:
        raise ValueError(f"has no usable sample among its {values.size}")
    known, interval = _where(timed, clock.time), clock.interval
    span = float(known[-1] - known[0])
    if span > EMPTIEST * interval * known.size:
        raise ValueError(f"has {known.size} samples at {1 / interval:.4g} Hz over {span:.4g} s; check its times")
    time = uniform_clock(known[0], known[-1], interval)
    used = _where(~bad, known)
    even, missing = resample(used, _where(~bad, _where(timed, values)), time, interval)
    reach = (LONGEST_BRIDGE + 0.5) * interval
    held = ((time < used[0]) & (used[0] - time[0] < reach)) | ((time > used[-1]) & (time[-1] - used[-1] < reach))
    return Record(time, even, missing & ~held, interval, known, _where(timed, flags).astype(np.int8), bad)


def _where(chosen: Mask, values: NDArray[Any]) -> NDArray[Any]:
    """Chosen values; those of a long record that are all chosen are not copied."""
    return values if chosen.all() else values[chosen]


def smoothed(record: Record, cutoff_hz: float, order: int) -> tuple[Array, float]:
    """
    Low-pass a record on its own clock, before any resampling could fold what is high into what is low.

    Returns
    -------
    values : ndarray, shape (n,)
        On the record's clock.
    noise : float
        Standard deviation that is left.
    """
    smooth = lowpass(record.values, record.interval, cutoff_hz, order)
    return smooth, noise_below(record.values, smooth, record.interval, cutoff_hz, ~record.missing)


def on_clock(record: Record, values: Array, clock: Array) -> tuple[Array, Codes]:
    """
    Bring values of a record's own clock to another one.

    Parameters
    ----------
    record : Record
    values : ndarray, shape (n,)
        On the record's clock.
    clock : ndarray, shape (m,)
        s, on the record's time axis: with its clock offset added.

    Returns
    -------
    brought : ndarray, shape (m,)
        NaN where missing.
    flags : ndarray of int8, shape (m,)
        Of the nearest sample as recorded. Bridged samples are suspect, not failed.
    """
    last, coarser = record.time.size - 1, int((clock[1] - clock[0]) / (THINNED * record.interval))
    if coarser > 1:  # a spline through all samples of a far slower clock would fill the memory
        knots = np.union1d(np.arange(0, last, coarser), [last])
        brought, outside = resample(record.time[knots], values[knots], clock, coarser * record.interval)
    else:
        brought, outside = resample(record.time, values, clock, record.interval)
    lost = outside | record.missing[_nearest(record.time, clock)]
    near = _nearest(record.stamps, clock)
    flags = record.flags[near].copy()
    bridged = record.bad[near] | (np.abs(record.stamps[near] - clock) > 0.75 * record.interval)
    flags[bridged] = Flag.SUSPECT
    flags[lost] = Flag.MISSING
    return np.where(lost, np.nan, brought), flags


def _nearest(times: Array, wanted: Array) -> NDArray[np.intp]:
    after = np.clip(np.searchsorted(times, wanted), 1, times.size - 1)
    return np.where(wanted - times[after - 1] < times[after] - wanted, after - 1, after)
