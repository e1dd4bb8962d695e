"""A block of numbers that run on from row to row within a text file -> one series."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np

from colonnade.errors import ReadError
from colonnade.readers.announced import Announced
from colonnade.readers.body import sample_lines
from colonnade.readers.clock import even_times
from colonnade.readers.damage import Source
from colonnade.readers.recording import Array, RecordedChannel, Recording
from colonnade.readers.row_layout import Verdict
from colonnade.readers.running_numbers import split_numbers
from colonnade.readers.text_encoding import head_lines


def series_of(recording: Recording, values: Array, width: int, told: Announced, verdict: Verdict) -> Recording:
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
    told : Announced
        What the lines above say: interval and unit are taken from there.
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
        channels: tuple[RecordedChannel, ...] = (clock, RecordedChannel("column 2", told.unit, values[1::2], times))
        notes = (*notes, "clock: every second number, taken as seconds")
    else:
        even = None if told.step is None else even_times(values.size, told.step)
        channels = (RecordedChannel("column 1", told.unit, values, even),)
        notes = (*notes, "no clock" if told.step is None else f"clock: {told.step:g} s, as the header says")
    return replace(recording, channels=channels, notes=notes, hint=hint)


def undecided(path: Path, width: int, verdict: Verdict) -> str:
    """Say why a file does not tell whether columns are channels, and what to do."""
    for_series = "; ".join(verdict.reasons) or "no names stand above the columns"
    for_channels = "; ".join(verdict.against) or "nothing says so"
    return (
        f"{path.name}: the file does not show whether the {width} numbers of each row are samples of {width} channels, "
        f"or one series that runs on from row to row. For channels: {for_channels}. For one series: {for_series}. "
        'Say which in `file`: layout = "columns" or layout = "running".'
    )


def fixed_fields(source: Source, count: int, width: int) -> list[Array] | None:
    """
    Cut the rows into fields of the width that the header declares, as a table; None where they are not written so.

    Parameters
    ----------
    source : Source
    count, width : int
        Fields of a row, characters of a field.
    """
    lines, _ = head_lines(source.path, source.dialect.encoding, wanted=source.first + 1)
    near = [_numbers(line, source, width) for line in lines[max(source.first - 2, 0) : source.first + 3]]
    if not any(len(row) == count and np.isfinite(row).all() for row in near):
        return None
    try:
        values = read_block(source, width)
    except ReadError:
        return None
    padded = np.concatenate([values, np.full(-values.size % count, np.nan)])
    return list(padded.reshape(-1, count).T)


def read_block(source: Source, width: int | None) -> Array:
    """
    Read numbers row by row.

    Parameters
    ----------
    source : Source
        Where they begin.
    width : int or None
        Characters of a field, where the header declares it; fields of fixed width may touch.

    Returns
    -------
    values : ndarray, shape (n,)

    Raises
    ------
    ReadError
        If a line within or below the block holds numbers, but does not continue it.
    """
    lines, _ = head_lines(source.path, source.dialect.encoding, wanted=source.first + 1)
    if width and not np.isfinite(_numbers(lines[source.first], source, width)).all():
        width = None
    first = source.first
    # Rows whose fields touch do not look like the others: they may stand above the first that does.
    while (
        width
        and first > 0
        and lines[first - 1].strip()
        and np.isfinite(_numbers(lines[first - 1], source, width)).all()
    ):
        first -= 1
    values: list[float] = []
    ended = 0
    for number, line in sample_lines(source.path, source.dialect, first):
        read = _numbers(line, source, width)
        if np.isfinite(read).all() and not ended:
            values.extend(read)
        elif np.isfinite(read).all() or (not ended and np.isfinite(read).any()):
            raise ReadError(
                f'{source.path.name}: line {number}, "{line.strip()[:50]}", does not continue the numbers above it. '
                "One block of numbers was expected; cut the file to it."
            )
        else:
            ended = number
    return np.array(values)


def _numbers(line: str, source: Source, width: int | None) -> list[float]:
    dialect, bare = source.dialect, line.rstrip()
    if width:
        return [dialect.number(bare[start : start + width]) for start in range(0, len(bare), width)]
    cells = dialect.split(bare)
    while len(cells) > 1 and not cells[-1]:
        cells.pop()
    values = [dialect.number(cell) for cell in cells]
    if dialect.decimal == "." and not np.isfinite(values).all():
        return split_numbers(bare)
    return values
