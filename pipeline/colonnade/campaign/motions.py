"""Reference motions: the records that the table was to follow, by the name that tests give them."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Annotated, Any, Literal

from pydantic import BeforeValidator, ValidationInfo, WithJsonSchema, model_validator

from colonnade.campaign.syntax.fields import Column, Duration
from colonnade.campaign.syntax.rawpath import inside
from colonnade.campaign.syntax.table import Table


def _path(value: object, info: ValidationInfo) -> Path:
    return inside(info.context["folder"] if info.context else Path.cwd(), value)


MotionPath = Annotated[Path, BeforeValidator(_path), WithJsonSchema({"type": "string", "minLength": 1})]


class ReferenceMotion(Table):
    """A base motion as published: a text file; only the shape of the motion counts. A bare path is its `file`."""

    file: MotionPath
    """Its file, from the folder of the campaign file."""
    interval: Duration | None = None
    """Its sampling interval, such as "0.02 s", if the file does not give it."""
    column: Column | None = None
    """Name or number, from 1, of the column of accelerations, if there are several."""
    layout: Literal["columns", "running"] | None = None
    """"columns" or "running" (numbers run on from row to row), if the file does not show which."""

    @model_validator(mode="before")
    @classmethod
    def _bare_path(cls, value: Any) -> Any:
        return value if isinstance(value, Mapping) else {"file": value}
