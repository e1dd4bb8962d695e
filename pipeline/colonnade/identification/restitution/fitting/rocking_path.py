"""A path of free rocking with its own e at each impact, fitted to the samples of a record."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property
from math import sqrt

import numpy as np

from colonnade.arrays import Array
from colonnade.identification.restitution.fitting.forecast import BLURRED, extended, stretch_of
from colonnade.identification.restitution.fitting.free_decay import ALWAYS, Decay
from colonnade.identification.restitution.fitting.least_squares import (
    MOST_HALVINGS,
    Stretch,
    UnfollowedError,
    blur,
    nearest,
)
from colonnade.identification.restitution.fitting.samples import AngleSamples

MOST_STEPS = 20
CONVERGED = 1e-3
"""Least lessening of the penalised sum of squares, in the noise's variance, for which another step is made."""

SAME_NOISE = 0.05
"""Change of the noise's variance, as a share of it, below which the iteration stops."""

LIKELY_SCATTER = 4e-3
"""Of ln e, with which the first arcs are followed; ..."""

SCATTERS = 3e-4, 3e-2
"""... then what they show, between these."""

FARTHER = 1.6
"""Times as many arcs as have been followed are looked at next."""


@dataclass(frozen=True)
class RockingPath:
    """A decay with its `deviations`, and the drift of the zero (rad over the stretch, none in its middle)."""

    decay: Decay
    drift: float = 0.0

    def seen(self, stretch: Stretch) -> Array:
        """Angle as a record through the stretch's low-pass shows it, rad, shape (n,)."""
        angle = self.decay.angle_alone(stretch.time)
        if stretch.cutoff_hz is not None:
            angle = angle + blur(self.decay, stretch)
        return np.asarray(angle + self.drift * _centred_time(stretch))

    def residual(self, stretch: Stretch) -> Array:
        """Measured less seen, rad; NaN where not counted."""
        residual = stretch.angle - self.seen(stretch)
        if stretch.margin > 0:
            ends = self.decay.arcs()[2]
            residual = np.where(nearest(stretch.time, ends) < stretch.margin, np.nan, residual)
        return residual

    def linear(self, stretch: Stretch, names: tuple[str, ...]) -> tuple[Array, Array, Array]:
        """Residual, and derivatives of the angle by the unknowns (the drift last) and by ln e of each impact."""
        residual = self.residual(stretch)
        fixed, by_impact = self.decay.jacobian(stretch.time, names)
        fixed = np.column_stack((fixed, _centred_time(stretch)))
        uncounted = ~np.isfinite(residual)
        fixed[uncounted], by_impact[uncounted] = 0.0, 0.0
        return residual, fixed, by_impact

    def normal_equations(self, residual: Array, stretch: Stretch, names: tuple[str, ...]) -> tuple[Array, Array]:
        """Products of the derivatives of `linear` with themselves, and with the residual."""
        return self.decay.normal_equations(stretch.time, residual, _centred_time(stretch), names)

    def moved(self, step: Array, names: tuple[str, ...]) -> RockingPath:
        """Return the path with steps added to the unknowns, the drift, and ln e of each impact."""
        steps = dict(zip(names, step.tolist(), strict=False))
        return RockingPath(
            self.decay.moved_by_impact(steps, step[len(names) + 1 :]), self.drift + float(step[len(names)])
        )


def fit_path(path: RockingPath, stretch: Stretch, names: tuple[str, ...], scatter: float) -> RockingPath:
    """
    Move a path to where it is closest to the record, with departures of ln e that a scatter allows.

    Parameters
    ----------
    path : RockingPath
    stretch : Stretch
    names : tuple of str
        Of the unknowns that are moved with the drift.
    scatter : float
        Standard deviation of ln e from impact to impact.

    Raises
    ------
    UnfollowedError
        If the path leads to where the block overturns.

    Notes
    -----
    Least squares by Gauss and Newton, with (departure / scatter)² of each impact added; noise as the residuals show.
    """
    return _fitted(_Laid(path, stretch, names), scatter).path


def fit_path_forward(samples: AngleSamples, path: RockingPath, lowest: float) -> RockingPath:
    """Follow a path forward: the first arcs, then as many more as are foreseen, to the record's end or lowest peak."""
    margin, scatter = BLURRED / float(path.decay.p.max()), LIKELY_SCATTER
    while True:
        stretch = stretch_of(samples, path.decay, margin=margin)
        laid = _fitted(_Laid(path, stretch, ALWAYS), scatter)
        path = laid.path
        if path.decay.count > 5:
            scatter = float(np.clip(1.5 * np.std(path.decay.by_impact), *SCATTERS))
        longer = _longer(laid, samples, scatter, lowest)
        if longer is None:
            return path
        path = longer


