"""Whether a recorded acceleration is the named motion: polarity, time scale, missing parts, or another motion."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
import scipy
from numpy.lib.stride_tricks import sliding_window_view

from colonnade.arrays import Array
from colonnade.findings import Finding, warning
from colonnade.signals.filters import lowpass

MOST_POWER = 0.9
"""Share of a motion's power below the frequency up to which it is compared."""

FEWEST_SAMPLES = 8
"""Of a motion or a record; in less nothing is told."""

OVERSAMPLING = 8.0
"""Samples a period of that frequency, when time scales are tried."""

AGREES = 0.8
"""Correlation from which on a record is taken to be of a motion."""

BETTER = 0.1
"""By which another polarity, time scale or motion has to agree better than the one named."""

SCALE_REACH, SCALE_STEP = 0.25, 0.002
"""Time scales are looked for within this fraction of the ratio of durations, in steps of this fraction."""

STRONG_PART = 0.05, 0.95
"""Shares of the energy between which a motion's duration is taken."""

STRETCH = 0.5
"""s at the motion's own time scale; of such stretches each is looked at."""

STANDS_OUT = 6.0
"""Times the difference of the quiet stretches by which one differs."""

QUIET = 0.2
"""Share of the stretches that count as quiet."""

OTHERWISE = 0.7
"""Of a stretch's own motion; one that differs by less follows it, if badly."""

LEAST_DIFFERENCE = 0.1
"""Of the motion's largest acceleration; a smaller one is not told."""


@dataclass(frozen=True)
class Series:
    """A motion: its acceleration, in any unit, and its interval, s."""

    acceleration: Array
    interval: float

    def at(self, interval: float, scale: float = 1.0) -> Series:
        """The same with its time multiplied, linear between its samples, at another interval (s)."""
        own = self.interval * scale * np.arange(self.acceleration.size)
        wanted = interval * np.arange(int(own[-1] / interval + 1e-6) + 1)
        return Series(np.interp(wanted, own, self.acceleration), interval)

    def below(self, cutoff_hz: float) -> Series:
        """The same below a frequency, without its mean."""
        if self.acceleration.size < FEWEST_SAMPLES:
            return self
        smooth = lowpass(self.acceleration, self.interval, cutoff_hz)
        return Series(smooth - smooth.mean(), self.interval)


@dataclass(frozen=True)
class Match:
    """
    A motion where it fits a record best, whatever its amplitude and sign.

    Attributes
    ----------
    recorded, due : ndarray, shapes (n,) and (m,)
        Both at the record's interval, below the frequency up to which the motion has its power; means taken off.
    correlation : float
        With its sign.
    begin : int
        Sample of the record at which the motion begins; below zero if that is not recorded.
    """

    recorded: Array
    due: Array
    correlation: float
    begin: int


@dataclass(frozen=True)
class Laid:
    """
    A motion laid on a record.

    Attributes
    ----------
    acceleration : ndarray, shape (n,)
        At the record's samples, in its unit; zero before it begins and after it ends.
    factor : float
        On the motion's own values: record over motion by least squares below the frequency of `Match`.
    correlation : float
    scale : float
        Factor on the motion's own time.
    """

    acceleration: Array
    factor: float
    correlation: float
    scale: float


def laid_on(record: Series, motion: Series, *, time_scale: float | None) -> Laid | None:
    """
    Lay a motion on a record, with the delay and the factor with which the two agree best.

    Parameters
    ----------
    record, motion : Series
        What was recorded, finite; the motion at its own time scale.
    time_scale : float or None
        Factor on the motion's time; None if it is not known.

    Returns
    -------
    laid : Laid or None
        None if the record is not of this motion.
    """
    scale = time_scale if time_scale is not None else best_scale(record, motion)
    found = match(record, motion, scale)
    if abs(found.correlation) < AGREES:
        return None
    size = record.acceleration.size
    due = _shifted(found.due, -found.begin, size)
    factor = float(found.recorded @ due / max(float(due @ due), 1e-300))
    whole = _shifted(motion.at(record.interval, scale).acceleration, -found.begin, size)
    return Laid(factor * whole, factor, found.correlation, scale)


def check_motion(
    record: Series, name: str, named: Series, *, time_scale: float | None, others: Mapping[str, Series]
) -> list[Finding]:
    """
    Compare what was recorded with the motion that was named.

    Parameters
    ----------
    record : Series
        Of the table.
    name : str
    named : Series
        The motion at its own time scale.
    time_scale : float or None
        Factor on its time in this test; None if it is not given.
    others : mapping of str to Series
        Further motions that it may be.

    Returns
    -------
    suspicions : list of Finding
        Empty if the record is that motion, whatever its amplitude.
    """
    scale = time_scale if time_scale is not None else best_scale(record, named)
    found = match(record, named, scale)
    if found.correlation >= AGREES:
        return _differences(found, name, scale, record.interval)
    if -found.correlation >= AGREES:
        text = (
            f'the table moved as "{name}" with the other polarity (correlation {found.correlation:.2f}): reverse '
            "the sign of the table's acceleration, or say so in the motion's name"
        )
        return [warning("polarity", text, follows=("sign",))]
    begun = f'the table did not move as "{name}" at time scale {scale:.4g} (correlation {found.correlation:.2f}'
    for other, series in {name: named, **others}.items():
        fits = {match(record, series, each).correlation: each for each in (scale, best_scale(record, series))}
        fit = max(fits, key=abs)
        if abs(fit) < max(AGREES, abs(found.correlation) + BETTER):
            continue
        if other == name:
            turned = " and the other polarity" if fit < 0 else ""
            text = f"{begun}), but with time scale {fits[fit]:.4g}{turned} ({fit:.2f}): check time_scale"
            return [warning("time scale", text)]
        text = f'{begun}): it moved as "{other}" ({fit:.2f}): another component was read, or the wrong motion is named'
        return [warning("another motion", text)]
    text = f"{begun}; {AGREES:g} is needed): it is another motion, or the table did not follow"
    return [warning("another motion", text, follows=("dead channel", "table motion"))]


