"""Setups: how the raw files are read, the recorders, and the channels; and what the shake table can do."""

from __future__ import annotations

from collections.abc import Mapping
from functools import cached_property
from typing import Annotated, Any, Literal

from pydantic import BaseModel, ConfigDict, Field, ValidationError
from pydantic_core import InitErrorDetails

from colonnade.campaign.channel import MAIN, SURROUNDINGS, Channel
from colonnade.campaign.syntax.fields import (
    Acceleration,
    Angle,
    Frequency,
    Kind,
    Length,
    PositiveAngle,
    Velocity,
    shown,
)
from colonnade.campaign.syntax.names import Identifier, identifier
from colonnade.campaign.syntax.table import Table, problem, refuse
from colonnade.errors import nearest


class FileOptions(BaseModel):
    """
    How a raw file is to be read.

    Attributes
    ----------
    format : str or None
        Name of its format; None if it is recognised from the file.
    options : dict
        Options of that format, as written and found valid.
    """

    model_config = ConfigDict(frozen=True)

    format: str | None = None
    options: dict[str, Any] = {}


class Align(BaseModel):
    """
    Two linked channels that give a recorder's delay relative to the main one.

    Attributes
    ----------
    channel : str
        Of the main recorder.
    own_channel : str
        Of this recorder.
    """

    model_config = ConfigDict(frozen=True)

    channel: str
    own_channel: str


def _file_options(value: object) -> FileOptions:
    from colonnade.readers.refused import retired
    from colonnade.readers.registry import MOST_GENERAL, formats

    if not isinstance(value, Mapping):
        raise ValueError(
            f'{shown(value)} was found. A table was expected, such as {{format = "delimited", delimiter = ";"}}.'
        )
    options = {str(key): each for key, each in value.items() if key != "format"}
    name = value.get("format")
    known = formats()
    if name is not None and (not isinstance(name, str) or name not in known):
        hint = retired(name) or nearest(str(name), known)
        raise refuse("file", [problem(f"Unknown format {shown(name)}.{hint}", "format")])
    chosen = known[name or MOST_GENERAL]
    try:
        chosen.options.model_validate(options)
    except ValidationError as error:
        raise refuse("file", [_option_problem(each, chosen.options, chosen.name) for each in error.errors()]) from None
    return FileOptions(format=name, options=options)


def _option_problem(error: Any, options: type[BaseModel], format_name: str) -> InitErrorDetails:
    place = error["loc"]
    if error["type"] == "extra_forbidden":
        return problem(
            f'Unknown option of format "{format_name}".{nearest(str(place[-1]), options.model_fields)}', *place
        )
    said = str(error["ctx"]["error"]) if error["type"] == "value_error" else error["msg"]
    return problem(f"{shown(error['input'])} was found: {said.rstrip('.')}.", *place)


def _clock(value: object) -> Literal["trigger"] | Align:
    if value == "trigger":
        return "trigger"
    named = value.get("align") if isinstance(value, Mapping) and set(value) == {"align"} else None
    if not (isinstance(named, list) and len(named) == 2 and all(isinstance(name, str) for name in named)):
        raise ValueError(
            f'{shown(value)} was found. Expected: "trigger" if the recorders start together, else '
            '{align = ["a channel of the main recorder", "its channel that measures the same"]}.'
        )
    return Align(channel=named[0], own_channel=named[1])


def _recorder_id(value: object) -> str:
    name = identifier(value)
    if name.casefold() == MAIN:
        raise ValueError(
            f'"{name}" is the recorder of the set-up\'s own `file`. Choose another id for an additional recorder.'
        )
    return name


_CLOCK_SCHEMA = {
    "anyOf": [
        {"const": "trigger"},
        {
            "type": "object",
            "properties": {"align": {"type": "array", "items": {"type": "string"}, "minItems": 2, "maxItems": 2}},
            "required": ["align"],
            "additionalProperties": False,
        },
    ]
}
FileTable = Annotated[FileOptions, Kind(_file_options, {"type": "object"})]
Clock = Annotated[Literal["trigger"] | Align, Kind(_clock, _CLOCK_SCHEMA)]
RecorderId = Annotated[str, Kind(_recorder_id, {"type": "string"})]


class Recorder(Table):
    """One data logger."""

    file: FileTable = FileOptions()
    """How its raw files are read; every option that is not given is sniffed."""
    sampling_rate: Frequency | None = None
    """Samples per second, such as "200 Hz", if the file has no time column."""
    clock: Clock = "trigger"
    """"trigger" if it starts with the main recorder, else {align = ["main's channel", "its channel"]}."""


class Setup(Table):
    """
    How tests were recorded.

    `recorders` holds all of them, the one of the set-up's own `file` first, under the name "main".
    """

    file: FileTable = FileOptions()
    """How the raw files are read; every option that is not given is sniffed."""
    sampling_rate: Frequency | None = None
    """Samples per second, such as "200 Hz", if the file has no time column."""
    further_recorders: dict[RecorderId, Recorder] = Field(default={}, alias="recorders")
    """Additional recorders, by id."""
    catch: PositiveAngle | None = None
    """Rotation at which the safety frame catches the specimen, such as "0.3 rad"."""
    table_tilt: Angle | None = None
    """Tilt of the table at rest, such as "0.1 deg": rotation about +y, positive where its +x side is the lower one."""
    channels: dict[Identifier, Channel] = Field(min_length=1)
    """The channels, by id."""

    def channels_of(self, specimen: str) -> dict[str, Channel]:
        """Give the channels in a test of a specimen: on it, its table or the ground, and not on another body."""
        always = (None, "specimen", *SURROUNDINGS)
        return {
            name: each if each.on in always else each.model_copy(update={"on": "specimen"})
            for name, each in self.channels.items()
            if each.on in (*always, specimen)
        }

    @cached_property
    def recorders(self) -> dict[str, Recorder]:
        """All recorders by name, "main" first."""
        return {MAIN: Recorder.model_construct(file=self.file, sampling_rate=self.sampling_rate, clock="trigger")} | (
            self.further_recorders
        )


class ShakeTable(Table):
    """Limits of the shake table, each at its peak; motions beyond one are not advised."""

    acceleration: Acceleration | None = None
    """Largest acceleration, such as "1.2 g"."""
    velocity: Velocity | None = None
    """Largest velocity, such as "0.8 m/s"."""
    stroke: Length | None = None
    """Largest displacement from the middle, such as "75 mm"."""
