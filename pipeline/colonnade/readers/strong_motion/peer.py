"""Strong-motion records as PEER publishes them (.AT2, .VT2, .DT2): four lines of header, then numbers row by row."""

from __future__ import annotations

import re
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from colonnade.errors import ReadError
from colonnade.readers.recording import RecordedChannel, Recording
from colonnade.readers.registry import Format, Options, Recognition
from colonnade.readers.text.clock import even_times
from colonnade.readers.text.lines.numbered import NumberedLines, first_lines
from colonnade.readers.text.lines.running import read_running, shortage

HEADER_LINES = 8
"""Lines among which the number of points and the time step are."""

_NUMBER = r"(\d*\.?\d+(?:[eE][-+]?\d+)?)"
SIZES = (
    re.compile(rf"NPTS\s*=\s*(?P<points>\d+)\s*,?\s*DT\s*=\s*{_NUMBER.replace('(', '(?P<step>', 1)}", re.IGNORECASE),
    re.compile(rf"^\s*(?P<points>\d+)\s+{_NUMBER.replace('(', '(?P<step>', 1)}\s+NPTS\s*,\s*DT\b", re.IGNORECASE),
)
"""`NPTS=  2999, DT= .01000 SEC` of NGA and NGA-West2, `4096    0.0100    NPTS, DT` of the first database."""
UNITS = re.compile(
    r"\bUNITS?\s+(?:OF|ARE|IN|:)?\s*:?\s*(CM/S(?:EC)?/S(?:EC)?|CM/S(?:EC)?\^?2|CM/S(?:EC)?|CM|M/S\^?2|G)\b",
    re.IGNORECASE,
)
QUANTITIES = (("ACCEL", "acceleration"), ("VELOCITY", "velocity"), ("DISPL", "displacement"))
SPELLINGS = {
    "cm/sec": "cm/s",
    **dict.fromkeys(("cm/sec2", "cm/sec^2", "cm/sec/sec", "cm/s/s", "cm/s2"), "cm/s^2"),
    "m/s2": "m/s^2",
}


@dataclass(frozen=True)
class Header:
    """What is above the numbers: lines taken, points, step in s, quantity, unit, title."""

    lines: int
    points: int
    step: float
    quantity: str
    unit: str | None
    title: str


def recognise(path: Path) -> Recognition:
    """Say whether one of the first lines gives NPTS and DT."""
    header = _header(first_lines(path, HEADER_LINES))
    if header is None:
        return Recognition(False, f"none of the first {HEADER_LINES} lines gives NPTS and DT")
    return Recognition(True, f"line {header.lines} gives NPTS and DT")


def read(path: Path, options: Options) -> Recording:
    """
    Read a PEER record.

    Raises
    ------
    ReadError
        If NPTS and DT are not given or no numbers follow.
    """
    header = _header(first_lines(path, HEADER_LINES))
    if header is None:
        raise ReadError(
            f"{path.name}: none of the first {HEADER_LINES} lines gives the number of points and the step; "
            '"NPTS=  2999, DT= .01000 SEC" was expected.'
        )
    if not 0 < header.step < np.inf:
        raise ReadError(f"{path.name}: line {header.lines} gives a time step of {header.step:g} s.")
    with NumberedLines(path) as lines:
        for _ in range(header.lines):
            lines.take()
        values, warnings = read_running(lines.rest())
    if not np.isfinite(values).any():
        raise ReadError(f"{path.name}: no numbers follow line {header.lines}: the file was cut off.")
    warnings += shortage("the header", header.points, values.size)
    if values.size > header.points:
        warnings.append(
            f"the header announces {header.points} points and {values.size} are there: all of them are read"
        )
    time = even_times(values.size, header.step)
    notes = (
        f"{header.points} points, step {header.step:g} s (line {header.lines})",
        f'{header.quantity} in {header.unit or "an unknown unit"}: "{header.title}"',
    )
    channel = RecordedChannel(header.quantity, header.unit, values, time)
    return Recording(path, "peer", (channel,), notes=notes, warnings=tuple(warnings))


def _header(lines: list[str]) -> Header | None:
    for number, line in enumerate(lines, 1):
        for spelling in SIZES:
            if found := spelling.search(line):
                above = lines[:number]
                return Header(
                    number, int(found["points"]), float(found["step"]), _quantity(above), _unit(above), _title(above)
                )
    return None


def _quantity(lines: list[str]) -> str:
    text = " ".join(lines).upper()
    return next((name for word, name in QUANTITIES if word in text), "values")


def _unit(lines: list[str]) -> str | None:
    found = next((match for line in lines if (match := UNITS.search(line))), None)
    if found is None:
        return None
    spelled = found[1].casefold()
    return SPELLINGS.get(spelled, spelled)


def _title(lines: list[str]) -> str:
    return " ".join(lines[min(1, len(lines) - 1)].split())[:80]


FORMAT = Format(
    name="peer",
    summary="Strong-motion records of the PEER databases: AT2, VT2, DT2.",
    suffixes=(".at2", ".vt2", ".dt2"),
    recognise=recognise,
    read=read,
    in_process=True,
)
