"""The lines of a text file with their numbers; the next line can be looked at before it is taken."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from pathlib import Path
from types import TracebackType
from typing import Self

from colonnade.errors import ReadError
from colonnade.readers.text.lines.encoding import detect_encoding, open_text

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


def first_lines(path: Path, count: int) -> list[str]:
    """
    Read the first lines of what may be a text.

    Returns
    -------
    lines : list of str
        At most `count`; none if the first line is longer than any text's.
    """
    found: list[str] = []
    with NumberedLines(path) as lines:
        try:
            while len(found) < count and (line := lines.take()) is not None:
                found.append(line)
        except ReadError:
            pass
    return found
