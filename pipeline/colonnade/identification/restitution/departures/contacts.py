"""Impacts that are not one clean contact: a block that bounces, or slides."""

from __future__ import annotations

import numpy as np

from colonnade.arrays import Array
from colonnade.dynamics.block import Block
from colonnade.identification.restitution.arcs.arcs import noise_level
from colonnade.identification.restitution.arcs.series import ArcSeries
from colonnade.identification.restitution.result import Departure
from colonnade.units import format_percent

NOISE_MARGIN = 5.0
"""Standard errors from which on a slide, an uplift or a pause is one."""

LOW = 0.15
"""Share of an arc's peak below which a block is near upright."""

LONGEST_PAUSE = 0.15
"""Share of the arc that follows, up to which a block may stay near upright longer than it needs to pass."""

LEAST_LIFT = 0.02
"""Share of the half-width by which the base is lifted off both edges in a bounce."""

FRICTION = 0.3
"""Coefficient assumed for the energy of a slide; ..."""

LEAST_WORK = 0.01
"""... a slide of less than this share of the energy lost is let pass, ..."""

LARGEST_WORK = 0.1
"""... and one of more than this share leaves no e of rocking."""

MANIFOLD = 10.0
"""Times the energy lost, from which no percentage is given: a record may lose nearly none."""


def find_sliding(time: Array, angle: Array, slide: Array, block: Block, series: ArcSeries) -> Departure | None:
    """
    Look for jumps of the pole at impacts.

    Parameters
    ----------
    time, angle, slide : ndarray, shape (m,)
        s; rad; displacement of the pole relative to the table, m.
    block : Block
    series : ArcSeries

    Returns
    -------
    departure : Departure or None
        Its size is the sum of the magnitudes of the jumps that stand `NOISE_MARGIN` standard errors out, m. Threshold:
        friction work over the energy lost in all impacts, μ m g Σ|jump| over it with μ = `FRICTION`, is more than
        `LEAST_WORK`; above `LARGEST_WORK` it refuses.

    Notes
    -----
    The slide of an arc is its mean, after what goes with θ on either side was taken off: a transducer that is not quite
    where it is said to be shows rocking as slide.
    """
    level, error = _slide_of_arcs(time, angle, slide, series)
    jumps = np.diff(level)
    errors = np.hypot(error[1:], error[:-1])
    large = np.abs(jumps) > NOISE_MARGIN * errors
    total, total_error = float(np.abs(jumps[large]).sum()), float(np.sqrt((errors[large] ** 2).sum()))
    lost = float(np.exp(series.energy[0]) - np.exp(series.energy[-1])) * block.inertia / 2
    work = FRICTION * block.mass * block.gravity * total / max(lost, 1e-300)
    if not work > LEAST_WORK:
        return None
    refuses = work > LARGEST_WORK
    share = f"{format_percent(work)} of" if work < MANIFOLD else f"more than {MANIFOLD:g} times"
    end = "; too much for an e of rocking alone." if refuses else "; e includes this loss."
    return Departure(
        "sliding",
        total,
        total_error,
        "m",
        f"The block slides at {int(large.sum())} of {jumps.size} impacts, by {1e3 * total:.3g} ± "
        f"{1e3 * total_error:.1g} mm in all ({1e3 * float(jumps[large].sum()):+.3g} mm with its sign): with a friction "
        f"of {FRICTION:g} this is {share} the energy lost" + end,
        refuses=refuses,
    )


def _slide_of_arcs(time: Array, angle: Array, slide: Array, series: ArcSeries) -> tuple[Array, Array]:
    """Mean slide of each arc and its standard error, m, after what is proportional to θ on either side."""
    pieces = [
        np.flatnonzero((time >= start + 0.1 * (end - start)) & (time <= end - 0.1 * (end - start)) & np.isfinite(slide))
        for start, end in zip(series.start, series.end, strict=True)
    ]
    slopes = {-1.0: 0.0, 1.0: 0.0}
    for side in slopes:
        own = [piece for piece, one in zip(pieces, series.side, strict=True) if one == side and piece.size > 2]
        theta = np.concatenate([angle[piece] - angle[piece].mean() for piece in own]) if own else np.zeros(0)
        if float(theta @ theta) > 0:
            moved = np.concatenate([slide[piece] - slide[piece].mean() for piece in own])
            slopes[side] = float(theta @ moved) / float(theta @ theta)
    level, error = np.full(series.number.size, np.nan), np.full(series.number.size, np.nan)
    for index, piece in enumerate(pieces):
        if piece.size < 4:
            continue
        left = slide[piece] - slopes[float(series.side[index])] * angle[piece]
        level[index] = left.mean()
        residual = left - left.mean()
        power = max(float(residual @ residual), 1e-300)
        correlation = min(max(float(residual[1:] @ residual[:-1]) / power, 0.0), 0.98)
        error[index] = np.sqrt(power / piece.size**2 * (1 + correlation) / (1 - correlation))
    return level, error


