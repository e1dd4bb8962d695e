"""The rate of one recorder's clock relative to another's, from two records of the same motion."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise

import numpy as np
import scipy

from colonnade.arrays import Array

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

ITERATIONS = 6

_HELD = 0.5
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
    weights = 1 / errors**2
    middle = float(np.average(middles, weights=weights))
    across = middles - middle
    leverage = float(weights @ across**2)
    mean = float(np.average(delays, weights=weights))
    slope = float(weights @ (across * delays)) / leverage
    misfit = float(weights @ (delays - mean - slope * across) ** 2) / (middles.size - 2)
    widened = float(np.sqrt(max(misfit, 1.0)))
    return ClockRate(
        slope,
        widened / float(np.sqrt(leverage)),
        mean,
        widened / float(np.sqrt(weights.sum())),
        middle,
        slope * float(np.ptp(middles)),
    )


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
    centred = reference - reference.mean()
    low, high = float(values.x[0]), float(values.x[-1])
    shift = delay
    for _ in range(ITERATIONS):
        moved = time + shift
        if moved[0] < low or moved[-1] > high:
            return None
        model, slope = values(moved), values(moved, 1)
        model, slope = model - model.mean(), slope - slope.mean()
        power = float(model @ model)
        if not power > 0:
            return None
        gain = float(model @ centred) / power
        columns = np.column_stack([model, gain * slope])
        normal = columns.T @ columns
        if not np.linalg.cond(normal) < 1e14:
            return None
        step = np.linalg.solve(normal, columns.T @ (centred - gain * model))
        shift += float(step[1])
    residual = centred - gain * model
    agreement = 1 - float(residual @ residual) / max(float(centred @ centred), 1e-300)
    if gain <= 0 or agreement < _HELD**2:
        return None
    independent = max(2 * bandwidth_hz * float(time[-1] - time[0]), 3.0)
    variance = float(residual @ residual) / (independent - 2) / time.size * independent
    covariance = variance * np.linalg.inv(normal) * time.size / independent
    error = max(float(np.sqrt(covariance[1, 1])), 1e-9)
    return float(time.mean()), shift, error
