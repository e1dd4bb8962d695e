"""A path of rocking through a record, and the penalised least squares that lay it there."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property
from math import exp, sqrt

import numpy as np
from numpy.typing import NDArray

from colonnade.arrays import Array, Mask
from colonnade.dynamics.block import Block
from colonnade.dynamics.uncertainty import Uncertainty
from colonnade.identification.restitution.follower import (
    BY_IMPACT,
    CRITICAL,
    LOCAL,
    PEAK,
    TILT,
    TIME,
    Followed,
    P,
    arc_products,
    follow,
    spread_columns,
)
from colonnade.identification.restitution.noise import Filter, corners
from colonnade.identification.restitution.peaks import angle_of_energy, lift
from colonnade.identification.restitution.record import AngleSamples

ZERO, DRIFT, GAIN, MEAN = range(BY_IMPACT, BY_IMPACT + 4)
"""Further unknowns: zero (rad) and its drift over the record (rad), ln of the angle's gain, mean of ln e."""

FIXED = MEAN + 1
"""Number of unknowns before the departure of ln e at each impact from its mean."""

ORDER = (MEAN, CRITICAL, P, GAIN, TILT, PEAK, TIME, ZERO, DRIFT)
"""The same in the order in which the linear model has them, as far as they are moved."""

BLURRED = 0.08
"""Over p: margin about impacts while the record's low-pass is not known; 1 / (2 × default cut-off)."""

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
        What is known of `PEAK`, …, `MEAN` beforehand, as of `prior_widths`.
    side : int
        Of the first peak: 0 for θ < 0, 1 for θ > 0.
    values : ndarray, shape (9 + m − 1,)
        By `PEAK`, …, `MEAN`, then the departure of ln e of each impact between m arcs.
    from_release : bool
        Whether the first peak is a release at rest.
    passed : Filter or None
        Low-pass of the record; None while it is not known, when samples near impacts are left out.
    """

    block: Block
    samples: AngleSamples
    widths: Array
    side: int
    values: Array
    from_release: bool = False
    passed: Filter | None = None

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
    def names(self) -> list[int]:
        """Those of `ORDER` that are moved."""
        return [name for name in ORDER if self.widths[name] > 0]

    @property
    def order(self) -> NDArray[np.int64]:
        """All unknowns that are moved, those of the impacts last."""
        return np.append(self.names, np.arange(FIXED, self.values.size))

    def precision(self, scatter: float) -> Array:
        """1 / variance of each unknown beforehand, with this scatter of ln e; of those not moved it means nothing."""
        known = np.where(self.widths > 0, self.widths, 1.0) ** -2.0
        return np.append(known, np.full(self.count - 1, scatter**-2.0))

    def with_arcs(self, count: int) -> Path:
        """Return the path with as many arcs; new impacts have the mean e."""
        kept = self.values[: FIXED + count - 1]
        return replace(self, values=np.append(kept, np.zeros(FIXED + count - 1 - kept.size)))

    @cached_property
    def followed(self) -> Followed:
        """The history, with its derivatives."""
        samples, values = self.samples, self.values
        return follow(samples.time, samples.base, values[PEAK], values[TIME], self.side, self.restitution, *self.sides)

    @cached_property
    def seen(self) -> Array:
        """Angle as the record shows it, rad; NaN where it is not followed."""
        angle = self.followed.angle
        if self.passed is not None:
            angle = angle + self._rounding(self.passed)
        return np.asarray(exp(self.values[GAIN]) * angle + self.values[ZERO] + self.values[DRIFT] * self.samples.along)

    def _rounding(self, passed: Filter) -> Array:
        """What the low-pass changes at corners, rad; the last impact has the e of the one before."""
        followed, e, (critical, p) = self.followed, self.restitution, self.sides
        e = np.append(e, e[-1:] if e.size else 1.0)
        signs = np.where((self.side + np.arange(e.size)) % 2, 1.0, -1.0)
        # Where the first arc was seen from its start on, it began with an impact too.
        ends = np.append(2 * followed.times[0] - followed.ends[0], followed.ends)
        jumps = signs * followed.speeds * (1 - e)
        jumps = np.append(-jumps[0] / e[0], jumps)
        bends = np.append(-signs[0], signs) * float((p**2 * np.sin(critical)).sum())
        return corners(self.samples.time, ends, jumps, bends, passed.time, passed.of_speed, passed.of_acceleration)

    @cached_property
    def residual(self) -> Array:
        """Measured less seen, rad; NaN where not counted."""
        residual = self.samples.angle - self.seen
        times, ends, time = self.followed.times, self.followed.ends, self.samples.time
        margin = BLURRED / float(self.sides[1].max())
        start = 2 * times[0] - ends[0] + margin
        if self.from_release:
            start = times[0] + RELEASED * (ends[0] - times[0])
        residual[time < start] = np.nan
        if self.passed is None:
            residual[_nearest(time, ends[np.isfinite(ends)]) < margin] = np.nan
        return residual

    @property
    def counted(self) -> Mask:
        """Samples that are counted."""
        return np.isfinite(self.residual)

    @cached_property
    def power(self) -> float:
        """Mean square of the residual, rad²."""
        counted = self.residual[self.counted]
        if not counted.size > self.values.size:
            raise UnfollowedError("too few samples")
        return max(float(counted @ counted) / counted.size, 1e-30)

    @cached_property
    def _by_arc(self) -> tuple[Array, Array]:
        """Local columns and the residual, (n, 8); residual and derivatives by all unknowns by these, (m, 8, 1 + k)."""
        followed, gain, samples = self.followed, exp(self.values[GAIN]), self.samples
        ones = np.ones(followed.angle.size)
        local = np.column_stack((gain * followed.local, ones, samples.along, gain * followed.angle, self.residual))
        arcs = np.zeros((self.count, LOCAL + 4, 1 + self.values.size))
        by = arcs[:, :, 1:]
        by[:, :2, :BY_IMPACT], by[:, :2, FIXED:] = followed.starts[:, :, :BY_IMPACT], followed.starts[:, :, BY_IMPACT:]
        by[:, :2, MEAN] = followed.starts[:, :, BY_IMPACT:].sum(axis=2)
        by[:, 2, CRITICAL] = by[:, 3, P] = by[:, LOCAL, ZERO] = by[:, LOCAL + 1, DRIFT] = by[:, LOCAL + 2, GAIN] = 1.0
        by[:, 2, TILT] = np.where((self.side + np.arange(self.count)) % 2, 1.0, -1.0)
        arcs[:, LOCAL + 3, 0] = 1.0
        return local, arcs

    @cached_property
    def products(self) -> Array:
        """Products of the residual and the angle's derivatives with each other, shape (1 + k, 1 + k)."""
        local, arcs = self._by_arc
        products = arc_products(local, np.where(self.counted, self.followed.arc, -1), self.count)
        flat = arcs.reshape(-1, arcs.shape[2])
        return flat.T @ (products @ arcs).reshape(flat.shape)

    @property
    def columns(self) -> Array:
        """Residual and derivatives of the angle by the unknowns in `order`, shape (1 + k, n); 0 where not counted."""
        local, arcs = self._by_arc
        by_unknown = np.take(arcs, np.append(0, 1 + self.order), axis=2)
        return spread_columns(local, np.where(self.counted, self.followed.arc, -1), by_unknown)


