"""The form of processed/summary.json, contract 1."""

from __future__ import annotations

from typing import Annotated, Any, Literal

from pydantic import Field

from colonnade.campaign.forms.assessed import AssessmentSummary
from colonnade.campaign.forms.foreseen import ForecastsSummary, TestForecast
from colonnade.campaign.syntax.table import Known, Record
from colonnade.findings import Finding, Severity

Outcome = Literal["no-rocking", "rocking", "overturned"]
Order = int | Literal["irregular"] | None


def _in(unit: str) -> Any:
    """Give the field of a number with its unit, which the schema and `colonnade show` take from it."""
    return Field(json_schema_extra={"unit": unit})


Ratio = Annotated[Known, _in("α")]
Metres = Annotated[Known, _in("m")]
Radians = Annotated[Known, _in("rad")]
Seconds = Annotated[Known, _in("s")]
Hertz = Annotated[Known, _in("Hz")]


class RestitutionSummary(Record):
    """The coefficient of restitution that predictions use."""

    value: float | tuple[float, float] | None
    """Ratio of angular velocity after an impact to before; a pair for θ < 0 and θ > 0; null where refused."""
    low: Known = None
    """Lower end of its interval."""
    high: Known = None
    """Upper end of its interval."""
    level: Known = None
    """Probability of the interval."""
    source: Literal["given", "identified", "rigid-body"]
    """Where it comes from."""
    method: str | None = None
    """How it was identified."""
    reason: str | None = None
    """Why it was refused."""
    tests: tuple[str, ...] = ()
    """Free vibrations it was identified from."""


class SpecimenPrototype(Record):
    """The specimen at prototype scale: length × s, time × √s, same density."""

    scale: float
    """s of the 1:s model."""
    p: float
    """Frequency parameter, rad/s."""
    pole_distance: float
    """R, m."""
    mass: float = _in("kg")
    """kg."""
    inertia: float
    """I₀ about the pole, kg m²."""
    sizes: dict[str, float]
    """Outer dimensions by their keys in the campaign file, m."""


class SpecimenSummary(Record):
    """A specimen; of one that is not symmetric the side with the smaller critical angle."""

    critical_angle: float = _in("rad")
    """α, rad."""
    p: float = _in("rad/s")
    """Frequency parameter, rad/s."""
    pole_distance: float = _in("m")
    """R, m."""
    inertia: float = _in("kg m²")
    """I₀ about the pole, kg m²."""
    restitution: RestitutionSummary
    """Coefficient of restitution."""
    prototype: SpecimenPrototype | None = None
    """At prototype scale, where the campaign file gives the specimen's scale."""


class PredictionSummary(Record):
    """What a model gives on the recorded base motion; empty if it has not run."""

    outcome: Outcome | None = None
    """Predicted outcome."""
    peak_ratio: Ratio = None
    """max |θ| / α; null when overturned."""
    nrmse: Ratio = None
    """RMS of predicted − measured, over α, until either first passes α."""
    order: Order = None
    """Predicted order of a sine test's response; see the test's own."""
    horizon: Seconds = None
    """Time up to which the model predicts the angle, s: the first at which the 95 % band of its runs is wider than the
    setting `processing.predict.ensemble.horizon`, else the record's end; null if it has no runs."""
    within_spread: Known = None
    """Rank of the measured angle: share of the model's runs that are closer to their median, by their largest scaled
    distance up to the horizon. Within the model's own spread: at most 0.95."""
    peak_low: Ratio = None
    """Lower end of the band that holds the peaks of 95 % of the model's runs, as max |θ| / α."""
    peak_high: Ratio = None
    """Its upper end; null where more than 2.5 % of the runs overturn."""
    peak_rank: Known = None
    """Share of the model's runs whose peak, measured with the same noise, would be below the measured one."""
    overturning_probability: Known = None
    """Share of the model's runs that overturn."""


class HistorySummary(Record):
    """e of a free vibration from its whole history, by one model."""

    value: Known = None
    """The e with which the model follows the measured angle most closely; null where refused."""
    low: Known = None
    """Lower end of its interval."""
    high: Known = None
    """Upper end of its interval."""
    residual: Radians = None
    """RMS of measured − simulated angle, rad."""


class IdentifiedSummary(Record):
    """e of one free vibration."""

    value: Known = None
    """By its peaks, which is the one that is pooled; null where refused."""
    low: Known = None
    """Lower end of its interval."""
    high: Known = None
    """Upper end of its interval."""
    reason: str | None = None
    """Why it was refused."""
    whole_history: dict[str, HistorySummary] = Field(default={})
    """Beside it that of the whole history, by model."""


class TestPrototype(Record):
    """A test at prototype scale; accelerations and angles are those of the model."""

    duration: float = _in("s")
    """Length of the record, s."""
    frequency: Hertz = None
    """Of a sine test, Hz."""
    peak_time: Seconds = None
    """Time of the peak, s."""
    peak_slide: Metres = None
    """Largest slide, m."""


