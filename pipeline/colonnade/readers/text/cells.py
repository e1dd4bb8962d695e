"""Cells of a line of text: splitting a line into cells, and the value of a cell."""

from __future__ import annotations

import csv
import re
from dataclasses import dataclass
from functools import cached_property

WHITESPACE = " "
"""As a delimiter: any run of spaces and tabs."""

SAMPLE_LINES = 120
"""Lines at the end of the head of a file from which it is found out how samples are written."""

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

MARKED = re.compile(r"[+\-\N{MINUS SIGN}]?[1-9]\d{0,2}([.,])\d{3}(?:\1\d{3})*", re.ASCII)
"""A decimal number, or a whole one with a point or a comma between its thousands."""

BLANKS = " '\N{RIGHT SINGLE QUOTATION MARK}\N{NO-BREAK SPACE}\N{NARROW NO-BREAK SPACE}"
"""Between thousands; none of them can be a decimal sign."""
_WITHOUT_BLANKS = str.maketrans("", "", BLANKS)

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
    encoding : str
    delimiter : str
        One character; a space stands for any run of spaces and tabs.
    decimal : str
        "." or ",".
    thousands : str or None
        The sign between groups of three digits, if there is one.
    quoted : bool
        Whether cells are in quotation marks, which then hide delimiters.
    padded : bool
        Whether spaces follow delimiters.
    comments : tuple of str
        What starts a line that is not a sample.
    missing : frozenset of str
        Casefolded texts that stand for a missing value.
    """

    encoding: str
    delimiter: str
    decimal: str
    thousands: str | None = None
    quoted: bool = False
    padded: bool = False
    comments: tuple[str, ...] = COMMENT_SIGNS
    missing: frozenset[str] = MISSING

    @property
    def other_sign(self) -> str:
        """The comma where points are decimal signs, the point where commas are."""
        return "," if self.decimal == "." else "."

    @property
    def own_missing(self) -> frozenset[str]:
        """Those of them that were given for this file."""
        return self.missing - MISSING

    def split(self, line: str) -> list[str]:
        """Cut a line into its cells, without the spaces around them."""
        if self.delimiter == WHITESPACE:
            return line.split()
        if self.quoted:
            return quoted_cells(line, self.delimiter)
        return [cell.strip() for cell in line.split(self.delimiter)]

    def is_blank(self, line: str) -> bool:
        """Whether a line holds nothing at all, not even a delimiter."""
        return not line.strip(" \r\n" if self.delimiter == "\t" else " \t\r\n")

    def is_comment(self, line: str) -> bool:
        """Whether a line starts with a comment sign."""
        return line.lstrip().startswith(self.comments)

    def is_missing(self, cell: str) -> bool:
        """Whether a cell says that there is no value."""
        return cell.casefold() in self.missing

    def is_number(self, cell: str) -> bool:
        """Whether a cell is a number, read in one way only: `1'234` is one, `1.234` with decimal commas is not."""
        return self._number.fullmatch(cell) is not None

    def number(self, cell: object) -> float:
        """Read a cell; NaN if it is not a number, or could be read in two ways."""
        if not isinstance(cell, str):
            return float(cell) if isinstance(cell, (int, float)) else float("nan")
        text = cell.strip().strip('"').strip().replace("\N{MINUS SIGN}", "-")
        if text.casefold() in self.missing:
            return float("nan")
        if self.is_number(text) or (self.thousands and self._grouped.fullmatch(text)):
            plain = text.replace(self.other_sign, "").replace(self.decimal, ".").translate(_WITHOUT_BLANKS)
            return float(plain.replace("d", "e").replace("D", "E"))
        return {"true": 1.0, "false": 0.0}.get(text.casefold(), float("nan"))

    @cached_property
    def _number(self) -> re.Pattern[str]:
        decimal, other = re.escape(self.decimal), re.escape(self.other_sign)
        plain = rf"(?:\d+(?:{decimal}\d*)?|{decimal}\d+)(?:[eEdD][+-]?\d+)?"
        # Groups of three cannot be decimals only if a decimal sign or another group follows.
        grouped = rf"\d{{1,3}}(?:{other}\d{{3}})+{decimal}\d*|\d{{1,3}}(?:{other}\d{{3}}){{2,}}"
        grouped += rf"|\d{{1,3}}(?:[{BLANKS}]\d{{3}})+(?:{decimal}\d*)?"
        return re.compile(rf"[+\-\N{{MINUS SIGN}}]?(?:{plain}|{grouped})", re.ASCII)

    @cached_property
    def _grouped(self) -> re.Pattern[str]:
        decimal, thousands = re.escape(self.decimal), re.escape(self.thousands or "")
        return re.compile(rf"[+-]?\d{{1,3}}(?:{thousands}\d{{3}})+(?:{decimal}\d*)?", re.ASCII)


def quoted_cells(line: str, delimiter: str) -> list[str]:
    """Cut a line whose cells may be in quotation marks."""
    try:
        rows = list(csv.reader([line], delimiter=delimiter, skipinitialspace=True))
    except csv.Error:
        return [cell.strip() for cell in line.split(delimiter)]
    return [cell.strip() for row in rows for cell in row]


def decimals_of(cell: str, decimal: str) -> int:
    """Count the digits after the decimal sign."""
    return len(cell.rpartition(decimal)[2]) if decimal in cell else 0


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
    if dialect.is_number(cell) or MARKED.fullmatch(cell):
        return "number"
    return "time" if is_timestamp(cell) else "text"


def is_sample(line: str, dialect: Dialect, kinds: list[str]) -> bool:
    """Whether a line holds something for each column, at least one number, and no text in a column of numbers."""
    if dialect.is_comment(line):
        return False
    cells = dialect.split(line)
    if len(cells) != len(kinds):
        return False
    found = [kind_of(cell, dialect) for cell in cells]
    return "number" in found and all(
        have == want or have == "missing" or want in ("text", "empty") for have, want in zip(found, kinds, strict=True)
    )
