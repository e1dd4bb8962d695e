"""The delay of one recorder relative to another, and its drift, from two records of the same motion."""

from __future__ import annotations

import warnings
from dataclasses import dataclass, replace
from itertools import pairwise

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

RIVAL_EVIDENCE = 10.0
"""Difference of log-likelihood needed to prefer one delay to another."""

OPPOSED = 2.0
"""Times less that has to be left unexplained with the sign of one record turned, before the sign is doubted."""

STRETCHES = 8
"""Number of parts of the motion, of equal information; the delay is found in each."""

FEWEST_STRETCHES = 4
"""That have to agree with a line."""

SHORTEST = 3.0
"""Of the shortest stretch, in periods of the bandwidth."""

SIGNIFICANCE = 4.0
"""Standard errors by which a rate differs from zero before it is taken off."""

LEAST_CHANGE = 5e-4
"""s; a delay that changes less than this over the motion is left as it is."""

HELD = 0.5
"""Correlation of a stretch below which its delay is not used."""


@dataclass(frozen=True)
class ClockRate:
    """
    A delay that changes evenly.

    Attributes
    ----------
    rate, standard_error : float
        Seconds gained in a second; positive where the second recorder's clock runs fast.
    seconds, seconds_error : float
        Delay in the middle of the motion, s.
    middle : float
        Time of that, s.
    change : float
        Of the delay over the stretches, s.
    """

    rate: float
    standard_error: float
    seconds: float
    seconds_error: float
    middle: float
    change: float

    @property
    def is_significant(self) -> bool:
        """Whether the change of the delay is more than chance and large enough to matter."""
        return abs(self.rate) >= SIGNIFICANCE * self.standard_error and abs(self.change) >= LEAST_CHANGE

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
    rival : float or None
        Another delay, s, that fits as well where both records have values.
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
    rival: float | None = None
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
        said = []
        if self.beyond is not None:
            said.append(
                f"the two agree better at {1e3 * self.beyond:.4g} ms, beyond the range searched; if the recorder can "
                "start that late or early, set processing.longest_offset above it"
            )
        elif not self.is_determined:
            said.append(
                f"the two agree poorly (correlation {self.correlation:.2f}; {WEAKEST_CORRELATION:g} is needed), as "
                "happens if the table hardly moves"
            )
        if self.is_determined and self.rival is not None:
            said.append(
                f"{1e3 * self.rival:.4g} ms fits as well as the {1e3 * self.seconds:.4g} ms used, as in a steady sine. "
                "Record the start or the end of the motion, or set processing.longest_offset below half a period"
            )
        if self.is_determined and self.opposed:
            said.append(
                f"the two agree only with the sign of one reversed (correlation {self.correlation:.2f}); check the "
                "`direction` of both and the sign of their gains"
            )
        return "; ".join(said)


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
    tell one period of a sine from the next. The standard error is that of a shift fitted by least squares. A steady
    sine that began before the records and outlasts them fits as well one period off: see `Offset.rival`.
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
    is_beyond = abs(furthest) > reach and reached >= WEAKEST_CORRELATION
    is_beyond &= at_border or _evidence(1 - agreement**2, 1 - reached**2, independent) > RIVAL_EVIDENCE
    rival = _rival(first, second, correlation, best, independent)
    return Offset(
        shift * interval,
        float(residual / slope / np.sqrt(independent)),
        agreement,
        None if rival is None else rival * interval,
        furthest * interval if is_beyond else None,
    )


def _evidence(misfit: float, other: float, independent: float) -> float:
    """Log-likelihood by which what leaves the second misfit is better than what leaves the first."""
    return 0.5 * independent * float(np.log(max(misfit, 1e-12) / max(other, 1e-12)))


def _rival(first: Array, second: Array, correlation: Array, best: int, independent: float) -> int | None:
    """Shift, in samples, of a further peak of the correlation that fits the overlap as well as the best one."""
    reach = correlation.size // 2
    misfit = _misfit(first, second, best - reach)
    peaks = scipy.signal.find_peaks(correlation, height=0.0)[0]
    for peak in sorted(peaks[peaks != best], key=lambda index: -float(correlation[index])):
        if _evidence(_misfit(first, second, int(peak) - reach), misfit, independent) < RIVAL_EVIDENCE:
            return int(peak) - reach
    return None


def _misfit(first: Array, second: Array, shift: int) -> float:
    """Share of the power in the overlap that the shifted record does not explain, one minus the correlation squared."""
    size = first.size - abs(shift)
    one, other = first[max(-shift, 0) :][:size], second[max(shift, 0) :][:size]
    power = float((one @ one) * (other @ other))
    return 1.0 - max(float(one @ other), 0.0) ** 2 / power if power > 0 else 1.0


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
    if turned.is_determined and turned.beyond is None and _is_better(turned, offset, clock, first, second, bandwidth):
        offset, second = replace(turned, opposed=True), -second
    if not offset.is_determined or offset.beyond is not None:
        return offset
    rate = find_rate(clock, first, second, delay=offset.seconds, bandwidth_hz=bandwidth)
    if rate is None or not rate.is_significant:
        return offset
    return replace(offset, seconds=rate.seconds, standard_error=rate.seconds_error, drift=rate)


