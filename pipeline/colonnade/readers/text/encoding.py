"""Text of unknown encoding: opened, looked at, and cut into pieces of whole lines."""

from __future__ import annotations

import codecs
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from io import StringIO
from pathlib import Path
from typing import Annotated, NamedTuple, TextIO

from pydantic import AfterValidator, Field

from colonnade.readers.format import Options

HEAD_BYTES = 1 << 18
"""As much of a file as is looked at to find out how it is written."""
PIECE = 1 << 21
"""Characters that are cut into cells at once."""
ROWS_AT_ONCE = 20_000
"""Lines that are cut into cells at once, if they are there already."""
UNREADABLE = "\ufffd"

PRINTED_CONTROLS = frozenset("\t\n\r\f\v\x1a")


ASSUMED = "cp1252"
"""The encoding of bytes that are not UTF-8: Windows-1252, which holds Latin-1."""


def encoding_of(head: bytes) -> str:
    """Find a text's encoding: UTF-16 by its byte order mark, UTF-8 if that is valid, else what is assumed."""
    if head.startswith((codecs.BOM_UTF16_LE, codecs.BOM_UTF16_BE)):
        return "utf-16"
    try:
        codecs.getincrementaldecoder("utf-8")().decode(head, final=False)
    except UnicodeDecodeError:
        return ASSUMED
    return "utf-8"


def known_encoding(name: str) -> str:
    """Give an encoding's own name; ValueError if it is unknown."""
    try:
        return codecs.lookup(name).name
    except LookupError:
        raise ValueError('unknown encoding; give for example "utf-8", "utf-16" or "latin-1"') from None


class TextOptions(Options):
    """What can be said about any text."""

    encoding: Annotated[str, AfterValidator(known_encoding)] | None = Field(
        default=None, description='Of the text, such as "utf-8", "utf-16", "latin-1"; found if it is not given.'
    )


class Piece(NamedTuple):
    """Whole lines of a file: the number of the first of them, from 1, and their text."""

    line: int
    text: str


@dataclass(frozen=True)
class Text:
    """
    A text in a file, or `made` of a file that is none, such as a workbook.

    NUL characters, which recorders leave when their power fails and which C takes for the end of a cell, come out as
    U+FFFD, as do bytes that are not characters.
    """

    path: Path
    encoding: str
    made: str | None = None

    @classmethod
    def of(cls, path: Path, encoding: str | None = None) -> Text:
        """Take a file, in an encoding that is given or found; OSError if it cannot be opened."""
        with path.open("rb") as stream:
            return cls(path, encoding or encoding_of(stream.read(HEAD_BYTES)))

    def open(self) -> TextIO:
        """Open it for reading; whatever its line ends are, they come out as line feeds."""
        if self.made is not None:
            return StringIO(self.made)
        name = "utf-8-sig" if self.encoding == "utf-8" else self.encoding
        return self.path.open(encoding=name, errors="replace")

    def head(self) -> list[str]:
        """Give the first lines; one that is cut by the limit is left out."""
        with self.open() as stream:
            head = stream.read(HEAD_BYTES)
            is_whole = not stream.read(1)
        lines = head.removeprefix("\ufeff").split("\n")
        return lines[:-1] if lines[-1] == "" or (not is_whole and len(lines) > 1) else lines

    def lines(self) -> list[str]:
        """All lines; the last one is empty if it has a line end."""
        with self.open() as stream:
            return stream.read().replace("\0", UNREADABLE).split("\n")

    def whole_lines(self) -> tuple[list[str], list[str]]:
        """All lines that end, as an instrument's own program ends each, and a warning of one that does not."""
        *lines, last = self.lines()
        return lines, [f"the file ends within line {len(lines) + 1}, which is left out"] if last.strip() else []

    def pieces(self, first: int) -> Iterator[Piece]:
        """Cut it into pieces, from the line with index `first` on."""
        number, rest = first + 1, ""
        with self.open() as stream:
            for _ in range(first):
                stream.readline()
            while block := stream.read(PIECE):
                read = rest + block.replace("\0", UNREADABLE)
                end = read.rfind("\n") + 1
                rest = read[end:]
                if end:
                    yield Piece(number, read[:end])
                number += read.count("\n")
        if rest:
            yield Piece(number, rest)


def pieces_of(lines: Sequence[str], first: int, stop: int) -> Iterator[Piece]:
    """Join lines, from the index `first` to before `stop`, into pieces."""
    for start in range(first, stop, ROWS_AT_ONCE):
        yield Piece(start + 1, "".join(f"{line}\n" for line in lines[start : min(start + ROWS_AT_ONCE, stop)]))


def looks_binary(lines: list[str]) -> str:
    """Say why these lines cannot be text; empty if they can."""
    text = "".join(lines).rstrip("\0\ufffd")
    controls = sum(text.count(chr(code)) for code in range(32) if chr(code) not in PRINTED_CONTROLS)
    unreadable = controls + text.count("\ufffd")
    if text and unreadable > 0.02 * len(text):
        return f"{unreadable} of the first {len(text)} characters are not printable: a binary file, or another encoding"
    return ""
