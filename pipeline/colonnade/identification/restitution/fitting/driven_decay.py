"""
Rocking from a peak on while the table moves, as a function of the same few unknowns as free rocking.

    θ̈ = −p² [ sin(α s − θ) + (a/g) cos(α s − θ) ],  s = sgn θ

by Runge and Kutta's fourth-order method; the base acceleration is linear between samples.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from math import cos, pi, sin

import numpy as np
from numpy.typing import ArrayLike, NDArray

from colonnade.arrays import Array
from colonnade.dynamics.block import Block
from colonnade.dynamics.kernel import kernel
from colonnade.identification.response.base_motion import table_moves
from colonnade.identification.restitution.fitting.free_decay import STEP, Decay
from colonnade.identification.restitution.fitting.samples import UNEVEN

LONGEST_STEP = 0.02
"""In p t: errors of 1e-9 α an arc."""

FEWEST_STEPS = 10
"""In an arc, however short."""


@dataclass(frozen=True)
class BaseMotion:
    """Base acceleration over gravity, shape (n,), positive towards +x; time of its first sample and its step, s."""

    acceleration: Array
    start: float
    interval: float


def moving_base(time: Array, acceleration: ArrayLike | None, block: Block) -> BaseMotion | None:
    """
    Return the base motion of a table that moves; None if it is at rest or was not recorded.

    Parameters
    ----------
    time : ndarray, shape (n,)
        s.
    acceleration : array_like, shape (n,), or None
        m/s².
    block : Block

    Raises
    ------
    ValueError
        If the shapes differ, or the table moves and samples are missing or not evenly spaced.
    """
    if acceleration is None:
        return None
    values = np.asarray(acceleration, dtype=np.float64)
    if values.shape != time.shape:
        raise ValueError(f"base_acceleration has shape {values.shape}; {time.shape}, as many as times, was expected")
    interval = float(time[-1] - time[0]) / (time.size - 1)
    if not table_moves(values, interval, block):
        return None
    if missing := int((~np.isfinite(values)).sum()):
        raise ValueError(
            f"The table moves, and its acceleration is missing {missing} of {values.size} samples: e cannot be "
            "identified. Give the test a `window` without them."
        )
    if np.abs(np.diff(time) - interval).max() > UNEVEN * interval:
        raise ValueError("The table moves, and the record's steps are uneven; a uniform clock was expected.")
    return BaseMotion(values / block.gravity, float(time[0]), interval)


@dataclass(frozen=True)
class DrivenDecay(Decay):
    """A decay on a table that moves: what is known of it, and the base motion. Derivatives are differences."""

    base: BaseMotion = field(default_factory=lambda: BaseMotion(np.zeros(2), 0.0, 1.0))

    @classmethod
    def of(cls, decay: Decay, base: BaseMotion) -> DrivenDecay:
        """Put a decay on a table that moves."""
        return cls(decay.values, decay.side, decay.count, decay.block, False, decay.deviations, base)

    def arcs(self) -> tuple[Array, Array, Array]:
        """Peaks (|θ|, rad), their times and the ends of the arcs (s), shape (count,)."""
        peaks, times, ends, _, _ = self._driven(np.empty(0))
        return peaks, times, ends

    def followed(self, time: Array) -> tuple[Array, NDArray[np.int64]]:
        """Angle at times (s), rad, shape (n,), and the number of the arc of each."""
        _, _, _, angle, arc = self._driven(time)
        return angle, arc

    def angle_alone(self, time: Array) -> Array:
        """Angle at times (s), rad."""
        return self.followed(time)[0]

    def jacobian(self, time: Array, names: tuple[str, ...]) -> tuple[Array, Array]:
        """Derivatives of the angle by the unknowns named, shape (n, k), and by ln e of each impact, (n, count − 1)."""

        def change(ahead: Decay, behind: Decay, step: float) -> Array:
            return (ahead.followed(time)[0] - behind.followed(time)[0]) / (2 * step)

        fixed = [change(self.moved({name: step}), self.moved({name: -step}), step) for name, step in self._steps(names)]
        pairs = [self._by_impact(impact) for impact in range(self.count - 1)]
        by_impact = [change(ahead, behind, STEP) for ahead, behind in pairs]
        return np.array(fixed).reshape(len(names), time.size).T, np.array(by_impact).reshape(-1, time.size).T

    def normal_equations(
        self, time: Array, residual: Array, further: Array, names: tuple[str, ...]
    ) -> tuple[Array, Array]:
        """Sum products of the derivatives of the angle over the samples counted."""
        fixed, by_impact = self.jacobian(time, names)
        columns = np.column_stack((fixed, further, by_impact))[np.isfinite(residual)]
        return columns.T @ columns, columns.T @ residual[np.isfinite(residual)]

    def derivatives(self, names: tuple[str, ...]) -> Array:
        """Derivatives of each arc's peak and time with respect to those named, shape (count, 2, len(names))."""
        result = np.zeros((self.count, 2, len(names)))
        for column, (name, step) in enumerate(self._steps(names)):
            ahead, behind = self.moved({name: step}).arcs(), self.moved({name: -step}).arcs()
            result[:, 0, column] = (ahead[0] - behind[0]) / (2 * step)
            result[:, 1, column] = (ahead[1] - behind[1]) / (2 * step)
        return result

    def derivatives_by_impact(self) -> tuple[Array, Array]:
        """Derivatives of each arc's peak (rad) and of its time (s) by ln e of each impact, shape (count, count − 1)."""
        by_peak, by_time = np.zeros((self.count, self.count - 1)), np.zeros((self.count, self.count - 1))
        for impact in range(self.count - 1):
            ahead, behind = (each.arcs() for each in self._by_impact(impact))
            by_peak[:, impact] = (ahead[0] - behind[0]) / (2 * STEP)
            by_time[:, impact] = (ahead[1] - behind[1]) / (2 * STEP)
        return by_peak, by_time

    def _steps(self, names: tuple[str, ...]) -> list[tuple[str, float]]:
        sizes = {"peak": self.values["peak"], "zero_offset": self.values["peak"], "time": 1 / float(self.p.max())}
        return [(name, 1e-6 * sizes.get(name, 1.0)) for name in names]

    def _by_impact(self, impact: int) -> tuple[Decay, Decay]:
        step = STEP * (np.arange(self.count - 1) == impact)
        return self.moved_by_impact({}, step), self.moved_by_impact({}, -step)

    def _driven(self, time: Array) -> tuple[Array, Array, Array, Array, NDArray[np.int64]]:
        restitution = np.exp(self.values["restitution"] + self.by_impact)
        return driven_arcs(
            time,
            self.values["peak"],
            self.values["time"],
            self.side,
            restitution,
            self.values["zero_offset"],
            self.critical,
            self.p,
            self.base.acceleration,
            self.base.start,
            self.base.interval,
            self.count,
        )


