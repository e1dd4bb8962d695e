"""Everything that is asked of the outcomes of a set of records, and the records that decide it."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import cached_property
from typing import Literal, NamedTuple

import numpy as np
import scipy

from colonnade.arrays import Array
from colonnade.assessment.comparison import MeasureScore, compare_measures
from colonnade.assessment.curves import IsotonicCurve, LognormalFit, fit_isotonic, fit_lognormal, lognormal_misfit
from colonnade.assessment.hazard import AnnualRate, Hazard, annual_rate, lognormal_rate
from colonnade.assessment.intervals import Interval, Resampling
from colonnade.assessment.measures import measure_of
from colonnade.assessment.outcomes import Outcomes
from colonnade.assessment.probit import fit_parameters
from colonnade.units.text import Digested, written
from colonnade.validation import number

MISFITS = 0.05
"""p-value of the misfit below which the lognormal curve is not taken."""


@dataclass(frozen=True, repr=False)
class Fragility(Digested):
    """
    Fragility of a block; all that follows from its outcomes is computed when it is first asked for.

    Attributes
    ----------
    outcomes : Outcomes
        Made by `gather`.
    resampling : Resampling
        Of all intervals.
    hazard : Hazard or None
        Of the measure of the outcomes.
    compared, magnitude, distance : optional
        Measures that are compared, and what is known of the earthquakes, as of `compare_measures`.
    measure : str
        Id of the measure of intensity; all intensities are in its SI unit.

    Examples
    --------
    >>> import numpy as np
    >>> import colonnade
    >>> block = colonnade.Block.prism(width=1.7, depth=1.7, height=9.1, mass=40e3)
    >>> time = np.arange(0.0, 6.0, 0.02)
    >>> taper = np.sin(np.pi * time / 6.0) ** 2
    >>> waves = [3.0 * taper * np.sin(2 * np.pi * f * (time - 3.0)) for f in (0.4, 0.5, 0.6, 0.7)]
    >>> motions = [colonnade.Motion(wave, 0.02) for wave in waves]
    >>> found = colonnade.fragility(block, motions, restitution=0.95, levels=[0.5, 1.0, 2.0, 4.0], draws=1)
    >>> found.measure, found.taken, 0.5 < found.reaches(0.5).value < 4.0
    ('pgv', 'isotonic', True)
    >>> found.isotonic.probability.value.tolist(), found.resurrected
    ([0.0, 0.25, 1.0, 1.0], 0.0)
    >>> found.lognormal.reason, found.uplift.reason  # what follows from the curve is not a number then
    ('separated', 'separated')
    >>> found.misfit, found.betas.records, found.influence[0].median, found.rate
    (nan, nan, nan, None)
    >>> len(found.measures), found.measures[0].measure
    (5, 'pgd')
    >>> found.digest()["records"]
    '4'
    """

    outcomes: Outcomes
    resampling: Resampling
    hazard: Hazard | None = None
    compared: Mapping[str, Array] = field(default_factory=dict)
    magnitude: Array | None = None
    distance: Array | None = None
    measure: str = "pgv"

    @cached_property
    def lognormal(self) -> LognormalFit:
        """Lognormal curve of overturning; `reason` says why it is missing, else it is empty."""
        return fit_lognormal(self.outcomes, self.resampling)

    @cached_property
    def isotonic(self) -> IsotonicCurve:
        """Curve of overturning that only rises."""
        return fit_isotonic(self.outcomes, self.resampling)

    @cached_property
    def misfit(self) -> float:
        """Probability of a misfit as large as the lognormal curve's if it were right; NaN without a curve."""
        return lognormal_misfit(self.outcomes, self.resampling)

    @cached_property
    def uplift(self) -> LognormalFit:
        """Curve of the start of rocking; "separated" if the intensity alone decides it, as PGA may."""
        return fit_lognormal(self.outcomes, self.resampling, event=self.outcomes.peak > 0)

    @property
    def resurrected(self) -> float:
        """Share of all histories that survive although the same record and draw overturned at a lower level."""
        run, fallen = self.outcomes.was_run, self.outcomes.overturned
        before = np.logical_or.accumulate(fallen, axis=1)
        return float((before & ~fallen & run).sum() / run.sum())

    @cached_property
    def betas(self) -> Betas:
        """β from motion to motion, and from draw to draw within one."""
        return split_beta(self.outcomes, self.lognormal)

    @cached_property
    @np.errstate(over="ignore", divide="ignore", invalid="ignore")  # without a record the curve may be nearly flat
    def influence(self) -> tuple[Without, ...]:
        """
        The curve without each record, the most influential first: by the rate if there is a hazard, else the median.

        A record without which there is no curve comes first of all.
        """
        rows = len(self.outcomes.records)
        weights = np.vstack((np.ones(rows), 1.0 - np.eye(rows)))
        parameters = fit_parameters(self.outcomes.cells(), weights)[0]
        median, beta = np.exp(parameters.log_median), np.exp(parameters.log_beta)
        rate = np.full(rows + 1, np.nan) if self.hazard is None else lognormal_rate(self.hazard, median, beta)
        decides = median if self.hazard is None else rate
        change = np.nan_to_num(np.abs(np.log(decides[1:] / decides[0])), nan=np.inf)
        found = list(map(Without, self.outcomes.records, median[1:].tolist(), rate[1:].tolist()))
        return tuple(found[place] for place in np.argsort(-change, kind="stable"))

    @cached_property
    def measures(self) -> tuple[MeasureScore, ...]:
        """Measures that were compared, the best by deviance first."""
        known = self.magnitude, self.distance
        return compare_measures(self.outcomes, self.compared, self.resampling, *known)

    @cached_property
    def rate(self) -> AnnualRate | None:
        """Annual rate of overturning, if there are a hazard and a lognormal curve."""
        if self.hazard is None or self.lognormal.reason:
            return None
        return annual_rate(self.hazard, self.lognormal, self.isotonic)

    @property
    def taken(self) -> Literal["lognormal", "isotonic"]:
        """The curve from which answers are read: the lognormal one, if there is one and it fits."""
        return "isotonic" if self.lognormal.reason or self.misfit < MISFITS else "lognormal"

    def reaches(self, probability: float) -> Interval:
        """
        Give the intensity at which so many overturn, by the curve that is `taken`.

        Parameters
        ----------
        probability : float
            Share that overturns, between 0 and 1.

        Returns
        -------
        intensity : Interval
            `value`, `low`, `high` in the SI unit of the measure; 0 if below the levels, inf if above.

        Raises
        ------
        ValueError
            If the probability is not between 0 and 1.
        """
        number("probability", probability, "a number between 0 and 1", above=0.0, below=1.0)
        return (self.isotonic if self.taken == "isotonic" else self.lognormal).reaches(probability)

    def digest(self) -> dict[str, str]:
        """
        Return the curve and what it rests on, or the reason why it is missing.

        Returns
        -------
        digest : dict of str to str
            Names and values with their units, as a notebook shows them.
        """
        unit = measure_of(self.measure).unit
        curve: dict[str, str] = {"no curve": self.lognormal.reason}
        if not self.lognormal.reason:
            median, beta = self.lognormal.median, self.lognormal.beta
            curve = {
                "median": written(median.value, f"({written(median.low)} to {written(median.high)}) {unit}"),
                "β": written(beta.value, f"({written(beta.low)} to {written(beta.high)})"),
                "p of the misfit": written(self.misfit, digits=2),
            }
        rate = {} if self.rate is None else {"rate": written(self.rate.rate.value, "1/year", 3)}
        return {"records": str(len(self.outcomes.records)), **curve, **rate}


