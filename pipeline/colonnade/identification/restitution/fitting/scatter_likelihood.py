"""What a linear model of a record says of the mean of ln e, for each scatter of e and each spectrum of the noise."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
import scipy
from numpy.typing import NDArray

from colonnade.arrays import Array
from colonnade.identification.restitution.fitting.mixture import SCATTERS, MeanByScatter
from colonnade.identification.restitution.fitting.scatter_model import KNEES, Products


@dataclass(frozen=True)
class Solution:
    """One scatter with the products of one knee, and the noise's variance at white level."""

    scatter: float
    level: float
    products: Products

    def covariance(self) -> Array:
        """Of the coefficients of X, shape (k, k)."""
        ratio, inner, side = self.scatter**2 / self.level, self.products.inner, self.products.side[:, 1:]
        shrunk = np.linalg.solve(np.eye(inner.shape[0]) + ratio * inner, ratio * side)
        normal = self.products.outer[1:, 1:] - side.T @ shrunk
        inverse = np.linalg.pinv(normal, hermitian=True)
        return np.asarray(self.level * inverse / np.outer(self.products.lengths, self.products.lengths))


@dataclass(frozen=True)
class Reduction:
    """
    Products of values and X, weighted by noise and scatter together: for s knees and each of `SCATTERS`.

    Attributes
    ----------
    tried : sequence of Products
    matrices : ndarray, shape (s, scatters, 1 + k, 1 + k)
    lengths : ndarray, shape (k,)
        Of the columns X.
    levels : ndarray, shape (s, 1)
        Level of the noise, in whose unit the scatters are tried, rad².
    volumes : ndarray, shape (s, scatters)
        ln of the determinant of the covariance, of unit level.
    """

    tried: Sequence[Products]
    matrices: Array
    lengths: Array
    levels: Array
    volumes: Array

    def of_columns(self, columns: NDArray[np.int_]) -> Reduction:
        """Return the products of some columns of X, in this order."""
        rows = np.append(0, 1 + columns)
        return replace(self, matrices=self.matrices[:, :, rows[:, None], rows], lengths=self.lengths[columns])


def reduced(tried: Sequence[Products], direction: Array | None = None) -> Reduction:
    """
    Weight products by the scatter of e, too.

    Parameters
    ----------
    tried : sequence of Products
        One for each knee.
    direction : ndarray, shape (m,), optional
        Its product with Z becomes the last column of X.
    """
    unknowns = tried[0].lengths.size
    all_columns = tried
    if direction is not None:
        # One length for all knees, as of the other columns.
        length = tried[0].length_along(direction)
        all_columns = [products.with_along(direction, length) for products in tried]
    outer, side = np.array([each.outer for each in all_columns]), np.array([each.side for each in all_columns])
    spread, vectors = np.linalg.eigh(np.array([each.inner for each in tried]))
    spread = np.maximum(spread, 0.0)[:, :, None]
    turned = vectors.transpose(0, 2, 1) @ side
    # What lies within the columns of the impacts, and what does not: that of the mean of ln e lies within them.
    inverse = np.where(spread > 1e-13 * spread.max(axis=1, keepdims=True), 1 / np.maximum(spread, 1e-300), 0.0)
    across = outer - (turned * inverse).transpose(0, 2, 1) @ turned
    beside, others = across[:, :1, 2 : 1 + unknowns], across[:, 2 : 1 + unknowns, 2 : 1 + unknowns]
    left = across[:, 0, 0] - (beside @ np.linalg.pinv(others, hermitian=True) @ beside.transpose(0, 2, 1))[:, 0, 0]
    freedom, least = np.array([(each.freedom, each.least) for each in tried]).T
    levels = np.maximum(left / np.maximum(freedom - unknowns - spread.shape[1], 1.0), least)[:, None]
    scaled = SCATTERS**2 / levels
    growth = 1 + scaled[:, :, None] * spread.transpose(0, 2, 1)
    squares = (turned[:, :, :, None] * turned[:, :, None, :]).reshape(*spread.shape[:2], -1)
    within = (inverse.transpose(0, 2, 1) / growth) @ squares
    matrices = across[:, None] + within.reshape(*scaled.shape, *across.shape[1:])
    volumes = np.log(growth).sum(axis=2) + np.array([[each.volume] for each in tried])
    return Reduction(tried, matrices, all_columns[0].lengths, levels, volumes)


