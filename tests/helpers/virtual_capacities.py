"""Virtual populations of capacities with known truth, as outcomes of records at levels."""

from __future__ import annotations

import numpy as np

from colonnade.assessment.fragility.outcomes import gather

MEDIAN, RECORDS_BETA, PARAMETERS_BETA = 0.4, 0.4, 0.15
BETA = float(np.hypot(RECORDS_BETA, PARAMETERS_BETA))
LEVELS = MEDIAN * np.exp(BETA * np.linspace(-2.2, 2.2, 10))


def names(count):
    return [f"record {number}" for number in range(count)]


def outcomes_of(capacity, levels=LEVELS):
    """Outcomes of capacities of shape (records, draws): a level above the capacity overturns."""
    peak = np.where(
        levels[None, :, None] > capacity[:, None, :], 2.0, 0.5 * levels[None, :, None] / capacity[:, None, :]
    )
    return gather(names(len(capacity)), np.tile(levels, (len(capacity), 1)), peak)


def lognormal_outcomes(seed, records=30, draws=10, levels=LEVELS):
    """ln capacity of each record, and of each of its draws, normal."""
    random = np.random.default_rng(seed)
    of_records = random.normal(0, RECORDS_BETA, (records, 1))
    return outcomes_of(MEDIAN * np.exp(of_records + random.normal(0, PARAMETERS_BETA, (records, draws))), levels)


def two_kinds(seed, records=30, draws=10):
    """Half of the records overturn the block early, half late, nothing between."""
    random = np.random.default_rng(seed)
    of_records = np.where(random.random((records, 1)) < 0.5, -0.6, 0.6) + random.normal(0, 0.15, (records, 1))
    return outcomes_of(MEDIAN * np.exp(of_records + random.normal(0, PARAMETERS_BETA, (records, draws))))