class Betas(NamedTuple):
    """β of the curve from motion to motion, and from draw to draw within one; NaN if they cannot be told apart."""

    records: float
    parameters: float


def split_beta(outcomes: Outcomes, fit: LognormalFit) -> Betas:
    """
    Split the β of a curve into that between motions and that between the draws of one.

    Parameters
    ----------
    outcomes : Outcomes
        Each record with draws of its own.
    fit : LognormalFit
        Of them.

    Returns
    -------
    betas : Betas
        NaN without a curve, or of a single draw.

    Notes
    -----
    ln capacity = ln median + β_records R + β_parameters D, R one for each motion (record and direction), D one for each
    of its draws: the capacities of two draws under one motion are correlated by ρ = β_records² / β². Both overturn at
    an intensity with the probability Φ₂(z, z; ρ) = Φ(z) − 2 T(z, √((1 − ρ) / (1 + ρ))), T Owen's function: ρ is such
    that as many pairs do as did (tetrachoric correlation, Pearson 1900), at all levels together. Capacities beyond the
    levels count as what they are, unlike in an analysis of variance.
    """
    histories, over = outcomes.was_run.sum(axis=2), outcomes.overturned.sum(axis=2)
    pairs, both = histories * (histories - 1), over * (over - 1)
    if fit.reason or not pairs.any():
        return Betas(np.nan, np.nan)
    z = (np.log(outcomes.levels)[:, None] - fit.fit.log_median[0]) / np.exp(fit.fit.log_beta[0])

    def excess(rho: float) -> float:
        likely = scipy.special.ndtr(z) - 2 * scipy.special.owens_t(z, np.sqrt((1 - rho) / (1 + rho)))
        return float((both - pairs * likely).sum())

    rho = 0.0 if excess(0.0) <= 0.0 else 1.0 if excess(1.0) >= 0.0 else scipy.optimize.brentq(excess, 0.0, 1.0)
    return Betas(float(fit.beta.value * np.sqrt(rho)), float(fit.beta.value * np.sqrt(1.0 - rho)))


class Without(NamedTuple):
    """Median of the curve without a record, and annual rate; NaN if there is then no curve, or no hazard."""

    record: str
    median: float
    rate: float