@kernel
def _at(base: Array, start: float, interval: float, time: float) -> float:
    """Base acceleration at a time: linear between samples, none outside."""
    place = (time - start) / interval
    if place < 0.0 or place > base.size - 1:
        return 0.0
    low = min(int(place), base.size - 2)
    return float(base[low] + (place - low) * (base[low + 1] - base[low]))


@kernel
def _pull(height: float, push: float, critical: float, square: float) -> float:
    """Second derivative of |θ|; `push` is the base acceleration over gravity towards the side that the block is on."""
    return -square * (sin(critical - height) + push * cos(critical - height))


@kernel
def _step(
    height: float, speed: float, time: float, length: float, sign: float, critical: float, square: float,
    base: Array, start: float, interval: float,
) -> tuple[float, float]:  # fmt: skip
    """One step of |θ| and its rate."""
    first = _pull(height, sign * _at(base, start, interval, time), critical, square)
    middle = sign * _at(base, start, interval, time + 0.5 * length)
    second = _pull(height + 0.5 * length * speed, middle, critical, square)
    third = _pull(height + 0.5 * length * (speed + 0.5 * length * first), middle, critical, square)
    end = sign * _at(base, start, interval, time + length)
    fourth = _pull(height + length * (speed + 0.5 * length * second), end, critical, square)
    return (
        height + length * speed + length * length / 6 * (first + second + third),
        speed + length / 6 * (first + 2 * second + 2 * third + fourth),
    )


@kernel
def _landing(
    height: float, speed: float, time: float, taken: float, higher: float, faster: float, sign: float,
    critical: float, square: float, base: Array, start: float, interval: float,
) -> tuple[float, float, float]:  # fmt: skip
    """Shorten a step that ends below zero to the impact (Newton): its length, and |θ| and its rate there."""
    for _ in range(6):
        taken -= higher / faster
        higher, faster = _step(height, speed, time, taken, sign, critical, square, base, start, interval)
    return taken, higher, faster


