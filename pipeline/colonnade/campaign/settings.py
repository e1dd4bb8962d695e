"""
Settings of the processing: each with its default and what it does.

Each model holds the settings of one stage, which keeps it in its inputs; of a `Processing` given in its place,
only the fields of the model are stored with the result and enter its key.
"""

from __future__ import annotations

from typing import Annotated, Any, Literal, cast

from pydantic import AfterValidator, BeforeValidator, Field

from colonnade.campaign.syntax import fields
from colonnade.campaign.syntax.table import Table
from colonnade.dynamics.contact.body import DEFAULT_STEP, STATIC_PENETRATION
from colonnade.dynamics.models import MODELS, PLANE_MODELS

DEFAULT_MODELS = tuple(PLANE_MODELS)
"""Models that `predict` runs unless the campaign names others."""


AutoFrequency = Literal["auto"] | fields.Frequency
Model = Annotated[str, fields.OneOf(tuple(MODELS))]
Models = Annotated[tuple[Model, ...], Field(min_length=1), BeforeValidator(fields.listed), AfterValidator(fields.once)]


def setting(default: Any, unit: str = "", **bounds: float) -> Any:
    """Give the field of a setting, with its default in SI, its unit, and bounds as of `Field`."""
    return Field(default=default, json_schema_extra={"unit": unit} if unit else None, **cast("Any", bounds))


class QualitySettings(Table):
    """Settings of the quality checks in `ingest`."""

    spike_threshold: fields.Number = setting(8.0, "robust standard deviations", gt=1.0, lt=1000.0)
    """A sample that differs from its neighbours by more than this is flagged as a spike and bridged."""
    flat_duration: fields.Duration = setting(0.5, "s")
    """A value that stays exactly the same for longer than this is flagged as flat."""
    gap: fields.Number = setting(1.5, "sampling intervals", gt=1.0, lt=1000.0)
    """A longer step of the clock is a gap."""
    jitter: fields.Number = setting(0.05, "sampling intervals", gt=0.0, lt=1.0)
    """A clock whose steps differ by more than this is flagged."""


class ConditionSettings(Table):
    """Settings of `condition`: the common clock, the low-pass filters and the zero."""

    sampling_rate: Literal["auto"] | Annotated[float, fields.Quantity("frequency", between=(1.0, 1e5))] = setting(
        "auto", "Hz"
    )
    """Rate of the common clock of all channels; "auto" uses that of the main recorder, at most 5000 Hz."""
    lowpass: AutoFrequency = setting("auto", "Hz")
    """Cut-off of the zero-phase low-pass of channels on the specimen; "auto" chooses it from specimen and rate."""
    base_lowpass: AutoFrequency = setting("auto", "Hz")
    """Cut-off of the zero-phase low-pass of channels on the table; "auto" chooses it from the rate."""
    filter_order: fields.Whole = setting(4, ge=1, le=10)
    """Order of the Butterworth low-pass, before it is run forwards and backwards."""
    rest_duration: fields.Duration = setting(0.5, "s")
    """Shortest quiet stretch that counts as rest."""
    longest_offset: fields.Duration = setting(1.0, "s")
    """Largest delay between two recorders that is searched for."""


class RestitutionSettings(Table):
    """Settings of the identification of the coefficient of restitution."""

    lowest_amplitude: fields.Number = setting(0.02, "of α", gt=1e-6, lt=1.0)
    """Peaks below this fraction of the critical angle are left out."""
    level: fields.Number = setting(0.95, gt=0.5, lt=0.999999)
    """Probability of the interval that is given for e."""


OVERNIGHT = 40
"""Runs on contact of each test of several bodies: 20 tests of four drums over 20 s take four cores seven hours."""


class ContactEnsembleSettings(Table):
    """Settings of the contact model's ensembles: the number of runs, and the ranges of its inputs."""

    members: Literal["auto"] | Annotated[fields.Whole, Field(ge=0, le=100_000)] = setting("auto")
    """Runs of the contact model over its unknown inputs, each as long as its prediction; 0 for no ensemble; "auto" is
    40 for an assembly, whose tests so take a night, and 0 for a single body."""
    friction: fields.Number = setting(0.2, "of the friction", ge=0.0, le=1.0)
    """Half of the range of friction, about that of the contact model; all values in it are equally likely."""
    damping_fraction: fields.Number = setting(0.2, "of the damping fraction", ge=0.0, le=1.0)
    """Half of the range of the contact's damping, about that of the contact model."""
    out_of_plane: fields.Angle = setting(1e-3, "rad")
    """Half of the range of the rotation about x at the start, about that of the contact model."""
    penetration: fields.Number = setting(0.5, "of the penetration", ge=0.0, lt=1.0)
    """Half of the range of how deep the bodies of an assembly sink into their contacts, which sets the stiffness."""
    misplacement: fields.Coordinate = setting(1e-3, "m")
    """How far each body of an assembly may stand off its place, along x and along y."""


class MeasurementSettings(Table):
    """How well the measured rocking angle is known, and how uncertain a prediction may become."""

    angle_gain: fields.Deviation = setting(0.005, "of the angle")
    """Standard deviation of the calibration of the measured rocking angle."""
    angle_zero: fields.Number = setting(5e-4, "of α", ge=0.0, le=0.5)
    """Standard deviation of the zero of the measured rocking angle; that of its drift between the rests, if larger."""
    horizon: fields.Number = setting(0.2, "of α", gt=0.0, lt=10.0)
    """A history is predicted up to the first time at which the 95 % band of its runs is wider than this."""


