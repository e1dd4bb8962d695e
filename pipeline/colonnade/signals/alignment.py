"""The delay of one recorder relative to another, and its drift, from two records of the same motion."""

from __future__ import annotations

from dataclasses import dataclass, replace
from math import log

import numpy as np
import scipy

from colonnade.arrays import Array
from colonnade.signals.filters import lowpass, second_derivative
from colonnade.signals.record import Record
from colonnade.signals.timing import resample, uniform_clock

WEAKEST_CORRELATION = 0.7
"""Two records that agree less than this are not of the same motion, or there was none."""

BANDWIDTH = 10.0
"""Hz; recorders are aligned on what their linked channels share below it, where displacements have little noise."""

FEWEST_SAMPLES = 16
"""That two records have to share."""

EVIDENCE = 10.0
"""Difference of log-likelihood needed to prefer one delay to another."""

OPPOSED = 2.0
"""Times less that has to be left unexplained with the sign of one record turned, before the sign is doubted."""

ROUNDS = 6
"""Of the fit of delay and rate, whose errors each squares."""

SIGNIFICANCE = 4.0
"""Standard errors by which a rate differs from zero before it is taken off."""

LEAST_CHANGE = 5e-4
"""s; a delay that changes less than this over the motion is left as it is."""

MOTION = 0.01, 0.99
"""Shares of a record's energy between which it moves."""


@dataclass(frozen=True)
class ClockRate:
    """
    A delay that changes evenly.

    Attributes
    ----------
    rate, standard_error : float
        Seconds gained in a second; positive where the second recorder's clock runs fast.
    middle : float
        Time of the delay, s.
    change : float
        Of the delay over the motion, s.
    """

    rate: float
    standard_error: float
    middle: float
    change: float

    def __str__(self) -> str:
        return f"{1e6 * abs(self.rate):.0f} ± {1e6 * self.standard_error:.0f} ppm {'fast' if self.rate > 0 else 'slow'}"


@dataclass(frozen=True)
class Offset:
    """
    Delay between two records.

    Attributes
    ----------
    seconds : float
        What has to be taken off the second record's times.
    standard_error : float
        s.
    correlation : float
        Of the two records once aligned, 0 to 1.
    beyond : float or None
        A delay, s, longer than those looked for, with which the two agree better.
    opposed : bool
        Whether they agree only with the sign of one of them turned.
    drift : ClockRate or None
        How the delay changes, where it does; `seconds` is then that in the middle of the motion.
    """

    seconds: float
    standard_error: float
    correlation: float
    beyond: float | None = None
    opposed: bool = False
    drift: ClockRate | None = None

    @property
    def is_determined(self) -> bool:
        """Whether the records agree well enough for the delay to mean something."""
        return self.correlation >= WEAKEST_CORRELATION

    def at(self, time: Array) -> Array:
        """Delay at times of the first recorder, s, of any shape."""
        change = 0.0 if self.drift is None else self.drift.rate * (time - self.drift.middle)
        return np.asarray(self.seconds + change + np.zeros_like(time))

    @property
    def doubt(self) -> str:
        """What speaks against the delay; empty if nothing does."""
        if self.beyond is not None:
            return (
                f"the two agree better at {1e3 * self.beyond:.4g} ms, beyond the range searched; if the recorder can "
                "start that late or early, set processing.longest_offset above it"
            )
        if not self.is_determined:
            return (
                f"the two agree poorly (correlation {self.correlation:.2f}; {WEAKEST_CORRELATION:g} is needed), as "
                "happens if the table hardly moves"
            )
        if self.opposed:
            return (
                f"the two agree only with the sign of one reversed (correlation {self.correlation:.2f}); check the "
                "`direction` of both and the sign of their gains"
            )
        return ""


def find_offset(reference: Array, values: Array, interval: float, *, longest: float, bandwidth_hz: float) -> Offset:
    """
    Find how late a record is against a reference.

    Parameters
    ----------
    reference, values : ndarray, shape (n,)
        The same quantity on one clock, band-limited alike; in any unit.
    interval : float
        s.
    longest : float
        Largest delay of either sign that is looked for, s.
    bandwidth_hz : float
        Of both records: it determines how many of their samples are independent.

    Returns
    -------
    offset : Offset
        Where the correlation over the whole record is largest, to a fraction of the interval.

    Notes
    -----
    The correlation is over the whole of both records, not over their overlap, so that the beginning and end of a motion
    tell one period of a sine from the next. The standard error is that of a shift fitted by least squares.
    """
    first, second = reference - reference.mean(), values - values.mean()
    power = float(np.sqrt((first @ first) * (second @ second)))
    reach = min(int(np.ceil(longest / interval)), first.size - 2)
    if not power > 0 or reach < 1:
        return Offset(0.0, float("inf"), 0.0)
    everywhere = scipy.signal.correlate(second, first, mode="full", method="fft") / power
    correlation = everywhere[first.size - 1 - reach : first.size + reach]
    best, furthest = int(np.argmax(correlation)), int(np.argmax(everywhere)) - first.size + 1
    at_border = best in (0, 2 * reach)
    shift, agreement = float(best - reach), max(float(correlation[best]), 0.0)
    if not at_border:
        before, peak, after = correlation[best - 1 : best + 2]
        shift += 0.5 * (before - after) / (before - 2 * peak + after)
    independent = max(2 * bandwidth_hz * interval * first.size, 1.0)
    residual = np.sqrt(max(1 / max(agreement, 1e-3) ** 2 - 1, 0.0)) * first.std()
    slope = max(float(np.sqrt((np.gradient(first, interval) ** 2).mean())), 1e-300)
    # Beyond what was looked for, a better one counts if the best one is at the border or fits far worse.
    reached = float(everywhere.max())
    evidence = 0.5 * independent * log(max(1 - agreement**2, 1e-12) / max(1 - reached**2, 1e-12))
    is_beyond = abs(furthest) > reach and reached >= WEAKEST_CORRELATION and (at_border or evidence > EVIDENCE)
    return Offset(
        shift * interval,
        float(residual / slope / np.sqrt(independent)),
        agreement,
        furthest * interval if is_beyond else None,
    )