def prior_widths(known: Uncertainty) -> Array:
    """Standard deviation of each of the first unknowns about 0; infinite if nothing is known, 0 if it is not moved."""
    widths = np.full(FIXED, np.inf)
    widths[[CRITICAL, P, GAIN, TILT]] = known.critical_angle, known.p, known.angle_gain, LARGEST_TILT
    return widths


def laid(path: Path, scatter: float, free: Array | None = None) -> Path:
    """
    Move a path to where it is closest to the record, with departures of ln e that a scatter allows, and any along
    `free`, shape (m − 1,).

    Raises
    ------
    UnfollowedError
        If an unknown has no effect, or the path leads to where the block overturns.

    Notes
    -----
    Least squares by Gauss and Newton, with (value / width)² of each unknown added; noise as the residuals show.
    """
    moved, precision = np.sort(path.order), np.diag(path.precision(scatter))
    if free is not None:
        precision[FIXED:, FIXED:] -= np.outer(free, free) / (free @ free * scatter**2)
    power = path.power
    here = _objective(path, precision, power)
    if not np.isfinite(here):
        raise UnfollowedError("the block would overturn")
    for _ in range(MOST_STEPS):
        step, gain = _step(path, moved, precision, power)
        if gain < CONVERGED:
            break
        for halving in range(MOST_HALVINGS):
            tried = replace(path, values=path.values + 0.5**halving * step)
            there = _objective(tried, precision, power)
            if there < here * (1 + 1e-9):
                break
        else:
            break
        path, power = tried, tried.power
        here = _objective(path, precision, power)
    return path


def _objective(path: Path, precision: Array, power: float) -> float:
    counted = path.residual[path.counted]
    if not (np.isfinite(path.followed.peaks).all() and counted.size > path.values.size):
        return np.inf
    return float(counted @ counted / power + path.values @ precision @ path.values)


