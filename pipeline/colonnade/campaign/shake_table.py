"""[table]: what the shake table can do."""

from __future__ import annotations

from typing import Annotated

from pydantic import Field

from colonnade.campaign.syntax.fields import quantity
from colonnade.campaign.syntax.table import Table


class ShakeTable(Table):
    """Limits of the shake table, each at its peak; motions beyond one are not advised."""

    acceleration: Annotated[float, *quantity("acceleration", above_zero=True)] | None = Field(
        default=None, json_schema_extra={"unit": "m/s^2"}
    )
    """Largest acceleration, such as "1.2 g"."""
    velocity: Annotated[float, *quantity("velocity", above_zero=True)] | None = Field(
        default=None, json_schema_extra={"unit": "m/s"}
    )
    """Largest velocity, such as "0.8 m/s"."""
    stroke: Annotated[float, *quantity("length", above_zero=True)] | None = Field(
        default=None, json_schema_extra={"unit": "m"}
    )
    """Largest displacement from the middle, such as "75 mm"."""
