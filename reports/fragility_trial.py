"""Trials of the study of fragilities: a sample of a population with known truth, and which intervals hold it."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import scipy
from scipy.special import ndtr

from colonnade.arrays import Array
from colonnade.assessment.curves import IsotonicCurve, fit_isotonic, fit_lognormal, lognormal_misfit
from colonnade.assessment.fragility import split_beta
from colonnade.assessment.hazard import annual_rate, hazard_curve, lognormal_rate
from colonnade.assessment.intervals import Interval, Resampling
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
    return gather(names, intensity, np.where(demand > 1, 2.0, 0.5 * demand))


RESAMPLES = 999
PROBABILITIES = (0.1, 0.6, 0.9)
"""True probabilities at the intensities where P is judged."""

SIGNIFICANT = 0.05
HAZARD = hazard_curve(np.geomspace(0.01, 10.0, 20), 1e-4 * np.geomspace(0.01, 10.0, 20) ** -2.0)
"""A power law, so that the true rate is in closed form."""

Held = dict[str, float | None]
"""
Whether it holds the truth, by the name of an interval, or a value over its truth; None if it is not given. `given` says
whether that of the curve is, `misfit` whether the test finds one.
"""


def run(population: Population, seed: int, number: int) -> Held:
    """Run repetition `number`."""
    outcomes = population.sample(np.random.default_rng((seed, number)))
    curve = fit_isotonic(outcomes, Resampling(RESAMPLES, number))
    truth = population.probability(curve.intensity)
    inside = (curve.probability.low <= truth) & (truth <= curve.probability.high)
    held: Held = {f"isotonic {place}": bool(each) for place, each in enumerate(inside)}
    held["misfit"] = lognormal_misfit(outcomes, Resampling(RESAMPLES, number)) < SIGNIFICANT
    return held if population.two_kinds else held | _lognormal(population, outcomes, curve, number)


def _lognormal(population: Population, outcomes: Outcomes, curve: IsotonicCurve, number: int) -> Held:
    fit = fit_lognormal(outcomes, Resampling(RESAMPLES, number))
    betas = split_beta(outcomes, fit)
    given = not (fit.reason or fit.no_interval)
    held: Held = {
        "given": given,
        "median": _holds(fit.median, MEDIAN),
        "beta": _holds(fit.beta, population.beta),
        "beta of records": _over(betas.records, population.of_records),
        "beta of parameters": _over(betas.parameters, population.of_parameters),
        "rate": _holds(annual_rate(HAZARD, fit, curve).rate, lognormal_rate(HAZARD, MEDIAN, population.beta)[0])
        if given
        else None,
    }
    at = fit.probability(MEDIAN * np.exp(population.beta * scipy.special.ndtri(PROBABILITIES)))
    for place, true in enumerate(PROBABILITIES):
        held[f"P = {true:g}"] = _holds(Interval(true, at.low[place], at.high[place]), true)
    return held


def _holds(interval: Interval, truth: float) -> bool | None:
    return None if np.isnan(interval.low) else bool(interval.low <= truth <= interval.high)


def _over(value: float, truth: float) -> float | None:
    return None if np.isnan(value) else value / truth
