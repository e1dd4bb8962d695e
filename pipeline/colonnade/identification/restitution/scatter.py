"""What a record says of the mean of ln e, and of α and p, for each scatter that e may have from impact to impact."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import scipy

from colonnade.arrays import Array

SCALE = 0.002
"""Scatter of ln e from impact to impact that weighs most; ..."""

SMALLER, LARGER = 0.7, 0.5
"""... powers with which the weight falls off towards smaller and larger ones, by their logarithm."""

NO_SCATTER = 4.0
"""Times that the record is to be likelier with one e for all impacts before it is taken to have one."""

SCATTERS = np.concatenate(([0.0], np.geomspace(3e-6, 0.1, 45)))
"""Standard deviations of ln e from impact to impact that are tried."""

NEGLIGIBLE = 1e-8
"""Weight of a part of the mixture that is left out; share of a column's square that is rounding."""


@dataclass(frozen=True)
class LinearModel:
    """
    Products of a record's model about a path: values y = X b + Z d + noise, with priors of b, and d about 0.

    Attributes
    ----------
    products : ndarray, shape (1 + k + m, 1 + k + m)
        Of y, X and Z with each other, for noise that is white.
    precision, origin : ndarray, shape (k,)
        1 / variance of each of b about 0 beforehand (0: nothing known), and b of the path, from which y is left.
    level : float
        Variance of the noise.
    """

    products: Array
    precision: Array
    origin: Array
    level: float

    @classmethod
    def of(cls, products: Array, precision: Array, origin: Array, samples: float, least: float) -> LinearModel:
        """Set up the model, the level of the noise being what nothing explains, over so many samples."""
        across, _, _ = _split(products, precision.size)
        size = np.sqrt(np.maximum(np.diag(across), 1e-300))
        # The mean of ln e is a sum of columns of Z.
        free = np.flatnonzero(np.diag(across)[1:] > NEGLIGIBLE * np.diag(products)[1 : size.size]) + 1
        scaled = across / np.outer(size, size)
        # Columns that are nearly one another leave directions of rounding alone.
        inverse = np.linalg.pinv(scaled[np.ix_(free, free)], rcond=1e-12, hermitian=True)
        left = across[0, 0] * (1 - scaled[0, free] @ inverse @ scaled[free, 0])
        level = max(float(left) / max(samples - products.shape[0] + 1, 1.0), least)
        return cls(products, precision, origin, level)

    def with_direction(self, direction: Array, precision: float = 0.0) -> LinearModel:
        """Return the model with one more unknown, the last of b: Z times a direction, shape (m,); 1 / its variance."""
        k = self.precision.size
        turn = np.eye(self.products.shape[0])
        added = np.zeros(turn.shape[0])
        added[1 + k :] = direction
        turn = np.insert(turn, 1 + k, added, axis=1)
        return LinearModel(
            turn.T @ self.products @ turn, np.append(self.precision, precision), np.append(self.origin, 0.0), self.level
        )

    def solved(self) -> Solved:
        """
        Solve the model for each scatter.

        Raises
        ------
        numpy.linalg.LinAlgError
            If the record does not separate the unknowns.
        """
        k = self.precision.size
        across, turned, spread = _split(self.products, k)
        variance = self.level + SCATTERS[:, None] ** 2 * spread
        matrices = across / self.level + np.einsum("ji,tj,jk->tik", turned, 1 / (spread * variance), turned)
        normal = matrices[:, 1:, 1:] + np.diag(self.precision)
        right = matrices[:, 1:, 0] - self.precision * self.origin
        scale = np.sqrt(np.maximum(np.diagonal(normal, axis1=1, axis2=2), 1e-300))
        scaled = normal / (scale[:, :, None] * scale[:, None, :])
        sign, volume = np.linalg.slogdet(scaled)
        inverse = np.linalg.inv(scaled) / (scale[:, :, None] * scale[:, None, :])
        solution = (inverse @ right[:, :, None])[:, :, 0]
        squares = matrices[:, 0, 0] + self.precision @ self.origin**2 - (right * solution).sum(axis=1)
        likelihood = -0.5 * (
            np.log(variance / self.level).sum(axis=1) + volume + 2 * np.log(scale).sum(axis=1) + squares
        )
        sound = (sign > 0) & np.isfinite(likelihood) & (np.diagonal(inverse, axis1=1, axis2=2) > 0).all(axis=1)
        if not sound.any():
            raise np.linalg.LinAlgError("the record does not separate the unknowns")
        return Solved(self.origin + solution, inverse, _weights(np.where(sound, likelihood, -np.inf)))