def find_bouncing(time: Array, angle: Array, uplift: Array | None, block: Block, series: ArcSeries) -> Departure | None:
    """
    Look for impacts with more than one contact.

    Parameters
    ----------
    time, angle : ndarray, shape (m,)
        s; rad.
    uplift : ndarray, shape (m,), or None
        Height of the lowest point of the base, m.
    block : Block
    series : ArcSeries

    Returns
    -------
    departure : Departure or None
        Where the uplift is measured, its size is the largest uplift next to an impact, m; threshold: `LEAST_LIFT` of
        the half-width and `NOISE_MARGIN` of noise. Else, from the angle alone, the longest time for which it stays
        within `LOW` of the next peak beyond what passing takes, s; threshold: `LONGEST_PAUSE` of the arc that follows
        and `NOISE_MARGIN` standard errors. It leaves no arc out: e includes the loss by bouncing.
    """
    if uplift is not None and np.isfinite(uplift).any():
        return _lifted(time, uplift, block, series)
    finite = np.isfinite(angle)
    return _paused(time[finite], angle[finite], series)


def _lifted(time: Array, uplift: Array, block: Block, series: ArcSeries) -> Departure | None:
    noise = noise_level(uplift[np.isfinite(uplift)])
    threshold = max(LEAST_LIFT * block.governing.half_width, NOISE_MARGIN * noise)
    lifts = np.zeros(series.number.size)
    for index, (start, end) in enumerate(zip(series.start, series.end, strict=True)):
        inside = uplift[slice(*np.searchsorted(time, (start, start + 0.4 * (end - start))))]
        lifts[index] = np.nanmax(inside) if np.isfinite(inside).any() else 0.0
    count, size = int((lifts > threshold).sum()), float(lifts.max(initial=0.0))
    if not count:
        return None
    return Departure(
        "bouncing",
        size,
        noise,
        "m",
        f"The base leaves the table after {count} of {series.number.size} impacts, by up to {1e3 * size:.3g} ± "
        f"{1e3 * noise:.1g} mm: the block bounces, and e includes that loss.",
    )


def _paused(time: Array, angle: Array, series: ArcSeries) -> Departure | None:
    noise = noise_level(angle)
    pauses, errors, limits = [], [], []
    speed, duration, steps = series.speed, series.duration, np.diff(time)
    for index in range(1, series.number.size):
        if series.number[index] != series.number[index - 1] + 1:
            continue
        low = LOW * float(series.peak[index])
        middle = (series.start[index - 1] + series.end[index - 1]) / 2, (series.start[index] + series.end[index]) / 2
        inside = slice(*np.searchsorted(time, middle))
        if low < NOISE_MARGIN * noise or inside.stop - inside.start < 8:
            continue
        step = float(np.sort(steps[inside.start : inside.stop - 1])[(inside.stop - inside.start - 1) // 2])
        near = float((np.abs(angle[inside]) < low).sum()) * step
        # Between upright and `low` on either side the speed falls by little; both sides share the mean of the two.
        expected = sum(_passing(series, float(speed[one]), one, low) for one in (index - 1, index))
        pauses.append(near - expected)
        errors.append(float(np.hypot(step, 2 * noise / speed[index])))
        limits.append(LONGEST_PAUSE * float(duration[index]))
    found = np.array(pauses)
    large = (found > np.array(limits)) & (found > NOISE_MARGIN * np.array(errors))
    if not large.any():
        return None
    longest = int(np.argmax(np.where(large, found, -np.inf)))
    size, error = pauses[longest], errors[longest]
    return Departure(
        "bouncing",
        size,
        error,
        "s",
        f"After {int(large.sum())} of {found.size} impacts the angle stays near zero, by up to {1e3 * size:.3g} ± "
        f"{1e3 * error:.1g} ms longer than a single impact takes: there is more than one contact; e includes that "
        "loss.",
    )


def _passing(series: ArcSeries, speed: float, index: int, low: float) -> float:
    """Time from upright to an angle `low` (rad) along an arc, s: ω falls as the block rises."""
    peak, critical = float(series.peak[index]), float(series.critical[index])
    lost = np.sin(critical - low / 2) * np.sin(low / 2) / (np.sin(critical - peak / 2) * np.sin(peak / 2))
    return float(2 * low / (speed * (1 + np.sqrt(max(1 - lost, 0.0)))))
