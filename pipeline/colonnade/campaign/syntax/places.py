"""Where a key is: its line in a TOML file, its row and column in a test log, and how its path is written."""

from __future__ import annotations

import re
from collections.abc import Collection, Iterable, Iterator, Mapping
from dataclasses import dataclass, field
from typing import Any

from colonnade.campaign.syntax.fields import shown
from colonnade.errors import nearest, quoted

Place = tuple[str | int, ...]

_HEADER = re.compile(r"^\s*(\[\[?)([^\[\]]+)\]\]?\s*(?:#.*)?$")
_KEY = re.compile(r"""^\s*((?:[A-Za-z0-9_-]+|"[^"]*"|'[^']*')(?:\s*\.\s*(?:[A-Za-z0-9_-]+|"[^"]*"|'[^']*'))*)\s*=""")
_PART = re.compile(r"""[A-Za-z0-9_-]+|"[^"]*"|'[^']*'""")


def key_lines(text: str) -> dict[Place, int]:
    """
    Find the lines of the keys of a TOML file, as far as they begin a line.

    Returns
    -------
    lines : dict of place to int
        From 1. A key inside an inline table has the place of the table only.

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
            table = next(
                (
                    (*table[:end], counts[table[:end]], *table[end:])
                    for end in range(len(table), 0, -1)
                    if table[:end] in counts
                ),
                table,
            )
            lines.setdefault(table, number)
        elif key:
            lines.setdefault((*table, *_parts(key[1])), number)
    return lines


def _parts(text: str) -> Place:
    return tuple(part.strip("\"'") for part in _PART.findall(text))


def written(place: Place, document: Mapping[str, Any]) -> str:
    """
    Write a key's whole path; a test is called by its id.

    Examples
    --------
    >>> written(("tests", 0, "kind"), {"tests": [{"id": "free-01"}]})
    'tests[free-01].kind'
    """
    if len(place) > 1 and place[0] == "tests" and isinstance(place[1], int):
        tests = document.get("tests")
        named = tests[place[1]] if isinstance(tests, list) and place[1] < len(tests) else None
        name = named.get("id") if isinstance(named, dict) else None
        start = f"tests[{_short(name) if isinstance(name, str) and name else place[1] + 1}]"
        place = place[2:]
    else:
        start, place = "", place
    for part in place:
        start += f"[{part + 1}]" if isinstance(part, int) else f"{'.' if start else ''}{_short(part)}"
    return start


def _short(part: str) -> str:
    return quoted(part)[1:-1]


@dataclass(frozen=True)
class Source:
    """
    The files that a campaign was read from, to say where a problem is.

    Attributes
    ----------
    name : str
        The campaign file's name.
    lines : dict
        Lines of its keys.
    log : str
        The test log's name, or empty.
    rows : tuple of int
        Row of each test in the log.
    """

    name: str
    lines: dict[Place, int] = field(default_factory=dict)
    log: str = ""
    rows: tuple[int, ...] = ()

    def order(self, place: Place) -> tuple[int, int]:
        """Sort problems in the order of the files, those without a line first."""
        if self._in_log(place):
            return len(self.lines) + 1_000_000, self.rows[int(place[1])]
        return self._line(place) or 0, 0

    def _in_log(self, place: Place) -> bool:
        return bool(self.log) and len(place) > 1 and place[0] == "tests" and isinstance(place[1], int)

    def _line(self, place: Place) -> int | None:
        return next((self.lines[place[:end]] for end in range(len(place), 0, -1) if place[:end] in self.lines), None)

    def paragraph(self, place: Place, message: str, document: Mapping[str, Any]) -> str:
        """Write one problem: file, line, the key's whole path, and what is wrong."""
        path = written(place, document)
        if self._in_log(place):
            where = f"{self.log}, row {self.rows[int(place[1])]}" + (
                f', column "{_head(place)}"' if len(place) > 2 else ""
            )
            return f"{where}: {path}: {message}"
        line = self._line(place)
        return f"{self.name}{f', line {line}' if line else ''}: {f'{path}: ' if path else ''}{message}"

    def paragraphs(self, problems: Iterable[tuple[Place, str]], document: Mapping[str, Any]) -> list[str]:
        """Write all problems in the order of the files."""
        ordered = sorted(problems, key=lambda each: self.order(each[0]))
        return [self.paragraph(place, message, document) for place, message in ordered]


def _head(place: Place) -> str:
    return f"file.{place[3]}" if place[2] == "file" and len(place) > 3 else str(place[2])


def unknown(place: Place, what: str, name: str, known: Collection[str], where: str = "") -> Iterator[tuple[Place, str]]:
    """Report a name that is not known."""
    if name not in known:
        yield place, f"Unknown {what} {shown(name)}{where}.{nearest(name, known)}"
