"""Lines one by one, with their numbers, and numbers that run on from line to line."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Iterator
from pathlib import Path
from types import TracebackType
from typing import Self

import numpy as np

from colonnade.arrays import Array
from colonnade.errors import ReadError
from colonnade.readers.text.encoding import detect_encoding, open_text

LONGEST_LINE = 1 << 20
"""Characters of a line; no recorder writes longer ones."""


class NumberedLines:
    """
    A text file line by line.

    Parameters
    ----------
    path : Path
    encoding : str, optional
        Detected if it is not given.

    Attributes
    ----------
    encoding : str
    number : int
        Of the line taken last, from 1; 0 before the first.
    """

    def __init__(self, path: Path, encoding: str | None = None) -> None:
        self._path = path
        self.encoding = encoding or detect_encoding(path).name
        self._stream = open_text(path, self.encoding)
        self._ahead: str | None = None
        self.number = 0

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self._stream.close()

    def peek(self) -> str | None:
        """Look at the next line, without its line end; None after the last one."""
        if self._ahead is not None:
            return self._ahead
        line = self._stream.readline(LONGEST_LINE)
        if not line:
            return None
        if len(line) == LONGEST_LINE:
            raise ReadError(
                f"{self._path.name}: line {self.number + 1} has more than {LONGEST_LINE} characters; "
                "rows of numbers were expected. The file is damaged or of another kind."
            )
        if self.number == 0:
            line = line.removeprefix("\ufeff")
        self._ahead = line.rstrip("\r\n").replace("\0", "\ufffd")
        return self._ahead

    def take(self) -> str | None:
        """Take the next line, without its line end; None after the last one."""
        line = self.peek()
        if line is not None:
            self._ahead = None
            self.number += 1
        return line

    def skip(self, count: int) -> None:
        """Pass over so many lines."""
        for _ in range(count):
            self.take()

    def until(self, stops: Callable[[str], bool]) -> Iterator[tuple[int, str]]:
        """Take lines, with their numbers, up to the first that stops; it can still be looked at."""
        while (line := self.peek()) is not None and not stops(line):
            self.take()
            yield self.number, line

    def rest(self) -> Iterator[tuple[int, str]]:
        """Take all further lines, with their numbers."""
        while (line := self.take()) is not None:
            yield self.number, line


FREE = re.compile(r"[-+]?(?:\d+\.?\d*|\.\d+)(?:[eEdD][-+]?\d+)?")
SHOWN = 50


def read_running(lines: Iterable[tuple[int, str]], *, width: int | None = None) -> tuple[Array, list[str]]:
    """
    Read numbers row by row.

    Parameters
    ----------
    lines : iterable of (int, str)
        Number and text of each line.
    width : int, optional
        Characters of a field, as in `8F10.5`; without it, spaces or signs separate the fields.

    Returns
    -------
    values : ndarray, shape (n,)
        NaN for a field that is not a number.
    warnings : list of str
        Lines with such fields.
    """
    pieces: list[list[float]] = []
    faults: list[str] = []
    count = 0
    for number, line in lines:
        bare = line.rstrip()
        if not bare:
            continue
        values = _fields(bare, width)
        if any(value != value for value in values):
            count += 1
            faults = faults or [f'{number}: "{bare.strip()[:SHOWN]}"']
        pieces.append(values)
    warnings = []
    if count:
        what = "1 line holds" if count == 1 else f"{count} lines hold"
        first = "first " if count > 1 else ""
        warnings.append(f"{what} something that is not a number ({first}on line {faults[0]}); missing")
    return np.array([value for piece in pieces for value in piece], dtype=np.float64), warnings


def shortage(source: str, announced: int, found: int) -> list[str]:
    """Warn if there are fewer numbers than what is above them says."""
    if found >= announced:
        return []
    return [f"{source} gives {announced} points, but the file has {found}: it ends too early"]


def _fields(line: str, width: int | None) -> list[float]:
    """Numbers of a line."""
    if width is not None:
        return [_number(line[start : start + width]) for start in range(0, len(line), width)]
    return split_numbers(line)


def split_numbers(line: str) -> list[float]:
    """Numbers of a line, separated by blanks or by their signs; NaN for what is not a number."""
    fields = line.split()
    try:
        return [_finite(float(field)) for field in fields]
    except ValueError:
        pass
    values: list[float] = []
    for field in fields:
        parts = FREE.findall(field)
        # Without a blank between, a new number starts with its sign.
        whole = parts and "".join(parts) == field and all(part[0] in "+-" for part in parts[1:])
        values += [_number(part) for part in parts] if whole else [float("nan")]
    return values


def _number(field: str) -> float:
    text = field.strip()
    if FREE.fullmatch(text) is None:
        return float("nan")
    return _finite(float(text.replace("D", "E").replace("d", "e")))


def _finite(value: float) -> float:
    return value if abs(value) != float("inf") else float("nan")
