"""Universal files with functions at nodes (UFF, data set 58), as text or with binary values."""

from __future__ import annotations

import re
from collections.abc import Iterator
from itertools import takewhile
from pathlib import Path
from typing import BinaryIO

import numpy as np

from colonnade.errors import ReadError
from colonnade.readers.clock import even_times
from colonnade.readers.format import Format, Options, Recognition
from colonnade.readers.head import Head, from_head
from colonnade.readers.recording import TIME_UNITS, RecordedChannel, Recording
from colonnade.readers.text.encoding import encoding_of
from colonnade.readers.text.running import read_running

MARK = b"-1"
FUNCTIONS = ("58", "58b")
"""Data sets of functions at nodes, in text and in binary."""
HEADER_LINES = 11
TIME = 17
"""Kind of abscissa, among the data characteristics."""
TIME_RESPONSE = 1
"""Kind of function."""
REAL_KINDS = {2: "f4", 4: "f8"}
"""Kinds of ordinates that are real, in single and double precision."""
IEEE = "2"
BYTE_ORDERS = {"1": "<", "2": ">"}
OPENING = re.compile(rb" {4}-1 *\r?\n *(?:\d{2,4}|58b .*) *\r?\n")
"""As Fortran writes the mark and the number of a data set; numbers of a table look otherwise."""


@from_head
def recognise(head: Head) -> Recognition:
    """Say whether the first lines open a data set."""
    if OPENING.match(head.content):
        return Recognition(True, "it opens with -1 and the number of a data set")
    return Recognition(False, "it does not open with -1 and the number of a data set")


def read(path: Path, options: Options) -> Recording:
    """Read the functions of time in a universal file; ReadError if it holds no functions."""
    warnings: list[str] = []
    notes: list[str] = []
    channels: list[RecordedChannel] = []
    kinds: list[str] = []
    with path.open("rb") as stream:
        for place, fields in _data_sets(stream):
            kinds.append(fields[0])
            try:
                channels += _function(stream, fields, warnings, notes) if fields[0] in FUNCTIONS else ()
            except (ValueError, IndexError, OverflowError) as error:
                warnings.append(f"the data set 58 at byte {place} is damaged or was cut off ({error}); left out")
    if not {*FUNCTIONS} & {*kinds}:
        raise ReadError(
            f"{path.name}: it holds data sets {', '.join(dict.fromkeys(kinds))}, but no data set 58, the one with "
            'recorded histories. Export the time histories ("functions at nodal DOF", data set 58).'
        )
    return Recording(path, "uff", tuple(channels), notes=tuple(notes), warnings=tuple(warnings))


def _data_sets(stream: BinaryIO) -> Iterator[tuple[int, list[str]]]:
    """Find the data sets; each is left to the caller to read from the line below its number on."""
    while line := stream.readline():
        if line.strip() == MARK:
            header = MARK
            while header == MARK:  # the mark that closes one set and the one that opens the next
                place = stream.tell()
                header = stream.readline().strip()
            if header:
                yield place, header.decode("latin-1").split()


def _function(stream: BinaryIO, fields: list[str], warnings: list[str], notes: list[str]) -> Iterator[RecordedChannel]:
    """Read a data set 58, its eleven lines by their columns; ValueError or IndexError if it is incomplete."""
    lines = [stream.readline() for _ in range(HEADER_LINES)]
    texts = (line.decode(encoding_of(line), errors="replace").rstrip("\r\n") for line in lines)
    title, *_, kinds, form, abscissa, ordinate, _, _ = texts
    name = _label(title) or f"node {kinds[41:51].strip()} direction {kinds[51:55].strip()}"
    number, points, spacing, start, interval = (*form.split(), *[""] * 5)[:5]
    function, kind, size, begin, step = int(kinds[:5]), int(number), int(points), float(start), float(interval)
    if size < 0:
        raise ValueError(f"{size} points")
    is_even, is_time = int(spacing) == 1, int(abscissa[:10]) == TIME
    if kind not in REAL_KINDS or not (is_time or function == TIME_RESPONSE):
        notes.append(f'"{name}": not a real function of time (kind {function}); left out')
        return
    if fields[0] == "58b":
        if not is_even or fields[1] not in BYTE_ORDERS or fields[2] != IEEE:
            raise ValueError("only even steps of IEEE numbers are read in binary; export it as text")
        stored, content = np.dtype(BYTE_ORDERS[fields[1]] + REAL_KINDS[kind]), stream.read(int(fields[4]))
        numbers = np.frombuffer(content, stored, len(content) // stored.itemsize).astype(np.float64)
    else:
        rows = takewhile(lambda line: line.strip() != MARK, iter(stream.readline, b""))
        numbers, told = read_running(enumerate((row.decode("latin-1") for row in rows), 1))
        warnings += [f'"{name}", below its header: {text}' for text in told]
    wanted = size if is_even else 2 * size
    if numbers.size < wanted:
        warnings.append(f'"{name}": the data set should have {wanted} numbers but has {numbers.size}: cut off')
    values = numbers[:wanted] if is_even else numbers[1:wanted:2]
    time = None if is_even else numbers[: 2 * values.size : 2]
    if is_even and step > 0:
        time = even_times(values.size, step, begin)
    second = TIME_UNITS.get(_label(abscissa[46:66]).casefold(), 1.0)
    yield RecordedChannel(name, _label(ordinate[46:66]) or None, values, None if time is None else time * second)


def _label(text: str) -> str:
    bare = text.strip()
    return "" if bare.upper() == "NONE" else bare


FORMAT = Format(
    name="uff",
    summary="Universal files with functions at nodes (data set 58), text or binary.",
    suffixes=(".uff", ".unv", ".uf"),
    recognise=recognise,
    read=read,
)
