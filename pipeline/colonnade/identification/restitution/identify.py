"""Identification of the coefficient of restitution from one free vibration, by all estimators."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from colonnade.dynamics.block import Block
from colonnade.identification.restitution import each_impact, half_periods, history, impact_by_impact, peaks
from colonnade.identification.restitution.arcs import Arcs, arcs_between, find_impacts, noise_level
from colonnade.identification.restitution.arguments import check_records, check_settings
from colonnade.identification.restitution.choice import METHODS, RULE, choose
from colonnade.identification.restitution.departures import find_departures
from colonnade.identification.restitution.driven_decay import moving_base
from colonnade.identification.restitution.each_impact import EachImpact, fit_each_impact
from colonnade.identification.restitution.free_rocking import objection
from colonnade.identification.restitution.half_periods import fit_half_periods
from colonnade.identification.restitution.history import HistoryFit, fit_history
from colonnade.identification.restitution.impact_by_impact import fit_impacts, impact_times, single_impacts
from colonnade.identification.restitution.peaks import fit_peaks
from colonnade.identification.restitution.result import Estimate, Peaks, Restitution
from colonnade.identification.restitution.samples import Samples, thinned
from colonnade.identification.restitution.single_impacts import found_by_impact

Array = NDArray[np.float64]

ASSUMPTIONS = {
    peaks.NAME: peaks.ASSUMPTIONS,
    half_periods.NAME: half_periods.ASSUMPTIONS,
    impact_by_impact.NAME: impact_by_impact.ASSUMPTIONS,
    "history-linear": history.ASSUMPTIONS,
    "history-nonlinear": history.ASSUMPTIONS,
    each_impact.NAME: each_impact.ASSUMPTIONS,
}
"""Of each estimator, in the order of `Restitution.estimates`."""

FEWEST_PEAKS = 2
NOISE_MARGIN = 8.0
"""Excursions below this many standard deviations of the smoothed noise are none."""

SMOOTHED = 0.1
"""Over p: length over which the record is averaged to find its excursions."""


def identify_restitution(
    time: ArrayLike,
    angle: ArrayLike,
    block: Block,
    *,
    level: float = 0.95,
    lowest_amplitude: float = 0.02,
    noise: float | None = None,
    lowpass: float | None = None,
    free: tuple[str, ...] = (),
    out_of_plane: ArrayLike | None = None,
    slide: ArrayLike | None = None,
    uplift: ArrayLike | None = None,
    base_acceleration: ArrayLike | None = None,
) -> Restitution:
    """
    Identify the coefficient of restitution from a free vibration.

    Parameters
    ----------
    time, angle : array_like, shape (n,)
        s, increasing; rad, about the rest position. Missing samples are NaN.
    block : Block
    level : float, optional
        Of the interval of confidence.
    lowest_amplitude : float, optional
        Peaks with |θ|/α below it are left out, as are those that do not stand out of the noise.
    noise : float, optional
        Standard deviation of the angle at rest, rad; default: from the record itself.
    lowpass : float, optional
        Cut-off of the zero-phase low-pass (Butterworth, order 4, both ways) that the record went through, Hz; default:
        found from what the fit leaves over.
    free : tuple of {"critical_angle", "p"}, optional
        What the whole histories, and for p the half-periods, identify beside e: worn edges, an uncertain inertia.
    out_of_plane, slide, uplift : array_like, shape (n,), optional
        Rotation about x (rad), displacement of the pole and height of the base (m), where measured: departures from
        plane rocking are then seen directly.
    base_acceleration : array_like, shape (n,), optional
        Of the base along x, m/s², at steps that are even. If it moves the table (`base_motion.table_moves`) it drives
        the history; only the whole history with an e of its own at each impact can follow that.

    Returns
    -------
    result : Restitution
        `value` is None, with a `reason`, where the record does not give e.

    Raises
    ------
    ValueError
        If an argument is out of its range or of another kind, time and angle differ in shape, or time does not
        increase.

    Notes
    -----
    What each estimator assumes stands in its `Estimate`. All are made; one is recommended (`choice.RULE`).
    """
    free = check_settings(
        block, level=level, lowest_amplitude=lowest_amplitude, noise=noise, lowpass=lowpass, free=free
    )
    times, angles = check_records(
        time, angle, out_of_plane=out_of_plane, slide=slide, uplift=uplift, base_acceleration=base_acceleration
    )
    if np.isfinite(angles).sum() < 8:
        return _refused("The record holds fewer than 8 values.", level)
    samples = thinned(times, angles, block)
    seen = _excursions(samples, block, lowest_amplitude, noise)
    if seen.usable.sum() < FEWEST_PEAKS:
        return _refused(
            f"{int(seen.usable.sum())} peaks between two impacts stand above {seen.lowest / block.critical_angle:.2g} "
            f"of the critical angle; at least {FEWEST_PEAKS} are needed.",
            level,
            peaks=seen.peaks,
        )
    if reason := objection(seen.arcs, seen.usable, block):
        return _refused(reason, level, peaks=seen.peaks)
    lowest = lowest_amplitude * block.critical_angle
    common: dict[str, Any] = {"free": free, "lowest": lowest, "level": level}
    try:
        base = moving_base(times, base_acceleration, block)
    except ValueError as error:
        return _refused(str(error), level, peaks=seen.peaks)
    scattered = fit_each_impact(samples, seen.arcs, block, lowpass=lowpass, base=base, **common)
    if base is not None:
        return _driven(scattered, seen, level)
    # Impacts are where the angle passes its true zero.
    shift = scattered.decay.values["zero_offset"] if scattered.decay is not None else 0.0
    seen = seen.shifted(shift, samples, block)
    arcs, usable = seen.arcs, seen.usable
    by_peaks, table, offset = fit_peaks(arcs, seen.critical, usable, seen.noise, level=level)
    impacts, impact_covariance = impact_times(arcs)
    departures = find_departures(
        times,
        angles - shift,
        block,
        impact_time=impacts,
        impact_standard_error=np.sqrt(np.diag(impact_covariance)),
        peak_angle=arcs.peak_angle,
        peak_standard_error=arcs.peak_standard_error,
        used=usable,
        out_of_plane=out_of_plane,
        slide=slide,
        uplift=uplift,
    )
    left_out = max((departure.left_out for departure in departures), default=0)
    if left_out:
        usable = usable & (np.arange(usable.size) >= left_out)
        by_peaks, table, offset = fit_peaks(arcs, seen.critical, usable, seen.noise, level=level)
        common["from_release"] = False
        later = Arcs(*(getattr(arcs, name)[left_out:] for name in vars(arcs)))
        scattered = fit_each_impact(samples, later, block, lowpass=lowpass, **common)
    else:
        later = seen.arcs
    nonlinear = fit_history(samples, later, block, lowpass=lowpass, **common)
    linear = _linear(samples, later, block, nonlinear, lowpass, common)
    singles = single_impacts(arcs, offset, usable, block)
    by_impact, constancy = fit_impacts(arcs, offset, singles, block, level=level)
    row = slice(left_out, _end_of_row(impact_covariance, left_out))
    periods = fit_half_periods(
        impacts[row],
        impact_covariance[row, row],
        int(np.nanmedian(arcs.peak_angle[left_out:] * (-1.0) ** np.arange(arcs.peak_angle.size - left_out)) > 0),
        block,
        free_p="p" in free,
        level=level,
    )

    departures += found_by_impact(scattered)
    chosen, reason = choose(scattered, by_peaks)
    refusing = [departure.sentence for departure in departures if departure.refuses]
    if refusing:
        chosen, reason = None, refusing[0]
    result = Restitution(
        None,
        None,
        None,
        None,
        level,
        RULE,
        reason,
        shift + offset,
        table,
        singles,
        (by_peaks, periods.estimate, by_impact, linear.estimate, nonlinear.estimate, scattered.estimate),
        scattered.fitted or nonlinear.fitted,
        departures,
        "",
        constancy,
    )
    return _with_value(result, chosen)


def _driven(scattered: EachImpact, seen: _Excursions, level: float) -> Restitution:
    """Return what the whole history gives on a table that moves; the other estimators hold on one at rest only."""
    reason = "The table moves: this estimator takes it to be at rest."
    others = tuple(
        Estimate(name, None, None, None, None, level, assumptions, reason)
        for name, assumptions in ASSUMPTIONS.items()
        if name != each_impact.NAME
    )
    departures = found_by_impact(scattered, driven=True)
    chosen, refusal = choose(scattered, others[0])
    refusing = [departure.sentence for departure in departures if departure.refuses]
    if refusing:
        chosen, refusal = None, refusing[0]
    result = _refused(refusal, level, peaks=seen.peaks)
    offset = scattered.decay.values["zero_offset"] if scattered.decay is not None else 0.0
    result = replace(
        result,
        estimates=(*others, scattered.estimate),
        history=scattered.fitted,
        departures=departures,
        zero_offset=offset,
    )
    return _with_value(result, chosen)


def _with_value(result: Restitution, chosen: Estimate | None) -> Restitution:
    if chosen is None:
        return result
    return replace(
        result,
        value=chosen.value,
        low=chosen.low,
        high=chosen.high,
        standard_error=chosen.standard_error,
        method=METHODS[chosen.name],
        recommended=chosen.name,
        reason="",
    )


def _linear(
    samples: Samples,
    arcs: Arcs,
    block: Block,
    nonlinear: HistoryFit,
    lowpass: float | None,
    common: dict[str, Any],
) -> HistoryFit:
    """Fit the linear model, with the low-pass that the nonlinear one found."""
    found = lowpass if nonlinear.fitted is None else nonlinear.fitted.cutoff_hz or np.inf
    return fit_history(samples, arcs, block, model="linear", lowpass=found, **common)


@dataclass(frozen=True)
class _Excursions:
    """Arcs of a record, α of their sides, which are usable, the lowest level (rad), the noise (rad)."""

    arcs: Arcs
    critical: Array
    usable: NDArray[np.bool_]
    lowest: float
    noise: float

    def shifted(self, offset: float, samples: Samples, block: Block) -> _Excursions:
        """Return the same arcs about another zero."""
        impacts = np.append(self.arcs.start, self.arcs.end[-1:])
        arcs = arcs_between(impacts, samples.time, samples.angle - offset, block.p, critical=block.critical_angle)
        return _sorted(arcs, self.lowest, self.noise, block)

    @property
    def peaks(self) -> Peaks:
        """As seen, without a fit."""
        arcs = self.arcs
        unfitted = np.full(arcs.peak_angle.shape, np.nan)
        return Peaks(arcs.peak_time, arcs.peak_angle, arcs.peak_standard_error, unfitted, self.usable)


def _excursions(samples: Samples, block: Block, lowest_amplitude: float, noise: float | None) -> _Excursions:
    """Find the arcs in the averaged record, and fit them in the record itself."""
    step = samples.interval or float(np.median(np.diff(samples.time)))
    length = max(int(SMOOTHED / (block.p * step)), 1)
    smooth = _averaged(samples.angle, length)
    sampled = smooth[::length]
    scatter = noise_level(sampled[np.isfinite(sampled)]) if noise is None else noise
    lowest = max(lowest_amplitude * block.critical_angle, NOISE_MARGIN * scatter)
    impacts = find_impacts(samples.time, smooth, lowest=lowest)
    arcs = arcs_between(impacts, samples.time, samples.angle, block.p, critical=block.critical_angle)
    return _sorted(arcs, lowest, scatter, block)


def _sorted(arcs: Arcs, lowest: float, noise: float, block: Block) -> _Excursions:
    critical = np.where(arcs.peak_angle < 0, block.negative.critical_angle, block.positive.critical_angle)
    size = np.abs(arcs.peak_angle)
    usable = np.isfinite(arcs.peak_standard_error) & (size > lowest) & (size < critical)
    return _Excursions(arcs, critical, usable, lowest, noise)


def _averaged(angle: Array, length: int) -> Array:
    """Mean over `length` samples (made odd) about each; NaN where one is missing, and as recorded at the ends."""
    half = length // 2
    if half == 0 or angle.size <= 2 * half:
        return angle
    windows = np.lib.stride_tricks.sliding_window_view(angle, 2 * half + 1)
    return np.concatenate((angle[:half], windows.mean(axis=1), angle[-half:]))


def _end_of_row(covariance: Array, first: int) -> int:
    """End of the stretch of impacts, from the first on, that all have a time with an error."""
    missing = np.flatnonzero(~np.isfinite(np.diag(covariance)[first:]))
    return first + int(missing[0]) if missing.size else covariance.shape[0]


def _refused(reason: str, level: float, *, peaks: Peaks | None = None) -> Restitution:
    estimates = tuple(
        Estimate(name, None, None, None, None, level, assumptions, f"There is no value to start from: {reason}")
        for name, assumptions in ASSUMPTIONS.items()
    )
    return Restitution(None, None, None, None, level, RULE, reason, peaks=peaks or Peaks(), estimates=estimates)
