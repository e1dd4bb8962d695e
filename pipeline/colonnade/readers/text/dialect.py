"""How a text is written: its delimiter and numbers, what each cell and column holds, and the first sample."""

from __future__ import annotations

import csv
import re
from collections import Counter, defaultdict
from dataclasses import dataclass, replace
from functools import cached_property
from itertools import chain, product
from typing import NamedTuple

WHITESPACE = " "
"""As a delimiter: any run of spaces and tabs."""

DELIMITERS = (";", "\t", "|", ",", WHITESPACE)
DELIMITER_NAMES = {"\t": "tab", WHITESPACE: "spaces"}
SAMPLE_LINES = 120
"""Lines at the end of the head of a file from which it is found out how samples are written."""
LOOK_AHEAD = 10
"""Lines from the first sample on of which half at least have to be samples."""

COMMENT_SIGNS = ("#", "%", "//", "!")

_WORDS = (
    "- -- --- ? nan -nan na n/a n.a. #n/a null none nil void k.a. missing invalid bad error err fault open overflow "
    "overload ovl ovld ovr ovrng ol over overrange under underflow underrange inf -inf +inf 1.#inf -1.#inf 1.#qnan "
    "-1.#ind #num! #div/0! #value!"
)
MISSING = frozenset(("", "no data", *_WORDS.split()))
"""What recorders write in place of a number, casefolded."""

MARKS = " '\N{RIGHT SINGLE QUOTATION MARK}\N{NO-BREAK SPACE}\N{NARROW NO-BREAK SPACE}"
"""Between thousands, besides points and commas, where there are such marks."""
_PLAIN = str.maketrans("dD\N{MINUS SIGN}", "ee-", MARKS)

TIMESTAMP = re.compile(
    r"(?:(?:\d{4}([-/])\d{1,2}\1\d{1,2}|\d{1,2}\.\d{1,2}\.\d{4})[T ]+)?"  # a date, year first or dotted, may be absent
    r"\d{1,2}:\d{2}(?::\d{2}(?:[.,]\d+)?)?(?:\s?(?:Z|[+-]\d{2}:?\d{2}))?"
)


@dataclass(frozen=True)
class Dialect:
    """
    How numbers are written in a file.

    Attributes
    ----------
    delimiter : str
        One character; a space stands for any run of spaces and tabs.
    decimal : str
        "." or ",".
    thousands : str or None
        The sign between groups of three digits, if there is one.
    quoted : bool
        Whether cells are in quotation marks, which then hide delimiters.
    comments : tuple of str
        What starts a line that is not a sample.
    missing : frozenset of str
        Casefolded texts that stand for a missing value.
    """

    delimiter: str
    decimal: str
    thousands: str | None = None
    quoted: bool = False
    comments: tuple[str, ...] = COMMENT_SIGNS
    missing: frozenset[str] = MISSING

    def split(self, line: str) -> list[str]:
        """Cut a line into its cells, without the spaces around them."""
        if self.delimiter == WHITESPACE:
            return line.split()
        if self.quoted:
            return quoted_cells(line, self.delimiter)
        return [cell.strip() for cell in line.split(self.delimiter)]

    def is_blank(self, line: str) -> bool:
        """Whether a line holds nothing at all, not even a delimiter."""
        return not line.strip(" " if self.delimiter == "\t" else " \t")

    def is_comment(self, line: str) -> bool:
        """Whether a line starts with a comment sign."""
        return line.lstrip().startswith(self.comments)

    def is_number(self, cell: str) -> bool:
        """Whether a cell is a number, with a mark between thousands only if that is known."""
        return self._number.fullmatch(cell) is not None

    def number(self, cell: object) -> float:
        """Read a cell; NaN if it is not a number."""
        if not isinstance(cell, str):
            return float(cell) if isinstance(cell, (int, float)) else float("nan")
        text = cell.strip().strip('"').strip()
        if text.casefold() in self.missing or not self.is_number(text):
            return {"true": 1.0, "false": 0.0}.get(text.casefold(), float("nan"))
        return float(text.replace(self.thousands or "", "").translate(_PLAIN).replace(self.decimal, "."))

    @cached_property
    def _number(self) -> re.Pattern[str]:
        decimal = re.escape(self.decimal)
        whole = rf"(?:\d{{1,3}}(?:[{self.thousands}{MARKS}]\d{{3}})+|\d+)" if self.thousands else r"\d+"
        number = rf"[+\-\N{{MINUS SIGN}}]?(?:{whole}(?:{decimal}\d*)?|{decimal}\d+)(?:[eEdD][+-]?\d+)?"
        return re.compile(number, re.ASCII)


def quoted_cells(line: str, delimiter: str) -> list[str]:
    """Cut a line whose cells may be in quotation marks."""
    try:
        rows = list(csv.reader([line], delimiter=delimiter, skipinitialspace=True))
    except csv.Error:
        return [cell.strip() for cell in line.split(delimiter)]
    return [cell.strip() for row in rows for cell in row]


