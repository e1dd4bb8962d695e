"""How a text is written: its delimiter and numbers, what each cell and column holds, and the first sample."""

from __future__ import annotations

import csv
import re
from collections import Counter, defaultdict
from collections.abc import Iterator
from dataclasses import dataclass, replace
from functools import cached_property
from itertools import chain
from typing import NamedTuple

WHITESPACE = " "
"""As a delimiter: any run of spaces and tabs."""

DELIMITERS = (";", "\t", "|", ",", WHITESPACE)
DELIMITER_NAMES = {"\t": "tab", WHITESPACE: "spaces"}
SAMPLE_LINES = 120
"""Lines at the end of the head of a file from which it is found out how samples are written."""
LOOK_AHEAD = 10
"""Lines after a candidate that have to look like samples too, at least in this share:"""
ALIKE = 0.7

COMMENT_SIGNS = ("#", "%", "//", "!")

MISSING = frozenset(
    text.casefold()
    for text in (
        *("", "-", "--", "---", "?", "NaN", "-NaN", "NA", "N/A", "n.a.", "#N/A", "null", "none", "nil", "void", "k.A."),
        *("OVERFLOW", "OVERLOAD", "OVL", "OVLD", "OVR", "OVRNG", "OL", "OVER", "UNDER", "UNDERFLOW", "UNDERRANGE"),
        *("OVERRANGE", "INF", "-INF", "+INF", "1.#INF", "-1.#INF", "1.#QNAN", "-1.#IND", "#NUM!", "#DIV/0!", "#VALUE!"),
        *("invalid", "bad", "error", "err", "fault", "open", "no data", "missing"),
    )
)
"""What recorders write in place of a number."""

