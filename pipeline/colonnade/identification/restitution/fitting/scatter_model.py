"""Linear model of a record with its own e at each impact: its products, for each spectrum that the noise may have."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from colonnade.arrays import Array
from colonnade.identification.restitution.fitting.noise import passed_power

KNEES = 9
"""Frequencies tried, below which noise of power 1/f exceeds the white noise; white noise alone is tried too."""

BAND = 0.02
"""Width of a band of frequencies, as a share of its lowest, over which the noise's spectrum is taken as even."""

AT_ONCE = 16
"""Bands whose products are added up together: they stay in the processor's memory."""

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
    knee : float
        Hz.
    outer : ndarray, shape (1 + k, 1 + k)
        Of values and X (each of unit length).
    side : ndarray, shape (m, 1 + k)
        Of Z with them.
    inner : ndarray, shape (m, m)
        Of Z.
    lengths : ndarray, shape (k,)
        Of the columns X.
    volume : float
        ln of the determinant of the noise's covariance, of unit level.
    freedom : float
        Independent values.
    least : float
        Least level of the noise, rad².
    """

    knee: float
    outer: Array
    side: Array
    inner: Array
    lengths: Array
    volume: float
    freedom: float
    least: float

    def length_along(self, direction: Array) -> float:
        """Length of Z times a direction, shape (m,)."""
        return max(float(np.sqrt(direction @ self.inner @ direction)), 1e-300)

    def with_along(self, direction: Array, length: float) -> Products:
        """Return the products with one more column of X, the last: Z times a direction, shape (m,), over a length."""
        along, across = self.inner @ direction / length, direction @ self.side / length
        last = np.append(across, direction @ along / length)
        outer = np.vstack((np.column_stack((self.outer, last[:-1])), last))
        side = np.column_stack((self.side, along))
        return replace(self, outer=outer, side=side, lengths=np.append(self.lengths, length))


class SpectralModel:
    """A linear model in frequencies."""

    def __init__(self, linear: LinearModel) -> None:
        self.linear = linear
        self.lengths = np.maximum(np.linalg.norm(linear.fixed, axis=0), 1e-300)
        self._rows = np.vstack((linear.values, (linear.fixed / self.lengths).T, linear.by_impact.T))

    def white(self) -> Products:
        """Products with white noise."""
        rows = self._rows if self._is_plain(0.0) else self._transforms
        return self._split(0.0, rows @ rows.T, 0.0)

    def all_products(self) -> list[Products]:
        """Products with white noise, and with knees from the record's length to its samples."""
        if self.linear.interval is None:
            return [self.white()]
        duration = self.linear.values.size * self.linear.interval
        knees = np.geomspace(0.5 / duration, 0.15 / self.linear.interval, KNEES)
        edges, middle = self._bands
        # Without a knee: white noise.
        shapes = 1 + np.append(0.0, knees)[:, None] / middle
        count = self._rows.shape[0]
        sums, some = np.zeros((1 + KNEES, count * count)), np.empty((AT_ONCE, count, count))
        for first in range(0, middle.size, AT_ONCE):
            bands = edges[first : first + AT_ONCE + 1]
            for product, (low, high) in zip(some, pairwise((2 * bands).tolist()), strict=False):
                inside = self._transforms[:, low:high]
                np.matmul(inside, inside.T, out=product)
            sums += (1 / shapes[:, first : first + AT_ONCE]) @ some[: bands.size - 1].reshape(bands.size - 1, -1)
        weight = np.add.reduceat(_shares(self._size)[: edges[-1]], edges[:-1])
        volumes = self._freedom * (np.log(shapes) @ weight) / weight.sum()
        matrices = sums.reshape(1 + KNEES, count, count)
        return [self._split(*each) for each in zip([0.0, *knees.tolist()], matrices, volumes.tolist(), strict=True)]

    def products_by_stretch(self, values: Array, starts: NDArray[np.int_], knee: float) -> tuple[Array, Array]:
        """As `products_with`, of values, shape (n,), cut into columns where stretches start, shape (j,)."""
        if self._is_plain(knee):
            return np.diag(np.add.reduceat(values**2, starts)), np.add.reduceat(self._rows * values, starts, axis=1).T
        columns = np.zeros((values.size, starts.size))
        number = np.searchsorted(starts, np.arange(values.size), side="right") - 1
        columns[np.arange(values.size), number] = values
        return self.products_with(columns, knee)

    def products_with(self, columns: Array, knee: float) -> tuple[Array, Array]:
        """Products of further columns, shape (n, j), with themselves, (j, j), and all others, (j, 1 + k + m)."""
        if self._is_plain(knee):
            return columns.T @ columns, (self._rows @ columns).T
        edges, middle = self._bands
        further = self._transformed(columns.T)
        weighted = further / np.repeat(1 + knee / middle, 2 * np.diff(edges))
        return weighted @ further.T, weighted @ self._transforms.T

    def _is_plain(self, knee: float) -> bool:
        """Whether products over frequencies are those over samples (Parseval)."""
        return self.linear.interval is None or (knee == 0 and self.linear.cutoff_hz is None)

    def _split(self, knee: float, matrix: Array, volume: float) -> Products:
        count = 1 + self.lengths.size
        outer, side, inner = matrix[:count, :count], matrix[count:, :count], matrix[count:, count:]
        freedom = float(self.linear.counted) if self._is_plain(knee) else self._freedom
        return Products(knee, outer, side, inner, self.lengths, volume, freedom, self.linear.least)

    @property
    def _size(self) -> int:
        """Of the transform: no sample is next to one of the other end."""
        from scipy.fft import next_fast_len

        return int(next_fast_len(2 * self.linear.values.size, real=True))

    @cached_property
    def _power(self) -> Array:
        """Share of power that the low-pass leaves, of the frequencies that count."""
        from scipy.fft import rfftfreq

        assert self.linear.interval is not None
        frequency = rfftfreq(self._size, self.linear.interval)
        if self.linear.cutoff_hz is None:
            return np.ones(frequency.size)
        # A low-pass passes ever less.
        power = passed_power(frequency, self.linear.cutoff_hz, self.linear.interval)
        return np.asarray(power[power > PASSED])

    @property
    def _freedom(self) -> float:
        return self.linear.counted * float(_shares(self._size)[: self._power.size].sum())

    @cached_property
    def _transforms(self) -> Array:
        """Transforms of values, X and Z, as rows of `_transformed`."""
        transforms = self._transformed(self._rows)
        # Only the record was filtered: what is taken off it again is white noise, and the sharp columns.
        transforms[0] /= np.repeat(np.sqrt(self._power), 2)
        return transforms

    def _transformed(self, rows: Array) -> Array:
        """Real and imaginary parts in turn, weighted by the root of each frequency's share, shape (j, 2 f)."""
        from scipy.fft import rfft

        size = self._size
        padded = np.zeros((rows.shape[0], size))
        np.multiply(rows, np.sqrt(2.0 / size), out=padded[:, : rows.shape[1]])
        transforms = np.asarray(rfft(padded, overwrite_x=True)).view(np.float64)
        alone = [0, 1] if size % 2 else [0, 1, -2, -1]
        transforms[:, alone] *= np.sqrt(0.5)
        return transforms[:, : 2 * self._power.size]

    @cached_property
    def _bands(self) -> tuple[NDArray[np.int_], Array]:
        """First frequency of each band and the end of the last, shape (b + 1,), and their means (Hz), shape (b,)."""
        assert self.linear.interval is not None
        edges = [0]
        while edges[-1] < self._power.size:
            edges.append(edges[-1] + max(1, int(BAND * edges[-1])))
        edges[-1] = self._power.size
        bounds, lowest = np.array(edges), 0.5 / (self.linear.values.size * self.linear.interval)
        # Evenly spaced frequencies: the mean is the middle.
        middle = 0.5 * (bounds[:-1] + bounds[1:] - 1) / (self._size * self.linear.interval)
        return bounds, np.maximum(middle, lowest)


def _shares(size: int) -> Array:
    """Shares of the frequencies of a real transform in a product over samples."""
    shares = np.full(size // 2 + 1, 2.0 / size)
    shares[0] /= 2
    shares[-1] /= 1 if size % 2 else 2
    return shares
