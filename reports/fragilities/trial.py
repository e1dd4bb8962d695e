"""One repetition: a sample of a population, and whether each interval holds the truth."""

from __future__ import annotations

import numpy as np
import scipy

from colonnade.assessment.betas import separate_betas
from colonnade.assessment.curves import IsotonicCurve, fit_isotonic, fit_lognormal, lognormal_misfit
from colonnade.assessment.hazard import annual_rate, hazard_curve, lognormal_rate
from colonnade.assessment.intervals import Interval, Resampling
from colonnade.assessment.outcomes import Outcomes
from fragilities.population import MEDIAN, Population

RESAMPLES = 999
PROBABILITIES = (0.1, 0.6, 0.9)
"""True probabilities at the intensities where P is judged."""

SIGNIFICANT = 0.05
HAZARD = hazard_curve(np.geomspace(0.01, 10.0, 20), 1e-4 * np.geomspace(0.01, 10.0, 20) ** -2.0)
"""A power law, so that the true rate is in closed form."""

Held = dict[str, bool | None]
"""
Whether it holds the truth, by the name of an interval; None if it is not given. `given` says whether that of the curve
is, `misfit` whether the test finds one.
"""


def run(population: Population, seed: int, number: int) -> Held:
    """Run repetition `number`."""
    outcomes = population.sample(np.random.default_rng((seed, number)))
    curve = fit_isotonic(outcomes, Resampling(RESAMPLES, number))
    truth = population.probability(curve.intensity)
    inside = (curve.probability.low <= truth) & (truth <= curve.probability.high)
    held: Held = {f"isotonic {place}": bool(each) for place, each in enumerate(inside)}
    held["misfit"] = lognormal_misfit(outcomes, Resampling(RESAMPLES, number)).p_value < SIGNIFICANT
    return held if population.two_kinds else held | _lognormal(population, outcomes, curve, number)


def _lognormal(population: Population, outcomes: Outcomes, curve: IsotonicCurve, number: int) -> Held:
    fit = fit_lognormal(outcomes, Resampling(RESAMPLES, number))
    betas = separate_betas(outcomes, Resampling(RESAMPLES, number))
    given = not (fit.reason or fit.no_interval)
    held: Held = {
        "given": given,
        "median": _holds(fit.median, MEDIAN),
        "beta": _holds(fit.beta, population.beta),
        "beta of records": _holds(betas.records, population.of_records),
        "beta of parameters": _holds(betas.parameters, population.of_parameters),
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