def _centred_time(stretch: Stretch) -> Array:
    """Time over the stretch, from −1/2 to 1/2."""
    start, end = float(stretch.time[0]), float(stretch.time[-1])
    return np.asarray((stretch.time - start) / max(end - start, 1e-300) - 0.5)


@dataclass(frozen=True)
class _Laid:
    """A path laid through a stretch, with what is computed of it when it is first asked for."""

    path: RockingPath
    stretch: Stretch
    names: tuple[str, ...]

    @cached_property
    def residual(self) -> Array:
        """Rad; NaN where not counted."""
        return self.path.residual(self.stretch)

    @cached_property
    def power(self) -> float:
        """Mean square of the residual, rad²."""
        counted = self.residual[np.isfinite(self.residual)]
        if not counted.size > self.path.decay.count + len(ALWAYS) + 1:
            raise UnfollowedError("too few samples")
        return max(float(counted @ counted) / counted.size, 1e-30)

    @cached_property
    def _products(self) -> tuple[Array, Array]:
        return self.path.normal_equations(self.residual, self.stretch, self.names)

    def objective(self, scatter: float, power: float) -> float:
        """Squares of the residual and of the departures, in the variance of each; infinite if the block overturns."""
        if not np.isfinite(self.path.decay.arcs()[0]).all():
            return np.inf
        counted = self.residual[np.isfinite(self.residual)]
        return float(counted @ counted / power + (self.path.decay.by_impact**2).sum() / scatter**2)

    def normal(self, scatter: float, power: float) -> tuple[Array, Array]:
        """Normal equations of the penalised squares: matrix and right side."""
        normal, gradient = (each / power for each in self._products)
        impact = np.arange(len(self.names) + 1, gradient.size)
        normal[impact, impact] += scatter**-2
        gradient[impact] -= self.path.decay.by_impact * scatter**-2
        return normal, gradient

    def moved(self, step: Array) -> _Laid:
        """Return the path with steps added, as `RockingPath.moved`."""
        return _Laid(self.path.moved(step, self.names), self.stretch, self.names)


def _fitted(laid: _Laid, scatter: float) -> _Laid:
    """Move a path as `fit_path` does."""
    power = laid.power
    for _ in range(3):
        laid = _closest(laid, scatter, power)
        power, before = laid.power, power
        if abs(power - before) < SAME_NOISE * before:
            break
    return laid


def _closest(laid: _Laid, scatter: float, power: float) -> _Laid:
    """Move a path to the least penalised squares with the noise's variance as given."""
    here = laid.objective(scatter, power)
    if not np.isfinite(here):
        raise UnfollowedError("the block would overturn")
    for _ in range(MOST_STEPS):
        normal, gradient = laid.normal(scatter, power)
        scale = np.sqrt(np.diag(normal))
        if not (scale > 0).all():
            raise UnfollowedError("an unknown has no effect")
        step = np.linalg.solve(normal / np.outer(scale, scale), gradient / scale) / scale
        if float(gradient @ step) < CONVERGED:
            break
        for halving in range(MOST_HALVINGS):
            tried = laid.moved(0.5**halving * step)
            there = tried.objective(scatter, power)
            if there < here * (1 + 1e-9):
                break
        else:
            break
        laid, here = tried, there
    return laid


def _longer(laid: _Laid, samples: AngleSamples, scatter: float, lowest: float) -> RockingPath | None:
    """Return the path with as many more arcs as the record has and the fit foresees; None for none."""
    path, power = laid.path, laid.power
    count = path.decay.count
    # Residuals of filtered noise are correlated over a few samples: twice the error that white noise would give.
    normal, _ = laid.normal(scatter, 4 * power)
    scale = np.sqrt(np.diag(normal))
    covariance = np.linalg.inv(normal / np.outer(scale, scale)) / np.outer(scale, scale)
    further = replace(path.decay, count=max(int(FARTHER * count), count + 4))
    _, by_impact = further.derivatives_by_impact()
    drift = np.zeros((further.count, 1))
    derivatives = np.hstack((further.derivatives(ALWAYS)[:, 1, :], drift, by_impact))
    known = covariance.shape[0]
    spread = np.diag(np.full(derivatives.shape[1], scatter**2))
    spread[:known, :known] = covariance
    error = np.sqrt(np.maximum(((derivatives @ spread) * derivatives).sum(axis=1), 0.0))
    longer = extended(path.decay, further, error, samples, max(lowest, 2 * sqrt(power)))
    return None if longer is None else replace(path, decay=longer)
