"""What the summary says of an assessment."""

from __future__ import annotations

from typing import Literal

from colonnade.campaign.record import Known, Record


class Estimate(Record):
    """A value and its 95 % interval."""

    value: Known = None
    """Null if it cannot be given."""
    low: Known = None
    """Lower end of the interval."""
    high: Known = None
    """Upper end of the interval."""


class AssessmentSummary(Record):
    """An assessment of a real column; accelerations in m/s², angles in rad, the measure in its SI unit."""

    status: Literal["done", "failed"]
    """Whether it could be made."""
    reason: str | None = None
    """Why it failed."""
    warnings: tuple[str, ...] = ()
    """What is doubtful about it."""
    specimen: str
    """Id of the specimen that is a model of the column."""
    measure: str
    """Measure of intensity."""
    unit: str | None = None
    """SI unit of the measure; empty if it has none."""
    records: int | None = None
    """Ground motions that were run."""
    left_out: int | None = None
    """Ground motions that could not be used."""
    critical_angle: Known = None
    """α of the column, rad."""
    p: Known = None
    """Frequency parameter of the column, rad/s."""
    restitution: Estimate = Estimate()
    """e that was assumed, with the limits between which it was drawn."""
    restitution_source: str | None = None
    """Where that e comes from: given, identified or rigid-body."""
    uplift_acceleration: Known = None
    """Horizontal acceleration at which the column starts to rock, m/s², without vertical motion."""
    median: Estimate = Estimate()
    """Of the lognormal curve: the measure at which half of the columns overturn."""
    dispersion: Estimate = Estimate()
    """β of the lognormal curve: standard deviation of the logarithm."""
    dispersion_records: Known = None
    """Part of β that the records make."""
    dispersion_parameters: Known = None
    """Part of β that e, α and p make."""
    five_percent: Estimate = Estimate()
    """Measure at which the column overturns with a probability of 5 %."""
    fifty_percent: Estimate = Estimate()
    """Measure at which it overturns with a probability of 50 %."""
    curve: Literal["lognormal", "isotonic"] | None = None
    """The curve from which these two are taken."""
    curve_reason: str | None = None
    """Why the lognormal curve is not taken, or not fitted."""
    misfit: Known = None
    """Probability of a misfit of the lognormal curve as large as this one if the curve were right."""
    sliding: Known = None
    """Share of the runs in which the friction given does not hold the column in place."""
    annual_rate: Estimate = Estimate()
    """Overturnings a year, with the hazard that is given."""
    probability_50_years: Estimate = Estimate()
    """Probability of overturning within 50 years."""
    rate_outside: Known = None
    """Share of the annual rate from intensities outside the hazard curve."""
