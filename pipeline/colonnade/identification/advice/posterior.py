"""Where the boundaries of overturning are, from the outcomes of sine tests at several frequencies."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from math import expm1

import numpy as np
from numpy.typing import ArrayLike

from colonnade.arrays import Array, Mask
from colonnade.identification.advice.prior import BoundaryPrior, Grid, chance, grid_of, offset_given
from colonnade.validation import number, samples

LEVEL = 0.90
"""Of the interval of a boundary."""


@dataclass(frozen=True)
class SineTests:
    """
    The sine tests of a specimen at one frequency.

    Attributes
    ----------
    predicted : float
        A of the predicted limit.
    amplitude_ratio : ndarray, shape (k,)
        A that the tests achieved; empty before the first.
    overturned : ndarray of bool, shape (k,)
        Their outcomes.
    sensitivity : float
        Change of ln A of the predicted limit by one standard deviation of e, signed: half the difference of its
        logarithms at e + and − that deviation. 0 if it is not known.
    """

    predicted: float
    amplitude_ratio: Array
    overturned: Mask
    sensitivity: float = 0.0

    @classmethod
    def of(
        cls, predicted: float, amplitude_ratio: ArrayLike = (), overturned: ArrayLike = (), sensitivity: float = 0.0
    ) -> SineTests:
        """
        Check and hold the tests of one frequency.

        Raises
        ------
        ValueError
            If an A is not positive or not every test has one outcome.
        """
        number("predicted", predicted, "the positive A of a predicted limit", above=0.0)
        number("sensitivity", sensitivity, "a change of ln A from -1 to 1", low=-1.0, high=1.0)
        amplitudes = samples("amplitude_ratio", np.asarray(amplitude_ratio, dtype=np.float64), fewest=0)
        outcomes = np.asarray(overturned, dtype=bool)
        if outcomes.shape != amplitudes.shape:
            raise ValueError(
                f"overturned has shape {outcomes.shape}; one outcome a test, {amplitudes.shape}, was expected"
            )
        if not (amplitudes > 0.0).all():
            raise ValueError("amplitude_ratio has to be positive throughout")
        return cls(predicted, amplitudes, outcomes, sensitivity)

    @property
    def count(self) -> int:
        """Number of tests."""
        return int(self.amplitude_ratio.size)


@dataclass(frozen=True)
class Boundary:
    """
    What is known of the boundary at one frequency.

    Attributes
    ----------
    predicted : float
        A of the predicted limit.
    grid : Grid
    weight : ndarray, shape (n, w)
        Probability of each offset and σ.
    """

    predicted: float
    grid: Grid
    weight: Array

    def quantiles(self, levels: ArrayLike) -> Array:
        """A below which the boundary is with these probabilities."""
        return self.predicted * np.exp(offset_quantiles(self.grid, self.weight, np.asarray(levels, dtype=np.float64)))

    @property
    def median(self) -> float:
        """A."""
        return float(self.quantiles(0.5))

    @property
    def interval(self) -> tuple[float, float]:
        """A from and to, of probability `LEVEL`."""
        low, high = self.quantiles([(1 - LEVEL) / 2, (1 + LEVEL) / 2])
        return float(low), float(high)

    @property
    def relative_width(self) -> float:
        """Of the interval: its larger end over its smaller one, less 1."""
        return relative_width(self.grid, self.weight)

    def risk(self, amplitude_ratio: ArrayLike) -> Array:
        """Predicted probability that a test at these A overturns."""
        apart = np.log(np.asarray(amplitude_ratio, dtype=np.float64) / self.predicted)[..., None] - self.grid.offset
        chances = chance(apart[..., None], self.grid.width, self.grid.prior.odd)
        return np.asarray((chances * self.weight).sum(axis=(-2, -1)))


def find_boundaries(tests: Sequence[SineTests], prior: BoundaryPrior | None = None) -> list[Boundary]:
    """
    Weigh where the boundary of overturning is at each frequency.

    Parameters
    ----------
    tests : sequence of SineTests
        Of one specimen, one for each frequency; those without any test so far included.
    prior : BoundaryPrior, optional

    Returns
    -------
    boundaries : list of Boundary
        In the same order.

    Notes
    -----
    A test at A overturns with probability Φ((ln A − μ)/σ), the probit of up-and-down tests (Dixon and Mood 1948). μ is
    the sum of ln of the predicted limit, an offset that all frequencies share, the sensitivity times an error of e that
    they share, and an offset of each frequency; σ of each frequency is about a common one. Given what is shared, the
    frequencies are independent, so that sums over a grid give the posterior without sampling it: the sum over a
    frequency's own offset and σ is one product of matrices.

    What is covered is the lower boundary, as seen by the first region of overturning: `lower` of a stability map is
    its predicted place. Islands, of overturning below it and of survival above it, make odd outcomes, which are allowed
    for with a fixed probability. They are not mapped, and what is above a wide region of survival is not looked for.
    Under many cycles the probability of overturning goes up and down with A over tens of percent; a probit does not
    describe that, and the interval is then of the probit that fits best.
    """
    grid = grid_of(prior or BoundaryPrior())
    likelihoods = [_likelihood(grid, each) for each in tests]
    given = [offset_given(grid.prior, each.sensitivity) for each in tests]
    # ln of the probability of a frequency's outcomes given what is shared; without outcomes it is 1.
    evidence = [
        np.log(matrix @ likelihood @ grid.width_given.T) if each.count else np.zeros(1)
        for each, matrix, likelihood in zip(tests, given, likelihoods, strict=True)
    ]
    shared = sum(evidence, np.log(grid.shared[:, None] * grid.common_width))
    boundaries = []
    for each, likelihood, matrix, own in zip(tests, likelihoods, given, evidence, strict=True):
        others = shared - own
        joint = likelihood * (matrix.T @ (np.exp(others - others.max()) @ grid.width_given))
        boundaries.append(Boundary(each.predicted, grid, joint / joint.sum()))
    return boundaries


def offset_quantiles(grid: Grid, weight: Array, levels: Array) -> Array:
    """Quantiles of the offset, linear between the edges of the grid's cells."""
    below = np.concatenate([[0.0], np.cumsum(weight.sum(axis=1))])
    half_step = 0.5 * (grid.offset[1] - grid.offset[0])
    edges = np.append(grid.offset - half_step, grid.offset[-1] + half_step)
    return np.asarray(np.interp(levels * below[-1], below, edges))


def relative_width(grid: Grid, weight: Array) -> float:
    """Width of the interval of probability `LEVEL`, as `Boundary.relative_width`."""
    low, high = offset_quantiles(grid, weight, np.array([(1 - LEVEL) / 2, (1 + LEVEL) / 2]))
    return expm1(float(high - low))


def _likelihood(grid: Grid, tests: SineTests) -> Array:
    """Probability of the outcomes for each offset and σ, shape (n, w), over that of the most likely."""
    logarithm = np.zeros((grid.offset.size, grid.width.size))
    for amplitude, overturned in zip(tests.amplitude_ratio, tests.overturned, strict=True):
        apart = np.log(amplitude / tests.predicted) - grid.offset[:, None]
        sign = 1.0 if overturned else -1.0  # of the chance's symmetry: survival is overturning on the other side
        logarithm += np.log(chance(sign * apart, grid.width, grid.prior.odd))
    likelihood: Array = np.exp(logarithm - logarithm.max())
    return likelihood
