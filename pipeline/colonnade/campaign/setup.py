"""Setups: how the raw files are read, the recorders, and the channels; and what the shake table can do."""

from __future__ import annotations

from collections.abc import Collection, Mapping
from functools import cached_property
from typing import Annotated, Any, Literal, Self

from pydantic import (
    BaseModel,
    BeforeValidator,
    ConfigDict,
    Field,
    GetJsonSchemaHandler,
    ValidationError,
    model_validator,
)
from pydantic_core import CoreSchema, InitErrorDetails

from colonnade import units
from colonnade.campaign.channel import MAIN, SURROUNDINGS, Channel, Unit
from colonnade.campaign.syntax import fields
from colonnade.campaign.syntax.names import Identifier
from colonnade.campaign.syntax.table import Problems, Table, missing, problem, refuse
from colonnade.errors import UnitError, nearest


class FileOptions(BaseModel):
    """How a raw file is read: its format, None if it is recognised from the file, and valid options as written."""

    model_config = ConfigDict(frozen=True)

    format: str | None = None
    options: dict[str, Any] = {}

    @classmethod
    def __get_pydantic_json_schema__(cls, core: CoreSchema, handler: GetJsonSchemaHandler) -> dict[str, Any]:
        """Give the schema of what is written: a format with its options."""
        from colonnade.readers.registry import formats

        kinds = []
        for format in formats().values():
            options = format.options.model_json_schema(by_alias=True, mode="validation")
            options |= {"title": format.name, "description": format.summary}
            named = {"const": format.name, "description": "The format; recognised from the file if it is not given."}
            options["properties"] = {"format": named} | options.get("properties", {})
            kinds.append(options)
        return {"title": "FileOptions", "description": "How a raw file is read; every key is optional.", "anyOf": kinds}


class Align(Table):
    """Two linked channels that give a recorder's delay relative to the main one."""

    align: tuple[str, str]
    """A channel of the main recorder, and one of this recorder that measures the same."""


def _file_options(value: object) -> FileOptions:
    from colonnade.readers.refused import retired
    from colonnade.readers.registry import MOST_GENERAL, formats

    if not isinstance(value, Mapping):
        raise ValueError(
            f'{fields.shown(value)} was found. A table was expected, such as {{format = "delimited", delimiter = ";"}}.'
        )
    options = {str(key): each for key, each in value.items() if key != "format"}
    name = value.get("format")
    known = formats()
    if name is not None and (not isinstance(name, str) or name not in known):
        hint = retired(name) or nearest(str(name), known)
        raise refuse([problem(f"Unknown format {fields.shown(name)}.{hint}", "format")])
    chosen = known[name or MOST_GENERAL]
    try:
        chosen.options.model_validate(options)
    except ValidationError as error:
        raise refuse(_option_problem(each, chosen.options, chosen.name) for each in error.errors()) from None
    return FileOptions(format=name, options=options)


def _option_problem(error: Any, options: type[BaseModel], format_name: str) -> InitErrorDetails:
    place = error["loc"]
    if error["type"] == "extra_forbidden":
        return problem(
            f'Unknown option of format "{format_name}".{nearest(str(place[-1]), options.model_fields)}', *place
        )
    said = str(error["ctx"]["error"]) if error["type"] == "value_error" else error["msg"]
    return problem(f"{fields.shown(error['input'])} was found: {said.rstrip('.')}.", *place)


FileTable = Annotated[FileOptions, BeforeValidator(_file_options)]


class Recorder(Table):
    """One data logger."""

    file: FileTable = FileOptions()
    """How its raw files are read; every option that is not given is sniffed."""
    sampling_rate: fields.Frequency | None = None
    """Samples per second, such as "200 Hz", if the file has no time column."""
    clock: Literal["trigger"] | Align = "trigger"
    """"trigger" if it starts with the main recorder, else {align = ["main's channel", "its channel"]}."""


class Tracking(Table):
    """An optical system that follows markers."""

    axes: tuple[fields.Direction, fields.Direction, fields.Direction] = ((1, 0, 0), (0, 1, 0), (0, 0, 1))
    """Its X, Y and Z in the frame of the table, such as [[0, 1, 0], [-1, 0, 0], [0, 0, 1]]."""
    relative_to: Literal["table", "ground"] = "ground"
    """What its cameras stand on: "ground" or "table"."""


