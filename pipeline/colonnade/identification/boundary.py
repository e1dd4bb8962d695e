"""Where the boundaries of overturning are by the sine tests so far, and at which amplitude the next one tells most."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cache
from math import ceil, log, log1p, log2

import numpy as np
import scipy
from numpy.typing import ArrayLike

from colonnade.arrays import Array

LEVEL = 0.90
"""Of the interval of a boundary."""

STEP, REACH = 0.004, 5.0
"""Of the grid, in ln A: a fifth of the least width asked for; how many standard deviations of the prior it covers."""

BETWEEN = 0.025
"""
Standard deviation of the offset from frequency to frequency about the common one, in ln A: twice that of
the linear model's limits about the nonlinear one's, of the paper's prism from 1 to 7 Hz under one cycle.
"""

WIDTHS = 0.02 * 2.0 ** np.linspace(-2.4, 2.4, 9)
"""
σ of the probit in ln A, that all frequencies share; log-normal about 0.02 with a factor of 2: from test to test the
start phase differs by a few degrees, e by a few thousandths and the amplitude by 1 %, each of which moves a limit by
1 % or so.
"""

ODD = 0.02
"""
Probability of an outcome that has nothing to do with the boundary: an island of survival above it or of overturning
below it, or a disturbed test (the lapse of Wichmann and Hill 2001).
"""


@dataclass(frozen=True)
class SineTests:
    """
    The sine tests of a specimen at one frequency.

    Attributes
    ----------
    predicted : float
        A of the predicted limit.
    amplitude_ratio : sequence of float, length k
        A that the tests achieved; empty before the first.
    overturned : sequence of bool, length k
        Their outcomes.
    sensitivity : float
        Change of ln A of the predicted limit by one standard deviation of e. 0 if it is not known.
    """

    predicted: float
    amplitude_ratio: Sequence[float] = ()
    overturned: Sequence[bool] = ()
    sensitivity: float = 0.0


@dataclass(frozen=True)
class Boundary:
    """
    What is known of the boundary at one frequency.

    Attributes
    ----------
    tests : SineTests
    offset : ndarray, shape (n,)
        ln of the boundary over the predicted limit, in steps of `STEP` about 0.
    weight : ndarray, shape (n, w)
        Probability of each offset and each of `WIDTHS`.
    """

    tests: SineTests
    offset: Array
    weight: Array

    def quantiles(self, levels: ArrayLike) -> Array:
        """A below which the boundary is with these probabilities: linear between the edges of the grid's cells."""
        below = np.concatenate([[0.0], np.cumsum(self.weight.sum(axis=1))])
        edges = STEP * (np.arange(below.size) - self.offset.size / 2)
        return np.asarray(self.tests.predicted * np.exp(np.interp(np.asarray(levels) * below[-1], below, edges)))

    @property
    def interval(self) -> tuple[float, float]:
        """A from and to, of probability `LEVEL`."""
        low, high = self.quantiles([(1 - LEVEL) / 2, (1 + LEVEL) / 2])
        return float(low), float(high)

    @property
    def relative_width(self) -> float:
        """Of the interval: its larger end over its smaller one, less 1."""
        low, high = self.interval
        return high / low - 1.0


@dataclass(frozen=True)
class SineAdvice:
    """
    The next sine test at one frequency, with its reason.

    Attributes
    ----------
    boundary : Boundary
        What is known so far: `interval`, `relative_width`, `quantiles`.
    is_enough : bool
        Whether the interval is as narrow as wanted, so that no other test is needed.
    amplitude_ratio : float
        A of the test that is expected to say most within the risk.
    information : float
        bit, that its outcome is expected to say about the boundary.
    risk : float
        Predicted probability that the specimen overturns in it. Above the largest one allowed only if every test is.
    left : int
        About how many tests are left, this one included, until the interval is as narrow as wanted.
    """

    boundary: Boundary
    is_enough: bool
    amplitude_ratio: float
    information: float
    risk: float
    left: int


def find_boundaries(tests: Sequence[SineTests], *, discrepancy: float = 0.15) -> list[Boundary]:
    """
    Weigh where the boundary of overturning is at each frequency.

    Parameters
    ----------
    tests : sequence of SineTests
        Of one specimen, one for each frequency; those without any test so far included.
    discrepancy : float, optional
        Standard deviation of the offset in ln A that all frequencies share. 0.15: measured limits of blocks differ from
        those of plane models by 10 to 20 %, mostly to one side for one specimen (a wrong e, α, p or gain moves the
        whole boundary), so that an error of 20 % is just above one standard deviation.

    Returns
    -------
    boundaries : list of Boundary
        In the same order.

    Notes
    -----
    A test at A overturns with probability Φ((ln A − μ)/σ), the probit of up-and-down tests (Dixon and Mood 1948). μ is
    the sum of ln of the predicted limit, an offset that all frequencies share, and one of each frequency, which an
    error of e widens by its sensitivity; σ is shared. All is weighed on one grid of offsets and σ.

    What is covered is the lower boundary, as seen by the first region of overturning: `lower` of a stability map is
    its predicted place. Islands, of overturning below it and of survival above it, make odd outcomes, which are allowed
    for with a fixed probability. They are not mapped, and what is above a wide region of survival is not looked for.
    Under many cycles the probability of overturning goes up and down with A over tens of percent; a probit does not
    describe that, and the interval is then of the probit that fits best.
    """
    offset, _, _ = _grid(ceil(REACH * np.hypot(discrepancy, BETWEEN) / STEP))
    likelihoods = [_likelihood(offset, each) for each in tests]
    # Of an offset at a frequency (second) for each common one (first).
    given = [_normal(offset - offset[:, None], np.hypot(BETWEEN, each.sensitivity)) for each in tests]
    evidence = [np.log(each @ own) for each, own in zip(given, likelihoods, strict=True)]
    shared = sum(evidence, np.log(_normal(offset, discrepancy))[:, None] + np.log(_normal(np.log2(WIDTHS / 0.02), 1.0)))
    boundaries = []
    for each, conditional, likelihood, own in zip(tests, given, likelihoods, evidence, strict=True):
        others = shared - own
        joint = likelihood * (conditional.T @ np.exp(others - others.max()))
        boundaries.append(Boundary(each, offset, joint / joint.sum()))
    return boundaries


