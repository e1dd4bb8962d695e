"""
One arc of a rocking block, in closed form or by series: to its impact, or as far as it goes.

Between two points of an arc the height is passed over where a bound on its higher derivatives excludes an impact, and
solved for where it shows that there is exactly one; the rest is halved.
"""

from __future__ import annotations

import numpy as np

from colonnade.dynamics.kernel import kernel_in_place
from colonnade.dynamics.plane.series import (
    Jet,
    Push,
    Series,
    Wave,
    closed_arc,
    closed_bounds,
    closed_jet,
    series_arc,
    series_bounds,
    series_jet,
)

SHORTEST_STEP = 1e-7
"""In x: events closer than this are not separated."""

FRESH = 1e-4
"""In x: the beginning of an arc after uplift, where rounding could feign a landing; it rises 1e-9 α."""

LANDING, SUMMIT, PASSING = np.int64(0), np.int64(1), np.int64(-1)
"""
What is searched on an arc: where h falls to 0, where it is largest, where it passes α outwards.

Of Python's own numbers numba would compile the search once for each.
"""

LARGEST_SINE = 1.6
"""What multiplies the weight is at most sin u ≤ 1, or |u| ≤ π/2 in the linearised equation up to where a block lies."""

Arc = tuple[Wave, int]
"""In closed form, or the number of terms of its series."""

NO_WAVE = Wave(*[0.0] * len(Wave._fields))


@kernel_in_place
def verdict(width: float, start: Jet, end: Jet, fourth: float, fifth: float) -> int:
    """
    Tell what happens between two points, the first at h ≥ 0; the bounds are those of |h''''| and |h'''''| in between.

    Returns 1 where there is no impact, −1 where h falls to 0 exactly once, 0 where the bounds do not decide.
    """
    eighth = 0.125 * width * width
    # A function is above the lower of its ends less width²/8 of what its second derivative is at most.
    most = max(start[2], end[2]) + eighth * fourth
    if end[0] < 0.0:
        steepest = max(abs(start[3]), abs(end[3])) + eighth * fifth
        return -1 if most < 0.0 or max(start[1], end[1]) + eighth * steepest < 0.0 else 0
    if most <= 0.0 or min(start[0], end[0]) > eighth * most:
        return 1
    # From the start: h ≥ h0 + h0' x + h0'' x²/2 + L x³/6 with L ≤ h''' throughout.
    if start[1] < 0.0:
        return 0
    least = min(start[3], end[3]) - eighth * fifth
    if least > 0.0 and (start[2] >= 0.0 or (start[0] == 0.0 and start[1] == 0.0 and start[2] > -1e-9)):
        return 1
    return 1 if start[1] + 0.5 * start[2] * width + min(least, 0.0) * width * width / 6.0 > 0.0 else 0


@kernel_in_place
def follow(
    height: float, rate: float, critical: float, push: Push, remaining: float, is_top_wanted: bool, work: Series | None
) -> tuple[bool, float, float, float, float, float, float, float]:
    """
    Follow an arc from h (rad) and h' = dh/dx: to its end, over all that remains (in x), or up to the impact; in closed
    form without `work`.

    Returns whether the step ends in an impact; its length in x; h and h' at its end; the largest height at its end or,
    if wanted, inside; where in x it passes α outwards, NaN if it is not above α at the end, or was before; in closed
    form, sin φ and cos φ at its end.
    """
    wave, terms = NO_WAVE, 0
    if work is None:
        wave, start, end = closed_arc(height, rate, critical, push, remaining)
    else:
        terms, start, end = series_arc(height, rate, critical, push, remaining, work)
    arc = wave, terms
    last = _jet(end, arc, work)
    landed, x, top = False, end, last[0]
    # A chord is above a curve by at most x²/8 times the largest second derivative: most steps of a record need no more.
    largest = LARGEST_SINE * (push.weight + abs(push.lift) * end) + abs(push.q) + abs(push.change) * end
    if work is None or is_top_wanted or not min(start[0], last[0]) > 0.125 * largest * end * end:
        landed, x, last, top = _to_landing(start, end, last, is_top_wanted, arc, work)
    passing = np.nan
    if last[0] > critical and not height > critical:
        passing = _root(0.0, x, start, last, PASSING, critical, arc, work)[0]
    return landed, x, last[0], last[1], top, passing, last[6], last[7]