@dataclass(frozen=True)
class Solved:
    """
    Unknowns b for each of `SCATTERS`.

    Attributes
    ----------
    centres, covariances : ndarray, shape (s, k), (s, k, k)
    weights : ndarray, shape (s,)
        Of each scatter; their sum is 1.
    """

    centres: Array
    covariances: Array
    weights: Array

    @property
    def scatter(self) -> float:
        """Mean scatter; 0 for one e at all impacts."""
        return float(self.weights @ SCATTERS)

    @property
    def mean(self) -> Array:
        """Posterior mean of b, shape (k,)."""
        return np.asarray(self.weights @ self.centres)

    @property
    def covariance(self) -> Array:
        """Of b over all scatters, shape (k, k)."""
        apart = self.centres - self.mean
        return np.asarray(
            np.einsum("t,tij->ij", self.weights, self.covariances)
            + np.einsum("t,ti,tj->ij", self.weights, apart, apart)
        )

    def quantile(self, share: float) -> float:
        """Value of the first of b below which there is a share of its distribution."""
        kept = self.weights > NEGLIGIBLE
        weight, centre = self.weights[kept], self.centres[kept, 0]
        error = np.sqrt(self.covariances[kept, 0, 0])

        def excess(value: float) -> float:
            return float(weight @ scipy.special.ndtr((value - centre) / error)) - share * float(weight.sum())

        reach = 10 * error.max() + np.ptp(centre)
        return float(scipy.optimize.brentq(excess, centre.min() - reach, centre.max() + reach, xtol=1e-4 * error.min()))


def _split(products: Array, unknowns: int) -> tuple[Array, Array, Array]:
    """
    Split products of y and X into what lies across all of Z and along it.

    Returns
    -------
    across : ndarray, shape (1 + k, 1 + k)
    turned : ndarray, shape (m, 1 + k)
        Products with the eigenvectors of Z.
    spread : ndarray, shape (m,)
        Their squares; those of directions without effect are left out.
    """
    first = 1 + unknowns
    spread, vectors = np.linalg.eigh(products[first:, first:])
    seen = spread > 1e-13 * spread[-1]
    spread, turned = spread[seen], vectors[:, seen].T @ products[first:, :first]
    return products[:first, :first] - turned.T @ (turned / spread[:, None]), turned, spread


def _weights(likelihood: Array) -> Array:
    """
    Weigh each scatter.

    Notes
    -----
    The scatter of a few impacts is badly known, and an interval that takes the likeliest one is too narrow. Each
    scatter counts by its restricted likelihood (Patterson and Thompson 1971) times a weight, as in a random-effects
    meta-analysis of few studies (Röver 2020). Only if one e for all impacts is `NO_SCATTER` times as likely as all of
    these together is there no scatter. These numbers were set by simulation: docs/decisions/0024.
    """
    relative = np.exp(likelihood - likelihood.max())
    size = SCATTERS[1:] / SCALE
    height = (SMALLER + LARGER) * np.sin(np.pi * SMALLER / (SMALLER + LARGER)) / np.pi
    prior = height * size**SMALLER / (1 + size ** (SMALLER + LARGER)) * np.log(SCATTERS[2] / SCATTERS[1])
    weight = np.append(0.0, relative[1:] * prior)
    if relative[0] > NO_SCATTER * weight.sum():
        weight = np.append(1.0, np.zeros(size.size))
    return np.asarray(weight / weight.sum())