def link(reference: Record, record: Record, *, quantities: tuple[str, str], longest: float, sign: float) -> Offset:
    """
    Find how late one recorder is against another from a channel of each.

    Parameters
    ----------
    reference, record : Record
        The same motion, each with its delay taken off its times.
    quantities : (str, str)
        Of both; a "displacement" is differentiated twice if the other is an "acceleration".
    longest : float
        Largest delay of either sign that is looked for, s.
    sign : float
        -1 where the two channels point against each other, otherwise 1.

    Returns
    -------
    offset : Offset
        With its drift, where the clocks run at different rates.

    Raises
    ------
    ValueError
        If the records share too few samples; the message completes "channels a and b ".
    """
    interval = max(reference.interval, record.interval)
    start, stop = max(reference.time[0], record.time[0]), min(reference.time[-1], record.time[-1])
    clock = uniform_clock(start, stop, interval)
    if clock.size < FEWEST_SAMPLES:
        raise ValueError(f"share {clock.size} samples; at least {FEWEST_SAMPLES} were expected")
    bandwidth = min(BANDWIDTH, 0.2 / interval)
    shared = []
    for each, quantity in zip((reference, record), quantities, strict=True):
        smooth = second_derivative if quantity == "displacement" and "acceleration" in quantities else lowpass
        shared.append(resample(each.time, smooth(each.values, each.interval, bandwidth), clock, each.interval)[0])
    first, second = shared[0] - shared[0].mean(), sign * (shared[1] - shared[1].mean())
    offset = find_offset(first, second, interval, longest=longest, bandwidth_hz=bandwidth)
    turned = find_offset(first, -second, interval, longest=longest, bandwidth_hz=bandwidth)
    if turned.is_determined and turned.beyond is None:
        # Half a period of a sine is told from a wrong sign where both have values.
        misfits = [
            _unexplained(first, each, round(found.seconds / interval))
            for each, found in ((second, offset), (-second, turned))
        ]
        if misfits[0] > OPPOSED * misfits[1]:
            offset, second = replace(turned, opposed=True), -second
    if not offset.is_determined or offset.beyond is not None:
        return offset
    return with_drift(offset, clock, first, second, bandwidth_hz=bandwidth)


def _unexplained(first: Array, second: Array, shift: int) -> float:
    """Share of the power in the overlap that the record shifted by so many samples does not explain."""
    size = first.size - abs(shift)
    one, other = first[max(-shift, 0) :][:size], second[max(shift, 0) :][:size]
    return 1.0 - max(float(np.corrcoef(one, other)[0, 1]), 0.0) ** 2


def with_drift(offset: Offset, time: Array, reference: Array, values: Array, *, bandwidth_hz: float) -> Offset:
    """
    Find whether a delay changes over the motion.

    Parameters
    ----------
    offset : Offset
        How late `values` are as a whole.
    time, reference, values : ndarray, shape (n,)
        s, at equal steps; the same quantity, band-limited alike, in any unit.
    bandwidth_hz : float
        Of both records: it determines how many of their samples are independent.

    Returns
    -------
    offset : Offset
        As given, where the change may be chance or is too small to matter.

    Notes
    -----
    Gain, level, delay and rate are fitted to the whole record by least squares.
    """
    spline = scipy.interpolate.CubicSpline(time, values)
    energy = np.cumsum(np.gradient(reference) ** 2)
    begin, middle, end = time[np.searchsorted(energy, np.array([MOTION[0], 0.5, MOTION[1]]) * energy[-1])].tolist()
    along = time - middle
    delay, rate = offset.seconds, 0.0
    for _ in range(ROUNDS):
        at = np.clip(time + delay + rate * along, time[0], time[-1])
        late, slope = spline(at), spline(at, 1)
        columns = np.column_stack((late, np.ones_like(late), slope, slope * along))
        found = np.linalg.lstsq(columns, reference, rcond=None)[0]
        delay, rate = delay + found[2] / found[0], rate + found[3] / found[0]
    independent = max(2 * bandwidth_hz * float(time[-1] - time[0]), 1.0)
    left = reference - columns @ found
    errors = np.sqrt(np.diag(np.linalg.pinv(columns.T @ columns)) * float(left @ left) / independent) / abs(found[0])
    drift = ClockRate(float(rate), float(errors[3]), middle, float(rate) * (end - begin))
    if abs(drift.rate) < SIGNIFICANCE * drift.standard_error or abs(drift.change) < LEAST_CHANGE:
        return offset
    return replace(offset, seconds=float(delay), standard_error=float(errors[2]), drift=drift)
