"""What is known of a boundary of overturning before it is tested, and the grid on which that is weighed."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache, cached_property, lru_cache

import numpy as np
import scipy

from colonnade.arrays import Array
from colonnade.validation import number

STEP = 0.004
"""Of the grid, in ln A: a fifth of the narrowest interval that can be asked for."""

NARROWEST = 0.02
"""Least relative width of an interval that can be asked for."""

REACH = 5.0
"""Standard deviations of the prior that the grid covers to each side."""

COMMON_STEPS, RESTITUTION_STEPS = 61, 9
BETWEEN_QUANTILES = 4
WIDTHS = 11
"""Points of the grid in what all frequencies share, and in the probit's width."""


@dataclass(frozen=True)
class BoundaryPrior:
    """
    How far a predicted limit may be from the measured boundary, and how sharp that boundary is.

    Attributes
    ----------
    common : float
        Standard deviation of the offset in ln A that all frequencies share. 0.15: measured limits of blocks differ from
        those of plane models by 10 to 20 %, mostly to one side for one specimen (a wrong e, α, p or gain moves the
        whole boundary), so that an error of 20 % is just above one standard deviation.
    between : float
        Median standard deviation of the offset from frequency to frequency about the common one. 0.025: twice that of
        the linear model's limits about the nonlinear one's, of the paper's prism from 1 to 7 Hz under one cycle.
    width : float
        Median σ of the probit in ln A. 0.02: from test to test the start phase differs by a few degrees, e by a few
        thousandths and the amplitude by 1 %, each of which moves a limit by 1 % or so.
    factor : float
        The last two are log-normal; one standard deviation is this factor. 2: neither is known better.
    width_between : float
        σ of single frequencies are log-normal about the common one; one standard deviation is this factor. 1.5.
    odd : float
        Probability of an outcome that has nothing to do with the boundary: an island of survival above it or of
        overturning below it, or a disturbed test (the lapse of Wichmann and Hill 2001). 0.02.

    Raises
    ------
    ValueError
        If a value is out of its range.
    """

    common: float = 0.15
    between: float = 0.025
    width: float = 0.02
    factor: float = 2.0
    width_between: float = 1.5
    odd: float = 0.02

    def __post_init__(self) -> None:
        for name in ("common", "between", "width"):
            number(name, getattr(self, name), "a standard deviation in ln A from 0.005 to 0.4", low=0.005, high=0.4)
        for name in ("factor", "width_between"):
            number(name, getattr(self, name), "a factor above 1 and at most 10", above=1.0, high=10.0)
        number("odd", self.odd, "a probability from 0.001 to 0.2", low=0.001, high=0.2)


@dataclass(frozen=True)
class Grid:
    """
    Points at which a prior is weighed.

    Attributes
    ----------
    prior : BoundaryPrior
    offset : ndarray, shape (n,)
        ln of the boundary over the predicted limit, in steps of `STEP` about 0.
    width : ndarray, shape (w,)
        σ, in equal steps of its logarithm.
    common, restitution, between, shared : ndarray, shape (h,)
        What all frequencies share: the common offset, the error of e in its standard deviations, the deviation between
        frequencies; and the prior probability of the three.
    common_width : ndarray, shape (w,)
        Prior probability that the common σ is each `width`.
    width_given : ndarray, shape (w, w)
        Probability of each σ of a frequency (second) for each common one (first).
    """

    prior: BoundaryPrior
    offset: Array
    width: Array
    common: Array
    restitution: Array
    between: Array
    shared: Array
    common_width: Array
    width_given: Array

    @cached_property
    def chances(self) -> Array:
        """Probability of overturning at each offset as amplitude, for each boundary and σ, shape (n, n, w)."""
        apart = self.offset[:, None] - self.offset
        return chance(apart[:, :, None], self.width, self.prior.odd)


@lru_cache(16)  # of 7 MB each
def offset_given(prior: BoundaryPrior, sensitivity: float) -> Array:
    """Probability of each offset at a frequency given what is shared, shape (h, n); `sensitivity` as of its tests."""
    grid = grid_of(prior)
    middle = grid.common + sensitivity * grid.restitution
    return _normal(grid.offset - middle[:, None], grid.between[:, None])


@cache
def grid_of(prior: BoundaryPrior) -> Grid:
    """Make the grid of a prior, once."""
    levels = (np.arange(BETWEEN_QUANTILES) + 0.5) / BETWEEN_QUANTILES
    between = prior.between * prior.factor ** scipy.special.ndtri(levels)
    steps = np.linspace(-2.4, 2.4, WIDTHS)
    apart = (steps[:, None] - steps) * np.log(prior.factor)
    half = np.ceil(REACH * np.hypot(prior.common, prior.between) / STEP)
    common, restitution = np.linspace(-4.0, 4.0, COMMON_STEPS), np.linspace(-2.4, 2.4, RESTITUTION_STEPS)
    shared = np.exp(-0.5 * (common[:, None, None] ** 2 + restitution[:, None] ** 2)) * np.ones(between.size)
    points = np.meshgrid(prior.common * common, restitution, between, indexing="ij")
    return Grid(
        prior,
        offset=STEP * np.arange(-half, half + 1),
        width=prior.width * prior.factor**steps,
        common=points[0].ravel(),
        restitution=points[1].ravel(),
        between=points[2].ravel(),
        shared=shared.ravel() / shared.sum(),
        common_width=_normal(steps, np.ones(1)),
        width_given=_normal(apart, np.log([prior.width_between])),
    )


def chance(apart: Array, width: Array, odd: float) -> Array:
    """Probability of overturning at ln A − μ = `apart` for σ = `width`, broadcast: a probit with odd outcomes."""
    ordinary: Array = scipy.special.ndtr(apart / width)
    return odd + (1.0 - 2.0 * odd) * ordinary


def _normal(apart: Array, deviation: Array) -> Array:
    """Probabilities, over the last axis, of points of a normal distribution."""
    density = np.exp(-0.5 * (apart / deviation) ** 2)
    return np.asarray(density / density.sum(axis=-1, keepdims=True))
