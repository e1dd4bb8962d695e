"""The TOML files of a campaign: read, with the place of each key and of what is wrong; values written as TOML."""

from __future__ import annotations

import json
import re
import tomllib
from collections.abc import Collection, Iterable, Iterator, Mapping
from dataclasses import dataclass
from datetime import date
from pathlib import Path
from typing import Any, TypeVar

from pydantic import BaseModel, ValidationError

from colonnade.campaign.syntax.fields import one_line, shown
from colonnade.errors import CampaignError, nearest, quoted
from colonnade.readers.files import irregular

Model = TypeVar("Model", bound=BaseModel)

_LARGEST_BYTES = 20_000_000

Place = tuple[str | int, ...]

_HEADER = re.compile(r"^\s*(\[\[?)([^\[\]]+)\]\]?\s*(?:#.*)?$")
_KEY = re.compile(r"""^\s*((?:[A-Za-z0-9_-]+|"[^"]*"|'[^']*')(?:\s*\.\s*(?:[A-Za-z0-9_-]+|"[^"]*"|'[^']*'))*)\s*=""")
_PART = re.compile(r"""[A-Za-z0-9_-]+|"[^"]*"|'[^']*'""")


def read(path: Path) -> Source:
    """Read a TOML file that a person wrote; CampaignError if it cannot be read or is none, with its line and column."""
    if kind := irregular(path):
        raise CampaignError(f"{path.name}: this is {kind}; a text file was expected.")
    try:
        if path.stat().st_size > _LARGEST_BYTES:
            raise CampaignError(f"{path.name} is too large for a campaign's own file. Is it a raw file?")
        text = path.read_bytes().decode("utf-8-sig")
        return Source(path.name, tomllib.loads(text.replace("\r\n", "\n")), key_lines(text))
    except UnicodeDecodeError as error:
        raise CampaignError(
            f"{path.name}: byte {error.start + 1} is not UTF-8 text. "
            "Save the file as UTF-8; editors offer it as the encoding."
        ) from None
    except OSError as error:
        raise CampaignError(f"{path.name}: it cannot be read ({error.strerror}).") from None
    except (ValueError, RecursionError) as error:  # a number of thousands of digits is a plain ValueError
        said = "tables or lists are nested too deeply" if isinstance(error, RecursionError) else str(error)
        raise CampaignError(
            f"{path.name}: this is not valid TOML: {said}. Put text in quotes and lists in [ ]; give each key once."
        ) from None


def validated(
    model: type[Model], document: Mapping[str, Any], folder: Path
) -> tuple[Model | None, list[tuple[Place, str]]]:
    """Read a document as a model, None if it is not one; with the problems and their places."""
    try:
        return model.model_validate(document, context={"folder": folder}), []
    except ValidationError as error:
        return None, [(each["loc"], each["msg"]) for each in error.errors()]


def refusal(paragraphs: Iterable[str]) -> CampaignError:
    """Build the error of a file with several problems, each paragraph once and on one line."""
    return CampaignError("\n".join(dict.fromkeys(map(one_line, paragraphs))))


def key_lines(text: str) -> dict[Place, int]:
    """
    Find the lines, from 1, of the keys that begin one in a TOML file; a key in an inline table has that of the table.

    Examples
    --------
    >>> key_lines("a = 1\\n[b.c]\\nd = {e = 1}\\n[[t]]\\nid = 'x'")[("t", 0, "id")]
    5
    """
    lines: dict[Place, int] = {}
    counts: dict[Place, int] = {}
    table: Place = ()
    for number, line in enumerate(text.split("\n"), start=1):
        header, key = _HEADER.match(line), _KEY.match(line)
        if header:
            table = _parts(header[2])
            if header[1] == "[[":
                counts[table] = counts.get(table, -1) + 1
            listed = next((end for end in range(len(table), 0, -1) if table[:end] in counts), 0)
            if listed:
                table = (*table[:listed], counts[table[:listed]], *table[listed:])
            lines.setdefault(table, number)
        elif key:
            lines.setdefault((*table, *_parts(key[1])), number)
    return lines


