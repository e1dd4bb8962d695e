"""A pattern of file names, such as "{specimen}-{kind}-{frequency:Hz}Hz-{number}.csv", and what a name says by it."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from functools import cached_property

from colonnade import units
from colonnade.errors import UnitError, nearest, quoted

WORDS = ("kind", "specimen", "setup", "motion", "recorder")
"""Parts that are one of the campaign's own names, or a word that stands for one."""

NUMBERS = ("span", "time_scale")
"""Parts that are a number without a unit."""

QUANTITIES = {"frequency": "frequency", "amplitude": "acceleration"}
"""Parts that are a number whose unit the pattern gives, and the dimension of each."""

COUNTER = "number"
"""The part that only tells repeated tests apart."""

PARTS = (*WORDS, *QUANTITIES, *NUMBERS, COUNTER)

_PART = re.compile(r"\{([^{}:]*)(?::([^{}]*))?\}")
_NUMBER = r"\d{1,9}(?:[.,p]\d{1,9})?"
_LONGEST = 200


@dataclass(frozen=True)
class Pattern:
    """
    A pattern of file names.

    Attributes
    ----------
    text : str
        As written: a path from the watched folder, with parts in braces.

    Examples
    --------
    >>> pattern = Pattern("{specimen}-{frequency:Hz}Hz-{number}.csv")
    >>> pattern.match("prism-4Hz-02.csv", {"specimen": {"prism": "prism"}})
    {'specimen': 'prism', 'frequency': '4 Hz', 'number': '02'}
    """

    text: str

    @cached_property
    def units(self) -> dict[str, str]:
        """Unit of each part, empty if it has none; in the order of the pattern."""
        return {found[1]: found[2] or "" for found in _PART.finditer(self.text)}

    def problems(self) -> Iterator[str]:
        """Say what is wrong with the pattern, in finished sentences."""
        if len(self.text) > _LONGEST:
            yield f"A pattern of {len(self.text)} characters was found. At most {_LONGEST} were expected."
            return
        outside = _PART.sub("", self.text)
        if "{" in outside or "}" in outside:
            yield f"{quoted(self.text)} has a brace without its partner. Parts are written as {{specimen}}."
        if outside.startswith("/") or "\\" in outside or ".." in self.text.split("/"):
            yield f"{quoted(self.text)} is not a path from the watched folder."
        names = [found[1] for found in _PART.finditer(self.text)]
        for name in dict.fromkeys(names):
            yield from self._problems_of(name, names.count(name))

    def _problems_of(self, name: str, count: int) -> Iterator[str]:
        unit = self.units[name]
        if name not in PARTS:
            yield f"Unknown part {{{name}}}.{nearest(name, PARTS)}"
        elif count > 1:
            yield f"{{{name}}} is there {count} times. Each part may be there once."
        elif name in QUANTITIES:
            dimension = QUANTITIES[name]
            example = f"{{{name}:{units.DIMENSIONS[dimension][1]}}}"
            try:
                units.to_si(f"1 {unit}", dimension)
            except UnitError:
                yield f"{{{name}{f':{unit}' if unit else ''}}} needs the unit of its number, such as {example}."
        elif unit:
            yield f"{{{name}:{unit}}}: this part has no unit. Write {{{name}}}."

    def match(self, path: str, names: Mapping[str, Mapping[str, str]]) -> dict[str, str | float] | None:
        """
        Read the name of a file.

        Parameters
        ----------
        path : str
            From the watched folder, with ``/``.
        names : mapping
            For each part in `WORDS`, what it may be in a name, in lower case, and what that stands for.

        Returns
        -------
        parts : dict or None
            Values as a test in campaign.toml would have them, and `number`; None if the name does not fit.
        """
        found = self._expression(names).fullmatch(path.casefold())
        if found is None:
            return None
        return {part: self._value(part, found[part], names) for part in self.units}

    def _expression(self, names: Mapping[str, Mapping[str, str]]) -> re.Pattern[str]:
        pieces, end = [], 0
        for found in _PART.finditer(self.text):
            pieces += [
                re.escape(self.text[end : found.start()].casefold()),
                f"(?P<{found[1]}>{_form(found[1], names)})",
            ]
            end = found.end()
        return re.compile("".join(pieces) + re.escape(self.text[end:].casefold()))

    def _value(self, part: str, written: str, names: Mapping[str, Mapping[str, str]]) -> str | float:
        if part in WORDS:
            return names[part][written]
        if part == COUNTER:
            return written
        number = re.sub("[,p]", ".", written)
        return f"{number} {self.units[part]}" if part in QUANTITIES else float(number)


def _form(part: str, names: Mapping[str, Mapping[str, str]]) -> str:
    """Give the expression of a part; the longest word first, so that "cone-2" is not taken for "cone"."""
    if part not in WORDS:
        return _NUMBER
    words = sorted(names.get(part, {}), key=len, reverse=True)
    return "|".join(map(re.escape, words)) or r"(?!)"
