"""e of a new test: campaigns of several free vibrations of one block, each with its own e."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from joblib import Parallel, delayed
from scipy import stats
from threadpoolctl import threadpool_limits

import colonnade
from colonnade.identification.restitution.pooling import pool
from monte_carlo.design import Draw, Kind, draw

TESTS = (2, 3, 10, 20)
"""Free vibrations of a campaign."""

BETWEEN = (0.0, 0.001, 0.005)
"""Standard deviations of e between tests; the campaigns of each number of tests are spread evenly over them."""

ERROR, SCATTER = 0.005, 0.001
"""Relative standard deviation of α, p and of the gain of each set-up; scatter of e from impact to impact."""


@dataclass(frozen=True)
class NewTest:
    """
    Campaigns of so many free vibrations and such a scatter between them.

    Attributes
    ----------
    tests, campaigns : int
    between : float
        Standard deviation of e between tests.
    content : float
        Probability that a new test's e is in its 95 % range, averaged over the campaigns.
    half_width : float
        Median of the range, halved.
    coverage : float
        Share of the intervals of the specimen's mean that hold it.
    """

    tests: int
    campaigns: int
    between: float
    content: float
    half_width: float
    coverage: float


def drawn(tests: int, between: float, seed: int, number: int) -> list[Draw]:
    """Draw the free vibrations of a campaign; `truth` of each is the mean of all that there might be."""
    random = np.random.default_rng((seed, tests, number, 5))
    # One e at all impacts: what scatters is drawn for each test, or the tests would share a part of it.
    base = draw(Kind("", ERROR, 0.0, {"shape": "prism"}), seed, 100_000 + number)
    found = []
    for test in range(tests):
        shift = between * random.normal()
        e = base.rocking.restitution
        e = np.minimum(e + shift + SCATTER * random.normal(size=e.size), 0.9995)
        errors = (*base.errors[:2], ERROR * random.normal())
        rocking = replace(base.rocking, restitution=e)
        found.append(replace(base, rocking=rocking, errors=errors, seed=(seed, number, test)))
    return found


def campaign(tests: int, between: float, seed: int, number: int) -> tuple[float, float, bool]:
    """Give the content of a campaign's range of a new test, its half-width, and whether the mean is held."""
    known = colonnade.Uncertainty(critical_angle=ERROR, p=ERROR, angle_gain=ERROR)
    found, mean = [], np.nan
    with threadpool_limits(1):
        for one in drawn(tests, between, seed, number):
            mean = one.truth
            result = colonnade.identify_restitution(*one.record(), one.block, lowpass=one.cutoff, uncertainty=known)
            if result.value is not None and result.joint is not None:
                found.append(result)
    if not found:
        return np.nan, np.nan, False
    pooled = pool(
        [each.value for each in found],
        [each.standard_error for each in found],
        joints=[each.joint for each in found],
        known=(ERROR, ERROR),
    )
    deviation, freedom = pooled.of_new_test(usual=0.005)
    reach = deviation * float(stats.norm.ppf(0.975) if freedom is None else stats.t.ppf(0.975, freedom))
    held = pooled.low <= mean <= pooled.high
    if between == 0:
        return float(abs(pooled.value - mean) < reach), reach, held
    ends = (pooled.value + np.array([-reach, reach]) - mean) / between
    return float(np.diff(stats.norm.cdf(ends))[0]), reach, held


def judge_new_tests(campaigns: int, seed: int, workers: int) -> list[NewTest]:
    """Run campaigns of each number of tests and each scatter."""
    each = max(campaigns // len(BETWEEN), 1)
    judged = []
    with Parallel(n_jobs=workers, batch_size=4) as run:
        for tests in TESTS:
            for between in BETWEEN:
                found = np.array(run(delayed(campaign)(tests, between, seed, number) for number in range(each)), float)
                content, half, held = found[np.isfinite(found[:, 0])].T
                judged.append(
                    NewTest(tests, each, between, float(content.mean()), float(np.median(half)), float(held.mean()))
                )
    return judged
