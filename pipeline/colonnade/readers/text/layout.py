"""Whether rows of numbers are samples of channels, or one series that runs on from row to row; reading of such one."""

from __future__ import annotations

import re
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Literal

import numpy as np

from colonnade.arrays import Array
from colonnade.errors import ReadError
from colonnade.readers.clock import RISING_SHARE, equal_step, even_times, rising_share
from colonnade.readers.recording import RecordedChannel, Recording
from colonnade.readers.text.cells import Dialect
from colonnade.readers.text.encoding import Text, head_lines, pieces_of_text
from colonnade.readers.text.numbered import split_numbers
from colonnade.readers.text.rows import filled_length

_NUMBER = r"(\d*\.\d+|\d+\.?)"
_STEPS = r"(?:spacing|interval|steps?|increments?)"
STEP = re.compile(
    rf"(?:\bdt\b|\bdelta\s*t\b|\b(?:time|sampl[a-z]*)[\W_]+{_STEPS})[^\d.\n]{{0,20}}{_NUMBER}\s*(?:s\b|sec|,|$)"
    rf"|{_STEPS}[^\d.\n]{{0,20}}{_NUMBER}\s*s(?:\b|ec)"  # a load step has a number, too, but no unit
    rf"|{_NUMBER}\s*s(?:ec(?:onds?)?)?\s*{_STEPS}",
    re.IGNORECASE | re.MULTILINE,
)
UNIT = re.compile(
    r"\bunits?\b[^\n\w]{0,5}(?:are|is|of|:|=)?\s*[(\[]?\s*(cm/s(?:ec)?/s(?:ec)?|cm/s(?:ec)?(?:\^|\*\*)?2|mm/s(?:ec)?(?:\^|\*\*)?2"
    r"|m/s(?:ec)?/s(?:ec)?|m/s(?:ec)?(?:\^|\*\*)?2|gals?|g's|g)(?![\w/])",
    re.IGNORECASE,
)
FIELDS = re.compile(r"\b(?:\d+P,?)?(\d{1,3})[FEG](\d{1,3})\.\d+\b", re.IGNORECASE)
_COUNTED = r"(?:points?|samples?|pts\.?|values|ordinates|readings)"
COUNTS = re.compile(
    rf"\b(\d{{2,9}})\s+(?:\w+\s+)?{_COUNTED}\b"
    rf"|\b(?:npts|(?:no\.?|number)\s+of\s+(?:\w+\s+)?{_COUNTED}|{_COUNTED})\s*[:=]?\s*(\d{{2,9}})\b",
    re.IGNORECASE,
)
PER_ROW = re.compile(
    rf"\b(\d{{1,3}})\s+(?:\w+\s+)?{_COUNTED}?\s*(?:across|(?:per|a|each|in a|in each|to a|on each)\s+(?:row|line))\b",
    re.IGNORECASE,
)
FEWEST_TIMES = 5
"""Rows from which on a first column that rises is one of times."""


@dataclass(frozen=True)
class HeaderClaims:
    """
    What a text says of the numbers below it.

    Attributes
    ----------
    counts : tuple of int
        How many points there are; several where several are given.
    per_row : int or None
        How many are in a row, if it says so in words.
    fields, width : int or None
        Fields of a row and characters of a field, as in `8F10.5`.
    step : float or None
        s.
    unit : str or None
    """

    counts: tuple[int, ...] = ()
    per_row: int | None = None
    fields: int | None = None
    width: int | None = None
    step: float | None = None
    unit: str | None = None

    def times(self, count: int) -> Array | None:
        """Times of so many numbers at the interval that the text gives, s; None if it gives none."""
        return None if self.step is None else even_times(count, self.step)

    @property
    def clock_note(self) -> str:
        """What these times come from."""
        return "no clock" if self.step is None else f"clock: {self.step:g} s, as the header says"


def header_claims(text: str) -> HeaderClaims:
    """
    Take from the lines above a block of numbers what they say of it.

    Examples
    --------
    >>> header_claims("1559 points at equal spacing of 0.02 sec, in the format of 8F10.5. The units are (g)")
    HeaderClaims(counts=(1559,), per_row=None, fields=8, width=10, step=0.02, unit='g')
    """
    form, across = FIELDS.search(text), PER_ROW.search(text)
    step = float(_first_group(STEP, text) or "nan")
    return HeaderClaims(
        tuple(int(match[1] or match[2]) for match in COUNTS.finditer(text)),
        int(across[1]) if across else None,
        int(form[1]) if form else None,
        int(form[2]) or None if form else None,
        step if step > 0 else None,
        _first_group(UNIT, text),
    )


def _first_group(pattern: re.Pattern[str], text: str) -> str | None:
    match = pattern.search(text)
    return next((group for group in match.groups() if group), None) if match else None


@dataclass(frozen=True)
class Layout:
    """What rows of numbers are: samples of channels, one series, or times and values in turn; and how that is known."""

    kind: Literal["columns", "running", "pairs"]
    reason: str = ""


