"""Linear model of a record with stationary noise and its own e at each impact: the likelihood of each scatter of e."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import scipy

from colonnade.arrays import Array
from colonnade.identification.restitution.fitting.mixture import SCATTERS, MeanByScatter
from colonnade.identification.restitution.fitting.noise import passed_power

KNEES = 9
"""Frequencies tried, below which noise of power 1/f exceeds the white noise; white noise alone is tried too."""

PASSED = 0.05
"""Share of power that a low-pass leaves at least of the frequencies that count."""


@dataclass(frozen=True)
class LinearModel:
    """
    Values y = X b + Z d + U c + noise, with d of each impact about 0.

    Attributes
    ----------
    values : ndarray, shape (n,)
        rad; 0 where not counted, as are the rows of the columns.
    fixed : ndarray, shape (n, k)
        X; the first is the derivative by the mean of ln e.
    by_impact : ndarray, shape (n, m)
        Z, by ln e of each impact.
    counted : int
        Of the values.
    least : float
        rad², variance of the noise below which it is rounding.
    interval : float or None
        s; None if the steps are not even and the noise is white.
    cutoff_hz : float or None
        Low-pass that values, but not columns, went through.
    """

    values: Array
    fixed: Array
    by_impact: Array
    counted: int
    least: float
    interval: float | None
    cutoff_hz: float | None


@dataclass(frozen=True)
class Products:
    """
    Products of values and columns with one shape of the noise's spectrum as weight.

    Attributes
    ----------
    matrix : ndarray, shape (1 + k + m, 1 + k + m)
        Of values, X (each of unit length) and Z.
    lengths : ndarray, shape (k,)
        Of the columns X.
    volume : float
        ln of the determinant of the noise's covariance, of unit level.
    freedom : float
        Independent values.
    least : float
        Least level of the noise, rad².
    weights : ndarray or None
        Of the frequencies; None if the noise is white.
    """

    matrix: Array
    lengths: Array
    volume: float
    freedom: float
    least: float
    weights: Array | None


class SpectralModel:
    """A linear model in frequencies."""

    def __init__(self, linear: LinearModel) -> None:
        self.linear = linear
        self.lengths = np.maximum(np.linalg.norm(linear.fixed, axis=0), 1e-300)
        self._columns = np.hstack((linear.values[:, None], linear.fixed / self.lengths, linear.by_impact))
        self._transforms: Array | None = None
        if linear.interval is None:
            return
        from scipy.fft import next_fast_len, rfftfreq

        self._size = next_fast_len(2 * linear.values.size, real=True)
        frequency = rfftfreq(self._size, linear.interval)
        power = np.ones(frequency.size)
        if linear.cutoff_hz is not None:
            power = passed_power(frequency, linear.cutoff_hz, linear.interval)
        self._kept = power > PASSED
        self._gain = np.sqrt(power[self._kept])
        shares = np.full(frequency.size, 2.0 / self._size)
        shares[0] /= 2
        shares[-1] /= 1 if self._size % 2 else 2
        self._shares = shares[self._kept]
        self.frequency = frequency[self._kept]
        # Only the record was filtered: what is taken off it again is white noise, and the sharp columns.
        self._transforms = self._transformed(self._columns)
        self._transforms[:, 0] /= self._gain

    def _transformed(self, columns: Array) -> Array:
        from scipy.fft import rfft

        return np.asarray(rfft(columns, n=self._size, axis=0)[self._kept])

    def products(self, knee: float) -> Products:
        """Products with noise whose power is 1 + knee / frequency (Hz)."""
        if self._transforms is None:
            matrix, counted = self._columns.T @ self._columns, float(self.linear.counted)
            return Products(matrix, self.lengths, 0.0, counted, self.linear.least, None)
        shape, freedom = self._shape(knee)
        weights = np.sqrt(self._shares / shape)
        white = self._transforms * weights[:, None]
        white = np.vstack((white.real, white.imag))
        volume = freedom * float((self._shares * np.log(shape)).sum() / self._shares.sum())
        return Products(white.T @ white, self.lengths, volume, freedom, self.linear.least, weights)

    def products_with(self, columns: Array, products: Products) -> Array:
        """Products of further columns, shape (n, j), with themselves and all others, shape (j, j + 1 + k + m)."""
        if self._transforms is None or products.weights is None:
            return np.hstack((columns.T @ columns, columns.T @ self._columns))
        further = self._transformed(columns) * products.weights[:, None]
        others = self._transforms * products.weights[:, None]
        both = np.hstack((further, others))
        return np.asarray((further.conj().T @ both).real)

    def knees(self) -> Array:
        """Knees to try, Hz: none, and from the record's length to its samples."""
        if self._transforms is None or self.linear.interval is None:
            return np.zeros(1)
        duration = self.linear.values.size * self.linear.interval
        return np.concatenate(([0.0], np.geomspace(0.5 / duration, 0.15 / self.linear.interval, KNEES)))

    def _shape(self, knee: float) -> tuple[Array, float]:
        assert self.linear.interval is not None
        lowest = 0.5 / (self.linear.values.size * self.linear.interval)
        shape = 1 + knee / np.maximum(self.frequency, lowest)
        return shape, self.linear.counted * float(self._shares.sum())


