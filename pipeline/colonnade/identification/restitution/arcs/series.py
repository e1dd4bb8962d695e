"""The arcs of a free vibration as numbers: speeds at the impacts, durations, and how they follow from the peaks."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from colonnade.arrays import Array, Mask
from colonnade.dynamics.block import Block
from colonnade.identification.restitution.arcs.energy import lift
from colonnade.identification.restitution.arcs.rocking_arc import half_duration_of

STEP = 1e-5
"""Of the derivatives of an arc's duration, as a share of the peak and of α."""


@dataclass(frozen=True, eq=False)
class ArcSeries:
    """
    Arcs in order, with what the nonlinear equation says of each.

    Attributes
    ----------
    number : ndarray of int, shape (n,)
        Impacts since the first arc.
    side : ndarray, shape (n,)
        −1 or 1, the sign of the peak.
    peak, peak_error : ndarray, shape (n,)
        |θ| and its standard error, rad.
    start, end, start_error, end_error : ndarray, shape (n,)
        Times of the impacts on either side and their standard errors, s.
    critical : ndarray, shape (n,)
        α of the side, rad.
    energy : ndarray, shape (n,)
        ln ω² (ω in rad/s) at the arc's impacts, from its peak.
    energy_by_peak, energy_by_critical : ndarray, shape (n,)
        Its derivatives by |θ| and by α, 1/rad.
    period : ndarray, shape (n,)
        ln of the duration over the one that the peak gives.
    period_by_peak, period_by_critical : ndarray, shape (n,)
        Derivatives of ln of the duration that the peak gives by |θ| and by α, 1/rad.
    """

    number: NDArray[np.int_]
    side: Array
    peak: Array
    peak_error: Array
    start: Array
    end: Array
    start_error: Array
    end_error: Array
    critical: Array
    energy: Array
    energy_by_peak: Array
    energy_by_critical: Array
    period: Array
    period_by_peak: Array
    period_by_critical: Array

    @property
    def speed(self) -> Array:
        """Magnitude of ω at the arc's impacts, rad/s."""
        return np.asarray(np.exp(self.energy / 2))

    @property
    def duration(self) -> Array:
        """Time between the impacts, s."""
        return self.end - self.start

    def covariance(self) -> Array:
        """Covariance of energies, then periods, shape (2 n, 2 n): neighbours share the error of an impact's time."""
        count = self.number.size
        by_peak = np.vstack((np.diag(self.energy_by_peak), np.diag(-self.period_by_peak))) * self.peak_error
        by_start, by_end = np.zeros((2 * count, count)), np.zeros((2 * count, count))
        by_start[count:] = np.diag(-self.start_error / self.duration)
        by_end[count:] = np.diag(self.end_error / self.duration)
        shared = by_end[:, :-1] + by_start[:, 1:]
        alone = self.end[:-1] != self.start[1:]
        shared[:, alone] = 0.0
        parts = [by_peak, shared, by_end[:, -1:], by_start[:, :1], by_end[:, :-1][:, alone], by_start[:, 1:][:, alone]]
        return np.asarray(sum(part @ part.T for part in parts))


def arc_series(
    block: Block,
    impact_time: Array,
    impact_error: Array,
    peak_angle: Array,
    peak_error: Array,
    used: Mask,
    *,
    zero_offset: float = 0.0,
) -> ArcSeries:
    """
    Turn peaks and the times between them into a series.

    Parameters
    ----------
    block : Block
    impact_time, impact_error : ndarray, shape (n + 1,)
        Times at which the angle, with its zero offset, passes zero before and after each arc; their standard errors, s.
    peak_angle, peak_error : ndarray, shape (n,)
        θ of each peak, signed, without the offset, and its standard error, rad.
    used : ndarray of bool, shape (n,)
        Arcs outside it, without times, or with a peak that is not below α are left out; the others keep their numbers.
    zero_offset : float, optional
        rad; the times are moved to where the block is upright.
    """
    critical, p = block.critical_angle_at(peak_angle), block.p_at(peak_angle)
    impact_time = impact_time + zero_offset * _slowness(block, peak_angle)
    timed = np.isfinite(impact_time) & np.isfinite(impact_error)
    kept = used & timed[:-1] & timed[1:] & np.isfinite(peak_error)
    kept &= (np.abs(peak_angle) < critical) & (peak_angle != 0)
    number = np.flatnonzero(kept)
    peak, critical, p = np.abs(peak_angle[kept]), critical[kept], p[kept]
    rise = lift(peak, critical)
    low, high = impact_time[:-1][kept], impact_time[1:][kept]

    def phase(angle: Array, limit: Array) -> Array:
        return np.asarray(np.log(half_duration_of(angle, limit, False)))

    # Where the fits disagree on the order of two impacts the arc has no duration.
    duration = np.where(high > low, high - low, np.nan)
    return ArcSeries(
        number=number,
        side=np.sign(peak_angle[kept]),
        peak=peak,
        peak_error=np.maximum(peak_error[kept], 1e-9 * critical),
        start=low,
        end=high,
        start_error=impact_error[:-1][kept],
        end_error=impact_error[1:][kept],
        critical=critical,
        energy=np.log(2 * p**2 * rise),
        energy_by_peak=np.sin(critical - peak) / rise,
        energy_by_critical=(np.sin(critical) - np.sin(critical - peak)) / rise,
        period=np.log(duration * p / 2) - phase(peak, critical),
        period_by_peak=(phase(peak * (1 + STEP), critical) - phase(peak * (1 - STEP), critical)) / (2 * STEP * peak),
        period_by_critical=(phase(peak, critical * (1 + STEP)) - phase(peak, critical * (1 - STEP)))
        / (2 * STEP * critical),
    )


def _slowness(block: Block, peak_angle: Array) -> Array:
    """1/ω, signed, at each impact: the mean of that before and after, of the one that is known where one is not."""
    critical, p = block.critical_angle_at(peak_angle), block.p_at(peak_angle)
    with np.errstate(invalid="ignore", divide="ignore"):
        inverse = np.sign(peak_angle) / (p * np.sqrt(2 * lift(peak_angle, critical)))
    inverse[~np.isfinite(inverse)] = np.nan
    # A block falls from one side to the other: before an impact ω has the sign opposite to the angle.
    before, after = np.append(np.nan, -inverse), np.append(inverse, np.nan)
    known = np.isfinite(before).astype(int) + np.isfinite(after)
    return np.asarray((np.nan_to_num(before) + np.nan_to_num(after)) / np.maximum(known, 1))
