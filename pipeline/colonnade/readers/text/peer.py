"""Strong-motion records as PEER publishes them (.AT2, .VT2, .DT2): four lines of header, then numbers row by row."""

from __future__ import annotations

import re
from pathlib import Path

import numpy as np

from colonnade import units
from colonnade.errors import ReadError
from colonnade.readers.clock import even_times
from colonnade.readers.format import Format, Options, Recognition
from colonnade.readers.head import Head, from_head, head_of
from colonnade.readers.recording import RecordedChannel, Recording
from colonnade.readers.text.encoding import Text
from colonnade.readers.text.running import read_running, shortage


def spelled(unit: str) -> str:
    """
    Give a unit's usual spelling; one that is not known as it is, in lower case.

    Examples
    --------
    >>> [spelled(unit) for unit in ("CM/SEC/SEC", "cm/sec2", "G", "counts/volt")]
    ['cm/s^2', 'cm/s^2', 'g', 'count/V']
    """
    found = units.find_unit(unit.casefold())
    return found.symbol if found else unit.casefold()


HEADER_LINES = 8
"""Lines among which the number of points and the time step are."""

_POINTS, _STEP = r"(?P<points>\d{1,12})", r"(?P<step>\d*\.?\d+(?:[eE][-+]?\d+)?)"
SIZES = (
    re.compile(rf"NPTS\s*=\s*{_POINTS}\s*,?\s*DT\s*=\s*{_STEP}", re.IGNORECASE),
    re.compile(rf"^\s*{_POINTS}\s+{_STEP}\s+NPTS\s*,\s*DT\b", re.IGNORECASE),
)
"""`NPTS=  2999, DT= .01000 SEC` of NGA and NGA-West2, `4096    0.0100    NPTS, DT` of the first database."""
UNITS = re.compile(
    r"\bUNITS?\s+(?:OF|ARE|IN|:)?\s*:?\s*(CM/S(?:EC)?/S(?:EC)?|CM/S(?:EC)?\^?2|CM/S(?:EC)?|CM|M/S\^?2|G)\b",
    re.IGNORECASE,
)
QUANTITIES = (("ACCEL", "acceleration"), ("VELOCITY", "velocity"), ("DISPL", "displacement"))


@from_head
def recognise(head: Head) -> Recognition:
    """Say whether one of the first lines gives NPTS and DT."""
    above, _ = _header(head)
    if not above:
        return Recognition(False, f"none of the first {HEADER_LINES} lines gives NPTS and DT")
    return Recognition(True, f"line {len(above)} gives NPTS and DT")


def read(path: Path, options: Options) -> Recording:
    """
    Read a PEER record.

    Raises
    ------
    ReadError
        If NPTS and DT are not given or no numbers follow.
    """
    above, size = _header(head_of(path))
    if size is None:
        raise ReadError(
            f"{path.name}: none of the first {HEADER_LINES} lines gives the number of points and the step; "
            '"NPTS=  2999, DT= .01000 SEC" was expected.'
        )
    line, points, step = len(above), int(size["points"]), float(size["step"])
    if not 0 < step < np.inf:
        raise ReadError(f"{path.name}: line {line} gives a time step of {step:g} s.")
    values, warnings = read_running(enumerate(Text.of(path).lines()[line:], line + 1))
    if not np.isfinite(values).any():
        raise ReadError(f"{path.name}: no numbers follow line {line}: the file was cut off.")
    warnings += shortage("the header", points, values.size)
    if values.size > points:
        warnings.append(f"the header gives {points} points, but the file has {values.size}: all of them are read")
    quantity = next((name for word, name in QUANTITIES if word in " ".join(above).upper()), "values")
    unit = next((spelled(found[1]) for each in above if (found := UNITS.search(each))), None)
    notes = (f"{points} points, step {step:g} s (line {line})",)
    channel = RecordedChannel(quantity, unit, values, even_times(values.size, step))
    return Recording(path, "peer", (channel,), notes=notes, warnings=tuple(warnings))


def _header(head: Head) -> tuple[list[str], re.Match[str] | None]:
    """Lines down to the one that gives points and step, and what it says; no line if none does."""
    lines = head.lines[:HEADER_LINES]
    for number, line in enumerate(lines, 1):
        for spelling in SIZES:
            if found := spelling.search(line):
                return lines[:number], found
    return [], None


FORMAT = Format(
    name="peer",
    summary="Strong-motion records of the PEER databases: AT2, VT2, DT2.",
    suffixes=(".at2", ".vt2", ".dt2"),
    recognise=recognise,
    read=read,
    in_process=True,
)
