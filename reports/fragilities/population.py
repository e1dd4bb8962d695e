"""Populations of capacities with known truth, as outcomes of records at levels."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.special import ndtr

from colonnade.arrays import Array
from colonnade.assessment.outcomes import Outcomes, gather

MEDIAN = 0.4
"""Of all capacities, m/s."""

APART, WITHIN = 0.6, 0.15
"""Half the distance of the two kinds of records in ln capacity, and the scatter within a kind."""


@dataclass(frozen=True)
class Population:
    """
    ln capacity = ln `MEDIAN` + record + draw.

    Attributes
    ----------
    records, draws, levels : int
        Each record has draws of its own, the same at all levels.
    of_records, of_parameters : float
        Standard deviations. The draws are normal.
    two_kinds : bool
        Whether records are of two kinds, `APART` above and below the median with a scatter of `WITHIN`; else normal.
    """

    records: int = 30
    draws: int = 10
    levels: int = 10
    of_records: float = 0.4
    of_parameters: float = 0.15
    two_kinds: bool = False

    @property
    def beta(self) -> float:
        """Standard deviation of ln capacity of a lognormal population."""
        return float(np.hypot(self.of_records, self.of_parameters))

    @property
    def intensity(self) -> Array:
        """Levels, evenly spaced in ln x over probabilities from about 1 to 99 %, m/s."""
        reach = 1.2 if self.two_kinds else 2.2 * self.beta
        return np.asarray(MEDIAN * np.exp(reach * np.linspace(-1, 1, self.levels)))

    def probability(self, intensity: Array) -> Array:
        """True probability of overturning."""
        y = np.log(intensity / MEDIAN)
        if not self.two_kinds:
            return np.asarray(ndtr(y / self.beta))
        width = np.hypot(WITHIN, self.of_parameters)
        return np.asarray((ndtr((y - APART) / width) + ndtr((y + APART) / width)) / 2)

    def sample(self, random: np.random.Generator) -> Outcomes:
        """Draw records and run them at all levels; a level above the capacity overturns."""
        of_records = random.normal(0, WITHIN if self.two_kinds else self.of_records, (self.records, 1))
        if self.two_kinds:
            of_records += np.where(random.random((self.records, 1)) < 0.5, -APART, APART)
        capacity = MEDIAN * np.exp(of_records + random.normal(0, self.of_parameters, (self.records, self.draws)))
        return outcomes_of(capacity, self.intensity)


def outcomes_of(capacity: Array, intensity: Array) -> Outcomes:
    """Give the outcomes of capacities of shape (records, draws) at intensities."""
    demand = intensity[None, :, None] / capacity[:, None, :]
    names = [f"record {number}" for number in range(len(capacity))]
    return gather(names, np.tile(intensity, (len(names), 1)), np.where(demand > 1, 2.0, 0.5 * demand))