BLANKS = " '\N{RIGHT SINGLE QUOTATION MARK}\N{NO-BREAK SPACE}\N{NARROW NO-BREAK SPACE}"
"""Between thousands; none of them can be a decimal sign."""
_WITHOUT_BLANKS = str.maketrans("dD\N{MINUS SIGN}", "ee-", BLANKS)

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
        Casefolded texts that stand for a missing value in this file, besides `MISSING`.
    """

    delimiter: str
    decimal: str
    thousands: str | None = None
    quoted: bool = False
    comments: tuple[str, ...] = COMMENT_SIGNS
    missing: frozenset[str] = frozenset()

    @property
    def other_sign(self) -> str:
        """The comma where points are decimal signs, the point where commas are."""
        return "," if self.decimal == "." else "."

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

    def is_missing(self, cell: str) -> bool:
        """Whether a cell says that there is no value."""
        return cell.casefold() in MISSING or cell.casefold() in self.missing

    def is_number(self, cell: str) -> bool:
        """Whether a cell is a number, read in one way only: `1'234` is one, `1.234` with decimal commas is not."""
        return self._number.fullmatch(cell) is not None

    def number(self, cell: object) -> float:
        """Read a cell; NaN if it is not a number, or could be read in two ways."""
        if not isinstance(cell, str):
            return float(cell) if isinstance(cell, (int, float)) else float("nan")
        text = cell.strip().strip('"').strip()
        if self.is_missing(text):
            return float("nan")
        if self.is_number(text):
            return float(text.replace(self.other_sign, "").replace(self.decimal, ".").translate(_WITHOUT_BLANKS))
        return {"true": 1.0, "false": 0.0}.get(text.casefold(), float("nan"))

    @cached_property
    def _number(self) -> re.Pattern[str]:
        decimal, other = re.escape(self.decimal), re.escape(self.other_sign)
        plain = rf"(?:\d+(?:{decimal}\d*)?|{decimal}\d+)(?:[eEdD][+-]?\d+)?"
        # Groups of three cannot be decimals only if a decimal sign or another group follows, or their sign was given.
        grouped = rf"\d{{1,3}}(?:{other}\d{{3}})+{decimal}\d*|\d{{1,3}}(?:{other}\d{{3}}){{2,}}"
        grouped += rf"|\d{{1,3}}(?:[{BLANKS}]\d{{3}})+(?:{decimal}\d*)?"
        grouped += rf"|\d{{1,3}}(?:{re.escape(self.thousands)}\d{{3}})+(?:{decimal}\d*)?" if self.thousands else ""
        return re.compile(rf"[+\-\N{{MINUS SIGN}}]?(?:{plain}|{grouped})", re.ASCII)


def quoted_cells(line: str, delimiter: str) -> list[str]:
    """Cut a line whose cells may be in quotation marks."""
    try:
        rows = list(csv.reader([line], delimiter=delimiter, skipinitialspace=True))
    except csv.Error:
        return [cell.strip() for cell in line.split(delimiter)]
    return [cell.strip() for row in rows for cell in row]


def is_timestamp(cell: str) -> bool:
    """Whether a cell is a date with time, or a time of day."""
    return ":" in cell and TIMESTAMP.fullmatch(cell) is not None


def looks_like_numbers(line: str) -> bool:
    """Whether a line has digits and no letters but those of exponents, however damaged it is."""
    return re.search(r"\d", line) is not None and re.search(r"[^\W\d_eEdD]", line) is None


def kind_of(cell: str, dialect: Dialect) -> str:
    """Name what a cell holds: `missing`, `number`, `time` or `text`."""
    if dialect.is_missing(cell):
        return "missing"
    if dialect.is_number(cell):
        return "number"
    return "time" if is_timestamp(cell) else "text"


def is_sample(line: str, dialect: Dialect, kinds: tuple[str, ...]) -> bool:
    """Whether a line holds something for each column, at least one number, and no text in a column of numbers."""
    cells = dialect.split(line)
    if dialect.is_comment(line) or len(cells) != len(kinds):
        return False
    found = [kind_of(cell, dialect) for cell in cells]
    return "number" in found and all(
        have == want or have == "missing" or want in ("text", "empty") for have, want in zip(found, kinds, strict=True)
    )


class _Fit(NamedTuple):
    """How well a dialect explains the sample: the rows of numbers, their cells, the share of sure numbers."""

    dialect: Dialect
    columns: int = 0
    rows: int = 0
    score: float = 0.0


def sniff(
    lines: list[str], given: Dialect, *, delimiter: str | None, decimal: str | None
) -> tuple[Dialect, int, list[str], list[str]]:
    """
    Find the dialect that makes most cells numbers and gives most lines the same number of cells.

    With it come the cells on most rows of numbers (0 without such a row), notes and warnings.

    The later lines of a head are looked at, as there the samples are surest. Comment signs, missing values and perhaps
    the sign between thousands are `given`; so may be the delimiter and the decimal sign.
    """
    filled = [line for line in lines if line.strip() and not given.is_comment(line)]
    sample = filled[-SAMPLE_LINES:]
    fits = [_fit(sample, dialect) for dialect in _candidates(sample, given, delimiter, decimal)]
    best = max(fits, key=lambda fit: (fit.score, fit.columns > 1))
    dialect = best.dialect
    if best.rows == 0:
        return dialect, 0, [], []
    numbers = filter(dialect.is_number, chain.from_iterable(map(dialect.split, sample)))
    signed = next((number for number in numbers if dialect.decimal in number), None)
    notes, warnings = [], []
    if delimiter is None and best.columns == 1:
        notes.append("one column: no delimiter gives more numbers in the lines examined")
    elif delimiter is None:
        sign = DELIMITER_NAMES.get(dialect.delimiter, f'"{dialect.delimiter}"')
        notes.append(f"delimiter {sign} ({best.columns} cells on {best.rows} of the {len(sample)} lines examined)")
    if decimal is None:
        why = " assumed: the numbers examined have none" if signed is None else f' (as in "{signed}")'
        notes.append(f'decimal sign "{dialect.decimal}"{why}')
    if dialect.thousands != given.thousands:
        warnings.append(
            f'the decimal sign is "{dialect.decimal}", so that "{dialect.thousands}" is taken as a mark between '
            f"thousands, as in 1{dialect.thousands}234: if it is none, write the file with one decimal sign; "
            f'thousands = "{dialect.thousands}" says that it is one'
        )
    is_open = not delimiter and not decimal and signed is None and (dialect.delimiter, best.columns) == (",", 2)
    if is_open and any(fit.columns == 1 and fit.score == best.score for fit in fits):
        warnings.append(
            f'rows such as "{sample[-1].strip()}" are read as two columns of whole numbers; they could also be '
            'one column with decimal commas: then set decimal = ","'
        )
    return dialect, best.columns, notes, warnings


def _candidates(sample: list[str], given: Dialect, delimiter: str | None, decimal: str | None) -> Iterator[Dialect]:
    """Dialects that the sample may be written in."""
    quoted = sum('"' in line for line in sample) > len(sample) / 2
    for candidate in DELIMITERS if delimiter is None else (delimiter,):
        if quoted and candidate == WHITESPACE and delimiter is None:
            continue
        for sign in (".", ",") if decimal is None else (decimal,):
            if sign != candidate or quoted:
                plain = replace(given, delimiter=candidate, decimal=sign, quoted=quoted)
                yield plain
                if given.thousands is None and _is_marked(sample, plain):
                    yield replace(plain, thousands=plain.other_sign)


def _is_marked(sample: list[str], dialect: Dialect) -> bool:
    """Whether a column has whole numbers alone, some with the other sign between their groups of three digits."""
    columns: defaultdict[int, list[str]] = defaultdict(list)
    for line in filter(looks_like_numbers, sample):
        for place, cell in enumerate(dialect.split(line)):
            columns[place].append(cell.lstrip("+-"))
    sign = dialect.other_sign
    whole = re.compile(rf"\d*|[1-9]\d{{0,2}}({re.escape(sign)}\d{{3}})+")
    return any(sign in "".join(cells) and all(map(whole.fullmatch, cells)) for cells in columns.values())


def _fit(sample: list[str], dialect: Dialect) -> _Fit:
    counts: Counter[int] = Counter()
    numbers: defaultdict[int, float] = defaultdict(float)
    for line in sample:
        cells = dialect.split(line)
        weights = [_weight(cell, dialect) for cell in cells if not dialect.is_missing(cell)]
        if sum(weights) > 0 and sum(weights) >= len(weights) / 2:
            counts[len(cells)] += 1
            numbers[len(cells)] += sum(weights) / len(weights)
    if not counts:
        return _Fit(dialect)
    columns, rows = max(counts.items(), key=lambda item: (item[1], item[0]))
    return _Fit(dialect, columns, rows, round(numbers[columns] / len(sample), 3))


def _weight(cell: str, dialect: Dialect) -> float:
    """How surely a cell is a number or a time, 0 to 1."""
    if kind_of(cell, dialect) == "text":
        return 0.0
    # "05" is hardly a whole number; rather the decimals of "1,05" cut at the comma.
    digits = cell.lstrip("+-")
    return 0.5 if len(digits) > 1 and digits[0] == "0" and digits.isdigit() else 1.0


def column_kinds(lines: list[str], dialect: Dialect, columns: int) -> tuple[str, ...]:
    """
    Find what each column holds in the later lines of a head: `number`, `time` (date or time of day), `text` or `empty`.

    A nameless empty last column, made by a delimiter at the end of each line, is among the columns.
    """
    counts: list[Counter[str]] = [Counter() for _ in range(columns)]
    for line in [line for line in lines if line.strip()][-SAMPLE_LINES:]:
        cells = dialect.split(line)
        kinds = [kind_of(cell, dialect) for cell in cells]
        if len(cells) == columns and "number" in kinds:
            for count, kind in zip(counts, kinds, strict=True):
                count[kind] += 1
    return tuple(
        max(("number", "time", "text"), key=count.__getitem__) if count.total() > count["missing"] else "empty"
        for count in counts
    )


def find_first_sample(lines: list[str], start: int, dialect: Dialect, kinds: tuple[str, ...]) -> int | None:
    """Find the index of the first line, from `start` on, with a value for each column, after which most have one."""
    filled = [index for index in range(start, len(lines)) if not dialect.is_blank(lines[index])]
    for place, index in enumerate(filled):
        if is_sample(lines[index], dialect, kinds):
            following = [lines[other] for other in filled[place : place + LOOK_AHEAD + 1]]
            following = [line for line in following if not dialect.is_comment(line)]
            alike = sum(_resembles_sample(line, dialect, kinds) for line in following)
            if alike >= ALIKE * len(following):
                return index
    return None


def _resembles_sample(line: str, dialect: Dialect, kinds: tuple[str, ...]) -> bool:
    """Whether a line could be a sample that is not quite as it should be."""
    found = [kind_of(cell, dialect) for cell in dialect.split(line)]
    is_alike = len(found) == len(kinds) and 2 * found.count("text") <= len(found) - found.count("missing")
    return is_alike or looks_like_numbers(line)
