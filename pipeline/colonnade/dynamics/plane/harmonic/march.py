"""A block from rest through a harmonic base motion, arc by arc: in closed form, or by series of the full equation."""

from __future__ import annotations

from math import atan, cos, pi, sin
from typing import NamedTuple

import numpy as np

from colonnade.arrays import Array, Codes
from colonnade.dynamics.kernel import kernel
from colonnade.dynamics.plane.harmonic.linear import State, closed_arc
from colonnade.dynamics.plane.harmonic.nonlinear import Series, series_arc
from colonnade.dynamics.plane.impact import comes_to_rest, holding_moment, restitution_of, survives_free_rocking
from colonnade.dynamics.plane.sides import Pair, Sides, of_side
from colonnade.dynamics.plane.uplift import Piece, harmonic_uplift, level_at, uplift_threshold

Triple = tuple[float, float, float]

NO_ROCKING, ROCKING, OVERTURNED = 0, 1, 2
"""Codes of outcomes."""


class Watch(NamedTuple):
    """
    What is wanted of a run.

    Attributes
    ----------
    since : float
        s, from when on peaks count.
    floor : float
        |θ|/α above which peaks need not be exact.
    interval : float
        s, of the samples.
    samples : ndarray, shape (n, 2)
        Filled with θ (rad) and ω (rad/s) from time 0 on; a block past return lies at ±π/2 in the end.
    impacts : ndarray, shape (m, 2)
        Filled with time (s) and angular velocity before (rad/s) of the first m impacts.
    """

    since: float
    floor: float
    interval: float
    samples: Array
    impacts: Array


class Part(NamedTuple):
    """A part of the motion of one envelope: from when to when (s), its envelope, and whether it is the fall."""

    begin: float
    end: float
    piece: Piece
    is_fall: bool


class March(NamedTuple):
    """
    Where a block is on its way.

    `height` and `rate` are h = s θ and dh/dx; `peak` is the largest |θ|/α that counts, `impact_count` that of impacts,
    `taken` that of samples; `is_past` says that it cannot come back, `has_ended` that nothing is left to follow.
    """

    height: float
    rate: float
    side: float
    is_resting: bool
    is_past: bool
    has_ended: bool
    peak: float
    impact_count: int
    taken: int


@kernel
def run(
    forcing: Triple,
    edges: Array,
    sides: Sides,
    watch: Watch,
    work: Series | None,
) -> tuple[bool, float, int]:
    """
    Run the block from rest under a/g = l(t) sin(ω t + ψ), l rising to `level`, constant, and falling to 0.

    Parameters
    ----------
    forcing : tuple of float
        ω, rad/s; ψ, rad; largest a/g.
    edges : ndarray, shape (3,)
        s: end of the rise, of the constant level and of the fall; equal ones leave a part out.
    sides : Sides
    watch : Watch
    work : Series or None
        Of the full equation; None for the linear one, in closed form.

    Returns
    -------
    overturned : bool
        Left to itself where the motion ends.
    peak, count : float, int
        Largest |θ|/α under the motion up to overturning, where `watch` counts it; number of impacts.
    """
    watch.samples[:] = 0.0
    march = March(0.0, 0.0, 1.0, True, False, False, 0.0, 0, 0)
    begin, reached = 0.0, 0.0
    for number in range(3):
        beginning = forcing[2] if number == 1 else reached
        reached = forcing[2] if number < 2 else 0.0
        if edges[number] > begin:
            piece = (beginning, (reached - beginning) / (edges[number] - begin))
            part = Part(begin, edges[number], piece, number == 2)
            march = _through(march, part, forcing, sides, watch, work)
            begin = edges[number]
        if march.has_ended:
            break
    if march.is_resting or march.is_past:
        return march.is_past, march.peak, march.impact_count
    here = 1 if march.side > 0.0 else 0
    stands = survives_free_rocking(march.height, march.rate, here, sides, work is None)
    return not stands, march.peak, march.impact_count