class Marker(Table):
    """A marker that an optical system follows; it becomes three displacement channels, ID_x, ID_y and ID_z."""

    columns: tuple[fields.Column, fields.Column, fields.Column]
    """Its columns along X, Y and Z of the system, such as ["m1 X", "m1 Y", "m1 Z"]."""
    recorder: Identifier = MAIN
    """Recorder that has the columns."""
    unit: Unit
    """Unit of the values in the file, such as "mm"."""
    on: Identifier
    """What it is fixed to: a body, "specimen" or "table"."""
    at: fields.Position | None = None
    """Where it is on the body, from the centre of the body's base, such as ["150 mm", "0 mm", "180 mm"]."""

    def channels(self, name: str, tracking: Tracking) -> dict[str, Channel]:
        """Return its channels by id."""
        placed: dict[str, Any] = {} if self.on in SURROUNDINGS else {"at": self.at, "relative_to": tracking.relative_to}
        return {
            f"{name}_{axis}": Channel.model_construct(
                None, recorder=self.recorder, quantity="displacement", unit=self.unit, on=self.on, column=column,
                direction=direction, **placed,
            )
            for axis, column, direction in zip("xyz", self.columns, tracking.axes, strict=True)
        }  # fmt: skip

    def contradictions(self) -> Problems:
        """Say that it measures no length, or where on its body it is not said."""
        try:
            units.factor_to_si(self.unit, "length")
        except UnitError as error:
            yield ("unit",), str(error)
        if self.at is None and self.on not in SURROUNDINGS:
            yield ("at",), missing(Channel, "at")


class Setup(Table):
    """
    How tests were recorded.

    `recorders` holds all of them, the one of the set-up's own `file` first, under the name "main"; `channels` those of
    the markers too.
    """

    file: FileTable = FileOptions()
    """How the raw files are read; every option that is not given is sniffed."""
    sampling_rate: fields.Frequency | None = None
    """Samples per second, such as "200 Hz", if the file has no time column."""
    further_recorders: dict[Identifier, Recorder] = Field(default={}, alias="recorders")
    """Additional recorders, by id."""
    catch: fields.PositiveAngle | None = None
    """Rotation at which the safety frame catches the specimen, such as "0.3 rad"."""
    table_tilt: fields.Angle | None = None
    """Tilt of the table at rest, such as "0.1 deg": rotation about +y, positive where its +x side is the lower one."""
    channels: dict[Identifier, Channel] = Field(default={})
    """The channels, by id."""
    tracking: Tracking = Tracking()
    """The optical system, if there is one."""
    markers: dict[Identifier, Marker] = Field(default={})
    """Its markers, by id."""

    @model_validator(mode="after")
    def _with_markers(self) -> Self:
        if not (self.channels or self.markers):
            raise refuse([problem(missing(Setup, "channels"), "channels")])
        found: dict[str, Channel] = {}
        for name, marker in self.markers.items():
            found |= marker.channels(name, self.tracking)
        if again := sorted(found.keys() & self.channels.keys()):
            raise refuse([problem("A marker has a channel of this id. Choose another.", "channels", again[0])])
        return self.model_copy(update={"channels": self.channels | found}) if found else self

    def channels_of(self, specimen: str, bodies: Collection[str] = ()) -> dict[str, Channel]:
        """Give the channels in a test of a specimen: on it or its bodies, its table or the ground, on no other."""
        always = (None, "specimen", *SURROUNDINGS)
        return {
            name: each if each.on in (*always, *bodies) else each.model_copy(update={"on": "specimen"})
            for name, each in self.channels.items()
            if each.on in (*always, *bodies, specimen)
        }

    @cached_property
    def recorders(self) -> dict[str, Recorder]:
        """All recorders by name, "main" first."""
        return {MAIN: Recorder.model_construct(file=self.file, sampling_rate=self.sampling_rate, clock="trigger")} | (
            self.further_recorders
        )


class ShakeTable(Table):
    """Limits of the shake table, each at its peak; motions beyond one are not advised."""

    acceleration: fields.Acceleration | None = None
    """Largest acceleration, such as "1.2 g"."""
    velocity: fields.Velocity | None = None
    """Largest velocity, such as "0.8 m/s"."""
    stroke: fields.Length | None = None
    """Largest displacement from the middle, such as "75 mm"."""
