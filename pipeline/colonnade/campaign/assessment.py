"""The real columns: [prototype.<specimen>] says what each is, [assessments.<name>] what is asked of it."""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import AfterValidator, Field

from colonnade import units
from colonnade.assessment.ground import LARGEST_DRIFT, NONE, correction_of
from colonnade.assessment.measures import measure_of
from colonnade.campaign.settings import setting
from colonnade.campaign.syntax import fields
from colonnade.campaign.syntax.names import Identifier
from colonnade.campaign.syntax.table import Problems, Table
from colonnade.campaign.test import CampaignPath
from colonnade.dynamics.models import PLANE_MODELS


def _scaling_measure(name: str) -> str:
    found = measure_of(name)
    if not found.power:
        raise ValueError(f'"{name}" does not grow with a motion. A measure that does was expected, such as "pgv".')
    return found.id


def _measures(names: tuple[str, ...]) -> tuple[str, ...]:
    return tuple(dict.fromkeys(measure_of(name).id for name in names))


def _baseline(name: str) -> str:
    correction_of(name)
    return name


Baseline = Annotated[fields.Text, AfterValidator(_baseline)]
Friction = Annotated[fields.Number, Field(ge=0.01, le=10.0)]


class Prototype(Table):
    """The real column of a specimen. What is not given follows from the specimen by its scale."""

    restitution: Literal["identified", "rigid-body"] | fields.Restitution
    """Its e: a number, "rigid-body", or "identified" to assume that it is the one that predictions of the model use."""
    restitution_range: fields.Limits[fields.Restitution] | None = None
    """Limits of e; without them the interval of the identified e in a new test, else 0.02 to either side."""
    critical_angle: fields.PositiveAngle | None = None
    """Its critical angle, such as "0.18 rad"; that of the specimen if it is not given."""
    critical_angle_range: fields.Limits[fields.PositiveAngle] | None = None
    """Limits of its critical angle; without them it counts as known."""
    p: fields.FrequencyParameter | None = None
    """Its frequency parameter, such as "1.26 rad/s"; by default that of the specimen over the root of the scale."""
    p_range: fields.Limits[fields.FrequencyParameter] | None = None
    """Limits of its frequency parameter; without them it counts as known."""
    friction: Friction | None = None
    """Coulomb's coefficient between the column and what it stands on; without it sliding is not judged."""
    friction_range: fields.Limits[Friction] | None = None
    """Limits of the coefficient; without them it counts as known."""

    def contradictions(self) -> Problems:
        """Say which limits do not hold their value."""
        for name in ("restitution", "critical_angle", "p", "friction"):
            value, limits = getattr(self, name), getattr(self, f"{name}_range")
            if isinstance(value, float) and limits is not None and not limits[0] <= value <= limits[1]:
                message = f"The limits {limits[0]:g} and {limits[1]:g} (SI) do not hold {name} = {value:g}."
                yield (f"{name}_range",), message


class Assessment(Table):
    """One question about the real column of a specimen: how probably it overturns on a set of ground motions."""

    specimen: Identifier
    """Id of the specimen; [prototype.<specimen>] says what the real column is."""
    records: CampaignPath
    """A folder of ground motions, or a CSV list of them."""
    scale: fields.Scale | None = None
    """How many times larger the column is; the scale of the specimen if it is not given."""
    measure: Annotated[fields.Text, AfterValidator(_scaling_measure)] = setting("pgv")
    """Measure of intensity to whose levels the records are scaled: the curve is over it."""
    levels: fields.Several | None = None
    """Levels of the measure, such as "0.4 m/s"; if not given, chosen so that shares run from 0 to 1."""
    measures: Annotated[fields.Several, AfterValidator(_measures)] | None = None
    """Measures that are compared with it; all that the records have if not given."""
    hazard: CampaignPath | None = None
    """CSV file with annual rates of exceedance of the measure at the site."""
    overturned: fields.Number = setting(1.0, "of α", ge=0.05, le=1.0)
    """A largest rotation beyond this fraction of the critical angle counts as overturned."""
    displaced: fields.Length | None = None
    """Of several bodies, such as "20 mm": one that ends farther from its place counts as one that overturned."""
    model: Annotated[str, fields.OneOf(tuple(PLANE_MODELS))] = setting("nonlinear")
    """Model in the plane that is run."""
    draws: fields.Whole = setting(8, ge=1, le=1000)
    """Draws of e, critical angle, p and friction, the same for each record and level."""
    resamples: fields.Whole = setting(1000, ge=100, le=100_000)
    """Times that the records are drawn again for the intervals."""
    drift: fields.Number = setting(LARGEST_DRIFT, "of the peak velocity", ge=0.0, le=1.0)
    """Largest velocity at the end of a record without drift, over its peak velocity."""
    baseline: Baseline = setting(NONE)
    """Correction of records that drift: linear, quadratic or highpass(0.1 Hz); "none" leaves them as they are."""
    seed: fields.Whole = setting(0, ge=0, le=2**31 - 1)
    """Of all that is drawn."""

    def contradictions(self) -> Problems:
        """Say which level is none of the measure."""
        try:
            self.levels_in_si()
        except ValueError as error:
            yield ("levels",), str(error)

    def levels_in_si(self) -> tuple[float, ...] | None:
        """Give the levels in SI, rising; None if they are to be chosen."""
        if self.levels is None:
            return None
        dimension = measure_of(self.measure).dimension
        found = sorted({units.to_si(level, dimension) for level in self.levels})
        if not found[0] > 0.0:
            raise ValueError(f"{fields.shown(self.levels)} was found. Levels above zero were expected.")
        return tuple(found)
