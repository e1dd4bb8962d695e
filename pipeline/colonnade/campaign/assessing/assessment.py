"""[assessments.<name>]: what is asked about the real column of a specimen, on which records."""

from __future__ import annotations

from typing import Annotated, Self

from pydantic import AfterValidator, model_validator

from colonnade import units
from colonnade.assessment.ground import LARGEST_DRIFT, NONE, correction_of
from colonnade.assessment.measures import measure_of
from colonnade.campaign.settings import setting
from colonnade.campaign.syntax.fields import (
    SOME_TEXT,
    Kind,
    Scale,
    Text,
    count_between,
    number_between,
    one_of,
    shown,
    text,
)
from colonnade.campaign.syntax.names import Identifier
from colonnade.campaign.syntax.table import Table, problem, refuse
from colonnade.campaign.test import MotionPath
from colonnade.dynamics.models.registry import PLANE_MODELS

MOST_LEVELS = 100


def _texts(value: object) -> tuple[str, ...]:
    listed = value if isinstance(value, (list, tuple)) else [value]
    if not 0 < len(listed) <= MOST_LEVELS:
        raise ValueError(f"{shown(value)} was found. A list of 1 to {MOST_LEVELS} texts was expected.")
    return tuple(dict.fromkeys(text(each).strip() for each in listed))


Texts = Annotated[tuple[str, ...], Kind(_texts, {"type": "array", "items": SOME_TEXT, "minItems": 1})]


def _measure(name: str) -> str:
    return measure_of(name).id


def _scaling_measure(name: str) -> str:
    found = measure_of(name)
    if not found.power:
        raise ValueError(f'"{name}" does not grow with a motion. A measure that does was expected, such as "pgv".')
    return found.id


def _measures(names: tuple[str, ...]) -> tuple[str, ...]:
    return tuple(dict.fromkeys(map(_measure, names)))


def _baseline(name: str) -> str:
    correction_of(name)
    return name


class Assessment(Table):
    """One question about the real column of a specimen: how probably it overturns on a set of ground motions."""

    specimen: Identifier
    """Id of the specimen; [prototype.<specimen>] says what the real column is."""
    records: MotionPath
    """A folder of ground motions, or a CSV list of them, from the folder of the campaign file."""
    scale: Scale | None = None
    """How many times larger the column is; the scale of the specimen if it is not given."""
    measure: Annotated[Text, AfterValidator(_scaling_measure)] = setting("pgv")
    """Measure of intensity to whose levels the records are scaled: the curve is over it."""
    levels: Texts | None = None
    """Levels of the measure, such as ["0.2 m/s", "0.4 m/s"]; if not given, chosen so that shares run from 0 to 1."""
    measures: Annotated[Texts, AfterValidator(_measures)] | None = None
    """Measures that are compared with it; all that the records have if not given."""
    hazard: MotionPath | None = None
    """CSV file with annual rates of exceedance of the measure at the site."""
    overturned: Annotated[float, number_between(0.05, 1.0)] = setting(1.0, "of α")
    """A largest rotation beyond this fraction of the critical angle counts as overturned."""
    model: Annotated[str, one_of(*PLANE_MODELS)] = setting("nonlinear")
    """Model in the plane that is run."""
    draws: Annotated[int, count_between(1, 1000)] = setting(8)
    """Draws of e, critical angle, p and friction, the same for each record and level."""
    resamples: Annotated[int, count_between(100, 100_000)] = setting(1000)
    """Times that the records are drawn again for the intervals."""
    drift: Annotated[float, number_between(0.0, 1.0)] = setting(LARGEST_DRIFT, "of the peak velocity")
    """Largest velocity at the end of a record that has no drift."""
    baseline: Annotated[Text, AfterValidator(_baseline)] = setting(NONE)
    """Correction of records that drift; "none" leaves them as they are."""
    seed: Annotated[int, count_between(0, 2**31 - 1)] = setting(0)
    """Of all that is drawn."""

    @model_validator(mode="after")
    def _levels_are_of_the_measure(self) -> Self:
        try:
            self.levels_in_si()
        except ValueError as error:
            raise refuse("assessment", [problem(str(error), "levels", value=self.levels)]) from None
        return self

    def levels_in_si(self) -> tuple[float, ...] | None:
        """Give the levels in SI, rising; None if they are to be chosen."""
        if self.levels is None:
            return None
        dimension = measure_of(self.measure).dimension
        found = sorted({units.to_si(level, dimension) for level in self.levels})
        if not found[0] > 0.0:
            raise ValueError(f"{shown(self.levels)} was found. Levels above zero were expected.")
        return tuple(found)
