"""The bases of tables of a campaign file, with plain messages about wrong keys, and of records written as JSON."""

from __future__ import annotations

from functools import cache
from math import isnan
from typing import Annotated, Any, NamedTuple, Self

from pydantic import (
    BaseModel,
    BeforeValidator,
    ConfigDict,
    ModelWrapValidatorHandler,
    ValidationError,
    model_validator,
)
from pydantic_core import ErrorDetails, InitErrorDetails, PydanticCustomError

from colonnade.campaign.syntax.fields import UNITS, shown
from colonnade.errors import nearest


class Form(NamedTuple):
    """What a key may be: a number, a quantity of a dimension (or empty), an interval of time, another list."""

    is_number: bool
    dimension: str
    is_interval: bool
    is_list: bool


class Table(BaseModel):
    """
    A table of the campaign file.

    Every problem in it becomes a "problem" error: the key's place in `loc`, and a finished sentence as its message.
    """

    model_config = ConfigDict(frozen=True, extra="forbid", populate_by_name=False, use_attribute_docstrings=True)

    @model_validator(mode="wrap")
    @classmethod
    def _explain(cls, data: Any, handler: ModelWrapValidatorHandler[Self]) -> Self:
        try:
            return handler(data)
        except ValidationError as error:
            raise ValidationError.from_exception_data(
                cls.__name__, [_explained(cls, each) for each in error.errors()]
            ) from None

    @classmethod
    def purposes(cls) -> dict[str, str]:
        """Keys as in the file, with the purpose of each."""
        return {field.alias or name: field.description or "" for name, field in cls.model_fields.items()}

    @classmethod
    @cache
    def forms(cls) -> dict[str, Form]:
        """Keys as in the file, with what each may be, by the types of the fields."""
        return {name: _form(schema) for name, schema in cls.model_json_schema()["properties"].items()}


def _form(schema: dict[str, Any]) -> Form:
    either = schema.get("anyOf", [schema])
    dimensions = {unit: dimension for dimension, unit in UNITS.items()}
    lists = [each.get("items", {}) for each in either if each.get("type") == "array"]
    return Form(
        any(each.get("type") in ("number", "integer") for each in either),
        next((dimensions[each["unit"]] for each in either if "unit" in each), ""),
        any("unit" in items for items in lists),
        any("unit" not in items for items in lists),
    )


def problem(message: str, *place: str | int, value: object = None) -> InitErrorDetails:
    """Build one problem at a place inside the table, for `refuse`."""
    return InitErrorDetails(
        type=PydanticCustomError("problem", "{message}", {"message": message}), loc=place, input=value
    )


def refuse(title: str, problems: list[InitErrorDetails]) -> ValidationError:
    """Build the error that carries several problems of one table, each at its own key."""
    return ValidationError.from_exception_data(title, problems)


def _explained(table: type[Table], error: ErrorDetails) -> InitErrorDetails:
    place, found = error["loc"], error["input"]
    kind, context = error["type"], error.get("ctx", {})
    if kind == "problem":
        message = context["message"]
    elif kind == "value_error":
        message = str(context["error"])
    elif kind == "extra_forbidden":
        message = f"Unknown key.{nearest(str(place[-1]), table.purposes())}"
    elif kind == "missing":
        message = f"It is missing. {_purpose(table, place)}".rstrip()
    elif kind == "union_tag_not_found":
        message = '"shape" is missing. Choose one of: "prism", "cylinder", "cone", "measured".'
    elif kind == "union_tag_invalid":
        shapes = [shape.strip("' ") for shape in context["expected_tags"].split(",")]
        message = f"Unknown shape {shown(context['tag'])}.{nearest(str(context['tag']), shapes)}"
    elif kind in {"model_type", "dict_type", "model_attributes_type"}:
        message = f"{shown(found)} was found. A table was expected."
    elif kind in {"list_type", "tuple_type"}:
        message = f"{shown(found)} was found. A list was expected."
    else:
        message = f"{shown(found)} was found. {error['msg']}."
    return problem(message, *place, value=found)


def _purpose(table: type[Table], place: tuple[str | int, ...]) -> str:
    purpose = table.purposes().get(str(place[0]), "") if len(place) == 1 else ""
    return f"Expected: {purpose[0].lower()}{purpose[1:]}" if purpose else ""


def _known(value: Any) -> Any:
    return None if isinstance(value, float) and isnan(value) else value


Known = Annotated[float | None, BeforeValidator(_known)]
"""A number, or null if it is not known; NaN becomes null, as JSON has no NaN."""


class Record(BaseModel):
    """Base of all records that are written as JSON: no unknown field, no NaN."""

    model_config = ConfigDict(
        frozen=True, extra="forbid", allow_inf_nan=False, populate_by_name=True, use_attribute_docstrings=True
    )
