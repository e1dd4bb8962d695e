"""The bases of tables of a campaign file, with plain messages about wrong keys, and of records written as JSON."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Mapping
from functools import cache
from math import isnan
from typing import Annotated, Any, Self

from pydantic import BaseModel, BeforeValidator, ConfigDict, ModelWrapValidatorHandler, ValidationError, model_validator
from pydantic_core import ErrorDetails, InitErrorDetails, PydanticCustomError

from colonnade.campaign.syntax.document import Place
from colonnade.campaign.syntax.fields import UNITS, shown
from colonnade.errors import nearest

Problems = Iterator[tuple[Place, str]]
"""What is wrong: the place of each in the table, and a finished sentence."""


class _Described(BaseModel):
    """Fixed once it is made, without unknown fields; each field's sentence is the text below it."""

    model_config = ConfigDict(frozen=True, extra="forbid", use_attribute_docstrings=True, defer_build=True)


class Table(_Described):
    """
    A table of the campaign file.

    Every problem in it becomes a "problem" error: the key's place in `loc`, and a finished sentence as its message.
    """

    @model_validator(mode="wrap")
    @classmethod
    def _explain(cls, data: Any, handler: ModelWrapValidatorHandler[Self]) -> Self:
        try:
            made = handler(data)
        except ValidationError as error:
            raise refuse(_explained(cls, data, error.errors())) from None
        if data is made:  # it was checked when it was made, and a copy may lack what the file has to say
            return made
        if wrong := [problem(message, *place) for place, message in made.contradictions()]:
            raise refuse(wrong)
        return made

    def contradictions(self) -> Problems:
        """Say which values, each right by itself, do not fit together."""
        return iter(())

    @classmethod
    def purposes(cls) -> dict[str, str]:
        """Keys as in the file, with the purpose of each."""
        keys = {field.alias or name: field for name, field in cls.model_fields.items()}
        return {key: " ".join((field.description or "").split()) for key, field in keys.items()}

    @classmethod
    @cache
    def alternatives(cls) -> dict[str, list[dict[str, Any]]]:
        """Keys as in the file, with the JSON Schema of each value that a key may have."""
        properties = cls.model_json_schema()["properties"]
        return {key: schema.get("anyOf", [schema]) for key, schema in properties.items()}

    @classmethod
    @cache
    def kinds(cls) -> dict[str, set[str]]:
        """Keys as in the file, with what each may be: "number", a dimension, "interval" or another "list"."""
        return {key: {kind for each in either if (kind := kind_of(each))} for key, either in cls.alternatives().items()}


def kind_of(schema: dict[str, Any]) -> str:
    """Name what a value may be by its JSON Schema, as of `Table.kinds`; empty for text and words."""
    if schema.get("type") == "array":
        return "interval" if "unit" in schema.get("prefixItems", [{}])[0] else "list"
    is_number = schema.get("type") in ("number", "integer")
    return "number" if is_number else next((name for name, unit in UNITS.items() if unit == schema.get("unit")), "")


def problem(message: str, *place: str | int, value: object = None) -> InitErrorDetails:
    """Build one problem at a place inside the table, for `refuse`."""
    return InitErrorDetails(
        type=PydanticCustomError("problem", "{message}", {"message": message}), loc=place, input=value
    )


def refuse(problems: Iterable[InitErrorDetails]) -> ValidationError:
    """Build the error that carries several problems of one table, each at its own key."""
    return ValidationError.from_exception_data("Table", list(problems))


_OF_LISTS = ("list_type", "tuple_type", "too_long", "too_short", "missing")
_WANTED = {
    "float_type": "A plain number was expected, without quotes and without a unit",
    "finite_number": "A finite number was expected",
    "string_type": "Text in quotes was expected",
    "string_pattern_mismatch": "Text in quotes was expected",
    **dict.fromkeys(("model_type", "dict_type", "model_attributes_type"), "A table was expected"),
    **dict.fromkeys(("list_type", "tuple_type"), "A list was expected"),
    "missing": "A list of more values was expected",
}


