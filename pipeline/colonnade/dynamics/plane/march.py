"""A block through a base motion, part by part and arc by arc: a record has a part for each sample, a sine three."""

from __future__ import annotations

from math import atan, cos, pi, sin, tan
from typing import NamedTuple

import numpy as np

from colonnade.arrays import Array, Codes
from colonnade.dynamics.kernel import kernel, kernel_in_place
from colonnade.dynamics.plane.arc import Push, Series, empty_series, follow
from colonnade.dynamics.plane.run import OVERTURNS, ROCKS, STANDS, Forcing
from colonnade.dynamics.plane.sides import (
    LONGEST_SAMPLE,
    Part,
    Sides,
    of_side,
    pass_over,
    rebound,
    stay,
    survives_free_rocking,
    uplift,
    whole_sample,
)

FIRST_ROOM = 256
"""Impacts kept of a run at first."""


class Watch(NamedTuple):
    """
    What is wanted of a run.

    Attributes
    ----------
    since : int
        Knot from which on peaks count.
    floor : float
        |θ|/α above which peaks need not be exact.
    angles, velocities : ndarray, shape (n,)
        Filled with θ (rad) and ω (rad/s) at the knots; empty if not wanted. The first are the initial ones. A block
        past return lies at ±π/2 in the end.
    impacts : ndarray, shape (m, 2)
        Filled with time (s) and angular velocity before (rad/s) of the first m impacts.
    """

    since: int
    floor: float
    angles: Array
    velocities: Array
    impacts: Array


class End(NamedTuple):
    """
    How a run ends.

    `time` (s) is when |θ| passed α for good, under the motion or left to itself where that ends; NaN if the block
    stands. `peak` is the largest |θ|/α that counts, up to where it cannot come back; `impacts` is their number.
    """

    time: float
    peak: float
    impacts: int


@kernel_in_place
def march(
    forcing: Forcing, sides: Sides, angle: float, velocity: float, watch: Watch, work: Series | None
) -> tuple[float, float, int]:
    """
    Run a block from θ (rad) and ω (rad/s) through a motion, in closed form without `work`, else by series.

    Returns the fields of an `End`: as such, numba would take 3 µs to hand it over, a sixteenth of a history.
    """
    omega, phase, interval, times, levels, weights = forcing
    since, floor, angles, velocities, impacts = watch
    linearised = True if work is None else work.is_linearised
    (left, right), p = sides.critical, sides.p
    thresholds = (left, right) if linearised else (tan(left), tan(right))
    # In closed form, samples of a record in which nothing happens are passed over at once.
    is_kept = angles.size > 0
    is_quick = work is None and times.size == 0 and is_kept
    largest = _largest(levels)
    whole = whole_sample(-1.0, left, p[0], interval, largest), whole_sample(1.0, right, p[1], interval, largest)
    most = largest if weights.size == 0 else np.inf
    past = most if linearised else atan(most)

    here = 1 if angle > 0.0 or (angle == 0.0 and velocity > 0.0) else 0
    side = 2.0 * here - 1.0
    height, rate, is_resting = abs(angle), side * velocity / of_side(p, here), angle == 0.0 and velocity == 0.0
    passed = 0.0 if height > of_side(sides.critical, here) else np.nan
    is_past, peak, count, knot, now = False, 0.0, 0, 0, 0.0
    while knot < levels.size - 1 and height < 0.5 * pi and (is_kept or not is_past):
        if is_quick:
            reached = knot
            if is_resting:
                reached = stay(levels, knot, thresholds)
            elif whole[here].step < LONGEST_SAMPLE:
                reached = pass_over(angles, velocities, levels, knot, whole[here])
            if reached > knot:
                knot = reached
                height, rate = side * angles[knot], side * velocities[knot] / of_side(p, here)
                continue
        begin, part = _part(knot, omega, phase, interval, times, levels, weights)
        now = 0.0
        sine, cosine = _turned(part, now)
        while now < part.length:
            # At rest, up to the uplift.
            if is_resting:
                now, here = uplift(now, part, thresholds)
                if now >= part.length:
                    break
                is_resting, side = False, 2.0 * here - 1.0
                sine, cosine = _turned(part, now)

            # One arc, as far as it goes.
            critical, quickness = of_side(sides.critical, here), of_side(p, here)
            q, slowness = side * (part.level + part.slope * now), 1.0 / quickness
            change, lift = side * part.slope * slowness, part.lift * slowness
            push = Push(q, change, part.weight + part.lift * now, lift, omega * slowness, sine, cosine)
            remaining = quickness * (part.length - now)
            is_watched = knot >= since and not is_past
            is_top_wanted = is_watched and peak <= floor
            landed, x, height, rate, top, passing, sine, cosine = follow(
                height, rate, critical, push, remaining, is_top_wanted, work
            )
            if is_watched:
                peak = max(peak, top / critical)
            if passing == passing:
                passed = begin + now + passing / quickness
            now = part.length if x == remaining else now + x * slowness

            # The impact: what it leaves, and on which side the block goes on.
            if landed:
                if count < impacts.shape[0]:
                    impacts[count, 0], impacts[count, 1] = begin + now, side * rate * quickness
                count += 1
                pull, weight = (part.level + part.slope * now) * sine, part.weight + part.lift * now
                rate, is_resting = rebound(rate, here, weight, pull, sides, linearised)
                here, side = 1 - here, -side
                continue
            beyond = height - critical
            is_past = is_past or (beyond + rate > past if linearised else beyond > past and rate > 0.0)
            is_past = is_past or height >= 0.5 * pi
            if is_past and (height >= 0.5 * pi or not is_kept):
                break
        knot += 1
        if is_kept:
            angles[knot], velocities[knot] = side * height, side * rate * of_side(p, here)
    if is_kept and height >= 0.5 * pi:
        angles[knot:] = side * 0.5 * pi
        velocities[knot:] = 0.0
    if is_resting or not (is_past or not survives_free_rocking(height, rate, here, sides, linearised)):
        return np.nan, peak, count
    end = interval * (levels.size - 1) if times.size == 0 else times[-1]
    return passed if height > of_side(sides.critical, here) else end, peak, count