@dataclass(frozen=True)
class Solution:
    """One knee and one scatter: its place, the noise's variance at white level, and the products."""

    knee: float
    scatter: float
    level: float
    products: Products

    def covariance(self) -> Array:
        """Of the coefficients of X, shape (k, k)."""
        count = 1 + self.products.lengths.size
        ratio, inner = self.scatter**2 / self.level, self.products.matrix[count:, count:]
        side = self.products.matrix[count:, 1:count]
        shrunk = np.linalg.solve(np.eye(inner.shape[0]) + ratio * inner, ratio * side)
        normal = self.products.matrix[1:count, 1:count] - side.T @ shrunk
        inverse = np.linalg.pinv(normal, hermitian=True)
        return np.asarray(self.level * inverse / np.outer(self.products.lengths, self.products.lengths))


def solve(transformed: SpectralModel, *, white: bool = False) -> tuple[MeanByScatter, Solution]:
    """
    Fit the linear model with each scatter of `SCATTERS` and each knee, or white noise alone.

    Returns
    -------
    parts : MeanByScatter
        Of the mean of ln e, as a step from where the model was made linear.
    best : Solution
        The likeliest.

    Notes
    -----
    Restricted likelihood (Patterson and Thompson 1971), in Whittle's approximation for noise that is not white; the
    level of the noise at its likeliest.
    """
    rows, best, highest = [], None, -np.inf
    freedom = 1.0
    for knee in [0.0] if white else transformed.knees().tolist():
        products = transformed.products(knee)
        freedom = max(products.freedom - products.lengths.size, 1.0)
        likelihood, centre, error, level, scatter = _by_scatter(products, freedom)
        # White noise is as likely beforehand as all others together.
        likelihood = likelihood - (np.log(KNEES) if knee > 0 else 0.0)
        rows.append((scatter, likelihood, centre, error))
        top = int(np.argmax(likelihood))
        if best is None or likelihood[top] > highest:
            highest = float(likelihood[top])
            best = Solution(knee, float(scatter[top]), float(level[top]), products)
    assert best is not None
    if not np.isfinite(highest):
        raise np.linalg.LinAlgError("the record does not separate the unknowns")
    scatter, likelihood, centre, error = (np.concatenate(column) for column in zip(*rows, strict=True))
    return MeanByScatter(scatter, likelihood, centre, error, freedom), best


