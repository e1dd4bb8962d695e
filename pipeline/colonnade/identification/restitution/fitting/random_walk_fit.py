"""Weighted least squares with an e that scatters from impact to impact: a random walk added to the errors."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
import scipy

from colonnade.arrays import Array


@dataclass(frozen=True)
class RandomWalkFit:
    """
    Coefficients with their covariance.

    Attributes
    ----------
    coefficients : ndarray, shape (k,)
    covariance : ndarray, shape (k, k)
        Scaled up where the residuals are larger than their errors.
    freedom : int
        Degrees of freedom.
    """

    coefficients: Array
    covariance: Array
    freedom: int

    def error(self, index: int) -> float:
        """Standard error of a coefficient."""
        return float(np.sqrt(self.covariance[index, index]))

    def is_sure(self, index: int, deviations: float) -> bool:
        """Whether a coefficient is not zero, as sure as `deviations` of a normal distribution are; by Student's t."""
        chance = 2 * float(scipy.special.ndtr(-deviations))
        ratio = abs(float(self.coefficients[index])) / max(self.error(index), 1e-300)
        return bool(2 * float(scipy.special.stdtr(self.freedom, -ratio)) < chance)


@dataclass(frozen=True)
class RandomWalkProblem:
    """
    Values to be fitted with variance s² [covariance + ρ walk], s not below 1.

    Attributes
    ----------
    design : ndarray, shape (n, k)
    values : ndarray, shape (n,)
    covariance, walk : ndarray, shape (n, n)
        Of the errors; of what one unit of scatter at each impact adds up to.
    """

    design: Array
    values: Array
    covariance: Array
    walk: Array

    def fit(self, extra: Array | None = None) -> RandomWalkFit:
        """
        Fit with the ρ of the largest restricted likelihood (Patterson and Thompson 1971); ρ = 0: no scatter of e.

        Parameters
        ----------
        extra : ndarray, shape (n,), optional
            Column of one unknown more, which comes last.

        Raises
        ------
        ValueError
            If there are not more values than coefficients.
        """
        design = self.design if extra is None else np.column_stack((self.design, extra))
        count, unknowns = design.shape
        if count <= unknowns:
            raise ValueError(f"{count} values for {unknowns} coefficients; more values were expected")
        lengths = _lengths(design)
        turned = self._turned(np.column_stack((self.values, design / lengths)))
        return _likeliest(turned, 1 + np.outer(RATIOS, self._spectrum[1]), lengths)

    def gains(self, columns: Array) -> Array:
        """
        Say by how much each of several columns, shape (n, m), taken by itself would lower −2 ln of the likelihood.

        Returns
        -------
        gains : ndarray, shape (m,)
            Of the lowest over all ρ, with and without the column.
        """
        count, split = self.values.size, 1 + columns.shape[1]
        turned = self._turned(np.column_stack((self.values, columns, self.design / _lengths(self.design))))
        variance = 1 + np.outer(RATIOS, self._spectrum[1])
        white = turned / np.sqrt(variance)[:, :, None]
        basis, _ = np.linalg.qr(white[:, :, split:])
        left = white[:, :, :split] - basis @ (basis.transpose(0, 2, 1) @ white[:, :, :split])
        along = (left[:, :, :1].transpose(0, 2, 1) @ left)[:, 0]
        explained = along[:, 1:] ** 2 / np.maximum((left[:, :, 1:] ** 2).sum(axis=1), 1e-300)
        power, volume = along[:, 0], np.log(variance).sum(axis=1)
        without = (volume + _misfit(power, count)[0]).min()
        lowest = volume[:, None] + _misfit(power[:, None] - explained, count)[0]
        return np.asarray(without - lowest.min(axis=0))

    def _turned(self, columns: Array) -> Array:
        """Turn columns so that their variance is diagonal at any ρ: 1 + ρ times the spectrum."""
        return np.asarray(self._spectrum[0] @ columns)

    @cached_property
    def _spectrum(self) -> tuple[Array, Array]:
        """Matrix that whitens the errors and turns the walk into a diagonal; that diagonal, in the median variance."""
        # Errors of an energy and of a duration differ by orders of magnitude: their own sizes are taken out first.
        sizes = np.sqrt(np.diag(self.covariance))
        factor = np.linalg.cholesky(self.covariance / np.outer(sizes, sizes))
        whitening = np.linalg.inv(factor) / sizes
        values, vectors = np.linalg.eigh(whitening @ self.walk @ whitening.T)
        unit = float(np.median(sizes**2))
        return vectors.T @ whitening, unit * np.maximum(values, 0.0)


def _lengths(design: Array) -> Array:
    """Sizes of the columns: offsets in rad are fitted with counts of impacts."""
    return np.asarray(np.sqrt((design**2).sum(axis=0)))


def _likeliest(turned: Array, variance: Array, lengths: Array) -> RandomWalkFit:
    """Fit values, the first column, by the others with each row of variances; the fit of least restricted criterion."""
    white = turned / np.sqrt(variance)[:, :, None]
    seen, columns = white[:, :, :1], white[:, :, 1:]
    normal = columns.transpose(0, 2, 1) @ columns
    inverse = np.linalg.pinv(normal, hermitian=True)
    coefficients = inverse @ (columns.transpose(0, 2, 1) @ seen)
    left = (seen - columns @ coefficients)[:, :, 0]
    freedom = left.shape[1] - lengths.size
    misfit, scale = _misfit((left**2).sum(axis=1), freedom)
    best = int(np.argmin(np.log(variance).sum(axis=1) + np.linalg.slogdet(normal)[1] + misfit))
    spread = inverse[best] * scale[best] / np.outer(lengths, lengths)
    return RandomWalkFit(coefficients[best, :, 0] / lengths, spread, freedom)


def _misfit(power: Array, freedom: int) -> tuple[Array, Array]:
    """What weighted squares add to −2 ln of the likelihood, and the scale of variances: as given or larger."""
    scale = np.maximum(power / freedom, 1.0)
    return freedom * np.log(scale) + power / scale, scale


RATIOS = np.concatenate(([0.0], np.geomspace(1e-3, 1e4, 15)))
"""Values of ρ that are tried, in the median variance of the errors."""
