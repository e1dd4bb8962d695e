"""Advice on sine tests: at which amplitude the next one tells most, and how many are probably left."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from colonnade.identification.advice.posterior import Boundary, SineTests, find_boundaries
from colonnade.identification.advice.prior import NARROWEST, BoundaryPrior
from colonnade.identification.advice.remaining import Choice, TestsLeft, best_choice, count_tests_left
from colonnade.validation import number

SAME_AMPLITUDE = 0.005
"""Tests whose A differ by less, relative, repeat each other: tables achieve an amplitude no better."""


@dataclass(frozen=True)
class SineAdvice:
    """
    The next sine test at one frequency, with its reason.

    Attributes
    ----------
    boundary : Boundary
        What is known so far: `interval`, `relative_width`, `median`.
    is_enough : bool
        Whether the interval is as narrow as wanted, so that no other test is needed.
    amplitude_ratio : float
        A of the test that is expected to say most within the risk.
    information : float
        bit, expected fall of the entropy of the boundary's posterior by this test.
    risk : float
        Predicted probability that the specimen overturns in it. Above the largest one allowed only if every test is.
    repeats : int
        Tests so far at this A.
    unlimited : Choice
        The test that would say most at any risk.
    left : TestsLeft
        Tests left, this one included, until the interval is as narrow as wanted.
    """

    boundary: Boundary
    is_enough: bool
    amplitude_ratio: float
    information: float
    risk: float
    repeats: int
    unlimited: Choice
    left: TestsLeft


def advise_sine_tests(
    tests: Sequence[SineTests], *, wanted_width: float, largest_risk: float, prior: BoundaryPrior | None = None
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
    prior : BoundaryPrior, optional

    Returns
    -------
    advice : list of SineAdvice
        In the same order. A laboratory that finishes one frequency before the next uses the first that is not enough:
        what is found there makes the others cheaper.

    Raises
    ------
    ValueError
        If an argument is out of its range.

    Notes
    -----
    The advised amplitude is the largest expected information about the boundary alone (Lindley 1956; Chaloner and
    Verdinelli 1995; as computed by Houlsby et al. 2011). It halves the probability of the boundary rather than a
    bracket of A, so that it does not test again what the prediction and the other frequencies have settled, and where
    outcomes scatter it comes back to an amplitude by itself. What it covers: see `find_boundaries`.

    Examples
    --------
    >>> new = SineTests.of(predicted=1.9)
    >>> [advice] = advise_sine_tests([new], wanted_width=0.05, largest_risk=1.0)
    >>> round(advice.amplitude_ratio, 1), round(advice.risk, 1), advice.repeats, advice.is_enough
    (1.9, 0.5, 0, False)
    """
    wanted = number("wanted_width", wanted_width, f"a relative width from {NARROWEST:g} to 1", low=NARROWEST, high=1.0)
    risk = number("largest_risk", largest_risk, "a probability above 0 and at most 1", above=0.0, high=1.0)
    return [
        _advise(each, boundary, wanted, risk)
        for each, boundary in zip(tests, find_boundaries(tests, prior), strict=True)
    ]


def _advise(tests: SineTests, boundary: Boundary, wanted_width: float, largest_risk: float) -> SineAdvice:
    grid, weight = boundary.grid, boundary.weight
    best, unlimited = (best_choice(grid, weight, risk) for risk in (largest_risk, 1.0))
    amplitude = boundary.predicted * float(np.exp(grid.offset[best.index]))
    apart = np.abs(np.log(tests.amplitude_ratio / amplitude))
    return SineAdvice(
        boundary,
        boundary.relative_width <= wanted_width,
        amplitude,
        best.information,
        best.risk,
        int((apart < SAME_AMPLITUDE).sum()),
        unlimited,
        count_tests_left(grid, weight, wanted_width=wanted_width, largest_risk=largest_risk),
    )