@kernel_in_place
def _largest(values: Array) -> float:
    """Largest magnitude: even and odd places apart, as each maximum waits for the one before."""
    even, odd = 0.0, float(abs(values[-1]))
    for k in range(0, values.size - 1, 2):
        even, odd = max(even, abs(values[k])), max(odd, abs(values[k + 1]))
    return max(even, odd)


@kernel_in_place
def _part(
    knot: int, omega: float, phase: float, interval: float, times: Array, levels: Array, weights: Array
) -> tuple[float, Part]:
    """Give when the part after a knot begins, s, and the part."""
    begin, length = interval * knot, interval
    if times.size > 0:
        begin, length = times[knot], times[knot + 1] - times[knot]
    weight, lift = 1.0, 0.0
    if weights.size > 0:
        weight, lift = weights[knot], (weights[knot + 1] - weights[knot]) / length
    slope = (levels[knot + 1] - levels[knot]) / length if length > 0.0 else 0.0
    return begin, Part(length, levels[knot], slope, weight, lift, omega, omega * begin + phase)


@kernel_in_place
def _turned(part: Part, now: float) -> tuple[float, float]:
    """Sine and cosine of the motion's phase."""
    if part.omega == 0.0:
        return 1.0, 0.0
    angle = part.omega * now + part.phase
    return sin(angle), cos(angle)


@kernel
def column(
    forcing: Forcing, scales: Array, sides: Sides, no_rocking: float, work: Series | None
) -> tuple[Codes, Array]:
    """
    Outcomes from rest under many multiples of a motion, as `OUTCOMES`, and the largest |θ|/α, NaN where it overturns.

    The block rocks where that is above `no_rocking`. Under a record it is the largest at the samples; under another
    motion it is exact up to `no_rocking` only.
    """
    omega, phase, interval, times, levels, weights = forcing
    outcomes, peaks, (left, right) = np.empty(scales.size, dtype=np.int8), np.empty(scales.size), sides.critical
    # Of a record the angles are kept, so that quiet samples are passed over.
    is_record = times.size == 0
    for index in range(scales.size):
        angles, velocities = np.zeros((2, levels.size if is_record else 0))
        watch = Watch(levels.size if is_record else 0, no_rocking, angles, velocities, np.empty((0, 2)))
        scaled = Forcing(omega, phase, interval, times, scales[index] * levels, weights)
        time, peak, _count = march(scaled, sides, 0.0, 0.0, watch, work)
        if is_record:
            peak = max(-angles.min() / left, angles.max() / right)
        outcomes[index] = OVERTURNS if time == time else ROCKS if peak > no_rocking else STANDS
        peaks[index] = np.nan if time == time else peak
    return outcomes, peaks


def propagate(
    forcing: Forcing,
    sides: Sides,
    *,
    is_linearised: bool,
    angle: float = 0.0,
    velocity: float = 0.0,
    since: int | None = None,
    floor: float = 0.0,
) -> tuple[Array, Array, Array, Array, End]:
    """
    Run a block from θ (rad) and ω (rad/s) through a motion, keeping what it does: θ and ω at the knots; times (s) of
    impacts and ω just before each; its `End`. A block past return lies at ±π/2 in the end.

    The equation that is linear in θ is solved in closed form where the base moves along x only. `since` and `floor` as
    of `Watch`; without `since` no peaks count.
    """
    work = None if is_linearised and forcing.weights.size == 0 else empty_series(is_linearised)
    knots = forcing.levels.size
    angles, velocities, impacts = np.zeros(knots), np.zeros(knots), np.empty((FIRST_ROOM, 2))
    angles[0], velocities[0] = angle, velocity
    while True:
        watch = Watch(knots if since is None else since, floor, angles, velocities, impacts)
        end = End(*march(forcing, sides, angle, velocity, watch, work))
        if end.impacts <= len(impacts):
            times, before = impacts[: end.impacts].T.copy()
            return angles, velocities, times, before, end
        impacts = np.empty((end.impacts, 2))