def _step(path: Path, moved: NDArray[np.int64], precision: Array, power: float) -> tuple[Array, float]:
    matrix = (path.products[1:, 1:] / power + precision)[np.ix_(moved, moved)]
    right = (path.products[1:, 0] / power - precision @ path.values)[moved]
    scale = np.sqrt(np.diag(matrix))
    if not (np.isfinite(scale).all() and (scale > 0).all()):
        raise UnfollowedError("an unknown has no effect")
    step = np.zeros(path.values.size)
    step[moved] = np.linalg.solve(matrix / np.outer(scale, scale), right / scale) / scale
    return step, float(right @ step[moved])


def laid_forward(path: Path, lowest: float) -> Path:
    """Follow a path forward: the first arcs, then as many more as are foreseen, to the record's end or lowest peak."""
    scatter = LIKELY_SCATTER
    while True:
        path = laid(path, scatter)
        if path.count > 5:
            scatter = float(np.clip(1.5 * np.std(path.deviations), *SCATTERS))
        count = _foreseen(path, scatter, lowest)
        if count <= path.count:
            return path
        path = path.with_arcs(count)


def _foreseen(path: Path, scatter: float, lowest: float) -> int:
    """How many arcs the record has, and the fit foresees."""
    # Residuals of filtered noise are correlated over a few samples: twice the error that white noise would give.
    matrix = path.products[1:, 1:] / (4 * path.power) + np.diag(path.precision(scatter))
    kept = np.sort(path.order)
    scale = np.sqrt(np.diag(matrix)[kept])
    further = path.with_arcs(max(int(FARTHER * path.count), path.count + 4))
    covariance = np.zeros((further.values.size, further.values.size))
    inverse = np.linalg.inv(matrix[np.ix_(kept, kept)] / np.outer(scale, scale)) / np.outer(scale, scale)
    covariance[np.ix_(kept, kept)] = inverse
    new = np.arange(path.values.size, further.values.size)
    covariance[new, new] = scatter**2
    followed, starts = further.followed, further._by_arc[1][:, 0, 1:]
    with np.errstate(invalid="ignore", divide="ignore"):
        speeds = np.append(np.inf, followed.speeds[:-1] * further.restitution)
        error = np.sqrt(np.maximum(((starts @ covariance) * starts).sum(axis=1), 0.0)) / speeds
        duration = followed.ends - np.append(np.nan, followed.ends[:-1])
        last = np.where(np.isfinite(duration), duration, np.inf)
        good = (followed.peaks > max(lowest, 2 * sqrt(path.power))) & np.isfinite(followed.times)
        good &= (followed.times < path.samples.time[-1]) & (error < FORESEEN * last)
    return path.count + int(np.argmin(np.append(good[path.count :], False)))


def from_release(path: Path) -> Path | None:
    """Return the path with the release before its first arc; None if no such release leads to it."""
    followed, (critical, p) = path.followed, path.sides
    side, peak = 1 - path.side, path.values[PEAK]
    rise = (p[path.side] / (p[side] * exp(path.values[MEAN]))) ** 2 * lift(peak, critical[path.side])
    height = float(angle_of_energy(rise / (1 - np.cos(critical[side])), critical[side]))
    if not height < 0.99 * critical[side]:
        return None
    impact = 2 * followed.times[0] - followed.ends[0]
    values = np.concatenate((path.values[:FIXED], [0.0], path.deviations))
    values[PEAK], values[TIME] = height, 0.0
    probe = np.linspace(0.0, 8.0 / float(p[side]), 400)
    fall = follow(probe, np.zeros(400), height, 0.0, side, np.empty(0), critical, p).ends[0]
    if not np.isfinite(fall) or path.samples.time[0] > impact - 0.1 * fall:
        return None
    values[TIME] = impact - fall
    return replace(path, side=side, values=values, from_release=True)


def without_first(path: Path) -> Path:
    """Return the path from its second arc on."""
    values = np.concatenate((path.values[:FIXED], path.deviations[1:]))
    values[PEAK], values[TIME] = path.followed.peaks[1], path.followed.times[1]
    return replace(path, side=1 - path.side, values=values, from_release=False)


def _nearest(time: Array, impacts: Array) -> Array:
    """Return the time from each of `time` to the nearest impact, s."""
    edges = np.concatenate(([-np.inf], impacts, [np.inf]))
    after = np.searchsorted(impacts, time)
    return np.minimum(time - edges[after], edges[after + 1] - time)
