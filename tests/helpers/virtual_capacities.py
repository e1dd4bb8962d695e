"""Samples of populations of capacities with known truth."""

import numpy as np

import fragility_trial
from fragility_trial import MEDIAN, Population

__all__ = ["BETA", "LEVELS", "MEDIAN", "lognormal", "names", "outcomes_of"]

BETA, LEVELS = Population().beta, Population().intensity


def names(count):
    return [f"record {number}" for number in range(count)]


def outcomes_of(capacity, levels=LEVELS):
    """Outcomes of capacities of shape (records, draws)."""
    return fragility_trial.outcomes_of(capacity, levels)


def lognormal(seed, **chosen):
    return Population(**chosen).sample(np.random.default_rng(seed))
