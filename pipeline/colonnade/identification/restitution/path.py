"""A path of rocking through a record, and the penalised least squares that lay it there."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property
from math import exp, sqrt

import numpy as np

from colonnade.arrays import Array, Mask
from colonnade.dynamics.block import Block
from colonnade.dynamics.uncertainty import Uncertainty
from colonnade.identification.restitution.arcs import BLURRED
from colonnade.identification.restitution.follower import (
    CRITICAL,
    DRIFT,
    FIXED,
    GAIN,
    LOCAL,
    MEAN,
    PEAK,
    TILT,
    TIME,
    ZERO,
    Followed,
    P,
    follow,
)
from colonnade.identification.restitution.noise import FINEST_CUTOFF, Filter, corners, filter_of
from colonnade.identification.restitution.peaks import angle_of_energy, half_duration, lift
from colonnade.identification.restitution.record import FEWEST_ARCS, AngleSamples
from colonnade.identification.restitution.result import EXACT, FittedHistory

RELEASED = 0.15
"""Share of the way from release to the first impact that is not followed: how the block was let go is not known."""

LIKELY_SCATTER = 4e-3
"""Of ln e, with which the first arcs are followed; ..."""

SCATTERS = 3e-4, 3e-2
"""... then what they show, between these."""

FIRST_ARCS = 10
FARTHER = 1.6
"""Arcs that are followed first, and times as many that are looked at next; ..."""

FORESEEN = 0.1
"""... as long as the standard error of the next peak's time is below this share of its arc."""

MOST_STEPS, MOST_HALVINGS = 20, 8
CONVERGED = 1e-3
"""Least lessening of the penalised sum of squares for which another step is made."""

LARGEST_TILT = 0.05
"""Standard deviation, beforehand, of half the difference of ln α of the two sides beyond that of the block."""


class UnfollowedError(Exception):
    """No path of rocking follows the record."""


