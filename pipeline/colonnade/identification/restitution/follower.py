"""
Rocking after a release, arc by arc, with its derivatives by all that is unknown.

    θ̈ = −p² [ sin(α − |θ|) + s (a/g) cos(α − |θ|) ] s,  s = sgn θ

by Runge and Kutta's fourth-order method from sample to sample; the derivatives are those of the same steps. An impact
multiplies the angular velocity by e. The base acceleration a is linear between samples, 0 of a table at rest.
"""

from __future__ import annotations

from math import cos, sin
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from colonnade.arrays import Array
from colonnade.dynamics.kernel import kernel

STEP = 0.04
"""Longest step, in p t: errors of 1e-8 α an arc."""

LOCAL = 4
"""Derivatives of the angle by height and speed at the start of its arc, by ln α, and by ln p."""

MEAN, CRITICAL, P, GAIN, TILT, PEAK, TIME, ZERO, DRIFT = range(9)
"""Unknowns: ln of the mean e, of α, of p and of the angle's gain, half the difference of ln α; first peak (rad) and its
time (s); zero (rad) and its drift over the record (rad). From `FIXED` on: departure of ln e of each impact."""

FIXED = DRIFT + 1

Stages = tuple[float, float, float, float]
"""Of a step, one value each."""


class Followed(NamedTuple):
    """
    A rocking history of m arcs at n samples.

    Attributes
    ----------
    angle : ndarray, shape (n,)
        rad; NaN where it was not followed.
    arc : ndarray of int, shape (n,)
        Number of the arc of each sample, −1 where it was not followed.
    local : ndarray, shape (n, 4)
        See `LOCAL`.
    starts : ndarray, shape (m, 2, 9 + m − 1)
        Derivatives of height and speed at each arc's start, at a fixed time, by all unknowns.
    peaks, times, ends : ndarray, shape (m,)
        |θ| of each peak, its time, and that of the impact that ends the arc; NaN from where the block overturns.
    speeds : ndarray, shape (m,)
        Angular velocity before that impact, rad/s.
    """

    angle: Array
    arc: NDArray[np.int64]
    local: Array
    starts: Array
    peaks: Array
    times: Array
    ends: Array
    speeds: Array


@kernel
def _pull(height: float, critical: float, square: float, push: float) -> tuple[float, float]:
    """Acceleration at a height, and its derivative by the height."""
    s, c = sin(critical - height), cos(critical - height)
    return -square * (s + push * c), square * (c - push * s)


@kernel
def _step(
    height: float, speed: float, length: float, critical: float, square: float, first: float, last: float
) -> tuple[float, float, Stages, Stages]:
    """Height and speed after a step with this push at its ends; accelerations of its stages, and their derivatives."""
    middle = 0.5 * (first + last)
    one, by_one = _pull(height, critical, square, first)
    two, by_two = _pull(height + 0.5 * length * speed, critical, square, middle)
    three, by_three = _pull(height + 0.5 * length * speed + 0.25 * length * length * one, critical, square, middle)
    four, by_four = _pull(height + length * speed + 0.5 * length * length * two, critical, square, last)
    higher = height + length * speed + length * length / 6.0 * (one + two + three)
    faster = speed + length / 6.0 * (one + 2.0 * two + 2.0 * three + four)
    return higher, faster, (one, two, three, four), (by_one, by_two, by_three, by_four)


@kernel
def _vary(varied: Array, length: float, critical: float, accelerations: Stages, by: Stages) -> None:
    """One step of each derivative x and its rate u: x'' = k x + source, with both at the four stages."""
    for k in range(LOCAL):
        x, u = varied[k, 0], varied[k, 1]
        of_lean, of_rate = -critical if k == 2 else 0.0, 2.0 if k == 3 else 0.0
        first = by[0] * x + of_lean * by[0] + of_rate * accelerations[0]
        second = by[1] * (x + 0.5 * length * u) + of_lean * by[1] + of_rate * accelerations[1]
        third = by[2] * (x + 0.5 * length * u + 0.25 * length * length * first)
        third += of_lean * by[2] + of_rate * accelerations[2]
        fourth = by[3] * (x + length * u + 0.5 * length * length * second)
        fourth += of_lean * by[3] + of_rate * accelerations[3]
        varied[k, 0] = x + length * u + length * length / 6.0 * (first + second + third)
        varied[k, 1] = u + length / 6.0 * (first + 2.0 * second + 2.0 * third + fourth)


