"""The form of a forecast file: what was foreseen of one specimen, motion and level, and all that it follows from."""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import AwareDatetime, Field, NonNegativeFloat, PositiveFloat, model_validator

from colonnade.campaign.syntax.table import Record
from colonnade.dynamics.block import Block, Side
from colonnade.dynamics.models import MODELS
from colonnade.dynamics.uncertainty import Uncertainty

MOST_MEMBERS = 1_000_000
"""Of an ensemble; as many as the settings allow."""

Probability = Annotated[float, Field(ge=0.0, le=1.0)]
Correlation = Annotated[float, Field(ge=-1.0, le=1.0)]
Peaks = Annotated[tuple[NonNegativeFloat | None, ...], Field(min_length=2, max_length=MOST_MEMBERS)]
Sha256 = Annotated[str, Field(pattern="^[0-9a-f]{64}$")]


class ForecastBlock(Record):
    """The block."""

    mass: PositiveFloat
    """kg."""
    gravity: PositiveFloat
    """m/s²."""
    negative: Side
    """At θ < 0."""
    positive: Side
    """At θ > 0."""
    beam_ratio: NonNegativeFloat = 0.0
    """γ: mass of the beam over that of all columns of a frame; 0 for a block."""

    @classmethod
    def of(cls, block: Block) -> ForecastBlock:
        """Take the values of a block."""
        return cls.model_validate(block, from_attributes=True)

    def block(self) -> Block:
        """Return the block; ValueError if a value is out of its range."""
        return Block(**dict(self))


class ForecastRestitution(Record):
    """The e that was known."""

    value: tuple[Probability, Probability]
    """Of impacts that end an arc at θ < 0, and at θ > 0."""
    low: Probability | None
    """Lower end of its interval; null if it was not identified."""
    high: Probability | None
    """Upper end."""
    level: Probability
    """Probability of the interval."""
    source: Literal["given", "identified", "rigid-body"]
    """Where it comes from."""
    rigid_body: tuple[Probability, Probability]
    """e of a rigid body without bounce, for the reference forecast."""


class ForecastSpread(Record):
    """Standard deviations of what is not exactly known."""

    restitution: NonNegativeFloat
    """Of e in a new test."""
    restitution_freedom: PositiveFloat | None = None
    """Degrees of freedom of Student's t that it is the scale of; null if e is normal."""
    critical_angle: NonNegativeFloat
    """Of α, relative."""
    p: NonNegativeFloat
    """Of p, relative."""
    correlations: tuple[Correlation, Correlation, Correlation] = (0.0, 0.0, 0.0)
    """Of e with α, of e with p, and of α with p."""
    gain: NonNegativeFloat
    """Of the calibration of the table's acceleration, relative."""
    clock: NonNegativeFloat
    """Of the sampling interval, relative."""

    def uncertainty(self) -> Uncertainty:
        """Return it as ensembles take it."""
        return Uncertainty(**self.model_dump())


class ForecastInputs(Record):
    """What the models were run with."""

    block: ForecastBlock
    """Of the specimen, as predictions take it: with its identified α and p, else as the campaign file gives it."""
    restitution: ForecastRestitution
    """Coefficient of restitution."""
    spread: ForecastSpread
    """Standard deviations."""
    table_tilt: float
    """Tilt of the table at rest, rad."""
    rest_angle: NonNegativeFloat
    """Largest arc after an impact that counts as rest, of α."""
    members: Annotated[int, Field(ge=2, le=MOST_MEMBERS)]
    """Runs of each model."""
    seed: Annotated[int, Field(ge=0, lt=2**63)]
    """Member k draws from a stream of its own, of (seed, k)."""

    @model_validator(mode="after")
    def _usable(self) -> ForecastInputs:
        self.block.block()
        self.spread.uncertainty()
        return self


class ForecastMotion(Record):
    """The base motion, along x."""

    name: str
    """As it was asked for."""
    source: str
    """Where it was taken from."""
    sha256: Sha256
    """Of the accelerations that the models got: m/s², little-endian float64."""
    interval: PositiveFloat
    """Between these samples, s."""
    samples: Annotated[int, Field(ge=1)]
    """Their number."""
    time_scale: PositiveFloat
    """Factor on the motion's own time."""


class ForecastTable(Record):
    """What the table has to do."""

    peak_acceleration: NonNegativeFloat
    """m/s²."""
    peak_velocity: NonNegativeFloat | None
    """m/s, by integration; null if the integral drifts."""
    peak_displacement: NonNegativeFloat | None
    """m from the position at rest, by integrating twice; null if the integral drifts."""
    drift: NonNegativeFloat
    """What a line takes off the integral so that the motion ends at rest, over its peak: of the displacement, or of the
    velocity if that drifts already. Above 0.25 the integral is not given."""


class ForecastBand(Record):
    """A central band of min(max |θ|, α)/α: 0 does not rock, 1 overturns."""

    probability: Probability
    """Of the band."""
    low: Probability
    """Its lower end."""
    high: Probability
    """Its upper end."""


class ModelForecast(Record):
    """What one model foresees."""

    no_rocking: Probability
    """Share of the members that do not rock."""
    rocking: Probability
    """Share of those that rock and stand."""
    overturned: Probability
    """Share of those that overturn."""
    bands: tuple[ForecastBand, ForecastBand, ForecastBand]
    """Of 50, 80 and 95 %."""
    required_friction: NonNegativeFloat | None
    """Largest |H|/N between impacts while the specimen stands, of the run with nothing varied; null if it lifts off."""
    peak_ratio: Peaks
    """max |θ|/α of each member; null if it overturns."""
    rigid_body_peak_ratio: Peaks
    """The same with the e of the rigid body: the reference."""


class ForecastFile(Record):
    """One forecast."""

    version: Literal[1] = Field(default=1, alias="schema")
    """Version of this form: 1."""
    made: AwareDatetime
    """When, UTC."""
    colonnade: str
    """Version of colonnade that made it."""
    code: Sha256
    """Hash of the code that made it."""
    test: str | None
    """Id of the test that it is for."""
    specimen: str
    """Id of the specimen."""
    level: str
    """As it was asked for: a peak acceleration, or a factor on the recorded motion."""
    motion: ForecastMotion
    """The base motion."""
    table: ForecastTable
    """What the table has to do."""
    inputs: ForecastInputs
    """What the models were run with."""
    models: Annotated[dict[str, ModelForecast], Field(min_length=1)]
    """By model."""
    raw_files: dict[str, Sha256]
    """Raw files that were there, and their SHA-256. It is blind if those of the test are not among them."""

    @model_validator(mode="after")
    def _belongs_together(self) -> ForecastFile:
        for name, model in self.models.items():
            if name not in MODELS or MODELS[name].in_space:
                raise ValueError(f'"{name}" is no model in the plane')
            if {len(model.peak_ratio), len(model.rigid_body_peak_ratio)} != {self.inputs.members}:
                raise ValueError(f"{name}: {self.inputs.members} members were expected")
        return self
