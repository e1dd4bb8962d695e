"""Three-dimensional rocking: rotation out of the plane, or what it leaves in the first, large cycles."""

from __future__ import annotations

import numpy as np

from colonnade.arrays import Array
from colonnade.identification.restitution.arcs.arcs import noise_level
from colonnade.identification.restitution.arcs.series import ArcSeries
from colonnade.identification.restitution.departures.two_sides import sides_problem
from colonnade.identification.restitution.fitting.random_walk_fit import RandomWalkFit
from colonnade.identification.restitution.result import Departure
from colonnade.units import format_percent

NAME = "three-dimensional rocking"

LARGEST_SHARE = 0.1
"""Of |θ|, up to which a rotation out of the plane is let pass."""

NOISE_MARGIN = 5.0
"""Standard deviations of the noise from which on a rotation is one."""

FEWEST_LATER = 6
"""Arcs that are left to compare the first ones with."""

SURE = 4.5
"""Standard errors from which on the first arcs differ; several numbers of them are tried."""

LEAST_LOSS = 0.15
"""Share of 1 − e by which the first impacts lose more."""

LEAST_PERIOD = 0.02
"""Share of their duration by which the first arcs differ."""

BETTER = 6.0
"""By how much −2 ln likelihood of a step is to be better than that of an e that depends on the speed of the impact."""


def out_of_plane_share(time: Array, out_of_plane: Array, series: ArcSeries) -> Departure | None:
    """
    Compare a measured rotation out of the plane with the rocking angle.

    Parameters
    ----------
    time, out_of_plane : ndarray, shape (m,)
        s, rad.
    series : ArcSeries

    Returns
    -------
    departure : Departure or None
        Its size is the largest share of |θ|. Threshold: within an arc the rotation is, from its median over the record,
        more than `LARGEST_SHARE` of the arc's peak and more than `NOISE_MARGIN` of noise. The arcs up to the last such
        one are left out; it refuses where fewer than `FEWEST_LATER` remain.
    """
    finite = np.isfinite(out_of_plane)
    if not finite.any():
        return None
    time, values = time[finite], out_of_plane[finite] - np.median(out_of_plane[finite])
    noise = noise_level(values)
    amplitude = np.full(series.number.size, np.nan)
    for index, (start, end) in enumerate(zip(series.start, series.end, strict=True)):
        inside = values[slice(*np.searchsorted(time, (start, end)))]
        if inside.size:
            amplitude[index] = np.abs(inside).max()
    share = amplitude / series.peak
    large = (share > LARGEST_SHARE) & (amplitude > NOISE_MARGIN * noise)
    if not large.any():
        return None
    last, largest = int(np.flatnonzero(large)[-1]), int(np.nanargmax(np.where(large, share, np.nan)))
    size, error = float(share[largest]), float(noise / series.peak[largest])
    return _named(
        series,
        last + 1,
        size,
        error,
        f"The block turns out of its plane by up to {format_percent(size)} of the rocking angle "
        f"(± {format_percent(error, 1)}, measured); more than {format_percent(LARGEST_SHARE)}",
    )


def signature(series: ArcSeries) -> Departure | None:
    """
    Look for first cycles that lose more, or last otherwise, than those that follow.

    Parameters
    ----------
    series : ArcSeries

    Returns
    -------
    departure : Departure or None
        Its size is e of the later impacts less that of the first ones where these lose more; else the relative
        difference of the first arcs' durations. Threshold: `SURE` standard errors by Student's t, `LEAST_LOSS` or
        `LEAST_PERIOD`, and a step that explains the record better (by `BETTER`) than an e that depends on the speed of
        the impact: that is a property of the block. It leaves the first arcs out.
    """
    most = min(series.number.size - FEWEST_LATER, series.number.size // 2)
    if most < 2:
        return None
    problem = sides_problem(series)
    impacts = (series.number - series.number[0]).astype(np.float64)
    counts = np.arange(2, most + 1)
    nothing = np.zeros((series.number.size, counts.size))
    losing = np.vstack((np.minimum.outer(impacts, impacts[counts]), nothing))
    lasting = np.vstack((nothing, np.less.outer(impacts, impacts[counts])))
    by_speed = np.cumsum(np.concatenate(([0.0], series.speed[:-1] * np.diff(series.number))))
    gains = problem.gains(np.column_stack((losing, np.concatenate((by_speed, nothing[:, 0])))))
    best = int(np.argmax(gains[:-1]))
    if gains[best] > gains[-1] + BETTER:
        departure = _extra_loss(series, problem.fit(losing[:, best]), int(counts[best]))
        if departure is not None:
            return departure
    best = int(np.argmax(problem.gains(lasting)))
    return _other_durations(series, problem.fit(lasting[:, best]), int(counts[best]))


def _extra_loss(series: ArcSeries, fit: RandomWalkFit, count: int) -> Departure | None:
    later = float(np.exp(fit.coefficients[1] / 2))
    first = later * float(np.exp(fit.coefficients[-1] / 2))
    error = first * fit.error(-1) / 2
    if not fit.is_sure(-1, SURE) or later - first < LEAST_LOSS * abs(1 - later):
        return None
    return _named(
        series,
        count,
        later - first,
        error,
        f"The first {count} impacts lose more than the later ones: e is {first:.4f} for them and {later:.4f} later, "
        f"{later - first:.4f} ± {error:.4f} apart, in a step and not gradually with the speed of impact, as large "
        "cycles that turn out of the plane do",
    )


def _other_durations(series: ArcSeries, fit: RandomWalkFit, count: int) -> Departure | None:
    if not fit.is_sure(-1, SURE) or abs(fit.coefficients[-1]) < LEAST_PERIOD:
        return None
    size, error = float(fit.coefficients[-1]), fit.error(-1)
    return _named(
        series,
        count,
        size,
        error,
        f"The first {count} arcs last {format_percent(abs(size), 1)} ± {format_percent(error, 1)} "
        f"{'longer' if size > 0 else 'shorter'} than later "
        "ones do at their peaks, as large cycles that turn out of the plane do",
    )


def _named(series: ArcSeries, count: int, size: float, error: float, finding: str) -> Departure:
    """Leave the first `count` arcs of a series out, and say so."""
    total = series.number.size
    first = f"the first {f'{count} ' if count > 1 else ''}of {total} arcs"
    left_out = int(series.number[count - 1]) + 1
    refuses = total - count < FEWEST_LATER
    if refuses:
        end = f"; too few are left without {first}."
    else:
        largest = float((series.peak / series.critical)[count:].max())
        end = f"; left out: {first}, above {largest:.2g} α."
    return Departure(NAME, size, error, "1", finding + end, left_out, refuses)