@kernel_in_place
def _jet(x: float, arc: Arc, work: Series | None) -> Jet:
    if work is None:
        return closed_jet(x, arc[0])
    return series_jet(x, arc[1], work.height)


@kernel_in_place
def _bounds(end: float, arc: Arc, work: Series | None) -> tuple[float, float]:
    if work is None:
        return closed_bounds(end, arc[0])
    return series_bounds(end, arc[1], work.height)


@kernel_in_place
def _to_landing(
    start: Jet, end: float, whole: Jet, is_top_wanted: bool, arc: Arc, work: Series | None
) -> tuple[bool, float, Jet, float]:
    """Find the first x in [0, end] where h falls to 0: whether it does, that x or the end, the state, and the top."""
    if start[0] <= 0.0 and start[1] < 0.0:
        return True, 0.0, start, start[0]
    fresh, left, top = start[0] == 0.0 and start[1] == 0.0, 0.0, 0.0
    fourth, fifth = _bounds(end, arc, work)
    while left < end:
        width, last = end - left, whole
        while True:
            told = verdict(width, start, last, fourth + max(start[4], last[4]), fifth + max(start[5], last[5]))
            if told != 0 or width <= SHORTEST_STEP or (fresh and left + width <= FRESH):
                break
            width *= 0.5
            last = _jet(left + width, arc, work)
        right = end if width == end - left else left + width
        landed = last[0] < 0.0
        if landed:
            if start[0] > 0.0 or width > SHORTEST_STEP:
                right, last = _root(left, right, start, last, LANDING, 0.0, arc, work)
            last = (0.0, last[1], last[2], last[3], last[4], last[5], last[6], last[7])
        top = max(top, last[0])
        if is_top_wanted and start[1] >= 0.0 and last[1] < 0.0:
            top = max(top, _root(left, right, start, last, SUMMIT, 0.0, arc, work)[1][0])
        if landed:
            return True, right, last, top
        left, start = right, last
    return False, end, start, top


@kernel_in_place
def _root(
    low: float, high: float, first: Jet, last: Jet, kind: np.int64, target: float, arc: Arc, work: Series | None
) -> tuple[float, Jet]:
    """
    Find the one x in [low, high] where what is searched is, and the state there.

    Steps of fourth order (Householder) inside a shrinking bracket, from the nearer end that falls.
    """
    x, jet, tried = high, last, 0
    if 0.0 < _searched(first, kind, target)[0] < -_searched(last, kind, target)[0] and (
        _searched(first, kind, target)[1] < 0.0
    ):
        x, jet = low, first
    while True:
        value, slope, bend, twist = _searched(jet, kind, target)
        low, high = (x, high) if value > 0.0 else (low, x)
        below = 6.0 * slope * slope * slope - 6.0 * value * slope * bend + value * value * twist
        step = -value * (6.0 * slope * slope - 3.0 * value * bend) / below if below != 0.0 else high - low
        tried += 1
        if not low <= x + step <= high or tried > 8:
            step = 0.5 * (low + high) - x
        # Where it comes down almost without speed, steps shrink slowly: the slope must hold over the last one.
        is_last = abs(step) * (1.0 + arc[0].ratio) <= 1e-5 and abs(step * bend) <= 1e-2 * abs(slope)
        if is_last or tried > 60:
            h, rate, bend, twist, fourth, fifth, sine, cosine = jet
            turn = arc[0].ratio * step
            there = (
                h + step * (rate + 0.5 * step * bend),
                rate + step * (bend + 0.5 * step * twist),
                bend + step * twist,
            )
            sine, cosine = sine + turn * (cosine - 0.5 * turn * sine), cosine - turn * (sine + 0.5 * turn * cosine)
            return x + step, (*there, twist, fourth, fifth, sine, cosine)
        x += step
        jet = _jet(x, arc, work)


@kernel_in_place
def _searched(jet: Jet, kind: np.int64, target: float) -> tuple[float, float, float, float]:
    """Give what falls through 0 where something is, and its derivatives as far as they are known."""
    if kind == SUMMIT:
        return jet[1], jet[2], jet[3], 0.0
    sign = 1.0 if kind == LANDING else -1.0
    return sign * (jet[0] - target), sign * jet[1], sign * jet[2], sign * jet[3]
