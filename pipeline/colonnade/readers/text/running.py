"""Numbers that run on from row to row: what the lines above say of them, whether rows are such, and their reading."""

from __future__ import annotations

import re
from collections.abc import Iterable, Sequence
from math import isfinite
from pathlib import Path
from typing import NamedTuple

import numpy as np

from colonnade.arrays import Array
from colonnade.errors import ReadError
from colonnade.readers.clock import RISING_SHARE, rising_share
from colonnade.readers.text.dialect import Dialect, looks_like_numbers
from colonnade.readers.text.encoding import Text

_NUMBER = r"(\d*\.\d+|\d+\.?)"
_STEPS = r"(?:spacing|interval|steps?|increments?)"
STEP = re.compile(
    rf"(?:\bdt\b|\bdelta\s*t\b|\b(?:time|sampl[a-z]*)[\W_]+{_STEPS})[^\d.\n]{{0,20}}{_NUMBER}\s*(?:s\b|sec|,|$)"
    rf"|{_STEPS}[^\d.\n]{{0,20}}{_NUMBER}\s*s(?:\b|ec)"  # a load step has a number, too, but no unit
    rf"|{_NUMBER}\s*s(?:ec(?:onds?)?)?\s*{_STEPS}",
    re.IGNORECASE | re.MULTILINE,
)
UNIT = re.compile(
    r"\bunits?\b[^\n\w]{0,5}(?:are|is|of|in|:|=)?\s*[(\[]?\s*"
    r"([cm]?m/s(?:ec)?(?:/s(?:ec)?|\^?2|\*\*2)?|cm|gals?|g's|g)(?![\w/])",
    re.IGNORECASE,
)
_COUNTED = r"(?:points?|samples?|pts\.?|values|ordinates|readings)"
COUNTS = re.compile(
    rf"\b(\d{{2,9}})\s+(?:\w+\s+)?{_COUNTED}\b|\b(?:npts|{_COUNTED})\s*[:=]?\s*(\d{{2,9}})\b", re.IGNORECASE
)
PER_ROW = re.compile(r"\b(\d{1,3})\s+(?:\w+\s+){1,4}(?:row|line)\b", re.IGNORECASE)
FEWEST_TIMES = 5
"""Rows from which on a first column that rises is one of times."""
TOUCHING = re.compile(r"(?<=[\d.])(?=[-+])")
"""Without a blank between, a new number starts with its sign."""


class HeaderClaims(NamedTuple):
    """What a text says of the numbers below it."""

    counts: tuple[int, ...] = ()
    """How many points there are; several where several are given."""
    per_row: int | None = None
    """How many are in a row."""
    step: float | None = None
    """s."""
    unit: str | None = None


def header_claims(text: str) -> HeaderClaims:
    """
    Take from the lines above a block of numbers what they say of it.

    Examples
    --------
    >>> header_claims("1559 points at equal spacing of 0.02 sec, 8 points across in a row. The units are (g)")
    HeaderClaims(counts=(1559,), per_row=8, step=0.02, unit='g')
    """
    per_row, step, unit = (
        next(filter(None, match.groups()), None) if (match := each.search(text)) else None
        for each in (PER_ROW, STEP, UNIT)
    )
    counts = tuple(int(match[1] or match[2]) for match in COUNTS.finditer(text))
    return HeaderClaims(counts, int(per_row) if per_row else None, float(step or 0) or None, unit)


def why_running(path: Path, columns: Sequence[Array], claims: HeaderClaims, *, is_free: bool) -> str:
    """
    Decide by what a file says of its nameless rows of numbers whether they run on, and why; empty if they do not.

    ReadError if only blanks are between numbers, and the file declares neither names, nor times, nor a count of points.
    """
    filled = [int(np.isfinite(column).sum()) for column in columns]
    width, rows, found = len(filled), max(filled), sum(filled)
    if width < 2 or rows < 2 or (rows >= FEWEST_TIMES and rising_share(columns[0]) >= RISING_SHARE):
        return ""
    if claims.per_row == width:
        return f"the header says that {width} points are in a row"
    if any(abs(count - rows) <= 1 for count in claims.counts):
        return ""
    if count := next((count for count in claims.counts if abs(count - found) < width), 0):
        return f"the header gives {count} points, and there are {found} numbers"
    if not is_free:
        return ""
    raise ReadError(
        f"{path.name}: the file does not show whether the {width} numbers of each row are samples of {width} channels, "
        "or one series that runs on from row to row: no names are above them, the first column does not rise as times "
        'do, and no count of points fits. Say which in `file`: layout = "columns" or layout = "running".'
    )


def read_series(text: Text, dialect: Dialect, first: int) -> Array:
    """Read numbers row by row, from the line with index `first` on; text may follow, but not be between."""
    lines = [line.replace(dialect.delimiter, " ").replace(dialect.decimal, ".") for line in text.lines()[first:]]
    while lines and not looks_like_numbers(lines[-1]):
        lines.pop()
    values, faults = read_running(enumerate(lines, first + 1))
    if faults:
        raise ReadError(
            f"{text.path.name}: the numbers run on from row to row, but {faults[0].removesuffix('; missing')}. One "
            "block of numbers was expected; cut the file to it."
        )
    return values


def read_running(lines: Iterable[tuple[int, str]], *, width: int | None = None) -> tuple[Array, list[str]]:
    """
    Read numbers row by row; what is none is NaN, and warned of with its line.

    A field has a `width`, as in `8F10.5`; without it, spaces or signs separate the fields.
    """
    numbers: list[float] = []
    faults: list[str] = []
    for number, line in lines:
        if width is None:
            fields = TOUCHING.sub(" ", line).split()
        else:
            fields = [line[at : at + width].strip() for at in range(0, len(line.rstrip()), width)]
        found = [_number(field) for field in fields]
        numbers += found
        if not all(map(isfinite, found)):
            faults.append(f'line {number} ("{line.strip()[:50]}")')
    more = f" and {len(faults) - 1} more" if len(faults) > 1 else ""
    warnings = [f"{faults[0]}{more}: something that is not a number; missing"] if faults else []
    values = np.array(numbers, dtype=np.float64)
    return np.where(np.isinf(values), np.nan, values), warnings


def _number(field: str) -> float:
    """Read a number, perhaps with an exponent as Fortran writes it; NaN if it is none."""
    try:
        return float(field.upper().replace("D", "E"))
    except ValueError:
        return float("nan")


def shortage(source: str, announced: int, found: int) -> list[str]:
    """Warn if there are fewer numbers than what is above them says."""
    if found >= announced:
        return []
    return [f"{source} gives {announced} points, but the file has {found}: it ends too early"]