@kernel
def _between(x: float, taken: float, height: float, speed: float, higher: float, faster: float) -> float:
    """|θ| at the share x of a step, from values and rates at its ends (Hermite)."""
    value = (1 + 2 * x) * (1 - x) ** 2 * height + x * (1 - x) ** 2 * taken * speed
    value += x**2 * (3 - 2 * x) * higher + x**2 * (x - 1) * taken * faster
    return value


@kernel
def _fill_before(
    angle: Array, time: Array, first_peak: float, first_time: float, offset: float, sign: float,
    critical: float, p: float, base: Array, start: float, interval: float,
) -> int:  # fmt: skip
    """Go backwards from the first peak to the first sample, and write the angles there; return their number."""
    before = int(np.searchsorted(time, first_time))
    height, speed, now = first_peak, 0.0, first_time
    i = before - 1
    while i >= 0 and abs(height) < 0.5 * pi:
        length = max(-LONGEST_STEP / p, time[i] - now)
        height, speed = _step(height, speed, now, length, sign, critical, p * p, base, start, interval)
        now += length
        if now <= time[i]:
            angle[i] = offset + sign * height
            i -= 1
    return before


@kernel
def driven_arcs(
    time: Array, first_peak: float, first_time: float, first_side: int, restitution: Array, offset: float,
    critical: Array, p: Array, base: Array, base_start: float, base_interval: float, count: int,
) -> tuple[Array, Array, Array, Array, NDArray[np.int64]]:  # fmt: skip
    """
    Follow rocking on a moving table; arguments as for `free_arcs`, `angle_and_sensitivity` and `BaseMotion`.

    Returns
    -------
    peaks, times, ends : ndarray, shape (count,)
        NaN from where the block overturns.
    angle : ndarray, shape (n,)
        rad; before the first peak its arc goes on backwards, after the last arc the block stands.
    arc : ndarray of int, shape (n,)
    """
    peaks, times, ends = np.full(count, np.nan), np.full(count, np.nan), np.full(count, np.nan)
    angle, arc = np.full(time.size, offset), np.zeros(time.size, dtype=np.int64)
    side = first_side
    sign, alpha, square, longest = 2.0 * side - 1.0, critical[side], p[side] * p[side], LONGEST_STEP / p[side]
    filled = _fill_before(
        angle, time, first_peak, first_time, offset, sign, alpha, p[side], base, base_start, base_interval
    )
    height, speed, now = first_peak, 0.0, first_time
    peaks[0], times[0] = first_peak, first_time
    n = 0
    while n < count:
        # One step, or the part of it up to the impact.
        taken = longest
        higher, faster = _step(height, speed, now, taken, sign, alpha, square, base, base_start, base_interval)
        landed = higher <= 0.0 and faster < 0.0
        if landed:
            taken, higher, faster = _landing(
                height, speed, now, taken, higher, faster, sign, alpha, square, base, base_start, base_interval
            )
        # Samples within the step.
        while filled < time.size and time[filled] <= now + taken:
            value = _between((time[filled] - now) / taken, taken, height, speed, higher, faster)
            angle[filled], arc[filled] = offset + sign * value, n
            filled += 1
        # The highest peak of the arc: on a moving table it may have several.
        if n > 0 and speed > 0.0 and faster <= 0.0 and not higher <= peaks[n]:
            turned = taken * speed / (speed - faster)
            peaks[n], times[n] = height + 0.5 * speed * turned, now + turned
        now, height, speed = now + taken, higher, faster
        if landed:
            ends[n] = now
            n += 1
            if n < count:
                # Over to the other side, in steps that are short enough for a low arc.
                side = 1 - side
                sign, alpha, square = -sign, critical[side], p[side] * p[side]
                height, speed = 0.0, -restitution[n - 1] * speed
                longest = min(LONGEST_STEP / p[side], 2 * speed / (square * sin(alpha)) / FEWEST_STEPS)
        elif height > 0.5 * pi or speed != speed:
            peaks[n:], times[n:] = np.nan, np.nan
            break
    arc[filled:] = count - 1
    return peaks, times, ends, angle, arc
