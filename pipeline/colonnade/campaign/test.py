"""Tests: the specimen, the setup, what was done, and the raw files; and the motions that the table was to follow."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Annotated, Any, Literal, get_args

from pydantic import AfterValidator, BeforeValidator, Field, ValidationInfo, WithJsonSchema, model_validator

from colonnade.campaign.channel import MAIN
from colonnade.campaign.syntax import fields
from colonnade.campaign.syntax.names import Identifier, inside
from colonnade.campaign.syntax.table import Table

Kind = Literal["free-vibration", "sine", "earthquake", "pulse", "noise", "tilt", "other"]
KINDS: tuple[str, ...] = get_args(Kind)
Outcome = Literal["overturned", "not-overturned", "no-rocking", "rocking"]


def _path(value: object, info: ValidationInfo) -> Path:
    return inside(info.context["folder"] if info.context else Path.cwd(), value)


def _by_recorder(value: object) -> object:
    return value if isinstance(value, Mapping) else {MAIN: value}


def _with_main(paths: dict[str, Path]) -> dict[str, Path]:
    if MAIN not in paths:
        raise ValueError('A file of `main` was expected, too: {main = "raw/a.csv", daq2 = "raw/b.csv"}.')
    return paths


CampaignPath = Annotated[Path, BeforeValidator(_path), WithJsonSchema(fields.SOME_TEXT)]
_FILES = {"anyOf": [fields.SOME_TEXT, {"type": "object", "required": [MAIN], "additionalProperties": fields.SOME_TEXT}]}
Files = Annotated[
    dict[str, CampaignPath], BeforeValidator(_by_recorder), AfterValidator(_with_main), WithJsonSchema(_FILES)
]


Zero = Literal["auto", "start", "end", "none"] | fields.Interval


class Test(Table):
    """One test."""

    id: Identifier
    """Its id, such as "free-01"; results are in a folder of this name."""
    kind: Kind
    """What was done: "free-vibration", "sine", "earthquake", "pulse", "noise", "tilt" or "other"."""
    specimen: str
    """Id of its specimen."""
    setup: str
    """Id of its set-up."""
    files: Files = Field(alias="file")
    """Its raw file, from the folder of the campaign file; with several recorders a table of one each."""
    window: fields.Interval | None = None
    """Part of the file that is this test, such as ["2 s", "14 s"]."""
    zero: Zero = "auto"
    """Where the transducers' zero is taken: "auto", "start", "end", "none" or an interval."""
    frequency: fields.Frequency | None = None
    """Frequency of a sine or pulse, such as "3 Hz"."""
    amplitude: fields.Acceleration | None = None
    """Amplitude of the table's acceleration in a sine or pulse as it was asked for, such as "0.2 g"."""
    motion: fields.Text | None = None
    """Name of the base motion, such as "El Centro 1940 NS"."""
    span: fields.PositiveNumber | None = None
    """The table's intensity setting."""
    time_scale: fields.PositiveNumber | None = None
    """Factor on the motion's time."""
    observed_outcome: Outcome | None = None
    """What was seen: "overturned", "not-overturned", "no-rocking" or "rocking"."""
    date: fields.Day | None = None
    """The day of the test, such as 2013-04-26."""
    operator: fields.Text | None = None
    """Who ran it."""
    photos: Annotated[tuple[fields.Text, ...], AfterValidator(fields.once)] = ()
    """Photos of it, JPEG or PNG, from the folder of the campaign file."""
    notes: fields.Text | None = None
    """Anything worth keeping."""
    planned: bool = False
    """Whether it may still have to be run: until its raw file is there it is pending, not failed."""


class ReferenceMotion(Table):
    """A base motion as published: a text file; only the shape of the motion counts. A bare path is its `file`."""

    file: CampaignPath
    """Its file, from the folder of the campaign file."""
    interval: fields.Duration | None = None
    """Its sampling interval, such as "0.02 s", if the file does not give it."""
    column: fields.Column | None = None
    """Name or number, from 1, of the column of accelerations, if there are several."""
    layout: Literal["columns", "running"] | None = None
    """"columns" or "running" (numbers run on from row to row), if the file does not show which."""

    @model_validator(mode="before")
    @classmethod
    def _bare_path(cls, value: Any) -> Any:
        return value if isinstance(value, Mapping) else {"file": value}
