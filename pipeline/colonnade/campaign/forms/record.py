"""The base of what is written as JSON: records without NaN and without unknown fields."""

from __future__ import annotations

from math import isnan
from typing import Annotated, Any

from pydantic import BaseModel, BeforeValidator, ConfigDict


def _known(value: Any) -> Any:
    return None if isinstance(value, float) and isnan(value) else value


Known = Annotated[float | None, BeforeValidator(_known)]
"""A number, or null if it is not known; NaN becomes null, as JSON has no NaN."""


class Record(BaseModel):
    """Base of all records that are written as JSON: no unknown field, no NaN."""

    model_config = ConfigDict(
        frozen=True, extra="forbid", allow_inf_nan=False, populate_by_name=True, use_attribute_docstrings=True
    )