def _parts(text: str) -> Place:
    return tuple(part.strip("\"'") for part in _PART.findall(text))


@dataclass(frozen=True)
class Source:
    """What a campaign was read from: a file's name, document and lines of keys; the name and rows of its test log."""

    name: str
    document: dict[str, Any]
    lines: dict[Place, int]
    log: str = ""
    rows: tuple[int, ...] = ()

    def path(self, place: Place) -> str:
        """Write a key's whole path; a test is called by its id: ``tests[free-01].kind``."""
        path = ""
        for index, part in enumerate(place):
            if not isinstance(part, int):
                path += f"{'.' if path else ''}{quoted(part)[1:-1]}"
                continue
            tests = self.document.get("tests") if place[:index] == ("tests",) else None
            name = tests[part].get("id") if isinstance(tests, list) and isinstance(tests[part], dict) else None
            path += f"[{quoted(name)[1:-1] if isinstance(name, str) and name else part + 1}]"
        return path

    def where(self, place: Place) -> tuple[tuple[int, int], str]:
        """Give the order of a place in the files, those without a line first; and its file with line, or row."""
        if self.log and len(place) > 1 and place[0] == "tests" and isinstance(place[1], int):
            row, key = self.rows[place[1]], place[2:4] if place[2:3] == ("file",) else place[2:3]
            column = f', column "{".".join(map(str, key))}"' if key else ""
            return (len(self.lines) + 1_000_000, row), f"{self.log}, row {row}{column}"
        line = next((self.lines[place[:end]] for end in range(len(place), 0, -1) if place[:end] in self.lines), 0)
        return (line, 0), f"{self.name}, line {line}" if line else self.name

    def paragraph(self, place: Place, message: str) -> str:
        """Write one problem: file, line, the key's whole path, and what is wrong."""
        path = self.path(place)
        return f"{self.where(place)[1]}: {f'{path}: ' if path else ''}{message}"

    def paragraphs(self, problems: Iterable[tuple[Place, str]]) -> list[str]:
        """Write all problems in the order of the files."""
        return [self.paragraph(*each) for each in sorted(problems, key=lambda each: self.where(each[0])[0])]


def unknown(place: Place, what: str, name: str, known: Collection[str], where: str = "") -> Iterator[tuple[Place, str]]:
    """Report a name that is not known."""
    if name not in known:
        yield place, f"Unknown {what} {shown(name)}{where}.{nearest(name, known)}"


def toml_value(value: object) -> str:
    """
    Write a value as TOML.

    Examples
    --------
    >>> toml_value("mm"), toml_value([1, 0, 0]), toml_value({"main": "a.csv"})
    ('"mm"', '[1, 0, 0]', '{main = "a.csv"}')
    """
    if isinstance(value, Mapping):
        return "{" + ", ".join(f"{toml_key(str(key))} = {toml_value(each)}" for key, each in value.items()) + "}"
    if isinstance(value, (list, tuple)):
        return "[" + ", ".join(toml_value(each) for each in value) + "]"
    if isinstance(value, date):
        return value.isoformat()
    # JSON's strings are TOML's basic strings, but for one sign that TOML wants escaped too.
    return json.dumps(value, ensure_ascii=False).replace("\x7f", "\\u007f")


def toml_key(name: str) -> str:
    """
    Write a key as TOML.

    Examples
    --------
    >>> toml_key("daq2"), toml_key("span-2.0")
    ('daq2', '"span-2.0"')
    """
    return name if re.fullmatch(r"[A-Za-z0-9_-]+", name) else toml_value(name)


def natural(name: str) -> tuple[tuple[int, str], ...]:
    """
    Sort names as people do, `free-2` before `free-10`.

    Examples
    --------
    >>> sorted(["free-10", "free-2"], key=natural)
    ['free-2', 'free-10']
    """
    parts = re.split(r"([0-9]+)", name.casefold())
    return tuple((int(part), "") if part.isdecimal() else (-1, part) for part in parts)