def match(record: Series, motion: Series, scale: float) -> Match:
    """Find where in a record a motion fits best, its time multiplied by a scale."""
    cutoff = min(_cutoff(motion) / scale, 0.2 / record.interval)
    one, other = record.below(cutoff), motion.at(record.interval, scale).below(cutoff)
    return Match(one.acceleration, other.acceleration, *_correlated(one.acceleration, other.acceleration))


def best_scale(record: Series, motion: Series) -> float:
    """Time scale with which a motion fits a record best, near the ratio of their durations."""
    about = _duration(record) / max(_duration(motion), 1e-9)
    if not about > 0:
        return 1.0
    steps = int(np.log1p(SCALE_REACH) / SCALE_STEP)
    scales = about * np.exp(SCALE_STEP * np.arange(-steps, steps + 1))
    cutoff = min(_cutoff(motion) / about, 0.2 / record.interval)
    step = max(int(1 / (OVERSAMPLING * cutoff * record.interval)), 1)
    coarse, smooth = record.below(cutoff).acceleration[::step], motion.at(record.interval, about).below(cutoff)
    tried = (smooth.at(step * record.interval, scale / about).acceleration for scale in scales)
    return float(scales[int(np.argmax([abs(_correlated(coarse, each)[0]) for each in tried]))])


def _correlated(one: Array, other: Array) -> tuple[float, int]:
    """Largest correlation, with its sign, and the sample of the first at which the second then begins."""
    power = float(np.sqrt((one @ one) * (other @ other)))
    if not power > 0 or min(one.size, other.size) < FEWEST_SAMPLES:
        return 0.0, 0
    correlation = scipy.signal.correlate(one, other, mode="full", method="fft") / power
    best = int(np.argmax(np.abs(correlation)))
    return float(correlation[best]), best - other.size + 1


def _shifted(values: Array, first: int, size: int) -> Array:
    """So many values from a sample on; zero where there are none."""
    padded = np.pad(values, (max(-first, 0), max(first + size - values.size, 0)))
    return padded[max(first, 0) :][:size]


def _cutoff(motion: Series) -> float:
    """Frequency below which most of a motion's power is, Hz: a table can follow it, and noise does not hide it."""
    spectrum = np.abs(np.fft.rfft(motion.acceleration - motion.acceleration.mean())) ** 2
    frequency = np.fft.rfftfreq(motion.acceleration.size, motion.interval)
    share = np.cumsum(spectrum) / max(float(spectrum.sum()), 1e-300)
    least = FEWEST_SAMPLES / (motion.acceleration.size * motion.interval)
    return float(max(frequency[np.searchsorted(share, MOST_POWER)], least))


def _duration(series: Series) -> float:
    energy = np.cumsum((series.acceleration - series.acceleration.mean()) ** 2)
    if not energy[-1] > 0:
        return 0.0
    first, last = np.searchsorted(energy, np.array(STRONG_PART) * energy[-1])
    return float(last - first) * series.interval


def _differences(found: Match, name: str, scale: float, interval: float) -> list[Finding]:
    """Say which part of the motion is not in the record, or otherwise."""
    size = min(max(int(STRETCH * scale / interval), 4), found.due.size)
    recorded = _shifted(found.recorded, found.begin, found.due.size)
    due, seen = (sliding_window_view(values, size)[:: size // 2] for values in (found.due, recorded))
    # The gain is the median of the stretches by their energy, so that a missing one does not matter.
    strength = (due**2).sum(axis=1)
    gains = (seen * due).sum(axis=1) / np.maximum(strength, 1e-300)
    order = np.argsort(gains)
    gain = gains[order][np.searchsorted(np.cumsum(strength[order]), 0.5 * strength.sum())]
    off, usual = np.sqrt(((seen - gain * due) ** 2).mean(axis=1)), abs(gain) * np.sqrt(strength / size)
    least = np.maximum(STANDS_OUT * np.quantile(off, QUIET), LEAST_DIFFERENCE * np.abs(gain * found.due).max())
    odd = np.flatnonzero((off > least) & (off > OTHERWISE * usual))
    if not odd.size:
        return []
    low, high = odd[[0, -1]] * (size // 2) * interval / scale
    text = (
        f'the table did not move as "{name}" from {low:.3g} to {high + STRETCH:.3g} s of its own time: a part is '
        "missing or differs"
    )
    return [warning("cut motion", text)]
