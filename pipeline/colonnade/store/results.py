"""The results of a campaign: their stages in order, the file of each, and the results that a test has."""

from __future__ import annotations

import csv
from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal, NamedTuple

if TYPE_CHECKING:
    from colonnade.campaign import Campaign, Test

WITHOUT_PREDICTION = ("tilt", "other")
"""Kinds of test that have no base motion to predict from."""


Subject = Literal["test", "specimen", "assessment"]
"""What a result is about."""


class Stage(NamedTuple):
    """
    A stage, the step from earlier results to one of the next kind.

    Attributes
    ----------
    name : str
    of : str
        What its subject is: a test, a specimen or an assessment.
    goes_with : str
        Stage of `RUN_STAGES` that a run names for this one; empty if it is its own. Scores of forecasts and maps count
        with the report, after everything else; a run makes the maps by the models in the plane, no steady responses.
    file : str
        Path of its result within `processed`, without suffix, by subject and model.
    summary : str
        What its result holds, for the file's own description.
    source : str
        What the result was made from, as ACDD asks.
    """

    name: str
    of: Subject
    goes_with: str
    file: str
    summary: str
    source: str


def rows(table: str) -> list[dict[str, Any]]:
    """Return the rows of a table of this room."""
    with Path(__file__).with_name(table).open(encoding="utf-8", newline="") as stream:
        return list(csv.DictReader(stream))


STAGES = {row["name"]: Stage(**row) for row in rows("stages.csv")}
"""All stages, in their order."""

RUN_STAGES = (*(name for name, stage in STAGES.items() if not stage.goes_with), "report")
"""Stages at which a run can be asked to start or to stop, in their order; the report comes last."""


@dataclass(frozen=True, order=True)
class ResultId:
    """
    Names one result: its subject, its stage and, if need be, its model.

    Attributes
    ----------
    subject : str
        Id of a test, a specimen or an assessment.
    stage : str
        One of `STAGES`.
    model : str or None
        Of a stage that runs once for each model.

    Examples
    --------
    >>> str(ResultId("span-2.0", "predict", "linear"))
    'predict linear'
    """

    subject: str
    stage: str
    model: str | None = None

    def __str__(self) -> str:
        """Return its name among the results of its subject."""
        return f"{self.stage} {self.model}" if self.model else self.stage

    @property
    def of(self) -> Subject:
        """What its subject is."""
        return STAGES[self.stage].of

    @property
    def file(self) -> str:
        """Its file within the folder of results."""
        return STAGES[self.stage].file.format(subject=self.subject, model=self.model) + ".nc"

    @property
    def order(self) -> int:
        """Place of its stage in `RUN_STAGES`."""
        return RUN_STAGES.index(STAGES[self.stage].goes_with or self.stage)


def models_of(campaign: Campaign, test: Test) -> tuple[str, ...]:
    """Models that a test is predicted by."""
    if test.kind in WITHOUT_PREDICTION:
        return ()
    asked = campaign.processing.predict.models
    if campaign.specimens[test.specimen].is_assembly:
        asked = (*(model for model in asked if model != _in_space()), _in_space())
    return models_moving(campaign, test.specimen, asked)


def models_moving(campaign: Campaign, specimen: str, models: Iterable[str]) -> tuple[str, ...]:
    """Return those that move a specimen: bodies that do not rock as one block are for the contact model alone."""
    is_in_plane = campaign.specimens[specimen].is_in_plane
    return tuple(model for model in models if is_in_plane or model == _in_space())


def _in_space() -> str:
    """Name of the model that moves several bodies; imported late, as the commands' names are read without numpy."""
    from colonnade.dynamics.models import CONTACT

    return CONTACT.name


def models_shown(campaign: Campaign) -> tuple[str, ...]:
    """Models that a campaign's tests are predicted by: those asked for, and of assemblies the contact model."""
    asked = campaign.processing.predict.models
    has_bodies = any(campaign.specimens[test.specimen].is_assembly for test in campaign.tests.values())
    return tuple(dict.fromkeys((*asked, _in_space()))) if has_bodies else asked


def results_of(campaign: Campaign, test: Test) -> list[ResultId]:
    """Results that a test has if nothing fails, in the order in which they are made."""
    models = models_of(campaign, test)
    repeated = [model for model in models if campaign.members(test, model) > 0]
    found = [ResultId(test.id, stage) for stage in ("ingest", "condition", "rocking")]
    if test.kind == "free-vibration":
        found.append(ResultId(test.id, "restitution"))
    found += [ResultId(test.id, "predict", model) for model in models]
    found += [ResultId(test.id, "ensemble", model) for model in repeated]
    return [*found, ResultId(test.id, "compare")]