@kernel
def _through(march: March, part: Part, forcing: Triple, sides: Sides, watch: Watch, work: Series | None) -> March:
    """Follow the block to the end of a part; arguments as for `run`."""
    height, rate, side, is_resting, is_past, has_ended, peak, count, taken = march
    here, now, linearised = 1 if side > 0.0 else 0, part.begin, work is None
    state = _phased(height, rate, forcing, now)
    while now < part.end and not has_ended:
        # At rest, up to the uplift; samples of that time stay zero.
        if is_resting:
            now, side = _uplift(now, part, forcing, sides.critical, linearised)
            while taken < watch.samples.shape[0] and taken * watch.interval <= min(now, part.end):
                taken += 1
            if side == 0.0:
                break
            is_resting, here = False, 1 if side > 0.0 else 0
            state = _phased(0.0, 0.0, forcing, now)

        # One step: as far as the model's own arc goes, to the next sample or to the impact.
        stop = min(part.end, taken * watch.interval) if taken < watch.samples.shape[0] else part.end
        begun, remaining = now, of_side(sides.p, here) * (stop - now)
        is_watched = now >= watch.since and not is_past
        is_top_wanted = is_watched and peak <= watch.floor
        landed, x, top, state = _arc(state, side, sides, forcing, now, part, remaining, is_top_wanted, work)
        if is_watched:
            peak = max(peak, top / of_side(sides.critical, here))
        now = stop if x == remaining else now + x / of_side(sides.p, here)

        # The impact: what it leaves, and on which side the block goes on.
        if landed:
            if count < watch.impacts.shape[0]:
                watch.impacts[count, 0], watch.impacts[count, 1] = now, side * state[1] * of_side(sides.p, here)
            count += 1
            sine = state[2] if linearised else sin(forcing[0] * now + forcing[1])
            pull = level_at(part.piece, now - part.begin) * sine
            rate, is_resting = _rebound(state[1], here, pull, sides, linearised)
            side, here, state = -side, 1 - here, (0.0, rate, state[2], state[3])
            continue

        # Past return, only its samples are left to be followed, until it lies.
        most = level_at(part.piece, begun - part.begin) if part.is_fall else forcing[2]
        is_past = is_past or _never_returns(state[0] - of_side(sides.critical, here), state[1], most, linearised)
        has_ended = is_past and (taken >= watch.samples.shape[0] or state[0] >= 0.5 * pi)
        if has_ended:
            watch.samples[taken:, 0] = side * 0.5 * pi
        elif taken < watch.samples.shape[0] and now >= taken * watch.interval:
            watch.samples[taken, 0], watch.samples[taken, 1] = side * state[0], side * state[1] * of_side(sides.p, here)
            taken += 1
    return March(state[0], state[1], side, is_resting, is_past, has_ended, peak, count, taken)


@kernel
def _phased(height: float, rate: float, forcing: Triple, now: float) -> State:
    """Put a height and its rate together with the sine and cosine of the motion's phase."""
    angle = forcing[0] * now + forcing[1]
    return height, rate, sin(angle), cos(angle)


@kernel
def _uplift(now: float, part: Part, forcing: Triple, critical: Pair, linearised: bool) -> tuple[float, float]:
    """Find when a block at rest uplifts before the end of a part, and to which side; (inf, 0) where it stays."""
    negative, positive = uplift_threshold(critical[0], linearised), uplift_threshold(critical[1], linearised)
    return harmonic_uplift(now, part.end, part.begin, forcing[0], forcing[1], part.piece, negative, positive)


@kernel
def _arc(
    state: State,
    side: float,
    sides: Sides,
    forcing: Triple,
    now: float,
    part: Part,
    remaining: float,
    is_top_wanted: bool,
    work: Series | None,
) -> tuple[bool, float, float, State]:
    """Follow an arc by the model's own kernel; results as for `closed_arc`."""
    here, level, slope = 1 if side > 0.0 else 0, level_at(part.piece, now - part.begin), part.piece[1]
    critical, p, omega = of_side(sides.critical, here), of_side(sides.p, here), forcing[0]
    if work is None:
        return closed_arc(state, side, critical, p, omega, level, slope, remaining, is_top_wanted)
    height, rate, sine, cosine = state
    angle = omega * now + forcing[1]
    landed, x, top, height, rate = series_arc(
        height, rate, side, critical, p, omega, angle, level, slope, remaining, is_top_wanted, work
    )
    return landed, x, top, (height, rate, sine, cosine)


@kernel
def _rebound(rate: float, here: int, pull: float, sides: Sides, linearised: bool) -> tuple[float, bool]:
    """Give dh/dx after an impact that ends an arc on side `here`, and whether the block then rests; a/g is `pull`."""
    there, (_, _, restitution, speeds, rest_angle) = 1 - here, sides
    critical, p = of_side(sides.critical, there), of_side(sides.p, here)
    e = restitution_of(restitution, speeds, here, rate * p)
    leaving = max(0.0, -e * rate * p / of_side(sides.p, there))
    holding = holding_moment(critical, 1.0, (2.0 * there - 1.0) * pull, linearised)
    return leaving, comes_to_rest(0.5 * leaving * leaving, critical, holding, rest_angle)


@kernel
def _never_returns(beyond: float, rate: float, most: float, linearised: bool) -> bool:
    """Tell whether a block at h = α + beyond falls whatever comes, the largest |a/g| to come being `most`."""
    return beyond + rate > most if linearised else beyond > atan(most) and rate > 0.0


@kernel
def column(
    omega: float,
    phase: float,
    levels: Array,
    edges: Array,
    sides: Sides,
    no_rocking: float,
    work: Series | None,
) -> Codes:
    """Codes of the outcomes under many levels; the block has not rocked where |θ|/α stays at or below `no_rocking`."""
    outcomes = np.empty(levels.size, dtype=np.int8)
    watch = Watch(0.0, no_rocking, 1.0, np.empty((0, 2)), np.empty((0, 2)))
    for index in range(levels.size):
        forcing = (omega, phase, levels[index])
        overturned, peak, _count = run(forcing, edges, sides, watch, work)
        outcomes[index] = OVERTURNED if overturned else ROCKING if peak > no_rocking else NO_ROCKING
    return outcomes