def _explained(table: type[Table], data: Any, errors: list[ErrorDetails]) -> Iterator[InitErrorDetails]:
    """Give the problems of a table; of a key that may be of several kinds those of the kind that was meant."""
    of_keys: dict[str | int, list[tuple[Place, ErrorDetails]]] = {}
    for error in errors:
        of_keys.setdefault(error["loc"][0] if error["loc"] else "", []).append((_place(data, error), error))
    for key, found in of_keys.items():
        has_parts = isinstance(data, Mapping) and isinstance(data.get(key), (list, tuple, Mapping))
        meant = [each for each in found if has_parts == (len(each[0]) > 1 or each[1]["type"] in _OF_LISTS)] or found
        words = [error for _, error in meant if error["type"] == "literal_error"] if len(meant) > 1 else []
        others = [each for each in meant if each[1] not in words]
        is_vague = len(others) > 1 or (words and others[0][1]["type"] == "problem")
        if is_vague and all(place == (key,) for place, _ in others):  # none of them says all that is possible
            yield problem(f"{_found(others[0][1])} Expected: {purpose(table, key)}", key)
            continue
        ending = f" Or {', '.join(map(shown, _words(words[0])))}." if words else ""
        for place, error in others:
            yield problem(_sentence(table, place, error) + ending, *place, value=error["input"])


def _place(data: Any, error: ErrorDetails) -> Place:
    """Give a place in the file, without pydantic's marks for a key, and for the kind that it tried."""
    place: list[str | int] = []
    is_absent = error["type"] == "problem" or (error["type"] == "missing" and isinstance(error["loc"][-1], str))
    for part in error["loc"]:
        is_key = isinstance(data, Mapping) and part in data
        is_there = is_key or (isinstance(data, (list, tuple)) and isinstance(part, int) and part < len(data))
        is_mark = "[" in str(part) or (isinstance(data, Mapping) and part == data.get("shape"))
        if is_there or (is_absent and isinstance(part, str) and not is_mark):
            place.append(part)
            data = data[part] if is_there else None
    return tuple(place)


def _found(error: ErrorDetails) -> str:
    return f"{shown(error['input'])} was found."


def _words(error: ErrorDetails) -> list[str]:
    return re.findall("'([^']*)'", error["ctx"].get("expected") or error["ctx"]["expected_tags"])


def _sentence(table: type[Table], place: Place, error: ErrorDetails) -> str:
    kind, found = error["type"], _found(error)
    if kind == "problem":
        return str(error["ctx"]["message"])
    if kind == "value_error":
        return str(error["ctx"]["error"])
    if kind == "extra_forbidden":
        return f"Unknown key.{nearest(str(place[-1]), table.purposes())}"
    if kind == "missing" and isinstance(error["loc"][-1], str):
        return missing(table, str(place[0]))
    if kind in ("literal_error", "union_tag_invalid") and _words(error):
        given = error["ctx"].get("tag", error["input"])
        return f"{shown(given)} was found.{nearest(str(given), _words(error))}"
    if kind == "union_tag_not_found":
        return '"shape" is missing. Choose one of: "prism", "cylinder", "cone", "measured".'
    wanted = _WANTED.get(kind) or re.sub(r"^\w+ should", "It should", error["msg"])
    return f"{found} {wanted}: {purpose(table, place[0])}" if place else f"{found} {wanted}."


def missing(table: type[Table], key: str) -> str:
    """Say that a key is missing, and what it is for."""
    return f"It is missing. Expected: {purpose(table, key)}"


def purpose(table: type[Table], key: str | int) -> str:
    """Say what a key is for, to follow a colon."""
    said = table.purposes().get(str(key), "")
    return f"{said[0].lower()}{said[1:]}" if said else "see `colonnade schema campaign`."


def _known(value: Any) -> Any:
    return None if isinstance(value, float) and isnan(value) else value


Known = Annotated[float | None, BeforeValidator(_known)]
"""A number, or null if it is not known; NaN becomes null, as JSON has no NaN."""


class Record(_Described):
    """Base of all records that are written as JSON: no unknown field, no NaN."""

    model_config = ConfigDict(allow_inf_nan=False, populate_by_name=True)