def looks_like_numbers(line: str) -> bool:
    """Whether a line has digits and no letters but those of exponents, however damaged it is."""
    return re.search(r"\d", line) is not None and re.search(r"[^\W\d_eEdD]", line) is None


def kind_of(cell: str, dialect: Dialect) -> str:
    """Name what a cell holds: `missing`, `number`, `time` or `text`."""
    if cell.casefold() in dialect.missing:
        return "missing"
    if dialect.is_number(cell):
        return "number"
    return "time" if ":" in cell and TIMESTAMP.fullmatch(cell) else "text"


class Sniffed(NamedTuple):
    """A dialect, and how well it explains some lines."""

    dialect: Dialect
    kinds: tuple[str, ...] = ()
    """What each column holds on most rows of numbers: `number`, `time` (date or time of day), `text` or `empty`."""
    score: float = 0.0
    """Share of lines with so many cells, each as sure as its numbers."""
    notes: tuple[str, ...] = ()


def sniff(lines: list[str], given: Dialect, *, delimiter: str | None, decimal: str | None) -> Sniffed:
    """
    Find the dialect that makes most cells numbers and gives most lines the same number of cells.

    The later lines of a head are looked at, as there the samples are surest. What is neither delimiter nor decimal
    sign is `given`; so may be these.
    """
    sample = [line for line in lines if line.strip() and not given.is_comment(line)][-SAMPLE_LINES:]
    quoted = sum('"' in line for line in sample) > len(sample) / 2
    fits = [
        _fit(sample, replace(given, delimiter=between, decimal=sign, quoted=quoted))
        for between, sign in product(delimiter or DELIMITERS, decimal or ".,")
        if (sign != between or quoted) and sign != given.thousands
    ]
    best = max(fits, key=lambda fit: (fit.score, len(fit.kinds) > 1), default=Sniffed(given))
    dialect, notes = best.dialect, []
    if delimiter is None:
        sign = DELIMITER_NAMES.get(dialect.delimiter, f'"{dialect.delimiter}"') if len(best.kinds) > 1 else "none"
        notes.append(f"delimiter {sign} ({len(best.kinds)} cells on most of the {len(sample)} lines examined)")
    if decimal is None:
        numbers = filter(dialect.is_number, chain.from_iterable(map(dialect.split, sample)))
        signed = next((number for number in numbers if dialect.decimal in number), None)
        why = " assumed: the numbers examined have none" if signed is None else f' (as in "{signed}")'
        notes.append(f'decimal sign "{dialect.decimal}"{why}')
    return best._replace(notes=tuple(notes))


def _fit(sample: list[str], dialect: Dialect) -> Sniffed:
    """Look at the rows of numbers: at least half of what a row says is a number or a time."""
    rows: defaultdict[int, list[list[str]]] = defaultdict(list)
    sure: Counter[int] = Counter()
    for line in sample:
        cells = dialect.split(line)
        kinds = [kind_of(cell, dialect) for cell in cells]
        weights = [_weight(cell, kind) for cell, kind in zip(cells, kinds, strict=True) if kind != "missing"]
        if sum(weights) > 0 and sum(weights) >= 100 * len(weights) / 2:
            rows[len(cells)].append(kinds)
            sure[len(cells)] += sum(weights) // len(weights)
    if not rows:
        return Sniffed(dialect)
    width = max(rows, key=lambda width: (len(rows[width]), width))
    columns = zip(*rows[width], strict=True)
    kinds = [
        max(("number", "time", "text"), key=column.count) if {*column} != {"missing"} else "empty" for column in columns
    ]
    return Sniffed(dialect, tuple(kinds), sure[width] / len(sample))


def _weight(cell: str, kind: str) -> int:
    """How surely a cell is a number or a time, %."""
    # "05" is hardly a whole number; rather the decimals of "1,05" cut at the comma.
    is_cut = re.fullmatch(r"[+-]?0\d+", cell) is not None
    return 0 if kind == "text" else 50 if is_cut else 100


def find_first_sample(lines: list[str], start: int, dialect: Dialect, kinds: tuple[str, ...]) -> int | None:
    """Find the index of the first line, from `start` on, with a value for each column, after which many have one."""
    filled = [
        n for n in range(start, len(lines)) if not dialect.is_blank(lines[n]) and not dialect.is_comment(lines[n])
    ]
    for place, index in enumerate(filled):
        if is_sample(lines[index], dialect, kinds):
            following = filled[place : place + LOOK_AHEAD]
            if 2 * sum(is_sample(lines[other], dialect, kinds) for other in following) >= len(following):
                return index
    return None


def is_sample(line: str, dialect: Dialect, kinds: tuple[str, ...]) -> bool:
    """Whether a line holds something for each column, at least one number, and no text in a column of numbers."""
    found = [kind_of(cell, dialect) for cell in dialect.split(line)]
    return (
        "number" in found
        and len(found) == len(kinds)
        and all(have in (want, "missing") or want in ("text", "empty") for have, want in zip(found, kinds, strict=True))
    )
