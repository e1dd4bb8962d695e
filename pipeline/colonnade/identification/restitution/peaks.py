"""Coefficient of restitution from the peaks of a free vibration, by Housner's relation between them."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from colonnade.identification.restitution.arcs import Arcs
from colonnade.identification.restitution.energy import angle_of_energy, released_energy
from colonnade.identification.restitution.mixture import Parts, mean_of
from colonnade.identification.restitution.result import Estimate, Peaks

Array = NDArray[np.float64]

NAME = "peaks"
FEWEST_PEAKS = 5

ASSUMPTIONS = (
    "plane rocking without slide or bounce; e of each impact about one mean; the angle's scale and the block's "
    "critical angles; both sides about one zero; p does not enter"
)


def fit_peaks(
    arcs: Arcs, critical: Array, usable: NDArray[np.bool_], noise: float, *, level: float = 0.95
) -> tuple[Estimate, Peaks, float]:
    """
    Identify e from the decay of the peaks' energy.

    Parameters
    ----------
    arcs : Arcs
        n of them.
    critical : ndarray, shape (n,)
        α of the side of each, rad.
    usable : ndarray of bool, shape (n,)
        Peaks that enter.
    noise : float
        Standard deviation of the angle, rad: errors far below it are not believed.
    level : float
        Of the interval.

    Returns
    -------
    estimate : Estimate
    peaks : Peaks
        Less the common zero offset.
    offset : float
        rad.

    Notes
    -----
    The logarithm of the energy of the n-th peak falls by 2 ln e an impact. Variances: that of each peak's own fit,
    scaled where the scatter is larger, and a random walk for an e that differs from impact to impact. The interval is
    a mixture over their ratio by its restricted likelihood (`mixture.mean_of`), the line drawn that of the likeliest.
    """
    unfitted = np.full(arcs.peak_angle.shape, np.nan)
    peaks = Peaks(arcs.peak_time, arcs.peak_angle, arcs.peak_standard_error, unfitted, usable)
    if usable.sum() < FEWEST_PEAKS:
        reason = f"{int(usable.sum())} peaks between two impacts stand above the noise; {FEWEST_PEAKS} are needed."
        return Estimate(NAME, None, None, None, None, level, ASSUMPTIONS, reason), peaks, 0.0
    number = np.flatnonzero(usable).astype(np.float64)
    angle, alpha = arcs.peak_angle[usable], critical[usable]
    error = np.maximum(arcs.peak_standard_error[usable], 1e-3 * max(noise, 1e-9))
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
    mean = mean_of(line.parts, level)
    fitted = np.exp(line.coefficients[0] + line.coefficients[1] * number)
    unfitted[usable] = np.sign(angle) * angle_of_energy(fitted, alpha)
    peaks = Peaks(arcs.peak_time, arcs.peak_angle - offset, arcs.peak_standard_error, unfitted, usable)
    low, value, high = (float(np.exp(bound)) for bound in (mean.low, mean.value, mean.high))
    return Estimate(NAME, value, low, high, value * mean.standard_error, level, ASSUMPTIONS), peaks, offset


@dataclass(frozen=True)
class _Line:
    """Height, slope and zero offset of the likeliest line; what each scatter says of ln e, half the slope."""

    coefficients: Array
    parts: Parts


def _weighted_line(design: Array, values: Array, error: Array, number: Array) -> _Line:
    """
    Generalised least squares with variance s² [diag(error²) + ρ min(i, j)], for each ρ of `RATIOS`.

    The walk begins at the first peak; ρ = 0 is independent scatter alone.
    """
    unit = float(np.median(error) ** 2)
    walk = np.minimum.outer(number - number[0], number - number[0]) / np.outer(error, error) * unit
    # In the eigenvectors of the walk both parts are diagonal.
    spread, vectors = np.linalg.eigh(walk)
    columns, aim = vectors.T @ (design / error[:, None]), vectors.T @ (values / error)
    variance = 1 + np.outer(RATIOS, np.maximum(spread, 0.0))
    normal = (columns.T[None, :, :] / variance[:, None, :]) @ columns
    inverse = np.linalg.inv(normal)
    coefficients = (inverse @ ((columns.T[None, :, :] / variance[:, None, :]) @ aim)[:, :, None])[:, :, 0]
    residual = aim[None, :] - coefficients @ columns.T
    freedom = values.size - design.shape[1]
    scale = np.maximum((residual**2 / variance).sum(axis=1) / freedom, 1e-300)
    volume = np.log(variance).sum(axis=1) + np.linalg.slogdet(normal)[1]
    likelihood = -0.5 * (volume + freedom * np.log(scale))
    # The logarithm of the energy falls by 2 ln e.
    centre, slope_error = coefficients[:, 1] / 2, np.sqrt(inverse[:, 1, 1] * np.maximum(scale, 1.0)) / 2
    scatter = np.sqrt(RATIOS * unit * scale) / 2
    step = float(np.log(RATIOS[2] / RATIOS[1])) / 2
    parts = Parts(scatter, likelihood, centre, slope_error, float(freedom), step)
    return _Line(coefficients[int(np.argmax(likelihood))], parts)


RATIOS = np.concatenate(([0.0], np.geomspace(1e-3, 1e4, 41)))
"""Values of ρ that are tried, in the median variance of the peaks."""
