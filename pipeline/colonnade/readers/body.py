"""The part of a text file that holds the samples: as a stream, in pieces of whole lines, and line by line."""

from __future__ import annotations

from collections.abc import Iterator
from io import TextIOBase
from pathlib import Path

from colonnade.readers.cells import Dialect
from colonnade.readers.text_encoding import open_text

UNREADABLE = "\ufffd"

PIECE = 1 << 21
"""Characters that are cut into cells at once."""


class Body(TextIOBase):
    """
    A text file from its first sample on.

    NUL characters, which recorders leave when their power fails and which C takes for the end of a cell, come out as
    U+FFFD, so that the cell is not a number.

    Parameters
    ----------
    path : Path
    dialect : Dialect
    first : int
        Index of the line of the first sample, from 0.
    widest : int, optional
        Lines with more cells come out as ones of just `widest` unreadable cells, and cells without their quotation
        marks, of which a single one that is never closed could take all that follows with it. Each line is then
        looked at, which takes longer.

    Attributes
    ----------
    separator : str
        Stands between cells in what is read; not the file's delimiter where quotation marks are taken off.
    """

    def __init__(self, path: Path, dialect: Dialect, first: int, widest: int | None = None) -> None:
        self._dialect, self._widest = dialect, widest
        self.separator = "\x1f" if dialect.quoted else dialect.delimiter
        self._stream = open_text(path, dialect.encoding)
        for _ in range(first):
            self._stream.readline()
        self._pending = self._stream.read(1).removeprefix("\ufeff")

    def pieces(self) -> Iterator[str]:
        """Read it in pieces of whole lines, none of them blank."""
        rest = ""
        while text := self.read(PIECE):
            text = rest + text
            # A line may end in a carriage return alone, but not between that and a line feed.
            end = text.rfind("\n") + 1 or text.rfind("\r", 0, -1) + 1
            piece, rest = text[:end], text[end:]
            if piece and not piece.isspace():
                yield piece
        if rest and not rest.isspace():
            yield rest

    def read(self, size: int | None = -1, /) -> str:
        """Read about `size` characters."""
        if self._widest is not None:
            return "".join(self._narrow(line) for line in self._lines(size or -1))
        text = self._pending + self._stream.read(-1 if size is None else size)
        self._pending = ""
        return text.replace("\0", UNREADABLE)

    def readline(self, size: int | None = -1, /) -> str:  # type: ignore[override]
        """Read a line with its line end."""
        line = self._pending + self._stream.readline()
        self._pending = ""
        return line.replace("\0", UNREADABLE)

    def close(self) -> None:
        """Close the file."""
        self._stream.close()
        super().close()

    def _lines(self, size: int) -> Iterator[str]:
        read = 0
        while size < 0 or read < size:
            line = self.readline()
            if not line:
                return
            read += len(line)
            yield line

    def _narrow(self, line: str) -> str:
        bare = line.rstrip("\r\n")
        if self._dialect.is_blank(bare):
            return line
        cells = self._dialect.split(bare)
        if self._widest is not None and len(cells) > self._widest:
            cells = [UNREADABLE] * self._widest
        elif not self._dialect.quoted:
            return line
        return self.separator.join(cells) + line[len(bare) :]


class Piece(TextIOBase):
    """A text that is read at once, and not encoded or copied before."""

    def __init__(self, text: str) -> None:
        self._text = text

    def readable(self) -> bool:
        """Tell pandas that it may read."""
        return True

    def read(self, size: int | None = -1, /) -> str:
        """Give all that is left."""
        text, self._text = self._text, ""
        return text


def sample_lines(path: Path, dialect: Dialect, first: int) -> Iterator[tuple[int, str]]:
    """
    Go through the lines that pandas makes rows of: all but blank ones.

    Yields
    ------
    number : int
        Of the line in the file, from 1.
    line : str
        Without its line end.
    """
    with Body(path, dialect, first) as body:
        for number, line in enumerate(body, first + 1):
            if not dialect.is_blank(line):
                yield number, line.rstrip("\r\n")
