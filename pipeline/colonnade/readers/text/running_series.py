"""A block of numbers that run on from row to row within a text file -> one series."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np

from colonnade.arrays import Array
from colonnade.errors import ReadError
from colonnade.readers.recording import RecordedChannel, Recording
from colonnade.readers.text.header_claims import HeaderClaims
from colonnade.readers.text.lines.cells import Dialect
from colonnade.readers.text.lines.encoding import head_lines
from colonnade.readers.text.lines.pieces import pieces_of_file
from colonnade.readers.text.lines.running import split_numbers
from colonnade.readers.text.row_layout import Verdict


def series_of(recording: Recording, values: Array, width: int, claims: HeaderClaims, verdict: Verdict) -> Recording:
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
    verdict : Verdict
        That they run on, and why.
    """
    why = "; ".join(verdict.reasons)
    hint = (
        f"Its numbers, {width} in a row, run on from row to row and are read as one series of {values.size} ({why}). "
        'If each column is a channel, say so: layout = "columns" in `file`.'
    )
    notes = (*recording.notes, f"numbers run on from row to row: {why}")
    if verdict.layout == "pairs":
        values = values[: values.size // 2 * 2]
        times = values[0::2].copy()
        clock = RecordedChannel("column 1", "s", times, times, is_clock=True)
        channels: tuple[RecordedChannel, ...] = (clock, RecordedChannel("column 2", claims.unit, values[1::2], times))
        notes = (*notes, "clock: every second number, taken as seconds")
    else:
        channels = (RecordedChannel("column 1", claims.unit, values, claims.times(values.size)),)
        notes = (*notes, claims.clock_note)
    return replace(recording, channels=channels, notes=notes, hint=hint)


def fixed_fields(path: Path, dialect: Dialect, first: int, claims: HeaderClaims) -> list[Array] | None:
    """
    Cut the rows into fields of the width that the header claims, as a table; None if they are not written so.

    Parameters
    ----------
    path, dialect, first : as for `read_block`
    claims : HeaderClaims
        With fields and width.
    """
    count, width = claims.fields or 1, claims.width or 1
    lines, _ = head_lines(path, dialect.encoding, wanted=first + 1)
    near = [_numbers(line, dialect, width) for line in lines[max(first - 2, 0) : first + 3]]
    if not any(len(row) == count and np.isfinite(row).all() for row in near):
        return None
    try:
        values = read_block(path, dialect, first, width)
    except ReadError:
        return None
    padded = np.concatenate([values, np.full(-values.size % count, np.nan)])
    return list(padded.reshape(-1, count).T)


def read_block(path: Path, dialect: Dialect, first: int, width: int | None) -> Array:
    """
    Read numbers row by row.

    Parameters
    ----------
    path : Path
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
    lines, _ = head_lines(path, dialect.encoding, wanted=first + 1)
    if not _is_row(lines[first], dialect, width):
        width = None
    # Rows whose fields touch do not look like the others: they may be above the first that does.
    while width and first > 0 and lines[first - 1].strip() and _is_row(lines[first - 1], dialect, width):
        first -= 1
    values: list[float] = []
    has_ended = False
    for piece in pieces_of_file(path, dialect.encoding, first):
        for number, line in piece.rows(dialect):
            read = np.isfinite(row := _numbers(line, dialect, width))
            if read.all() and not has_ended:
                values.extend(row)
            elif read.all() or (not has_ended and read.any()):
                raise ReadError(
                    f'{path.name}: line {number}, "{line.strip()[:50]}", does not continue the numbers above it. '
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