def advise_sine_tests(
    tests: Sequence[SineTests], *, wanted_width: float, largest_risk: float, discrepancy: float = 0.15
) -> list[SineAdvice]:
    """
    Advise the next sine test at each frequency.

    Parameters
    ----------
    tests : sequence of SineTests
        Of one specimen, one for each frequency; those without any test so far included.
    wanted_width : float
        Relative width that the 90 % interval of each boundary is to have, from 0.02 to 1.
    largest_risk : float
        Largest predicted probability that the specimen overturns in a test; overturning may damage it.
    discrepancy : float, optional
        As of `find_boundaries`.

    Returns
    -------
    advice : list of SineAdvice
        In the same order. A laboratory that finishes one frequency before the next uses the first that is not enough:
        what is found there makes the others cheaper.

    Notes
    -----
    The advised amplitude has the largest expected information (Lindley 1956; as computed by Houlsby et al. 2011). It
    halves the probability of the boundary rather than a bracket of A, so that it does not test again what the
    prediction and the other frequencies have settled, and where outcomes scatter it comes back to an amplitude by
    itself. What it covers: see `find_boundaries`.

    Examples
    --------
    >>> new = SineTests(predicted=1.9)
    >>> [advice] = advise_sine_tests([new], wanted_width=0.05, largest_risk=1.0)
    >>> round(advice.amplitude_ratio, 1), round(advice.risk, 1), advice.is_enough
    (1.9, 0.5, False)
    """
    boundaries = find_boundaries(tests, discrepancy=discrepancy)
    return [_advise(each, wanted_width, largest_risk) for each in boundaries]


def _advise(boundary: Boundary, wanted_width: float, largest_risk: float) -> SineAdvice:
    risk, information = _expected(boundary.weight)
    allowed = risk <= largest_risk
    best = int(np.argmax(np.where(allowed, information, -1.0))) if allowed.any() else int(np.argmin(risk))
    amplitude = boundary.tests.predicted * float(np.exp(boundary.offset[best]))
    width = boundary.relative_width
    is_enough = width <= wanted_width
    # Each bit halves the interval; a test says less as it nears σ: the mean of the next one's bits and the last one's.
    at_last = _normal(boundary.offset, log1p(wanted_width) / (2 * scipy.special.ndtri((1 + LEVEL) / 2)))
    least = float(_expected(at_last[:, None] * boundary.weight.sum(axis=0))[1].max())
    left = 0 if is_enough else ceil(2 * log2(width / wanted_width) / (float(information[best]) + least))
    return SineAdvice(boundary, is_enough, amplitude, float(information[best]), float(risk[best]), left)


def _expected(weight: Array) -> tuple[Array, Array]:
    """Risk of a test at each offset as amplitude, and the bits that its outcome is expected to say, shape (n,) each."""
    _, chances, noise = _grid((len(weight) - 1) // 2)
    risk = np.tensordot(chances, weight, 2)
    return risk, _outcome_entropy(risk) - np.tensordot(noise, weight, 2)


@cache
def _grid(half: int) -> tuple[Array, Array, Array]:
    """Offsets; the chance of overturning at each as amplitude, for each boundary and σ, (n, n, w), and its entropy."""
    offset: Array = STEP * np.arange(-half, half + 1, dtype=np.float64)
    chances = _chance((offset[:, None] - offset)[..., None])
    return offset, chances, _outcome_entropy(chances)


def _chance(apart: Array) -> Array:
    """Probability of overturning at ln A − μ = `apart`, shape (…, 1), for each σ: a probit with odd outcomes."""
    return np.asarray(ODD + (1.0 - 2.0 * ODD) * scipy.special.ndtr(apart / WIDTHS))


def _likelihood(offset: Array, tests: SineTests) -> Array:
    """Probability of the outcomes for each offset and σ, shape (n, w), over that of the most likely."""
    apart = np.log(np.divide(tests.amplitude_ratio, tests.predicted))[:, None] - offset
    # Survival is overturning on the other side.
    signed = np.where(np.array(tests.overturned, dtype=bool)[:, None], apart, -apart)
    logarithm = np.log(_chance(signed[..., None])).sum(axis=0)
    return np.asarray(np.exp(logarithm - logarithm.max()))


def _normal(apart: Array, deviation: float) -> Array:
    """Probabilities, over the last axis, of points of a normal distribution."""
    density = np.exp(-0.5 * (apart / deviation) ** 2)
    return np.asarray(density / density.sum(axis=-1, keepdims=True))


def _outcome_entropy(probability: Array) -> Array:
    """Entropy of an outcome that happens with a probability, or does not, bit."""
    return np.asarray((scipy.special.entr(probability) + scipy.special.entr(1.0 - probability)) / log(2.0))
