"""Base motions from files of any format, and from text whose numbers run on from row to row."""

from __future__ import annotations

import re
import warnings
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from colonnade import units
from colonnade.dynamics.motion import Motion
from colonnade.errors import ReadError, UnitError
from colonnade.readers import registry
from colonnade.readers.body import sample_lines
from colonnade.readers.clock import rising_share
from colonnade.readers.damage import Source
from colonnade.readers.delimited import DelimitedOptions, read_header
from colonnade.readers.recording import RecordedChannel, Recording
from colonnade.readers.text_encoding import head_lines

Array = NDArray[np.float64]

_NUMBER = r"(\d*\.\d+|\d+\.?)"
STEP_IN_TEXT = re.compile(
    rf"(?:\bdt\b|\bdelta\s*t\b|spacing|interval|steps?|increments?)[^\d.\n]{{0,20}}{_NUMBER}\s*(?:s\b|sec|,|$)"
    rf"|{_NUMBER}\s*s(?:ec(?:onds?)?)?\s*(?:spacing|interval|steps?|increments?)",
    re.IGNORECASE | re.MULTILINE,
)
UNIT_IN_TEXT = re.compile(
    r"\bunits?\b[^\n\w]{0,5}(?:are|is|of|:|=)?\s*[(\[]?\s*(cm/s(?:ec)?/s(?:ec)?|cm/s(?:ec)?(?:\^|\*\*)?2|mm/s(?:ec)?(?:\^|\*\*)?2"
    r"|m/s(?:ec)?/s(?:ec)?|m/s(?:ec)?(?:\^|\*\*)?2|gals?|g's|g)(?![\w/])",
    re.IGNORECASE,
)
FORTRAN_FORMAT = re.compile(r"\b(\d+)[FE](\d+)\.\d+\b", re.IGNORECASE)
UNEVEN = 0.01
"""Largest deviation of a time step, as a share of the mean step, in a motion with equal steps."""


def read_motion(
    path: Path | str, *, unit: str | None = None, dt: float | None = None, column: str | int | None = None
) -> Motion:
    """
    Read the acceleration of a base.

    Parameters
    ----------
    path : Path or str
        Of any format that is known (PEER, COSMOS, K-NET, LabVIEW …), or text with a column of times and one of
        accelerations, a single column of accelerations, or numbers that run on from row to row below lines of text
        (as `8F10.5`).
    unit : str, optional
        Of the acceleration, such as "g" or "cm/s^2"; needed where the file does not tell it.
    dt : float, optional
        Sampling interval, s; needed where the file has neither times nor tells it.
    column : str or int, optional
        Name or number, from 1, of the column of accelerations, where there are several.

    Returns
    -------
    motion : Motion
        In m/s², with the file's own sign.

    Raises
    ------
    ReadError
        If something has to be known that is neither given nor in the file, steps are unequal or a value is missing.

    Warns
    -----
    UserWarning
        If the file is not as its own header says, for example shorter.
    """
    path = Path(path)
    recording = registry.read(path)
    if recording.format != "delimited":
        channel, step = _column(recording, column)
        for told in recording.warnings:
            warnings.warn(f"{path.name}: {told}", stacklevel=2)
        return _motion(recording, channel.values, unit or channel.unit, dt or step)
    source = read_header(path, DelimitedOptions()).source
    lines, _ = head_lines(path, source.dialect.encoding)
    text = "\n".join(lines[: source.first])
    declared = FORTRAN_FORMAT.search(text)
    width = int(declared[2]) if declared else None
    if column is None and (width or _runs_on(recording, source)):
        values, step, own_unit = _block(source, lines, width), None, None
    else:
        channel, step = _column(recording, column)
        values, own_unit = channel.values, channel.unit
    unit = unit or own_unit or _first_group(UNIT_IN_TEXT, text)
    step = dt or step or float(_first_group(STEP_IN_TEXT, text) or "nan")
    return _motion(recording, values, unit, step)


def _motion(recording: Recording, values: Array, unit: str | None, step: float | None) -> Motion:
    """Make a motion of accelerations of which unit and step are known; say what is missing where they are not."""
    name = recording.path.name
    if unit is None:
        raise ReadError(
            f"{name}: the file does not tell the unit of its acceleration. Give it, for example "
            f'read_motion("{name}", unit="g"), or "m/s^2".'
        )
    if step is None or not step > 0:
        raise ReadError(
            f"{name}: the file has no column of times and does not tell its sampling interval. "
            f'Give it in seconds, for example read_motion("{name}", dt=0.02).'
        )
    if not np.isfinite(values).all():
        told = "; ".join(recording.warnings) or f"sample {int(np.argmin(np.isfinite(values))) + 1}"
        raise ReadError(f"{name}: accelerations are missing ({told}). A base motion has to be whole; mend the file.")
    try:
        return Motion(values * units.factor_to_si(unit, "acceleration"), step)
    except UnitError as error:
        raise ReadError(f"{name}: {error}") from error


def _runs_on(recording: Recording, source: Source) -> bool:
    """Whether numbers run on from row to row: three or more nameless columns, none of them a clock."""
    nameless = all(channel.name == f"column {number}" for number, channel in enumerate(recording.channels, 1))
    return len(source.headings) >= 3 and nameless and recording.channels[0].time is None


def _block(source: Source, lines: list[str], width: int | None) -> Array:
    """Read numbers row by row, in fields of `width` characters where the text above declares them."""

    def numbers(line: str) -> list[float]:
        bare = line.rstrip()
        fields = [bare[start : start + width] for start in range(0, len(bare), width)] if width else bare.split()
        return [source.dialect.number(field) for field in fields]

    first = source.first
    # Fields of fixed width may touch: then the rows above are rows of numbers too.
    while width and first > 0 and lines[first - 1].strip() and np.isfinite(numbers(lines[first - 1])).all():
        first -= 1
    values: list[float] = []
    ended = 0
    for number, line in sample_lines(source.path, source.dialect, first):
        read = numbers(line)
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


def _column(recording: Recording, column: str | int | None) -> tuple[RecordedChannel, float | None]:
    """Find the column of accelerations and the step of the times beside it."""
    rising = [channel for channel in recording.channels if rising_share(channel.values) == 1.0]
    others = [channel for channel in recording.channels if not any(channel is clock for clock in rising)]
    if column is not None:
        chosen = recording.channel(column)
    elif len(others) == 1:
        chosen = others[0]
    else:
        names = ", ".join(f'"{channel.heading}"' for channel in others[:8])
        raise ReadError(
            f"{recording.path.name}: {len(others)} columns may be the acceleration{': ' if names else ''}{names}. "
            "Say which, for example column=2."
        )
    times = rising[0].values if chosen.time is None and rising else chosen.time
    if times is None:
        return chosen, None
    step = _step(times)
    if step is None:
        raise ReadError(
            f"{recording.path.name}: the times are not equally spaced. "
            "A base motion has equal steps: resample it first."
        )
    return chosen, step


def _step(times: Array) -> float | None:
    """Mean step of times that rise in equal steps, else None."""
    steps = np.diff(times)
    if steps.size == 0 or not np.isfinite(steps).all():
        return None
    mean = float((times[-1] - times[0]) / steps.size)
    return mean if mean > 0 and np.abs(steps - mean).max() <= UNEVEN * mean else None


def _first_group(pattern: re.Pattern[str], text: str) -> str | None:
    match = pattern.search(text)
    return next((group for group in match.groups() if group), None) if match else None