def declared_layout(
    path: Path,
    columns: Sequence[Array],
    claims: HeaderClaims,
    series: Callable[[], Array] | None,
    *,
    is_named: bool,
    is_free: bool,
) -> Layout:
    """
    Decide by what a file says of its rows of numbers how they are to be read.

    Parameters
    ----------
    path : Path
    columns : sequence of ndarray, shape (n,)
        As if it were a table; NaN if a row is too short.
    claims : HeaderClaims
        What the lines above say.
    series : callable or None
        Gives the numbers as one series; None if not all of the file was read.
    is_named : bool
        Whether names or units are above the columns.
    is_free : bool
        Whether only blanks are between numbers, as in what a Fortran program wrote.

    Raises
    ------
    ReadError
        If only blanks are between the numbers, and the file declares neither names, nor times, nor a count of points.
    """
    width, rows = len(columns), max(filled_length(column) for column in columns)
    if width < 2 or rows < 2 or is_named:
        return Layout("columns")
    table = np.column_stack([column[:rows] for column in columns])
    full = table[np.isfinite(table).all(axis=1)]
    if rows >= FEWEST_TIMES and rising_share(columns[0]) >= RISING_SHARE > rising_share(full.ravel()):
        times = full[:, 0::2].ravel()
        if width >= 4 and width % 2 == 0 and len(full) == rows and equal_step(times, 0.1) is not None:
            return Layout("pairs", "every second number is a time, in equal steps from row to row")
        return Layout("columns")
    if claims.per_row == width:
        return Layout("running", f"the header says that {width} points are in a row")
    if claims.counts and series is not None:
        if any(abs(count - rows) <= 1 for count in claims.counts):
            return Layout("columns")
        found = series().size
        if count := next((count for count in claims.counts if abs(count - found) < width), 0):
            return Layout("running", f"the header gives {count} points, and there are {found} numbers")
    if not is_free:
        return Layout("columns")
    raise ReadError(
        f"{path.name}: the file does not show whether the {width} numbers of each row are samples of {width} channels, "
        "or one series that runs on from row to row: no names are above them, the first column does not rise as times "
        'do, and no count of points fits. Say which in `file`: layout = "columns" or layout = "running".'
    )


def touching_fields(lines: Sequence[str], first: int, width: int, dialect: Dialect, claims: HeaderClaims) -> bool:
    """Whether rows near the first, cut at blanks into `width` cells, are fields of the width that the header claims."""
    if not (claims.fields and claims.width) or claims.fields == width:
        return False
    near = [_numbers(line, dialect, claims.width) for line in lines[max(first - 2, 0) : first + 3]]
    return any(len(row) == claims.fields and np.isfinite(row).all() for row in near)


def series_of(recording: Recording, values: Array, width: int, claims: HeaderClaims, layout: Layout) -> Recording:
    """
    Give numbers that run on from row to row as one series, or as times and values in turn.

    Parameters
    ----------
    recording : Recording
        The file, with what is known of it already.
    values : ndarray, shape (n,)
        Its numbers, in their order.
    width : int
        Numbers in a row.
    claims : HeaderClaims
        What the lines above say, with interval and unit.
    layout : Layout
        That they run on, and why.
    """
    hint = (
        f"Its numbers, {width} in a row, run on from row to row and are read as one series of {values.size} "
        f'({layout.reason}). If each column is a channel, say so: layout = "columns" in `file`.'
    )
    notes = (*recording.notes, f"numbers run on from row to row: {layout.reason}")
    if layout.kind == "pairs":
        times = values[: values.size // 2 * 2 : 2].copy()
        clock = RecordedChannel("column 1", "s", times, times, is_clock=True)
        channels: tuple[RecordedChannel, ...] = (clock, RecordedChannel("column 2", claims.unit, values[1::2], times))
        notes = (*notes, "clock: every second number, taken as seconds")
    else:
        channels = (RecordedChannel("column 1", claims.unit, values, claims.times(values.size)),)
        notes = (*notes, claims.clock_note)
    return replace(recording, channels=channels, notes=notes, hint=hint)


def read_block(text: Text, dialect: Dialect, first: int, width: int | None) -> Array:
    """
    Read numbers row by row.

    Parameters
    ----------
    text : Text
    dialect : Dialect
    first : int
        Index of the line where they begin, from 0.
    width : int or None
        Characters of a field, if the header declares it; fields of fixed width may touch.

    Returns
    -------
    values : ndarray, shape (n,)

    Raises
    ------
    ReadError
        If a line within or below the block holds numbers, but does not continue it.
    """
    lines, _ = head_lines(text, wanted=first + 1)
    if not _is_row(lines[first], dialect, width):
        width = None
    # Rows whose fields touch do not look like the others: they may be above the first that does.
    while width and first > 0 and lines[first - 1].strip() and _is_row(lines[first - 1], dialect, width):
        first -= 1
    values: list[float] = []
    has_ended = False
    for piece in pieces_of_text(text, first):
        for number, line in piece.rows(dialect):
            read = np.isfinite(row := _numbers(line, dialect, width))
            if read.all() and not has_ended:
                values.extend(row)
            elif read.all() or (not has_ended and read.any()):
                raise ReadError(
                    f'{text.path.name}: line {number}, "{line.strip()[:50]}", does not continue the numbers above it. '
                    "One block of numbers was expected; cut the file to it."
                )
            else:
                has_ended = True
    return np.array(values)


def _is_row(line: str, dialect: Dialect, width: int | None) -> bool:
    return bool(np.isfinite(_numbers(line, dialect, width)).all())


def _numbers(line: str, dialect: Dialect, width: int | None) -> list[float]:
    bare = line.rstrip()
    if width:
        return [dialect.number(bare[start : start + width]) for start in range(0, len(bare), width)]
    cells = dialect.split(bare)
    while len(cells) > 1 and not cells[-1]:
        cells.pop()
    values = [dialect.number(cell) for cell in cells]
    if dialect.decimal == "." and not np.isfinite(values).all():
        return split_numbers(bare)
    return values
