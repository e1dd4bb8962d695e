"""[watch]: the folder in which raw files appear, and what their names say."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Annotated, Any

from pydantic import BeforeValidator, Field, ValidationInfo, WithJsonSchema

from colonnade.campaign.naming.pattern import Pattern
from colonnade.campaign.syntax.fields import Duration, shown, text
from colonnade.campaign.syntax.rawpath import inside
from colonnade.campaign.syntax.table import Table
from colonnade.campaign.test import Test
from colonnade.errors import nearest

GIVEN = tuple(key for key in Test.purposes() if key not in ("id", "file", "planned", "photos"))
"""Keys of a test that an entry of `pattern` may give."""


@dataclass(frozen=True)
class NamedTests:
    """
    Tests whose raw files are named by one pattern.

    Attributes
    ----------
    pattern : Pattern
    given : dict
        Keys of these tests as in [[tests]]; text in them may name parts, as in "{specimen}-table".
    """

    pattern: Pattern
    given: dict[str, Any] = field(default_factory=dict)

    def entry(self, parts: Mapping[str, str | float]) -> dict[str, Any]:
        """Give the keys of a test whose file's name has these parts; what the name says counts more."""

        def filled(value: Any) -> Any:
            for part, meaning in parts.items():
                value = value.replace(f"{{{part}}}", str(meaning)) if isinstance(value, str) else value
            return value

        return {key: filled(value) for key, value in self.given.items()} | dict(parts)


def _folder(value: object, info: ValidationInfo) -> str:
    if info.context:
        inside(info.context["folder"], value)
    return text(value).strip("/")


def _patterns(value: object) -> tuple[NamedTests, ...]:
    return tuple(map(_named, value if isinstance(value, (list, tuple)) else [value]))


def _named(value: object) -> NamedTests:
    given = dict(value) if isinstance(value, Mapping) else {"file": value}
    written = given.pop("file", None)
    if not isinstance(written, str):
        raise ValueError(f'{shown(value)} was found. A pattern was expected, such as "{{specimen}}-{{number}}.csv".')
    for key in given:
        if key not in GIVEN:
            raise ValueError(f"Unknown key {shown(key)} of a pattern.{nearest(str(key), ('file', *GIVEN))}")
    pattern = Pattern(text(written).strip())
    if problems := list(pattern.problems()):
        raise ValueError(" ".join(problems))
    return NamedTests(pattern, given)


def _words(value: object) -> dict[str, str]:
    if not isinstance(value, Mapping) or not all(isinstance(each, str) for each in value.values()):
        raise ValueError(f'{shown(value)} was found. Words of file names were expected: {{free = "free-vibration"}}.')
    return {str(word).casefold(): meaning for word, meaning in value.items()}


_TABLE = {"type": "object", "required": ["file"], "properties": {"file": {"type": "string", "minLength": 1}}}
_ENTRY = {"anyOf": [{"type": "string", "minLength": 1}, _TABLE]}


class Watched(Table):
    """Where raw files appear, when they are finished, and what their names say."""

    folder: Annotated[str, BeforeValidator(_folder), WithJsonSchema({"type": "string", "minLength": 1})] = "raw"
    """Folder in which raw files appear, from the folder of the campaign file."""
    settle: Duration = Field(default=1.0, json_schema_extra={"unit": "s"})
    """A file is finished when its size and time have not changed for this long."""
    pattern: Annotated[
        tuple[NamedTests, ...],
        BeforeValidator(_patterns),
        WithJsonSchema({"anyOf": [*_ENTRY["anyOf"], {"type": "array", "items": _ENTRY}]}),
    ] = ()
    """Names of raw files, such as "{specimen}-{kind}-{number}.csv", each file a test; or a list of them, each with
    keys of its tests: {file = "{specimen}-free-{number}.csv", kind = "free-vibration", setup = "bench"}."""
    words: Annotated[
        dict[str, str],
        BeforeValidator(_words),
        WithJsonSchema({"type": "object", "additionalProperties": {"type": "string"}}),
    ] = Field(default={})
    """What words in the names stand for, such as {free = "free-vibration"}."""