def _is_better(turned: Offset, offset: Offset, time: Array, first: Array, second: Array, bandwidth_hz: float) -> bool:
    """Whether two records agree much better with the sign of one turned, where both have values."""
    spline = scipy.interpolate.CubicSpline(time, second)

    def unexplained(sign: float, shift: float) -> float:
        shared = (time + shift >= time[0]) & (time + shift <= time[-1])
        return _misfit(first[shared], sign * spline(time[shared] + shift), 0)

    misfits = unexplained(1.0, offset.seconds), unexplained(-1.0, turned.seconds)
    independent = 2 * bandwidth_hz * float(time[-1] - time[0])
    return misfits[0] > OPPOSED * misfits[1] and _evidence(*misfits, independent) > RIVAL_EVIDENCE


def find_rate(time: Array, reference: Array, values: Array, *, delay: float, bandwidth_hz: float) -> ClockRate | None:
    """
    Fit a line through the delays of a record's stretches.

    Parameters
    ----------
    time, reference, values : ndarray, shape (n,)
        s, at equal steps; the same quantity, band-limited alike, in any unit.
    delay : float
        How late `values` are as a whole, s.
    bandwidth_hz : float
        Of both records: it determines how many of their samples are independent.

    Returns
    -------
    rate : ClockRate or None
        None if too few stretches have a delay of their own.

    Notes
    -----
    In each stretch delay and gain are fitted by least squares. A scatter of the delays about the line that is larger
    than their standard errors widens that of the rate.
    """
    spline = scipy.interpolate.CubicSpline(time, values)
    found: list[tuple[float, float, float]] = []
    for start, stop in _stretches(time, reference, bandwidth_hz):
        # Each stretch starts from the delay of the one nearest to it.
        near = min(found, key=lambda each: abs(each[0] - time[start]))[1] if found else delay
        local = _local_delay(time[start:stop], reference[start:stop], spline, near, bandwidth_hz)
        if local is not None:
            found.append(local)
    if len(found) < FEWEST_STRETCHES:
        return None
    middles, delays, errors = np.array(sorted(found)).T
    middle = float(np.average(middles, weights=errors**-2))
    line, covariance = np.polyfit(middles - middle, delays, 1, w=1 / errors, cov="unscaled")
    misfit = ((delays - np.polyval(line, middles - middle)) / errors) ** 2
    deviations = np.sqrt(np.diag(covariance) * max(float(misfit.sum()) / (middles.size - 2), 1.0))
    (slope, mean), (slope_error, mean_error) = line.tolist(), deviations.tolist()
    return ClockRate(slope, slope_error, mean, mean_error, middle, slope * float(np.ptp(middles)))


def _stretches(time: Array, reference: Array, bandwidth_hz: float) -> list[tuple[int, int]]:
    """Parts of the record in which the motion's slope has equal energy, those nearest to the middle first."""
    slope = np.gradient(reference)
    energy = np.cumsum(slope**2)
    if not energy[-1] > 0:
        return []
    shares = np.linspace(0.01, 0.99, STRETCHES + 1) * energy[-1]
    edges = np.searchsorted(energy, shares)
    shortest = SHORTEST / bandwidth_hz / float(time[1] - time[0])
    parts = [(int(a), int(b)) for a, b in pairwise(edges) if b - a >= shortest]
    return sorted(parts, key=lambda part: abs(sum(part) - edges[0] - edges[-1]))


def _local_delay(
    time: Array, reference: Array, values: scipy.interpolate.CubicSpline, delay: float, bandwidth_hz: float
) -> tuple[float, float, float] | None:
    """Middle, delay and standard error of a stretch; None if it does not agree or leaves the record."""

    def moved(time: Array, gain: float, shift: float) -> Array:
        late = values(time + shift)
        return np.asarray(gain * (late - late.mean()))

    centred = reference - reference.mean()
    try:
        with warnings.catch_warnings(action="ignore", category=scipy.optimize.OptimizeWarning):
            (gain, shift), covariance = scipy.optimize.curve_fit(
                moved, time, centred, p0=(1.0, delay), ftol=1e-13, xtol=1e-13
            )
    except RuntimeError:  # it does not converge
        return None
    residual = centred - moved(time, gain, shift)
    agreement = 1 - float(residual @ residual) / max(float(centred @ centred), 1e-300)
    independent = max(2 * bandwidth_hz * float(time[-1] - time[0]), 3.0)
    error = float(np.sqrt(covariance[1, 1] * (time.size - 2) / (independent - 2)))
    is_inside = values.x[0] <= time[0] + shift and time[-1] + shift <= values.x[-1]
    if not is_inside or gain <= 0 or agreement < HELD**2 or not np.isfinite(error):
        return None
    return float(time.mean()), float(shift), max(error, 1e-9)
