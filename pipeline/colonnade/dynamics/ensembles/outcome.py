"""What an ensemble says: its bands, the share that overturns, and what its peaks depend on."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from math import inf, sqrt

import numpy as np
from numpy.typing import NDArray

from colonnade.arrays import Array
from colonnade.digest import Digested, written
from colonnade.dynamics.ensembles.uncertainty import INPUTS
from colonnade.validation import number, samples

Histories = NDArray[np.float32]

LEVELS = (0.025, 0.25, 0.5, 0.75, 0.975)
"""Quantiles of the bands: the middle, half of all members, 95 % of them."""

KEPT = 200
"""Members whose whole histories are kept."""

LARGEST_Z = 1e6
"""Standard deviations of an interval; beyond it is 0 to 1."""


@dataclass(frozen=True, repr=False)
class Ensemble(Digested):
    """
    What all members together say.

    Attributes
    ----------
    time : ndarray, shape (n,)
        s, on the record's clock.
    central : ndarray, shape (n,)
        rad, θ with nothing varied.
    levels : ndarray, shape (q,)
        Shares of the members, 0 to 1, that the bands are for.
    bands : ndarray, shape (q, n)
        rad, quantiles of θ at each time.
    inputs : ndarray, shape (members, inputs)
        Of each member: what is added to e (dimensionless) and θ₀ (rad), and factors on the others.
    peak_ratio : ndarray, shape (members,)
        max |θ|/α of each member up to overturning.
    overturning_time : ndarray, shape (members,)
        s, on the record's clock; NaN for a member that stands.
    histories : ndarray of float32, shape (k, n)
        rad, θ of the first members, at most `KEPT`, up to ±α: one that overturned stays there.
    names : tuple of str
        Of the inputs.

    Examples
    --------
    >>> import numpy as np
    >>> import colonnade
    >>> block = colonnade.Block.prism(width=0.086, depth=0.086, height=0.456, mass=26.10)
    >>> motion = colonnade.Motion(3.0 * np.sin(np.arange(600) * 0.2), 0.005)
    >>> inputs = colonnade.Uncertainty(restitution=0.005, gain=0.02)
    >>> found = colonnade.ensemble(block, motion, restitution=0.95, uncertainty=inputs, count=50)
    >>> found.overturning_probability, tuple(round(end, 3) for end in found.overturning_interval())
    (0.0, (0.0, 0.071))
    >>> found.peak_quantiles([0.5]).round(2).tolist(), found.horizon(0.5 * block.critical_angle)
    ([0.13], 2.995)
    >>> sorted(found.sensitivity()), found.sensitivity() == found.correlations(found.peak_ratio)
    (['gain', 'restitution'], True)
    >>> list(found.digest())
    ['members', 'overturned', 'median of max |θ|/α', 'duration']
    """

    time: Array
    central: Array
    levels: Array
    bands: Array
    inputs: Array
    peak_ratio: Array
    overturning_time: Array
    histories: Histories
    names: tuple[str, ...] = INPUTS

    def digest(self) -> dict[str, str]:
        """
        Return the number of members, the share that overturns, the median peak and the duration.

        Returns
        -------
        digest : dict of str to str
            Names and values with their units, as a notebook shows them.
        """
        median = float(self.peak_quantiles([0.5])[0])
        return {
            "members": str(self.overturning_time.size),
            "overturned": written(100 * self.overturning_probability, "%", 3),
            "median of max |θ|/α": "overturned" if median == inf else written(median),
            "duration": written(float(self.time[-1] - self.time[0]), "s"),
        }

    def horizon(self, width: float) -> float:
        """
        Return the first time at which the widest band is wider than this, else the last one.

        Parameters
        ----------
        width : float
            rad.

        Returns
        -------
        horizon : float
            s, on the record's clock.
        """
        wide = self.bands[-1] - self.bands[0] > number("width", width, "a positive angle in rad", above=0.0)
        return float(self.time[int(np.argmax(wide)) if wide.any() else -1])

    @property
    def overturning_probability(self) -> float:
        """Share of the members that overturn."""
        return float(np.isfinite(self.overturning_time).mean())

    def overturning_interval(self, z: float = 1.959964) -> tuple[float, float]:
        """
        Return the interval (Wilson 1927) of the probability of overturning that the finite number of members leaves.

        Parameters
        ----------
        z : float, optional
            Half of its width in standard deviations, dimensionless; by default it has 95 %.

        Returns
        -------
        low, high : float
            Probabilities, 0 to 1.
        """
        z = number("z", z, "a positive number of standard deviations", above=0.0, high=LARGEST_Z)
        members, share = self.overturning_time.size, self.overturning_probability
        middle = (share + z**2 / (2 * members)) / (1 + z**2 / members)
        half = z * sqrt(share * (1 - share) / members + z**2 / (4 * members**2)) / (1 + z**2 / members)
        return max(middle - half, 0.0), min(middle + half, 1.0)

    def peak_quantiles(self, levels: Sequence[float] = LEVELS) -> Array:
        """
        Quantiles of max |θ|/α over the members.

        Parameters
        ----------
        levels : sequence of float, optional
            Shares of the members, 0 to 1.

        Returns
        -------
        quantiles : ndarray, shape of `levels`
            Dimensionless; members that overturn are above all others, inf.
        """
        wanted = samples("levels", levels)
        if not ((wanted >= 0.0) & (wanted <= 1.0)).all():
            raise ValueError(f"levels go from {wanted.min():g} to {wanted.max():g}; numbers from 0 to 1 were expected")
        ranked = np.sort(np.where(np.isfinite(self.overturning_time), inf, self.peak_ratio))
        return np.asarray(ranked[np.rint(wanted * (ranked.size - 1)).astype(np.intp)])

    def sensitivity(self) -> dict[str, float]:
        """
        Rank correlation (Spearman 1904) of the peak with each input that varies.

        Members that overturn share the highest rank. Inputs that do not vary are left out.

        Returns
        -------
        sensitivity : dict of str to float
            −1 to 1, by input; NaN if all peaks are equal.
        """
        return self.correlations(np.where(np.isfinite(self.overturning_time), inf, self.peak_ratio))

    def correlations(self, values: Array) -> dict[str, float]:
        """
        Rank correlation (Spearman 1904) of values of the members with each input that varies.

        Parameters
        ----------
        values : ndarray, shape (members,)
            In any unit; NaN is the highest.

        Returns
        -------
        correlations : dict of str to float
            −1 to 1, by input.
        """
        given = samples("values", values, finite=False)
        if given.size != len(self.inputs):
            raise ValueError(f"values has {given.size} numbers; {len(self.inputs)}, one a member, were expected")
        return rank_correlations(given, dict(zip(self.names, self.inputs.T, strict=True)))


def rank_correlations(values: Array, columns: Mapping[str, Array]) -> dict[str, float]:
    """Correlate the ranks of values, NaN being highest, with those of each column that varies; shapes (n,)."""
    ranks = ranks_of(values)
    return {name: correlation(ranks, ranks_of(column)) for name, column in columns.items() if np.ptp(column) > 0.0}


def ranks_of(values: Array) -> Array:
    """Rank from 0, NaN being highest; equal values share the mean of their ranks."""
    _, place, number = np.unique(values, return_inverse=True, return_counts=True)
    last = np.cumsum(number)
    return np.asarray((last - 0.5 * (number + 1))[place])


def correlation(first: Array, second: Array) -> float:
    """Return the correlation (Pearson's) of two rows of ranks; NaN if one of them does not vary."""
    one, other = first - first.mean(), second - second.mean()
    scale = sqrt(float(one @ one) * float(other @ other))
    return float(one @ other) / scale if scale > 0.0 else float("nan")