class Warned(Record):
    """A finding of a stage."""

    severity: Severity
    """serious: results are wrong until it is put right; warning: a result may be affected; note: the results hold."""
    kind: str
    """In a few words what it is about; findings of one kind are counted together."""
    text: str
    """What was found, where, and what to do."""
    stage: str = ""
    """That found it."""
    explained: bool = False
    """Whether it follows from one before it in the list."""

    @classmethod
    def of(cls, finding: Finding, *, explained: bool) -> Warned:
        """Return the record of a finding."""
        return cls.model_validate(finding, from_attributes=True).model_copy(update={"explained": explained})


class BodyPrediction(Record):
    """What a model gives of one body of an assembly."""

    outcome: Outcome | None = None
    """Predicted outcome."""
    peak_ratio: Ratio = None
    """Largest rocking angle in the joint below, over the critical angle of all that turns there; null where it fell."""
    residual_x: Metres = None
    """Displacement along x of the centre of its base at the end, from where it stood, m."""
    residual_y: Metres = None
    """The same along y, m."""
    residual_yaw: Radians = None
    """Rotation about the vertical at the end, rad."""
    moved_low: Metres = None
    """Of the model's runs in which it stands, 95 % move it farther than this and less than the next, m."""
    moved_high: Metres = None
    """The upper end of that band, m."""
    overturning_probability: Known = None
    """Share of the model's runs in which it falls."""


class BodySummary(BodyPrediction):
    """One body of an assembly, as measured."""

    outcome: Outcome | None = None
    """Measured outcome; null where it was not measured."""
    opening: Metres = None
    """Largest gap of the joint below, m."""
    opening_time: Seconds = None
    """When that joint first opened, s; null where it did not."""
    separation: str | None = None
    """What its transducers separate, or why it was not measured."""
    predicted: dict[str, BodyPrediction] = Field(default={})
    """By model."""


class TestSummary(Record):
    """A test."""

    status: Literal["done", "failed", "pending"]
    """Whether its stages have run."""
    reason: str | None = None
    """Why it failed, or is left out by the manual review."""
    warnings: tuple[Warned, ...] = ()
    """What its stages found: the worst first, causes before what follows from them."""
    kind: str
    """As in the campaign file."""
    specimen: str
    """As in the campaign file."""
    span: Known = None
    """As in the campaign file."""
    date: str | None = None
    """Day of the test, as in the campaign file: year, month, day."""
    operator: str | None = None
    """As in the campaign file."""
    outcome: Outcome | None = None
    """Measured outcome."""
    observed_outcome: str | None = None
    """As in the campaign file."""
    peak_ratio: Ratio = None
    """max |θ| / α; null when overturned. Of a free vibration over the time that is predicted."""
    peak_time: Seconds = None
    """Time of the peak, s."""
    release_ratio: Ratio = None
    """Of a free vibration max |θ| / α before the time that is predicted: the angle that it was released from."""
    pga: Annotated[Known, _in("m/s²")] = None
    """Peak acceleration of the table, m/s²."""
    duration: Seconds = None
    """Length of the record, s."""
    peak_slide: Metres = None
    """Largest slide of the base on the table while the specimen stands, m; null where not measured."""
    impacts: int | None = None
    """Impacts followed by a peak above noise and 0.001 α."""
    frequency: Hertz = None
    """Of a sine test, as recorded on the table, Hz; as given where the record does not show it."""
    frequency_ratio: Known = None
    """Ω = ω / p of a sine test."""
    amplitude_ratio: Known = None
    """A = a / (g tan α) of a sine test, a the amplitude while the table's recorded motion is steady."""
    order: Order = None
    """Order of a sine test's response: 1 harmonic, n sub-harmonic 1/n, or irregular; null if it is not known."""
    order_reason: str | None = None
    """What the order is based on, or why it cannot be determined."""
    impacts_per_cycle: Known = None
    """Impacts a period of the table, of a sine test."""
    restitution: IdentifiedSummary | None = None
    """What a free vibration says."""
    prototype: TestPrototype | None = None
    """At prototype scale, where the campaign file gives the specimen's scale."""
    predicted: dict[str, PredictionSummary] = Field(default={})
    """By model."""
    bodies: dict[str, BodySummary] = Field(default={})
    """Of an assembly: each body by its id, from the bottom to the top."""
    forecast: TestForecast | None = None
    """What was foreseen of it; null without a forecast."""


class Summary(Record):
    """One record for each specimen and test, rebuilt from the result files."""

    version: Literal[1] = Field(default=1, alias="schema")
    """Version of this form: 1."""
    campaign: str
    """Id of the campaign."""
    colonnade: str
    """Version of colonnade that wrote it."""
    specimens: dict[str, SpecimenSummary]
    """By id."""
    tests: dict[str, TestSummary]
    """By id."""
    forecasts: ForecastsSummary | None = None
    """The forecasts together; null without one."""
    assessments: dict[str, AssessmentSummary] = Field(default={})
    """The assessments of real columns, by name."""

    def text(self) -> str:
        """Write it as JSON."""
        return self.model_dump_json(by_alias=True, indent=1) + "\n"
