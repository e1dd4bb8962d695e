"""Strong-motion records as PEER publishes them (.AT2, .VT2, .DT2): four lines of header, then numbers row by row."""

from __future__ import annotations

import re
from pathlib import Path

import numpy as np

from colonnade import units
from colonnade.errors import ReadError
from colonnade.readers.clock import even_times
from colonnade.readers.format import Format, Options, Recognition
from colonnade.readers.head import Head, from_head
from colonnade.readers.recording import RecordedChannel, Recording
from colonnade.readers.text.encoding import Text
from colonnade.readers.text.running import header_claims, read_running, shortage


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
    re.compile(rf"^\s*{_POINTS}\s+{_STEP}\s+NPTS\s*,\s*DT\b", re.IGNORECASE | re.MULTILINE),
)
"""`NPTS=  2999, DT= .01000 SEC` of NGA and NGA-West2, `4096    0.0100    NPTS, DT` of the first database."""
QUANTITIES = (("ACCEL", "acceleration"), ("VELOCITY", "velocity"), ("DISPL", "displacement"))


@from_head
def recognise(head: Head) -> Recognition:
    """Say whether one of the first lines gives NPTS and DT."""
    line, size = _size(head)
    if size is None:
        return Recognition(False, f"none of the first {HEADER_LINES} lines gives NPTS and DT")
    return Recognition(True, f"line {line} gives NPTS and DT")


def _size(head: Head) -> tuple[int, re.Match[str] | None]:
    """Number of the line that gives points and step, and what it says."""
    text = "\n".join(head.lines[:HEADER_LINES])
    found = next(filter(None, (spelling.search(text) for spelling in SIZES)), None)
    return 0 if found is None else text.count("\n", 0, found.end()) + 1, found


def read(path: Path, options: Options) -> Recording:
    """Read a PEER record."""
    head = recognise.expected(path)
    line, size = _size(head)
    assert size is not None
    above, points, step = head.lines[:line], int(size["points"]), float(size["step"])
    if not 0 < step < np.inf:
        raise ReadError(f"{path.name}: line {line} gives a time step of {step:g} s.")
    values, warnings = read_running(enumerate(Text.of(path).lines()[line:], line + 1))
    warnings += shortage("the header", points, values.size)
    quantity = next((name for word, name in QUANTITIES if word in " ".join(above).upper()), "values")
    unit = header_claims("\n".join(above)).unit
    channel = RecordedChannel(quantity, spelled(unit) if unit else None, values, even_times(values.size, step))
    return Recording(path, "peer", (channel,), warnings=tuple(warnings))


FORMAT = Format(
    name="peer",
    summary="Strong-motion records of the PEER databases: AT2, VT2, DT2.",
    suffixes=(".at2", ".vt2", ".dt2"),
    recognise=recognise,
    read=read,
    in_process=True,
)