@kernel
def _land(
    starts: Array, number: int, varied: Array, side: float, speed: float, e: float, pull: float, after: float
) -> None:
    """Fill in derivatives at the start of an arc from those at the end of the one before, on a side (−1 or 1)."""
    for k in range(FIXED + number):
        x = varied[0, 0] * starts[number - 1, 0, k] + varied[1, 0] * starts[number - 1, 1, k]
        u = varied[0, 1] * starts[number - 1, 0, k] + varied[1, 1] * starts[number - 1, 1, k]
        if k == CRITICAL:
            x, u = x + varied[2, 0], u + varied[2, 1]
        elif k == TILT:
            x, u = x + side * varied[2, 0], u + side * varied[2, 1]
        elif k == P:
            x, u = x + varied[3, 0], u + varied[3, 1]
        later, own = -x / speed, e * speed if k in (MEAN, FIXED + number - 1) else 0.0
        starts[number, 0, k] = e * speed * later
        starts[number, 1, k] = -e * (u + pull * later) - own - after * later


@kernel
def follow(
    time: Array, base: Array, peak: float, peak_time: float, first_side: int, restitution: Array,
    critical: Array, p: Array,
) -> Followed:  # fmt: skip
    """
    Follow rocking from a peak, forward to the end of the last arc and backward to the first sample.

    Parameters
    ----------
    time : ndarray, shape (n,)
        s, increasing.
    base : ndarray, shape (n,)
        Base acceleration over gravity at these times.
    peak, peak_time : float
        |θ| (rad) and time (s) of the first peak.
    first_side : int
        0 where it has θ < 0, 1 where θ > 0.
    restitution : ndarray, shape (m − 1,)
        e of each impact.
    critical, p : ndarray, shape (2,)
        α (rad) and p (rad/s) of the sides θ < 0 and θ > 0.
    """
    n, m = time.size, restitution.size + 1
    angle, arc, local = np.full(n, np.nan), np.full(n, -1), np.zeros((n, LOCAL))
    starts, varied = np.zeros((m, 2, FIXED + m - 1)), np.eye(LOCAL, 2)
    peaks, times = np.full(m, np.nan), np.full(m, np.nan)
    ends, speeds = np.full(m, np.nan), np.full(m, np.nan)
    begin = int(np.searchsorted(time, peak_time))
    # np.interp alone takes two seconds to compile.
    before = min(max(begin, 1), n - 1) - 1
    share = min(max((peak_time - time[before]) / (time[before + 1] - time[before]), 0.0), 1.0)
    at_peak = base[before] + share * (base[before + 1] - base[before])
    for way in (-1, 1):
        now, height, speed, e, pull, pushed = peak_time, peak, 0.0, 0.0, 0.0, at_peak
        i = begin if way > 0 else begin - 1
        # Arc by arc; backward only the first, to its start.
        for number in range(m if way > 0 else 1):
            side = (first_side + number) % 2
            sign, alpha, square, longest = 2.0 * side - 1.0, critical[side], p[side] * p[side], STEP / p[side]
            push, landed = sign * pushed, False
            after = -square * (sin(alpha - height) + push * cos(alpha - height))
            if number > 0:
                _land(starts, number, varied, -sign, speed, e, pull, after)
                speed = -e * speed
            elif way > 0:
                starts[0, 0, PEAK], starts[0, 1, TIME] = 1.0, -after
                peaks[0], times[0] = peak, peak_time
            varied = np.eye(LOCAL, 2)
            while not landed and 0 <= i < n and abs(height) < 1.5:
                length, ends_at_sample = time[i] - now, True
                if abs(length) > longest:
                    parts = np.ceil(abs(length) / longest)
                    length, ends_at_sample = length / parts, parts < 1.5
                next_push = push + (sign * base[i] - push) * (length / (time[i] - now) if time[i] != now else 1.0)
                higher, faster, accelerations, by = _step(height, speed, length, alpha, square, push, next_push)
                landed = way > 0 and higher <= 0.0 and faster < 0.0
                if landed:
                    whole, whole_push, ends_at_sample = length, next_push, False
                    for _ in range(5):
                        length -= higher / faster
                        next_push = push + (whole_push - push) * (length / whole)
                        higher, faster, accelerations, by = _step(height, speed, length, alpha, square, push, next_push)
                _vary(varied, length, alpha, accelerations, by)
                if way > 0 and number > 0 and speed > 0.0 and faster <= 0.0 and not higher <= peaks[number]:
                    turned = length * speed / (speed - faster)
                    peaks[number], times[number] = height + 0.5 * speed * turned, now + turned
                now, height, speed, push = now + length, higher, faster, next_push
                if ends_at_sample:
                    now = time[i]
                    if way < 0 and height <= 0.0:
                        break
                    angle[i], arc[i] = sign * height, number
                    for k in range(LOCAL):
                        local[i, k] = sign * varied[k, 0]
                    i += way
            if not landed or not abs(height) < 1.5:
                break
            ends[number], speeds[number] = now, -speed
            if number + 1 < m:
                e, pull = restitution[number], -square * (sin(alpha) + push * cos(alpha))
            height, pushed = 0.0, sign * push
    return Followed(angle, arc, local, starts, peaks, times, ends, speeds)