class PlaneEnsembleSettings(Table):
    """Settings of the plane models' ensembles: the number of runs, and how well their inputs are known."""

    members: fields.Whole = setting(100, ge=0, le=1_000_000)
    """Runs of each model over its uncertain inputs; 0 for no ensemble."""
    restitution: fields.Number = setting(0.005, ge=0.0, le=0.5)
    """Standard deviation of e from test to test if fewer than two free vibrations show it."""
    critical_angle: fields.Deviation = setting(0.005, "of α")
    """Standard deviation of the critical angle."""
    p: fields.Deviation = setting(0.005, "of p")
    """Standard deviation of the frequency parameter."""
    gain: fields.Number = setting(0.005, "of the acceleration", ge=0.0, le=0.5)
    """Standard deviation of the calibration of the table's acceleration."""
    clock: fields.Number = setting(1e-5, "of the sampling interval", ge=0.0, le=0.1)
    """Standard deviation of the recorder's clock rate."""
    filter: fields.Number = setting(0.1, "of the cut-off", ge=0.0, le=0.5)
    """Standard deviation of the low-pass cut-off of the table's acceleration: how much its choice matters."""


class EnsembleSettings(MeasurementSettings, PlaneEnsembleSettings):
    """Settings of all ensembles."""

    contact: ContactEnsembleSettings = ContactEnsembleSettings()
    """The ensembles of the contact model, if it is among the models."""


class ContactSettings(Table):
    """Settings of the contact model."""

    mesh: Literal["rigid"] | Annotated[fields.Whole, Field(ge=100, le=30_000)] = setting("rigid")
    """Body of the contact model: "rigid" (a round base on whole circles), or elastic with about so many degrees of
    freedom, such as 1224, 5478 or 20322 of the paper's meshes."""
    step: Annotated[float, fields.Quantity("time", between=fields.STEP, example="10 us")] = setting(DEFAULT_STEP, "s")
    """Time step of the contact model; it has to be stable."""
    damping_fraction: Literal["auto"] | Annotated[fields.Number, Field(ge=0.0, le=10.0)] = setting("auto")
    """Critical damping fraction of the contact; "auto" finds the one that gives the specimen's restitution."""
    penetration: fields.Number = setting(STATIC_PENETRATION, "of the height of the centre of mass", gt=1e-10, lt=0.01)
    """How deep the standing specimen sinks into its contact, which sets the contact's stiffness."""
    friction: fields.Number = setting(0.6, ge=0.0, le=10.0)
    """Coulomb's coefficient between specimen and table."""
    modulus: fields.Pressure = setting(2e11, "Pa")
    """Young's modulus of an elastic specimen."""
    poisson_ratio: fields.Number = setting(0.3, gt=-0.999, lt=0.4999)
    """Poisson's ratio of an elastic specimen."""
    out_of_plane: fields.Angle = setting(0.0, "rad")
    """Rotation about x at the start of the contact model: a disturbance out of the plane."""


class PredictSettings(Table):
    """Settings of the predictions."""

    models: Models = setting(DEFAULT_MODELS)
    """Models of rocking that are run on the recorded base motion."""
    rest_angle: fields.Number = setting(1e-6, "of α", gt=1e-10, lt=0.1)
    """An arc after an impact that stays below this fraction of the critical angle counts as rest."""
    ensemble: EnsembleSettings = EnsembleSettings()
    """The ensembles of the predictions."""
    contact: ContactSettings = ContactSettings()
    """The contact model, if it is among the models."""


class NextSettings(Table):
    """Settings of the advice on which test tells most."""

    largest_risk: fields.Number = setting(0.6, gt=0.0, lt=1.0)
    """Largest probability of overturning of a test that is advised."""
    boundary_width: fields.Number = setting(0.05, "of the amplitude", ge=0.02, le=1.0)
    """Wanted width of the 90 % interval of the amplitude at which the specimen overturns half the time."""
    discrepancy: fields.Number = setting(0.15, "of the amplitude", ge=0.005, le=0.4)
    """Standard deviation of that amplitude about the one that the models predict."""
    restitution_width: fields.Number = setting(0.005, ge=1e-5, le=0.5)
    """Wanted width of the interval of e."""


class Processing(QualitySettings, ConditionSettings):
    """Settings of all stages; SI."""

    restitution: RestitutionSettings = RestitutionSettings()
    """The identification of the coefficient of restitution."""
    predict: PredictSettings = PredictSettings()
    """The predictions."""


def settings(table: Table, prefix: str) -> dict[str, dict[str, Any]]:
    """List every setting of a table by its whole key: value and default in SI, unit, and what it does."""
    found: dict[str, dict[str, Any]] = {}
    for name, field in type(table).model_fields.items():
        value, key = getattr(table, name), f"{prefix}.{name}"
        if isinstance(value, Table):
            found |= settings(value, key)
            continue
        extra = field.json_schema_extra if isinstance(field.json_schema_extra, dict) else {}
        said = {"unit": str(extra.get("unit", "")), "description": type(table).purposes()[name]}
        found[key] = {"value": value, "default": field.default} | said
    return found
