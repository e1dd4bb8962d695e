"""Coefficient of restitution of each impact, from the arcs before and after it, against its velocity: is e constant?"""

from __future__ import annotations

from dataclasses import dataclass, field
from math import sqrt

import numpy as np
import scipy

from colonnade.arrays import Array, Mask
from colonnade.dynamics.block import Block
from colonnade.identification.restitution.arcs.arcs import Arcs
from colonnade.identification.restitution.arcs.energy import energy_slope, lift
from colonnade.identification.restitution.estimators.estimator import Estimator, Fit
from colonnade.identification.restitution.estimators.peaks import PeakDecay
from colonnade.identification.restitution.fitting.mixture import mean_of_student
from colonnade.identification.restitution.free_vibration import FreeVibration
from colonnade.identification.restitution.result import Constancy, Impacts

FEWEST_IMPACTS = 4


@dataclass(frozen=True)
class ImpactFit(Fit):
    """The estimate, the impacts with e of each, and how constant that is."""

    impacts: Impacts = field(default_factory=Impacts)
    constancy: Constancy = field(default_factory=Constancy)


class ImpactByImpact(Estimator[ImpactFit]):
    """
    The mean of e over the impacts, and whether e is constant.

    Notes
    -----
    Neighbouring impacts share a peak, so that their errors are correlated: generalised least squares of ln e with the
    errors' covariance, a scatter τ² between impacts on its diagonal (where the weighted sum of squares equals its
    degrees of freedom, Paule and Mandel 1982), and a correction of the zero offset, which moves successive e in
    opposite ways.
    """

    name = "impact-by-impact"
    label = "impact by impact"
    assumptions = (
        "plane rocking without slide or bounce; e of each impact about one mean, independent of the others; the "
        "angle's scale and the block's critical angles; both sides about one zero; p does not enter"
    )
    description = "e of each impact from the arcs before and after it, and its change with the angular velocity"
    result = ImpactFit

    def fit(self, record: FreeVibration) -> ImpactFit:
        """Fit the impacts between arcs about the zero that the peaks have in common."""
        offset = record.fitted(PeakDecay()).zero_offset
        return self.fit_arcs(record.arcs, offset, record.usable, record.block, level=record.level)

    def fit_arcs(self, arcs: Arcs, offset: float, usable: Mask, block: Block, *, level: float = 0.95) -> ImpactFit:
        """
        Identify e from n arcs.

        Parameters
        ----------
        arcs : Arcs
        offset : float
            Common zero offset of the peaks, rad.
        usable : ndarray of bool, shape (n,)
        block : Block
        level : float
        """
        impacts = single_impacts(arcs, offset, usable, block)
        used = impacts.used
        number = int(used.sum())
        if number < FEWEST_IMPACTS:
            reason = f"{FEWEST_IMPACTS} impacts between two peaks that can be used are needed; the record has {number}."
            return ImpactFit(self.refuse(level, reason).estimate, None, impacts)
        peak = arcs.peak_angle - offset
        slope = energy_slope(peak, block.critical_angle_at(peak))
        difference = 0.5 * (np.eye(peak.size, k=1) - np.eye(peak.size))[:-1][used]
        known = np.isfinite(slope) & np.isfinite(arcs.peak_standard_error)
        covariance = (difference * np.where(known, (slope * arcs.peak_standard_error) ** 2, 0.0)) @ difference.T
        by_offset = difference @ np.where(known, np.sign(peak) * slope, 0.0)
        problem = _ScatteredMean(np.log(impacts.restitution[used]), covariance)

        design = np.column_stack((np.ones(number), by_offset))
        scatter = problem.scatter(design)
        coefficients, inverse, _ = problem.fit(design, scatter)
        mean = mean_of_student(float(coefficients[0]), sqrt(inverse[0, 0]), number - design.shape[1], level)
        estimate = self.estimate_of(mean, level)
        e = float(np.exp(mean.value))

        velocity = impacts.velocity[used]
        trend = np.column_stack((design, velocity - velocity.mean()))
        sloped, variance, _ = problem.fit(trend, problem.scatter(trend))
        constancy = Constancy(
            e * float(sloped[2]),
            e * sqrt(variance[2, 2]),
            e * float(sloped[2]) * float(np.ptp(velocity)),
            e * sqrt(scatter),
        )
        return ImpactFit(estimate, None, impacts, constancy)


def single_impacts(arcs: Arcs, offset: float, usable: Mask, block: Block) -> Impacts:
    """
    Find e of each impact between two arcs; arguments as for `ImpactByImpact.fit_arcs`.

    Returns
    -------
    impacts : Impacts
        n − 1 of them. Times are the mean, by their errors, of the two arcs' zeros; the interpolated zero where an arc
        has none.
    """
    if arcs.start.size < 2:
        return Impacts()
    times, covariance = arcs.impacts
    errors = np.sqrt(np.diag(covariance))
    peak = arcs.peak_angle - offset
    critical = block.critical_angle_at(peak)
    sound = usable & (np.abs(peak) < critical)
    with np.errstate(invalid="ignore", divide="ignore"):
        energy = np.where(sound, block.p_at(peak) ** 2 * lift(peak, critical), np.nan)
        relative = np.where(sound, energy_slope(peak, critical) * arcs.peak_standard_error, np.nan)
        restitution = np.sqrt(energy[1:] / energy[:-1])
    error = 0.5 * restitution * np.hypot(relative[1:], relative[:-1])
    used = np.isfinite(restitution) & np.isfinite(error)
    return Impacts(times[1:-1], errors[1:-1], np.sqrt(2 * energy[:-1]), restitution, error, used)


@dataclass(frozen=True)
class _ScatteredMean:
    """Values with the covariance of their errors, and a scatter of their own."""

    values: Array
    covariance: Array

    def fit(self, columns: Array, scatter: float) -> tuple[Array, Array, float]:
        """Generalised least squares: coefficients, their covariance, and the weighted sum of squares."""
        unit = np.eye(self.values.size)
        factor = np.linalg.cholesky(self.covariance + scatter * unit + 1e-18 * unit)
        white, values = np.linalg.solve(factor, columns), np.linalg.solve(factor, self.values)
        inverse = np.linalg.pinv(white.T @ white)
        coefficients = inverse @ (white.T @ values)
        return coefficients, inverse, float(((values - white @ coefficients) ** 2).sum())

    def scatter(self, columns: Array) -> float:
        """Variance τ² with which the weighted sum of squares equals its degrees of freedom; 0 if it never does."""
        count = self.values.size
        spare, widest = count - int(columns.shape[1]), float(np.var(self.values)) * count + 1e-12
        # In the eigenvectors of the errors' covariance their variance is diagonal, whatever the scatter.
        variances, vectors = np.linalg.eigh(self.covariance)
        turned, values = vectors.T @ columns, vectors.T @ self.values

        def excess(scatter: float) -> float:
            root = np.sqrt(np.maximum(variances, 0.0) + scatter + 1e-18)
            white, seen = turned / root[:, None], values / root
            normal = np.linalg.pinv(white.T @ white)
            return float(((seen - white @ (normal @ (white.T @ seen))) ** 2).sum()) - spare

        if spare < 1 or excess(0.0) <= 0 or excess(widest) >= 0:
            return 0.0
        return float(scipy.optimize.brentq(excess, 0.0, widest, rtol=1e-3))
