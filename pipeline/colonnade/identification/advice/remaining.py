"""The test that is expected to say most, and how many are left if that is always the next one."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from math import log

import numpy as np
import scipy

from colonnade.arrays import Array
from colonnade.identification.advice.posterior import relative_width
from colonnade.identification.advice.prior import Grid

COURSES = 20
"""Courses of outcomes that are followed at a time; of more, as many are kept, spread over their probability."""

FARTHEST = 40
"""Tests ahead that are looked at."""

SURE = 0.9
"""Probability with which `TestsLeft.most` tests are enough."""


@dataclass(frozen=True)
class TestsLeft:
    """
    Number of tests left.

    Attributes
    ----------
    median, most : int or None
        So many tests are enough with a probability of a half, and of `SURE`; None if that is too far ahead to say.
    """

    median: int | None
    most: int | None


@dataclass(frozen=True)
class Choice:
    """A test: index of its offset as amplitude, expected information (bit), and risk (probability) of overturning."""

    index: int
    information: float
    risk: float


def best_choice(grid: Grid, weight: Array, largest_risk: float) -> Choice:
    """Choose the test that is expected to say most within a risk; if every test has more, the one with the least."""
    candidates = candidates_of(grid, weight)
    information, risk = expected_information(grid, weight, candidates)
    allowed = risk <= largest_risk
    best = int(np.argmax(np.where(allowed, information, -np.inf))) if allowed.any() else int(np.argmin(risk))
    return Choice(int(candidates[best]), float(information[best]), float(risk[best]))


def count_tests_left(grid: Grid, weight: Array, *, wanted_width: float, largest_risk: float) -> TestsLeft:
    """
    Follow the advice through the outcomes that it may have.

    Parameters
    ----------
    grid : Grid
    weight : ndarray, shape (n, w)
        Probability of each offset and σ.
    wanted_width : float
        Relative width of the interval that ends the tests.
    largest_risk : float
        Largest risk of overturning of a test.

    Notes
    -----
    Each course of outcomes has the probability that the posterior predicts. From a certain number on, courses stand for
    their neighbours, by a fixed rule: nothing is drawn at random. What other frequencies will add is left out, so that
    the number is on the large side.
    """
    ended: dict[int, float] = {}
    courses = [(1.0, weight / weight.sum())]
    for count in range(FARTHEST + 1):
        ended[count] = sum(share for share, each in courses if relative_width(grid, each) <= wanted_width)
        courses = [(share, each) for share, each in courses if relative_width(grid, each) > wanted_width]
        if not courses or sum(ended.values()) >= SURE:
            break
        courses = _thinned([after for course in courses for after in _next(grid, *course, largest_risk)])
    return TestsLeft(_reached(ended, 0.5), _reached(ended, SURE))


def _next(grid: Grid, share: float, weight: Array, largest_risk: float) -> Iterator[tuple[float, Array]]:
    """Give the two courses that a course can take by the next test, as probability and posterior."""
    choice = best_choice(grid, weight, largest_risk)
    falls = weight * grid.chances[choice.index]
    for probability, part in ((choice.risk, falls), (1.0 - choice.risk, weight - falls)):
        yield share * probability, part / part.sum()


def _thinned(courses: list[tuple[float, Array]]) -> list[tuple[float, Array]]:
    """Keep `COURSES` of them in all, at equal steps of their summed probability."""
    if len(courses) <= COURSES:
        return courses
    reached = np.cumsum([share for share, _ in courses])
    chosen = np.searchsorted(reached, (np.arange(COURSES) + 0.5) / COURSES * reached[-1])
    indices, counts = np.unique(chosen, return_counts=True)
    return [(count * reached[-1] / COURSES, courses[index][1]) for index, count in zip(indices, counts, strict=True)]


def _reached(ended: dict[int, float], share: float) -> int | None:
    """Give the number of tests within which at least this share of the courses has ended."""
    total = 0.0
    for depth in sorted(ended):
        total += ended[depth]
        if total >= share:
            return depth
    return None


NEGLIGIBLE = 1e-4
"""Probability of the posterior's ends, beyond which no test is considered."""


def expected_information(grid: Grid, weight: Array, candidates: Array) -> tuple[Array, Array]:
    """
    Expected fall of the entropy of a boundary's posterior by one test, and the risk that the test overturns.

    Parameters
    ----------
    grid : Grid
    weight : ndarray, shape (n, w)
        Probability of each offset and σ.
    candidates : ndarray of int, shape (c,)
        Indices of offsets, as amplitudes.

    Returns
    -------
    information, risk : ndarray, shape (c,)
        bit; probability.

    Notes
    -----
    The mutual information of the outcome and the boundary alone, σ being summed out first (Lindley 1956; Chaloner and
    Verdinelli 1995, sec. 3): the entropy of the predicted outcome less its mean entropy given the boundary, which is
    how Houlsby et al. (2011) compute it. It needs no posterior of outcomes that have not happened.
    """
    offset_weight = weight.sum(axis=1)
    likely = np.flatnonzero(offset_weight > 1e-9 * offset_weight.max())
    held = slice(int(likely[0]), int(likely[-1]) + 1)
    own, total = weight[held], offset_weight[held]
    overturning = np.einsum("cnw,nw->cn", grid.chances[candidates, held], own)
    risk = overturning.sum(axis=1) / total.sum()
    given = overturning / np.maximum(total, np.finfo(float).tiny)
    return (outcome_entropy(risk) - outcome_entropy(given) @ (total / total.sum())), risk


def candidates_of(grid: Grid, weight: Array) -> Array:
    """Indices of the amplitudes at which a test can say anything: where the boundary may be."""
    below = np.cumsum(weight.sum(axis=1))
    first, last = np.searchsorted(below / below[-1], [NEGLIGIBLE, 1.0 - NEGLIGIBLE])
    return np.arange(first, min(int(last) + 1, grid.offset.size))


def outcome_entropy(probability: Array) -> Array:
    """Entropy of an outcome that happens with a probability, or does not, bit."""
    entropy: Array = (scipy.special.entr(probability) + scipy.special.entr(1.0 - probability)) / log(2.0)
    return entropy
