"""What the summary says of an assessment."""

from __future__ import annotations

from typing import Literal

from colonnade.campaign.syntax.table import Known, Record

UNCORRECTED = "records as they are"
"""Name of the variant without the correction of the records that was asked for."""


class Estimate(Record):
    """A value and its 95 % interval."""

    value: Known = None
    """Null if it cannot be given."""
    low: Known = None
    """Lower end of the interval."""
    high: Known = None
    """Upper end of the interval."""
    beyond: Literal["below", "above"] | None = None
    """Of a value that is null: whether it is below the lowest level or above the highest."""


class Variant(Record):
    """What the answer would be under another assumption, with nothing drawn."""

    name: str
    """The assumption, in words."""
    restitution: float
    """e."""
    median: Estimate = Estimate()
    """Of its lognormal curve."""
    five_percent: Estimate = Estimate()
    """Measure at which the column overturns with a probability of 5 %, by that curve."""
    records: int | None = None
    """Number of ground motions that were run."""
    reason: str | None = None
    """Why there is no curve."""


class JudgedMeasure(Record):
    """How well a measure of intensity predicts overturning."""

    measure: str
    """Its id."""
    deviance: Known = None
    """−2 log-likelihood a history of the best curve over it: the smaller the better."""
    auc: Known = None
    """Probability that of two histories the one that overturns has more of it."""
    scatter: Known = None
    """Standard deviation of ln peak about its regression on the logarithm of the measure."""
    best: Known = None
    """Share of the resamples of records in which its deviance is the smallest."""
    magnitude: Known = None
    """p-value of no dependence on the magnitude that is left; null if magnitudes are not given."""
    distance: Known = None
    """p-value of no dependence on the distance that is left; null if distances are not given."""


class JudgedCriterion(Record):
    """A criterion of practice against what was computed: numbers of motions, each at a level, with nothing varied."""

    criterion: str
    """Its id."""
    right_overturned: int
    """It says that the column overturns (or rocks), and it does."""
    right_stands: int
    """It says that it stands (or does not rock), and it does."""
    false_alarms: int
    """It says that the column overturns (or rocks), and it does not."""
    missed: int
    """It says that it stands (or does not rock), and it does not."""
    unknown: int = 0
    """It says nothing, as the record drifts and has no velocity."""


class DecidingRecord(Record):
    """The answer without one record."""

    record: str
    """Its name."""
    median: Known = None
    """Median without it."""
    annual_rate: Known = None
    """Annual rate without it; null without a hazard."""


class RecordUsed(Record):
    """A ground motion that was run."""

    record: str
    """Its name."""
    files: dict[str, str]
    """SHA-256 of its files, by name."""
    components: tuple[str, ...]
    """Its components, the horizontal ones first."""
    drift: float
    """Largest velocity at the end of a horizontal component over its peak velocity."""
    measures: dict[str, Known]
    """Measures of its first horizontal component as recorded, SI; null if it has none, as of a record that drifts."""


class RecordLeftOut(Record):
    """A file or a record that could not be used."""

    record: str
    """Its name."""
    reason: str
    """Why."""


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
    critical_angle: Known = None
    """α of the column, rad."""
    p: Known = None
    """Frequency parameter of the column, rad/s."""
    critical_angle_range: tuple[float, float] | None = None
    """Limits between which α was drawn, rad."""
    p_range: tuple[float, float] | None = None
    """Limits between which p was drawn, rad/s."""
    friction: Known = None
    """Friction between the column and what it stands on."""
    friction_range: tuple[float, float] | None = None
    """Limits between which it was drawn."""
    baseline: str = "none"
    """Correction of the records."""
    restitution: Estimate = Estimate()
    """e that was assumed, with the limits between which it was drawn; null of several bodies on contact."""
    restitution_source: str | None = None
    """Where that e comes from: given, identified or rigid-body."""
    displaced: Known = None
    """Of several bodies: how far from its place, m, one may end; one that ends farther counts as overturned."""
    uplift_acceleration: Known = None
    """Horizontal acceleration at which the column starts to rock, m/s², without vertical motion."""
    uplift: Estimate = Estimate()
    """Measure at which it rocks, however little, in half of the histories; null if it alone decides that, as the PGA
    does without vertical motion, if α is not drawn."""
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
    resurrected: Known = None
    """Share of the histories that stand although the same column overturned on the same record at a lower level."""
    sliding: Known = None
    """Share of the runs in which the friction given does not hold the column in place."""
    annual_rate: Estimate = Estimate()
    """Overturnings a year, with the hazard that is given, by the lognormal curve."""
    annual_rate_isotonic: Known = None
    """The same by the curve that only rises: 0 below the lowest level, constant above the highest."""
    probability_50_years: Estimate = Estimate()
    """Probability of overturning within 50 years."""
    rate_outside: Known = None
    """Share of the annual rate from intensities outside the hazard curve."""
    variants: tuple[Variant, ...] = ()
    """The answer under other assumptions."""
    measures: tuple[JudgedMeasure, ...] = ()
    """Measures of intensity, the best first."""
    criteria: tuple[JudgedCriterion, ...] = ()
    """Criteria of practice."""
    deciding: tuple[DecidingRecord, ...] = ()
    """The records that change the answer most, the first one most."""
    records_used: tuple[RecordUsed, ...] = ()
    """Ground motions that were run."""
    records_left_out: tuple[RecordLeftOut, ...] = ()
    """Ground motions that could not be used."""
    notes: tuple[str, ...] = ()
    """What else is to know of the files of the ground motions."""
