"""Whether a recorded acceleration is the named motion: polarity, time scale, missing parts, or another motion."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import NamedTuple

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

LEAST_ENERGY = 0.01
"""Of the motion, that has to lie outside of the record before it is said to be cut off."""


@dataclass(frozen=True)
class Series:
    """A motion: its acceleration, in any unit, and its interval, s."""

    acceleration: Array
    interval: float

    def stretched(self, scale: float) -> Series:
        """The same with its time multiplied."""
        return Series(self.acceleration, self.interval * scale)

    def at(self, interval: float) -> Series:
        """The same, linear between its samples, at another interval (s)."""
        own = self.interval * np.arange(self.acceleration.size)
        wanted = interval * np.arange(int(own[-1] / interval + 1e-6) + 1)
        return Series(np.interp(wanted, own, self.acceleration), interval)

    def every(self, step: int) -> Series:
        """Every `step`-th sample of it."""
        return Series(self.acceleration[::step], self.interval * step)


class Match(NamedTuple):
    """Largest correlation of a motion with a record, with its sign, and where in the record the motion begins, s."""

    correlation: float
    start: float


@dataclass(frozen=True)
class Laid:
    """
    A motion laid on a record.

    Attributes
    ----------
    acceleration : ndarray, shape (n,)
        At the record's samples, in its unit; zero before it begins and after it ends.
    factor : float
        On the motion's own values: record over motion by least squares below the frequency of `match`.
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
    stretched = motion.stretched(scale)
    found = match(record, stretched)
    if abs(found.correlation) < AGREES:
        return None
    own = found.start + stretched.interval * np.arange(stretched.acceleration.size)
    clock = record.interval * np.arange(record.acceleration.size)
    on_clock = np.interp(clock, own, stretched.acceleration, left=0.0, right=0.0)
    one, other = (series.acceleration for series in _below_one_cutoff(record, Series(on_clock, record.interval)))
    factor = float(one @ other / max(float(other @ other), 1e-300))
    return Laid(factor * on_clock, factor, found.correlation, scale)


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
    found = match(record, named.stretched(scale))
    if found.correlation >= AGREES:
        return _differences(record, name, named.stretched(scale), found, scale)
    if -found.correlation >= AGREES:
        text = (
            f'the table moved as "{name}" with the other polarity (correlation {found.correlation:.2f}): reverse '
            "the sign of the table's acceleration, or say so in the motion's name"
        )
        return [warning("polarity", text, follows=("sign",))]
    begun = f'the table did not move as "{name}" at time scale {scale:.4g} (correlation {found.correlation:.2f}'
    for other, series in {name: named, **others}.items():
        likely = [each for each in (scale, best_scale(record, series)) if each > 0]
        fits = {match(record, series.stretched(each)).correlation: each for each in likely}
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


def match(record: Series, motion: Series) -> Match:
    """Find where in a record a motion fits best, whatever its amplitude and sign."""
    return _correlated(*_below_one_cutoff(record, motion))


def best_scale(record: Series, motion: Series) -> float:
    """Time scale with which a motion fits a record best, near the ratio of their durations."""
    about = _duration(record) / max(_duration(motion), 1e-9)
    if not about > 0:
        return 1.0
    steps = int(np.log1p(SCALE_REACH) / SCALE_STEP)
    scales = about * np.exp(SCALE_STEP * np.arange(-steps, steps + 1))
    first, second = _below_one_cutoff(record, motion.stretched(about))
    coarse = first.every(max(int(1 / (OVERSAMPLING * _cutoff(motion.stretched(about)) * record.interval)), 1))
    tried = (second.stretched(scale / about).at(coarse.interval) for scale in scales)
    return float(scales[int(np.argmax([abs(_correlated(coarse, each).correlation) for each in tried]))])


def _correlated(first: Series, second: Series) -> Match:
    one, other = first.acceleration, second.acceleration
    power = float(np.sqrt((one @ one) * (other @ other)))
    if not power > 0 or min(one.size, other.size) < FEWEST_SAMPLES:
        return Match(0.0, 0.0)
    correlation = scipy.signal.correlate(one, other, mode="full", method="fft") / power
    best = int(np.argmax(np.abs(correlation)))
    return Match(float(correlation[best]), (best - other.size + 1) * first.interval)


def _below_one_cutoff(record: Series, motion: Series) -> tuple[Series, Series]:
    """Both at the record's interval, below the frequency up to which the motion has its power; means taken off."""
    second = motion.at(record.interval)
    cutoff = min(_cutoff(motion), 0.2 / record.interval)
    return _below(record, cutoff), _below(second, cutoff)


def _below(series: Series, cutoff_hz: float) -> Series:
    if series.acceleration.size < FEWEST_SAMPLES:
        return series
    smooth = lowpass(series.acceleration, series.interval, cutoff_hz)
    return Series(smooth - smooth.mean(), series.interval)


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


def _differences(record: Series, name: str, motion: Series, found: Match, scale: float) -> list[Finding]:
    """Parts of the motion that are not in the record, or otherwise."""
    one, other = (series.acceleration for series in _below_one_cutoff(record, motion))
    interval = record.interval
    begin = round(found.start / interval)
    inside = slice(max(-begin, 0), min(other.size, one.size - begin))
    energy = np.cumsum(other**2) / float(other @ other)
    lost = {
        f"the first {inside.start * interval:.3g} s": energy[inside.start] if inside.start else 0.0,
        f"the last {(other.size - inside.stop) * interval:.3g} s": 1 - energy[inside.stop - 1],
    }
    told = [
        warning("cut motion", f'{part} of "{name}" are missing from the record')
        for part, share in lost.items()
        if share > LEAST_ENERGY
    ]
    size = min(max(int(STRETCH * scale / interval), 4), inside.stop - inside.start)
    due, recorded = (
        sliding_window_view(values, size)[:: size // 2]
        for values in (other[inside], one[inside.start + begin : inside.stop + begin])
    )
    # The gain is the median of the stretches by their energy, so that a missing one does not matter.
    strength = (due**2).sum(axis=1)
    gains = (recorded * due).sum(axis=1) / np.maximum(strength, 1e-300)
    order = np.argsort(gains)
    gain = gains[order][np.searchsorted(np.cumsum(strength[order]), 0.5 * strength.sum())]
    off, usual = np.sqrt(((recorded - gain * due) ** 2).mean(axis=1)), abs(gain) * np.sqrt(strength / size)
    least = np.maximum(STANDS_OUT * np.quantile(off, QUIET), LEAST_DIFFERENCE * np.abs(gain * other[inside]).max())
    odd = np.flatnonzero((off > least) & (off > OTHERWISE * usual))
    if odd.size:
        low, high = ((odd[end] * (size // 2) + inside.start) * interval / scale for end in (0, -1))
        text = (
            f'the table did not move as "{name}" from {low:.3g} to {high + STRETCH:.3g} s of its own time: a part '
            "is missing or differs"
        )
        told.append(warning("cut motion", text))
    return told
