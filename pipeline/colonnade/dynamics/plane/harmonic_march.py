"""A block from rest through a harmonic base motion, arc by arc: in closed form, or by series of the full equation."""

from __future__ import annotations

from math import atan, cos, pi, sin
from typing import NamedTuple

import numpy as np

from colonnade.arrays import Array, Codes
from colonnade.dynamics.kernel import kernel
from colonnade.dynamics.plane.envelope import Piece, level_at, piece_between
from colonnade.dynamics.plane.harmonic_linear import closed_arc
from colonnade.dynamics.plane.harmonic_nonlinear import Series, series_arc
from colonnade.dynamics.plane.impact import comes_to_rest, holding_moment, restitution_of, survives_free_rocking
from colonnade.dynamics.plane.uplift import harmonic_uplift, uplift_threshold

Triple = tuple[float, float, float]

NO_ROCKING, ROCKING, OVERTURNED = 0, 1, 2
"""Codes of outcomes."""


class Sides(NamedTuple):
    """
    The block on its sides θ < 0 and θ > 0: α (rad) and p (rad/s), shape (2,); e as of `restitution_of`.

    After an impact whose next arc, under the base acceleration of that instant, would not rise above `rest_angle` α,
    the block is at rest until the base acceleration uplifts it again.
    """

    critical: Array
    p: Array
    restitution: Array
    speeds: Array
    rest_angle: float


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
    smooth: bool | None,
    sides: Sides,
    watch: Triple,
    samples: Array,
    impacts: Array,
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
    smooth : True or None
        Rise and fall are half a cosine; linear with None.
    sides : Sides
    watch : tuple of float
        Time (s) from which peaks count, |θ|/α above which they need not be exact, and interval of samples (s).
    samples : ndarray, shape (n, 2)
        Filled with θ (rad) and ω (rad/s) from time 0 on; a block past return lies at ±π/2 in the end.
    impacts : ndarray, shape (m, 2)
        Filled with time (s) and angular velocity before (rad/s) of the first m impacts.
    work : Series or None
        Of the full equation; None for the linear one, in closed form.

    Returns
    -------
    overturned : bool
        Left to itself where the motion ends.
    peak, count : float, int
        Largest |θ|/α under the motion up to overturning, where `watch` counts it; number of impacts.
    """
    samples[:] = 0.0
    march = March(0.0, 0.0, 1.0, True, False, False, 0.0, 0, 0)
    begin, reached = 0.0, 0.0
    for number in range(3):
        beginning = forcing[2] if number == 1 else reached
        reached = forcing[2] if number < 2 else 0.0
        if edges[number] > begin:
            piece = piece_between(beginning, reached, edges[number] - begin, smooth)
            part = Part(begin, edges[number], piece, number == 2)
            march = _through(march, part, forcing, smooth, sides, watch, samples, impacts, work)
            begin = edges[number]
        if march.has_ended:
            break
    if march.is_resting or march.is_past:
        return march.is_past, march.peak, march.impact_count
    stands = survives_free_rocking(
        march.height,
        march.rate,
        1 if march.side > 0.0 else 0,
        sides.critical,
        sides.p,
        sides.restitution,
        sides.speeds,
        work is None,
    )
    return not stands, march.peak, march.impact_count


@kernel
def _through(
    march: March,
    part: Part,
    forcing: Triple,
    smooth: bool | None,
    sides: Sides,
    watch: Triple,
    samples: Array,
    impacts: Array,
    work: Series | None,
) -> March:
    """Follow the block to the end of a part; arguments as for `run`."""
    height, rate, side, is_resting, is_past, _has_ended, peak, count, taken = march
    (omega, phase, level), (watched, floor, interval) = forcing, watch
    critical, p, piece = sides.critical, sides.p, part.piece
    here, now = 1 if side > 0.0 else 0, part.begin
    sine, cosine = sin(omega * now + phase), cos(omega * now + phase)
    while now < part.end:
        # At rest, up to the uplift; samples of that time stay zero.
        if is_resting:
            negative, positive = (
                uplift_threshold(critical[0], work is None),
                uplift_threshold(critical[1], work is None),
            )
            now, side = harmonic_uplift(now, part.end, part.begin, omega, phase, piece, negative, positive)
            while taken < samples.shape[0] and taken * interval <= min(now, part.end):
                taken += 1
            if side == 0.0:
                break
            is_resting, here, height, rate = False, 1 if side > 0.0 else 0, 0.0, 0.0
            sine, cosine = sin(omega * now + phase), cos(omega * now + phase)

        # One step: as far as the model's own arc goes, to the next sample or to the impact.
        stop = min(part.end, taken * interval) if taken < samples.shape[0] else part.end
        since, remaining = now - part.begin, p[here] * (stop - now)
        is_watched = now >= watched and not is_past
        if work is None:
            landed, x, top, (height, rate, sine, cosine) = closed_arc(
                (height, rate, sine, cosine),
                side,
                critical[here],
                p[here],
                omega,
                piece,
                since,
                smooth,
                remaining,
                is_watched and peak <= floor,
            )
        else:
            landed, x, top, height, rate = series_arc(
                height,
                rate,
                side,
                critical[here],
                p[here],
                omega,
                omega * now + phase,
                piece,
                since,
                smooth,
                remaining,
                is_watched and peak <= floor,
                work,
            )
        if is_watched:
            peak = max(peak, top / critical[here])
        now = stop if x == remaining else now + x / p[here]

        if landed:
            if count < impacts.shape[0]:
                impacts[count, 0], impacts[count, 1] = now, side * rate * p[here]
            count += 1
            phased = sine if work is None else sin(omega * now + phase)
            pull = level_at(piece, now - part.begin)[0] * phased
            there, e = 1 - here, restitution_of(sides.restitution, sides.speeds, here, rate * p[here])
            height, rate = 0.0, max(0.0, -e * rate * p[here] / p[there])
            side, here = -side, there
            holding = holding_moment(critical[here], 1.0, side * pull, work is None)
            is_resting = comes_to_rest(0.5 * rate * rate, critical[here], holding, sides.rest_angle)
            continue
        # Past return, only its samples are left to be followed, until it lies.
        most = level_at(piece, since)[0] if part.is_fall else level
        is_past = is_past or _never_returns(height - critical[here], rate, most, work is None)
        if is_past and (taken >= samples.shape[0] or height >= 0.5 * pi):
            samples[taken:, 0] = side * 0.5 * pi
            return March(height, rate, side, False, True, True, peak, count, taken)
        if taken < samples.shape[0] and now >= taken * interval:
            samples[taken, 0], samples[taken, 1] = side * height, side * rate * p[here]
            taken += 1
    return March(height, rate, side, is_resting, is_past, False, peak, count, taken)


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
    smooth: bool | None,
    sides: Sides,
    no_rocking: float,
    work: Series | None,
) -> Codes:
    """Codes of the outcomes under many levels; the block has not rocked where |θ|/α stays at or below `no_rocking`."""
    outcomes = np.empty(levels.size, dtype=np.int8)
    none, watch = np.empty((0, 2)), (0.0, no_rocking, 1.0)
    for index in range(levels.size):
        forcing = (omega, phase, levels[index])
        overturned, peak, _count = run(forcing, edges, smooth, sides, watch, none, none, work)
        outcomes[index] = OVERTURNED if overturned else ROCKING if peak > no_rocking else NO_ROCKING
    return outcomes
