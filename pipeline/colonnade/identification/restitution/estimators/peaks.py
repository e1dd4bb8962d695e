"""Coefficient of restitution from the peaks of a free vibration, by Housner's relation between them."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from colonnade.arrays import Array
from colonnade.identification.restitution.arcs.energy import angle_of_energy, released_energy
from colonnade.identification.restitution.estimators.estimator import Estimator, Fit
from colonnade.identification.restitution.fitting.mixture import MeanByScatter, mean_over_scatters
from colonnade.identification.restitution.free_vibration import FreeVibration
from colonnade.identification.restitution.result import Peaks

FEWEST_PEAKS = 5


@dataclass(frozen=True)
class PeakFit(Fit):
    """The estimate, the peaks less their common zero offset, and that offset (rad)."""

    peaks: Peaks | None = None
    offset: float = 0.0

    @property
    def zero_offset(self) -> float:
        """Offset that the peaks have in common, rad."""
        return self.offset


class PeakDecay(Estimator[PeakFit]):
    """
    e from the decay of the peaks' energy.

    Notes
    -----
    The logarithm of the energy of the n-th peak falls by 2 ln e an impact. Variances: that of each peak's own fit,
    scaled if the scatter is larger, and a random walk for an e that differs from impact to impact. The interval is
    a mixture over their ratio by its restricted likelihood (`mixture.mean_over_scatters`), the line drawn that of the
    likeliest.
    """

    name = "peaks"
    label = "peaks"
    assumptions = (
        "plane rocking without slide or bounce; e of each impact about one mean; the angle's scale and the block's "
        "critical angles; both sides about one zero; p does not enter"
    )
    description = (
        "ln of the energy of each peak, from a local fit of its arc, against the impact number; weighted, with a "
        "common zero offset, and a scatter of e from impact to impact by restricted maximum likelihood"
    )
    references = ("patterson",)
    method = "peaks: log-energy against impact number, weighted, common zero offset, random-walk scatter (REML)"
    priority = 2
    result = PeakFit

    def fit(self, record: FreeVibration) -> PeakFit:
        """Fit a line to the peaks; errors far below the noise of the angle are not believed."""
        arcs, usable = record.arcs, record.usable
        if usable.sum() < FEWEST_PEAKS:
            needed = f"At least {FEWEST_PEAKS} peaks between two impacts, above the noise, are needed"
            reason = f"{needed}; the record has {int(usable.sum())}."
            return self.refuse(record.level, reason)
        number = np.flatnonzero(usable).astype(np.float64)
        angle = arcs.peak_angle[usable]
        alpha = record.block.critical_angle_at(angle)
        error = np.maximum(arcs.peak_standard_error[usable], 1e-3 * max(record.noise, 1e-9))
        offset, line = 0.0, None
        for _ in range(6):
            # The common zero offset is the third unknown: it moves peaks of opposite sign in opposite ways.
            moved = np.abs(angle - offset)
            energy = released_energy(moved, alpha)
            gradient = np.sin(alpha - moved) / (1 - np.cos(alpha)) / energy
            design = np.column_stack((np.ones_like(number), number, np.sign(angle) * gradient))
            line = _weighted_line(design, np.log(energy), gradient * error, number)
            step = float(line.coefficients[2])
            offset += step
            if abs(step) < 1e-9 or not np.abs(angle - offset).min() > 0:
                break
        assert line is not None
        fitted = np.full(arcs.peak_angle.shape, np.nan)
        energy = np.exp(line.coefficients[0] + line.coefficients[1] * number)
        fitted[usable] = np.sign(angle) * angle_of_energy(energy, alpha)
        peaks = replace(record.peaks, angle=arcs.peak_angle - offset, fitted_angle=fitted)
        mean = mean_over_scatters(line.parts, record.level)
        return PeakFit(self.estimate_of(mean, record.level), None, peaks, offset)


@dataclass(frozen=True)
class _Line:
    """Height, slope and zero offset of the likeliest line; what each scatter says of ln e, half the slope."""

    coefficients: Array
    parts: MeanByScatter


def _weighted_line(design: Array, values: Array, error: Array, number: Array) -> _Line:
    """
    Generalised least squares with variance s² [diag(error²) + ρ min(i, j)], s not below 1, for each ρ of `RATIOS`.

    The walk begins at the first peak; ρ = 0 is independent scatter alone.
    """
    unit = float(np.median(error) ** 2)
    walk = np.minimum.outer(number - number[0], number - number[0]) / np.outer(error, error) * unit
    # In the eigenvectors of the walk both parts are diagonal.
    widths, vectors = np.linalg.eigh(walk)
    columns, aim = vectors.T @ (design / error[:, None]), vectors.T @ (values / error)
    variance = 1 + np.outer(RATIOS, np.maximum(widths, 0.0))
    normal = (columns.T[None, :, :] / variance[:, None, :]) @ columns
    inverse = np.linalg.inv(normal)
    coefficients = (inverse @ ((columns.T[None, :, :] / variance[:, None, :]) @ aim)[:, :, None])[:, :, 0]
    residual = aim[None, :] - coefficients @ columns.T
    freedom = values.size - design.shape[1]
    power = (residual**2 / variance).sum(axis=1)
    # Errors are as given or larger, in the likelihood too: it would else prefer a walk that they are too large for.
    scale = np.maximum(power / freedom, 1.0)
    volume = np.log(variance).sum(axis=1) + np.linalg.slogdet(normal)[1]
    likelihood = -0.5 * (volume + freedom * np.log(scale) + power / scale)
    # The logarithm of the energy falls by 2 ln e.
    centre, slope_error = coefficients[:, 1] / 2, np.sqrt(inverse[:, 1, 1] * scale) / 2
    scatter = np.sqrt(RATIOS * unit * scale) / 2
    step = float(np.log(RATIOS[2] / RATIOS[1])) / 2
    parts = MeanByScatter(scatter, likelihood, centre, slope_error, float(freedom), step)
    return _Line(coefficients[int(np.argmax(likelihood))], parts)


RATIOS = np.concatenate(([0.0], np.geomspace(1e-3, 1e4, 41)))
"""Values of ρ that are tried, in the median variance of the peaks."""