@dataclass(frozen=True)
class Path:
    """
    Unknowns of a rocking history.

    Attributes
    ----------
    block : Block
    samples : AngleSamples
    widths : ndarray, shape (9,)
        What is known of `MEAN`, …, `DRIFT` beforehand, as of `prior_widths`.
    side : int
        Of the first peak: 0 for θ < 0, 1 for θ > 0.
    values : ndarray, shape (9 + m − 1,)
        By `MEAN`, …, `DRIFT`, then the departure of ln e of each impact between m arcs.
    from_release : bool
        Whether the first peak is a release at rest.
    passed : Filter
        What the record went through.
    """

    block: Block
    samples: AngleSamples
    widths: Array
    side: int
    values: Array
    passed: Filter
    from_release: bool = False

    @classmethod
    def through(
        cls, samples: AngleSamples, block: Block, widths: Array, lowpass: float | None, peaks: Array, times: Array
    ) -> Path:
        """
        Return the path of a run of arcs on alternating sides, by their peaks (rad, signed) and times (s), shape (n,).

        `lowpass` is the cut-off of the record, Hz.

        Raises
        ------
        UnfollowedError
            If the arcs are too few.
        """
        if peaks.size < FEWEST_ARCS:
            raise UnfollowedError(f"at least {FEWEST_ARCS} arcs in a row are needed")
        energies = block.p_at(peaks) ** 2 * lift(peaks, block.critical_angle_at(peaks))
        # An error of the angle is one of the logarithm in proportion to 1 / |θ|.
        slope, _ = np.polyfit(np.arange(peaks.size), np.log(energies), 1, w=np.abs(peaks))
        values = np.zeros(FIXED)
        values[[PEAK, TIME, MEAN]] = abs(peaks[0]), times[0], np.clip(slope / 2, np.log(0.3), np.log(0.9999))
        is_seen = lowpass is not None and samples.is_even and lowpass * samples.interval <= FINEST_CUTOFF
        passed = filter_of(lowpass if is_seen else None, samples.step, samples.group)
        return cls(block, samples, widths, int(peaks[0] > 0), values, passed).with_arcs(min(peaks.size, FIRST_ARCS))

    @property
    def count(self) -> int:
        """Number of arcs."""
        return self.values.size - FIXED + 1

    @property
    def deviations(self) -> Array:
        """Departure of ln e of each impact from the mean."""
        return self.values[FIXED:]

    @property
    def restitution(self) -> Array:
        """e of each impact."""
        return np.asarray(np.exp(self.values[MEAN] + self.deviations))

    @cached_property
    def sides(self) -> tuple[Array, Array]:
        """α (rad) and p (rad/s) of θ < 0 and θ > 0, as the unknowns have them."""
        tilt, sides = self.values[TILT] * np.array([-1.0, 1.0]), self.block.sides
        critical = np.array([side.critical_angle for side in sides]) * np.exp(self.values[CRITICAL] + tilt)
        return critical, np.array([self.block.side_p(side) for side in sides]) * exp(self.values[P])

    @property
    def signs(self) -> Array:
        """Side of each arc, −1 or 1."""
        return np.where((self.side + np.arange(self.count)) % 2, 1.0, -1.0)

    def precision(self, scatter: float) -> Array:
        """1 / variance of each unknown beforehand, with this scatter of ln e."""
        return np.append(self.widths, np.full(self.count - 1, scatter)) ** -2.0

    def with_arcs(self, count: int) -> Path:
        """Return the path with as many arcs; new impacts have the mean e."""
        values = np.zeros(FIXED + count - 1)
        kept = min(values.size, self.values.size)
        values[:kept] = self.values[:kept]
        return replace(self, values=values)

    @cached_property
    def followed(self) -> Followed:
        """The history, with its derivatives."""
        samples, values = self.samples, self.values
        return follow(samples.time, samples.base, values[PEAK], values[TIME], self.side, self.restitution, *self.sides)

    @property
    def start(self) -> float:
        """When the first arc began with an impact, unless with a release."""
        return float(2 * self.followed.times[0] - self.followed.ends[0])

    @cached_property
    def seen(self) -> Array:
        """Angle as the record shows it, rad; NaN where it is not followed."""
        followed, values, passed = self.followed, self.values, self.passed
        (critical, p), signs = self.sides, self.signs
        # The last impact has the e of the one before.
        e = np.append(self.restitution, self.restitution[-1:] if self.count > 1 else 1.0)
        jumps = signs * followed.speeds * (1 - e)
        # Where the first arc was seen from its start on, it began with an impact too.
        jumps, ends = np.append(-jumps[0] / e[0], jumps), np.append(self.start, followed.ends)
        bends = np.append(-signs[0], signs) * float((p**2 * np.sin(critical)).sum())
        rounding = passed.time, passed.of_speed, passed.of_acceleration
        angle = followed.angle + corners(self.samples.time, ends, jumps, bends, *rounding)
        return np.asarray(exp(values[GAIN]) * angle + values[ZERO] + values[DRIFT] * self.samples.along)

    @cached_property
    def residual(self) -> Array:
        """Measured less seen, rad; NaN where not counted."""
        residual = self.samples.angle - self.seen
        top, end = self.followed.times[0], self.followed.ends[0]
        start = self.start + BLURRED / float(self.sides[1].max())
        residual[self.samples.time < (top + RELEASED * (end - top) if self.from_release else start)] = np.nan
        return residual

    @property
    def counted(self) -> Mask:
        """Samples that are counted."""
        return np.isfinite(self.residual)

    @property
    def history(self) -> FittedHistory:
        """From the first to the last sample that is counted."""
        first, *_, last = np.flatnonzero(self.counted)
        return FittedHistory(*(each[first : last + 1] for each in (self.samples.time, self.seen, self.residual)))

    @cached_property
    def power(self) -> float:
        """Mean square of the residual, rad²."""
        counted = self.residual[self.counted]
        if not counted.size > self.values.size:
            raise UnfollowedError("too few samples")
        return max(float(counted @ counted) / counted.size, 1e-30)

    @cached_property
    def _by_arc(self) -> tuple[list[Array], Array]:
        """Residual and local columns of each arc, (n, 8), and by these residual and all derivatives, (m, 8, 1 + k)."""
        followed, gain, samples = self.followed, exp(self.values[GAIN]), self.samples
        ones = np.ones(followed.angle.size)
        local = np.column_stack((gain * followed.local, ones, samples.along, gain * followed.angle, self.residual))
        local[~self.counted] = 0.0
        arcs = np.zeros((self.count, LOCAL + 4, 1 + self.values.size))
        by = arcs[:, :, 1:]
        by[:, :2] = followed.starts
        by[:, 2, CRITICAL] = by[:, 3, P] = by[:, LOCAL, ZERO] = by[:, LOCAL + 1, DRIFT] = by[:, LOCAL + 2, GAIN] = 1.0
        by[:, 2, TILT] = self.signs
        arcs[:, LOCAL + 3, 0] = 1.0
        return np.split(local, np.searchsorted(samples.time, followed.ends[:-1], "right")), arcs

    @cached_property
    def products(self) -> Array:
        """Products of the residual and the angle's derivatives with each other, shape (1 + k, 1 + k)."""
        pieces, arcs = self._by_arc
        products = np.array([piece.T @ piece for piece in pieces])
        flat = arcs.reshape(-1, arcs.shape[2])
        return flat.T @ (products @ arcs).reshape(flat.shape)

    @property
    def columns(self) -> Array:
        """Residual and derivatives of the angle by all unknowns, shape (1 + k, n); 0 where not counted."""
        return np.hstack([arc.T @ piece.T for piece, arc in zip(*self._by_arc, strict=True)])

    def laid(self, scatter: float, free: Array | None = None) -> Path:
        """
        Move the path to where it is closest to the record, with departures of ln e that a scatter allows, and any along
        `free`, shape (m − 1,).

        Raises
        ------
        UnfollowedError
            If an unknown has no effect, or the path leads to where the block overturns.

        Notes
        -----
        Least squares by Gauss and Newton, with (value / width)² of each unknown added; noise as the residuals show.
        """
        precision = np.diag(self.precision(scatter))
        if free is not None:
            precision[FIXED:, FIXED:] -= np.outer(free, free) / (free @ free * scatter**2)
        path, power = self, self.power
        here = path._objective(precision, power)
        if not np.isfinite(here):
            raise UnfollowedError("the block would overturn")
        for _ in range(MOST_STEPS):
            step, gain = path._step(precision, power)
            if gain < CONVERGED:
                break
            shorter = (replace(path, values=path.values + 0.5**halving * step) for halving in range(MOST_HALVINGS))
            better = next((each for each in shorter if each._objective(precision, power) < here * (1 + 1e-9)), None)
            if better is None:
                break
            path, power = better, better.power
            here = path._objective(precision, power)
        return path

    def _objective(self, precision: Array, power: float) -> float:
        counted = self.residual[self.counted]
        if not (np.isfinite(self.followed.peaks).all() and counted.size > self.values.size):
            return np.inf
        return float(counted @ counted / power + self.values @ precision @ self.values)

    def _step(self, precision: Array, power: float) -> tuple[Array, float]:
        matrix = self.products[1:, 1:] / power + precision
        right = self.products[1:, 0] / power - precision @ self.values
        scale = np.sqrt(np.diag(matrix))
        if not (np.isfinite(scale).all() and (scale > 0).all()):
            raise UnfollowedError("an unknown has no effect")
        step = np.linalg.solve(matrix / np.outer(scale, scale), right / scale) / scale
        return step, float(right @ step)

    def laid_forward(self, lowest: float) -> Path:
        """Follow the record forward: first arcs, then as many more as are foreseen, to its end or lowest peak (rad)."""
        path, scatter = self, LIKELY_SCATTER
        while True:
            path = path.laid(scatter)
            if path.count > 5:
                scatter = float(np.clip(1.5 * np.std(path.deviations), *SCATTERS))
            count = path._foreseen(scatter, lowest)
            if count <= path.count:
                return path
            path = path.with_arcs(count)

    def _foreseen(self, scatter: float, lowest: float) -> int:
        """How many arcs the record has, and the fit foresees."""
        further = self.with_arcs(max(int(FARTHER * self.count), self.count + 4))
        precision, known = further.precision(scatter), self.values.size
        matrix = np.diag(precision)
        # Residuals of filtered noise are correlated over a few samples: twice the error that white noise would give.
        matrix[:known, :known] += self.products[1:, 1:] / (4 * self.power)
        scale = np.sqrt(np.diag(matrix))
        covariance = np.linalg.inv(matrix / np.outer(scale, scale)) / np.outer(scale, scale)
        followed, starts = further.followed, further.followed.starts[:, 0]
        with np.errstate(invalid="ignore", divide="ignore"):
            speeds = np.append(np.inf, followed.speeds[:-1] * further.restitution)
            error = np.sqrt(np.maximum(((starts @ covariance) * starts).sum(axis=1), 0.0)) / speeds
            duration = followed.ends - np.append(np.nan, followed.ends[:-1])
            last = np.where(np.isfinite(duration), duration, np.inf)
            good = (followed.peaks > max(lowest, 2 * sqrt(self.power))) & np.isfinite(followed.times)
            good &= (followed.times < self.samples.time[-1]) & (error < FORESEEN * last)
        return self.count + int(np.argmin(np.append(good[self.count :], False)))

    def with_release(self) -> Path | None:
        """Return the path with the release before its first arc; None if no such release leads to it."""
        (critical, p), side, values = self.sides, 1 - self.side, np.insert(self.values, FIXED, 0.0)
        before = critical[side]
        rise = (p[self.side] / (p[side] * exp(values[MEAN]))) ** 2 * lift(values[PEAK], critical[self.side])
        height = float(angle_of_energy(rise / (1 - np.cos(before)), before))
        if not height < 0.99 * before:
            return None
        fall = float(half_duration(height, before) / p[side])
        if self.samples.time[0] > self.start - 0.1 * fall:
            return None
        values[[PEAK, TIME]] = height, self.start - fall
        return replace(self, side=side, values=values, from_release=True)


def prior_widths(known: Uncertainty) -> Array:
    """Standard deviation of each of the first unknowns about 0; infinite if nothing is known."""
    widths = np.full(FIXED, np.inf)
    given = known.critical_angle, known.p, known.angle_gain
    widths[[CRITICAL, P, GAIN]], widths[TILT] = np.maximum(given, EXACT), LARGEST_TILT
    return widths
