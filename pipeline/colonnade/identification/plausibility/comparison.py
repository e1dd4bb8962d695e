"""How an acceleration follows another: its scale, how late it is, and what a high-pass took off it."""

from __future__ import annotations

from dataclasses import dataclass
from math import log

import numpy as np

from colonnade.arrays import Array, Mask
from colonnade.identification.plausibility.scale import SURE, least_squares
from colonnade.signals.alignment import RIVAL_EVIDENCE, find_offset
from colonnade.signals.filters import lowpass

SLOWEST = 0.5
"""Hz, above which an acceleration is integrated."""

CALIBRATED = 0.05
"""Relative departure of their ratio from one that calibrations leave."""

BETTER = 2.0
"""Times less that has to be left unexplained with a delay, or with what a high-pass took off."""

LONGEST_DELAY, LEAST_DELAY = 1.0, 0.01
"""s: the longest delay searched for; the shortest reported."""

LEAST_LOST = 0.1
"""Share of the motion that a high-pass has to take off."""


@dataclass(frozen=True)
class Comparison:
    """
    How an acceleration follows a reference that is one, too.

    Attributes
    ----------
    factor, factor_error : float
        Acceleration over reference, with its sign; standard error.
    delay, delay_error : float
        How late it is, s; 0 unless a delay explains far more.
    corner, corner_error : float
        Hz, below which a high-pass took its motion off; 0 unless that explains far more.
    correlation : float
        With these.
    """

    factor: float
    factor_error: float
    correlation: float
    delay: float = 0.0
    delay_error: float = 0.0
    corner: float = 0.0
    corner_error: float = 0.0

    @property
    def differs(self) -> bool:
        """Whether it has another scale, sign, clock or high-pass than declared."""
        return self.is_misplaced or abs(self.factor - 1) > max(CALIBRATED, SURE * self.factor_error)

    @property
    def is_misplaced(self) -> bool:
        """Whether it is late, or lacks what is slow."""
        return bool(self.delay or self.corner)


def compare(interval: float, acceleration: Array, reference: Array, bandwidth: float, where: Mask) -> Comparison:
    """
    Regress a reference on an acceleration as it is, on a shifted one, and on one with its integral.

    Parameters
    ----------
    interval, bandwidth : float
        s; Hz, of the reference.
    acceleration, reference : ndarray, shape (n,)
        m/s²; finite.
    where : ndarray of bool, shape (n,)
        Samples of the reference that count.

    Notes
    -----
    What a high-pass took off an acceleration a is ω∫a dt if it is of the first order, and √2 ω∫a dt + ω²∬a dt dt of the
    second: the coefficient of the integral is about its corner. Of two explanations the one that leaves less is taken.
    Errors are from what is left, in as many independent samples as the bandwidth allows.
    """
    recorded = lowpass(acceleration, interval, bandwidth)
    once = integrated(recorded, interval)
    offset = find_offset(
        np.where(where, reference, 0.0), recorded, interval, longest=LONGEST_DELAY, bandwidth_hz=bandwidth
    )
    time = interval * np.arange(recorded.size)
    shifted = np.interp(time + offset.seconds, time, recorded)
    independent = 2 * bandwidth * interval * float(where.sum())

    def fit(*columns: Array) -> tuple[Array, Array, float]:
        found, errors, left = least_squares(reference, columns, where, independent)
        return found, errors, left**2 / max(float(np.mean(reference[where] ** 2)), 1e-300)

    def better(left: float) -> bool:
        ratio = max(plain, 1e-12) / max(left, 1e-12)
        return ratio > BETTER and 0.5 * independent * log(ratio) > RIVAL_EVIDENCE

    (share,), (error,), plain = fit(recorded)
    (late,), (late_error,), by_delay = fit(shifted)
    (kept, lost, _), (kept_error, lost_error, _), by_corner = fit(recorded, once, integrated(once, interval))
    is_late = late > 0 and better(by_delay) and abs(offset.seconds) > max(LEAST_DELAY, SURE * offset.standard_error)
    is_cut = kept > 0 and lost > SURE * lost_error and better(by_corner)
    is_cut = is_cut and lost * once[where].std() > LEAST_LOST * reference[where].std()
    if is_cut and not (is_late and by_delay < by_corner):
        corner, corner_error = (each / kept / (2 * np.pi) for each in (lost, lost_error))
        return Comparison(1 / kept, kept_error / kept**2, _left(by_corner), corner=corner, corner_error=corner_error)
    if is_late:
        return Comparison(1 / late, late_error / late**2, _left(by_delay), offset.seconds, offset.standard_error)
    share = share if share else 1e-300
    return Comparison(1 / share, error / share**2, _left(plain))


def integrated(values: Array, interval: float) -> Array:
    """Integral above `SLOWEST`."""
    summed = np.cumsum(values - values.mean()) * interval
    return summed - lowpass(summed, interval, SLOWEST)


def _left(unexplained: float) -> float:
    return float(np.sqrt(max(1 - unexplained, 0.0)))
