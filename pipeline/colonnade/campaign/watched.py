"""[watch]: the folder in which raw files appear, and the patterns of their names: "{specimen}-{frequency:Hz}Hz.csv"."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from functools import cached_property
from string import Formatter
from typing import Annotated, Any

from pydantic import AfterValidator, BeforeValidator, Field, ValidationInfo, WithJsonSchema

from colonnade import units
from colonnade.campaign.syntax.fields import SOME_TEXT, Duration, Text, listed, shown
from colonnade.campaign.syntax.names import inside
from colonnade.campaign.syntax.table import Table
from colonnade.campaign.test import Test
from colonnade.errors import nearest, quoted

WORDS = ("kind", "specimen", "setup", "motion", "recorder")
"""Parts that are one of the campaign's own names, or a word that stands for one."""

COUNTER = "number"
"""The part that only tells repeated tests apart."""

_NUMBER = r"\d{1,9}(?:[.,p]\d{1,9})?"


def parts() -> tuple[str, ...]:
    """Parts that a pattern may have: words, keys of a test that are a number or a quantity, and the counter."""
    return (*WORDS, *(key for key, kinds in Test.kinds().items() if kinds & {"number", *units.DIMENSIONS}), COUNTER)


@dataclass(frozen=True)
class Pattern:
    """
    A pattern of names of raw files with parts in braces, and the keys that are given for its tests.

    Text in the keys may name parts, as in "{specimen}-table".

    Examples
    --------
    >>> pattern = Pattern("{specimen}-{frequency:Hz}Hz-{number}.csv")
    >>> pattern.match("prism-4Hz-02.csv", {"specimen": {"prism": "prism"}})
    {'specimen': 'prism', 'frequency': '4 Hz', 'number': '02'}
    """

    text: str
    given: dict[str, Any] = field(default_factory=dict)

    @cached_property
    def parts(self) -> list[tuple[str, str | None, str]]:
        """The text before each part, its name and its unit; after the last one, text without a part."""
        return [(before, name, unit or "") for before, name, unit, _ in Formatter().parse(self.text)]

    def problems(self) -> Iterator[str]:
        """Say what is wrong with the pattern, in finished sentences."""
        try:
            found = [(name, unit) for _, name, unit in self.parts if name is not None]
        except ValueError:
            yield f"{quoted(self.text)} has a brace without its partner. Parts are written as {{specimen}}."
            return
        names = [name for name, _ in found]
        for name, unit in dict(found).items():
            dimension = next(iter(Test.kinds().get(name, set()) & units.DIMENSIONS.keys()), "")
            if name not in parts():
                yield f"Unknown part {{{name}}}.{nearest(name, parts())}"
            elif names.count(name) > 1:
                yield f"{{{name}}} is there {names.count(name)} times. Each part may be there once."
            elif not units.is_of(unit, dimension) if dimension else unit:
                example = f"{name}:{units.DIMENSIONS[dimension][1]}" if dimension else name
                yield f'{{{name}}} with unit "{unit}" was found. {{{example}}} was expected.'

    def match(self, path: str, names: Mapping[str, Mapping[str, str]]) -> dict[str, str | float] | None:
        """
        Read the name of a file, from the watched folder: its parts as a test would have them; None if it does not fit.

        `names` gives for each part in `WORDS` what it may be in a name, in lower case, and what that stands for.
        """
        form = ""
        for before, name, _ in self.parts:
            # The longest word first, so that "cone-2" is not taken for "cone".
            words = "|".join(map(re.escape, sorted(names.get(name or "", {}), key=len, reverse=True))) or "(?!)"
            part = f"(?P<{name}>{words if name in WORDS else _NUMBER})" if name else ""
            form += re.escape(before.casefold()) + part
        found = re.fullmatch(form, path.casefold())
        return found and {name: self._value(name, unit, found[name], names) for _, name, unit in self.parts if name}

    def entry(self, parts: Mapping[str, str | float]) -> dict[str, Any]:
        """Give the keys of a test whose file's name has these parts; what the name says counts more."""
        entry = self.given | dict(parts)
        for key, value in self.given.items():
            if isinstance(value, str) and key not in parts:
                entry[key] = re.sub(r"\{(\w+)\}", lambda part: str(parts.get(part[1], part[0])), value)
        return entry

    @staticmethod
    def _value(part: str, unit: str, written: str, names: Mapping[str, Mapping[str, str]]) -> str | float:
        if part in WORDS:
            return names[part][written]
        number = re.sub("[,p]", ".", written)
        return written if part == COUNTER else f"{number} {unit}" if unit else float(number)


def _folder(folder: str, info: ValidationInfo) -> str:
    if info.context:
        inside(info.context["folder"], folder)
    return folder.strip("/")


def _named(value: object) -> Pattern:
    given = dict(value) if isinstance(value, Mapping) else {"file": value}
    written = given.pop("file", None)
    if not isinstance(written, str) or not written.strip():
        raise ValueError(f'{shown(value)} was found. A pattern was expected, such as "{{specimen}}-{{number}}.csv".')
    allowed = Test.purposes().keys() - {"id", "file", "planned", "photos"}
    for key in given:
        if key not in allowed:
            raise ValueError(f"Unknown key {shown(key)} of a pattern.{nearest(str(key), ('file', *allowed))}")
    pattern = Pattern(written.strip(), given)
    if problems := list(pattern.problems()):
        raise ValueError(" ".join(problems))
    return pattern


_TABLE = {"type": "object", "required": ["file"], "properties": {"file": SOME_TEXT}}
_ENTRY = {"anyOf": [SOME_TEXT, _TABLE]}
_ENTRIES = {"anyOf": [*_ENTRY["anyOf"], {"type": "array", "items": _ENTRY}]}


class Watched(Table):
    """Where raw files appear, when they are finished, and what their names say."""

    folder: Annotated[Text, AfterValidator(_folder)] = "raw"
    """Folder in which raw files appear, from the folder of the campaign file."""
    settle: Duration = 1.0
    """A file is finished when its size and time have not changed for this long."""
    pattern: Annotated[
        tuple[Annotated[Pattern, BeforeValidator(_named)], ...], BeforeValidator(listed), WithJsonSchema(_ENTRIES)
    ] = ()
    """Names of raw files, such as "{specimen}-{kind}-{number}.csv", each file a test; or a list of them, each with
    keys of its tests: {file = "{specimen}-free-{number}.csv", kind = "free-vibration", setup = "bench"}."""
    words: dict[Annotated[str, AfterValidator(str.casefold)], str] = Field(default={})
    """What words in the names stand for, such as {free = "free-vibration"}."""
