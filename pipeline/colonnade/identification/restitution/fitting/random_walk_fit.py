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
        chance = 2 * float(scipy.stats.norm.sf(deviations))
        ratio = abs(float(self.coefficients[index])) / max(self.error(index), 1e-300)
        return bool(2 * float(scipy.stats.t.sf(ratio, self.freedom)) < chance)


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
        fits = (_fit(turned[:, 0], turned[:, 1:], 1 + ratio * self._spectrum[1], lengths) for ratio in RATIOS)
        return min(fits, key=lambda found: found[0])[1]

    def gains(self, columns: Array) -> Array:
        """
        Say by how much each of several columns, shape (n, m), taken by itself would lower −2 ln of the likelihood.

        Returns
        -------
        gains : ndarray, shape (m,)
            Of the lowest over all ρ, with and without the column.
        """
        lowest, without = np.full(columns.shape[1], np.inf), np.inf
        count, split = self.values.size, 1 + columns.shape[1]
        turned = self._turned(np.column_stack((self.values, columns, self.design / _lengths(self.design))))
        for ratio in RATIOS:
            variance = 1 + ratio * self._spectrum[1]
            white = turned / np.sqrt(variance)[:, None]
            volume = float(np.log(variance).sum())
            basis, _ = np.linalg.qr(white[:, split:])
            left = white[:, :split] - basis @ (basis.T @ white[:, :split])
            power = float(left[:, 0] @ left[:, 0])
            explained = (left[:, 1:].T @ left[:, 0]) ** 2 / np.maximum((left[:, 1:] ** 2).sum(axis=0), 1e-300)
            without = min(without, volume + count * float(np.log(power / count)))
            lowest = np.minimum(lowest, volume + count * np.log(np.maximum(power - explained, 1e-300) / count))
        return np.asarray(without - lowest)

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


def _fit(seen: Array, columns: Array, variance: Array, lengths: Array) -> tuple[float, RandomWalkFit]:
    """Return the restricted criterion and the fit, with independent values of given variance."""
    root = np.sqrt(variance)
    seen, columns = seen / root, columns / root[:, None]
    normal = columns.T @ columns
    inverse = np.linalg.pinv(normal, hermitian=True)
    coefficients = inverse @ (columns.T @ seen)
    left = seen - columns @ coefficients
    freedom = seen.size - lengths.size
    scale = max(float(left @ left) / freedom, 1e-12)
    spread = inverse * max(scale, 1.0) / np.outer(lengths, lengths)
    volume = float(np.log(variance).sum())
    restricted = volume + float(np.linalg.slogdet(normal)[1]) + freedom * float(np.log(scale))
    return restricted, RandomWalkFit(coefficients / lengths, spread, freedom)


RATIOS = np.concatenate(([0.0], np.geomspace(1e-3, 1e4, 15)))
"""Values of ρ that are tried, in the median variance of the errors."""
