"""A text file cut into pieces of whole lines, each with the number of its first line."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from io import StringIO
from itertools import islice

from colonnade.readers.text.lines.cells import Dialect
from colonnade.readers.text.lines.encoding import Text

UNREADABLE = "\ufffd"

PIECE = 1 << 21
"""Characters that are cut into cells at once."""
ROWS_AT_ONCE = 20_000
"""Lines that are cut into cells at once, if they are read one by one."""


@dataclass(frozen=True)
class Piece:
    """
    Whole lines of a file.

    Attributes
    ----------
    line : int
        Number of the first of them, from 1.
    text : str
    """

    line: int
    text: str

    def rows(self, dialect: Dialect) -> Iterator[tuple[int, str]]:
        """Go through the lines that pandas makes rows of, all but blank ones: their numbers and texts."""
        for number, line in enumerate(StringIO(self.text, newline=""), self.line):
            if not dialect.is_blank(line):
                yield number, line.rstrip("\r\n")


def pieces_of_text(text: Text, first: int) -> Iterator[Piece]:
    """
    Cut a text into pieces, none of them blank, from the line with index `first` on.

    NUL characters, which recorders leave when their power fails and which C takes for the end of a cell, come out as
    U+FFFD, so that the cell is not a number.
    """
    with text.open() as stream:
        for _ in range(first):
            stream.readline()
        number = first + 1
        rest = stream.read(1).removeprefix("\ufeff").replace("\0", UNREADABLE)
        while read := stream.read(PIECE):
            read = rest + read.replace("\0", UNREADABLE)
            # A line may end in a carriage return alone, but not between that and a line feed.
            end = read.rfind("\n") + 1 or read.rfind("\r", 0, -1) + 1
            piece, rest = read[:end], read[end:]
            if piece and not piece.isspace():
                yield Piece(number, piece)
            number += piece.count("\n")
            if "\r" in piece:
                number += piece.count("\r") - piece.count("\r\n")
        if rest and not rest.isspace():
            yield Piece(number, rest)


def pieces_of_lines(lines: Iterable[tuple[int, str]]) -> Iterator[Piece]:
    """Join lines that were taken one by one, with their numbers, into pieces."""
    remaining = iter(lines)
    texts: list[str] = []
    start = 0
    while batch := list(islice(remaining, ROWS_AT_ONCE)):
        for number, text in batch:
            if texts and number != start + len(texts):
                yield Piece(start, "\n".join(texts))
                texts = []
            start = start if texts else number
            texts.append(text)
        yield Piece(start, "\n".join(texts))
        texts = []