def _by_scatter(products: Products, freedom: float) -> tuple[Array, Array, Array, Array, Array]:
    """Likelihood, centre, error, noise level and scatter, for each of `SCATTERS`."""
    count = 1 + products.lengths.size
    spread, vectors = np.linalg.eigh(products.matrix[count:, count:])
    spread = np.maximum(spread, 0.0)
    turned = vectors.T @ products.matrix[count:, :count]
    outer = products.matrix[:count, :count]
    # What lies within the columns of the impacts, and what does not: that of the mean of ln e lies within them.
    inverse = np.where(spread > 1e-13 * spread.max(initial=0.0), 1 / np.maximum(spread, 1e-300), 0.0)
    across = outer - (turned * inverse[:, None]).T @ turned
    left = float(across[0, 0] - across[0, 2:] @ np.linalg.pinv(across[2:, 2:], hermitian=True) @ across[2:, 0])
    level = max(left / max(freedom - spread.size, 1.0), products.least)
    ratio = SCATTERS**2 / level
    shrunk = inverse / (1 + ratio[:, None] * spread)
    reduced = across + np.einsum("mi,sm,mj->sij", turned, shrunk, turned)
    normal, along = reduced[:, 1:, 1:], reduced[:, 1:, :1]
    inverses = np.linalg.inv(normal)
    solution = inverses @ along
    residual = reduced[:, 0, 0] - (along * solution).sum(axis=(1, 2))
    levels = np.maximum(residual / freedom, products.least)
    likelihood = -0.5 * (
        np.log1p(ratio[:, None] * spread).sum(axis=1)
        + np.linalg.slogdet(normal)[1]
        + freedom * np.log(levels)
        + products.volume
    )
    # Rounding may leave nothing of a column where noise is next to none.
    sound = (inverses[:, 0, 0] > 0) & np.isfinite(likelihood)
    likelihood = np.where(sound, likelihood, -np.inf)
    error = np.sqrt(np.where(sound, inverses[:, 0, 0], 1.0) * levels) / products.lengths[0]
    return likelihood, solution[:, 0, 0] / products.lengths[0], error, levels, SCATTERS * np.sqrt(levels / level)


def explained(transformed: SpectralModel, solved: Solution, columns: Array) -> float:
    """
    Probability that noise and scatter alone let further columns explain as much as they do (F-test).

    Parameters
    ----------
    transformed : SpectralModel
    solved : Solution
    columns : ndarray, shape (n, j)
    """
    products = solved.products
    lengths = np.linalg.norm(columns, axis=0)
    columns = columns[:, lengths > 0] / lengths[lengths > 0]
    further = transformed.products_with(columns, products)
    own, others = further[:, : columns.shape[1]], further[:, columns.shape[1] :]
    count = 1 + products.lengths.size
    ratio = solved.scatter**2 / solved.level
    inner = products.matrix[count:, count:]
    # Of d a prior, of X none.
    scattered = np.linalg.solve(np.eye(inner.shape[0]) + ratio * inner, ratio * np.eye(inner.shape[0]))
    scattered = (scattered + scattered.T) / 2
    side, mixed = products.matrix[count:, :count], others[:, count:]
    outer = products.matrix[:count, :count] - side.T @ scattered @ side
    cross = others[:, :count] - mixed @ scattered @ side
    own = own - mixed @ scattered @ mixed.T
    inverse = np.linalg.pinv(outer[1:, 1:], hermitian=True)
    own = own - cross[:, 1:] @ inverse @ cross[:, 1:].T
    score = cross[:, 0] - cross[:, 1:] @ inverse @ outer[1:, 0]
    scale = np.sqrt(np.maximum(np.diag(own), 1e-300))
    values, vectors = np.linalg.eigh(own / np.outer(scale, scale))
    known = values > 1e-6
    gained = ((vectors.T @ (score / scale))[known] ** 2 / values[known]).sum() / solved.level
    freed = int(known.sum())
    rest = max(products.freedom - products.lengths.size - freed, 1.0)
    return float(scipy.stats.f.sf(gained / max(freed, 1), max(freed, 1), rest))