def solve(reduction: Reduction) -> tuple[MeanByScatter, Solution]:
    """
    Fit the linear model with each scatter and each knee.

    Returns
    -------
    parts : MeanByScatter
        Of the first coefficient, the mean of ln e, as a step from where the model was made linear.
    best : Solution
        The likeliest.

    Raises
    ------
    numpy.linalg.LinAlgError
        If the record does not separate the unknowns.

    Notes
    -----
    Restricted likelihood (Patterson and Thompson 1971), in Whittle's approximation for noise that is not white; the
    level of the noise at its likeliest.
    """
    tried, matrices, length = reduction.tried, reduction.matrices, reduction.lengths[0]
    freedom = np.array([[max(each.freedom - reduction.lengths.size, 1.0)] for each in tried])
    normal, along = matrices[:, :, 1:, 1:], matrices[:, :, 1:, :1]
    inverses = np.linalg.inv(normal)
    solution = inverses @ along
    residual = matrices[:, :, 0, 0] - (along * solution).sum(axis=(2, 3))
    levels = np.maximum(residual / freedom, tried[0].least)
    likelihood = -0.5 * (reduction.volumes + np.linalg.slogdet(normal)[1] + freedom * np.log(levels))
    # White noise is as likely beforehand as all others together.
    likelihood -= np.where([[each.knee > 0] for each in tried], np.log(KNEES), 0.0)
    # Rounding may leave nothing of a column where noise is next to none.
    variance = inverses[:, :, 0, 0]
    sound = (variance > 0) & np.isfinite(likelihood)
    likelihood = np.where(sound, likelihood, -np.inf)
    if not sound.any():
        raise np.linalg.LinAlgError("the record does not separate the unknowns")
    scatter = SCATTERS * np.sqrt(levels / reduction.levels)
    error = np.sqrt(np.where(sound, variance, 1.0) * levels) / length
    knee, top = np.unravel_index(int(np.argmax(likelihood)), likelihood.shape)
    best = Solution(float(scatter[knee, top]), float(levels[knee, top]), tried[int(knee)])
    centre = solution[:, :, 0, 0] / length
    parts = MeanByScatter(scatter.ravel(), likelihood.ravel(), centre.ravel(), error.ravel(), float(freedom[-1, 0]))
    return parts, best


def explained(solved: Solution, own: Array, others: Array) -> float:
    """
    Probability that noise and scatter alone let further columns explain as much as they do (F-test).

    Parameters
    ----------
    solved : Solution
    own : ndarray, shape (j, j)
        Products of the further columns with each other (`SpectralModel.products_with`).
    others : ndarray, shape (j, 1 + k + m)
        With the values, X and Z.
    """
    products = solved.products
    lengths = np.sqrt(np.diag(own))
    there = lengths > 0
    lengths = lengths[there]
    own, others = own[np.ix_(there, there)] / np.outer(lengths, lengths), others[there] / lengths[:, None]
    ratio, inner, side = solved.scatter**2 / solved.level, products.inner, products.side
    # Of d a prior, of X none.
    scattered = np.linalg.solve(np.eye(inner.shape[0]) + ratio * inner, ratio * np.eye(inner.shape[0]))
    scattered = (scattered + scattered.T) / 2
    mixed = others[:, side.shape[1] :] @ scattered
    outer = products.outer - side.T @ scattered @ side
    cross = others[:, : side.shape[1]] - mixed @ side
    own = own - mixed @ others[:, side.shape[1] :].T
    inverse = np.linalg.pinv(outer[1:, 1:], hermitian=True)
    own = own - cross[:, 1:] @ inverse @ cross[:, 1:].T
    score = cross[:, 0] - cross[:, 1:] @ inverse @ outer[1:, 0]
    scale = np.sqrt(np.maximum(np.diag(own), 1e-300))
    values, vectors = np.linalg.eigh(own / np.outer(scale, scale))
    known = values > 1e-6
    gained = ((vectors.T @ (score / scale))[known] ** 2 / values[known]).sum() / solved.level
    freed = int(known.sum())
    rest = max(products.freedom - products.lengths.size - freed, 1.0)
    return float(scipy.special.fdtrc(max(freed, 1), rest, gained / max(freed, 1)))
