"""Text of unknown encoding: opened, looked at, and cut into pieces of whole lines."""

from __future__ import annotations

import codecs
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from io import StringIO
from itertools import islice
from pathlib import Path
from typing import Annotated, TextIO

from pydantic import AfterValidator, Field

from colonnade.readers.format import Options
from colonnade.readers.text.cells import Dialect

HEAD_BYTES = 1 << 18
"""As much of a file as is looked at to find out how it is written."""

# UTF-32 before UTF-16: the little-endian mark of the former starts with that of the latter.
BYTE_ORDER_MARKS = (
    (codecs.BOM_UTF8, "utf-8-sig"),
    (codecs.BOM_UTF32_LE, "utf-32"),
    (codecs.BOM_UTF32_BE, "utf-32"),
    (codecs.BOM_UTF16_LE, "utf-16"),
    (codecs.BOM_UTF16_BE, "utf-16"),
)
PRINTED_CONTROLS = frozenset("\t\n\r\f\v\x1a")


@dataclass(frozen=True)
class Encoding:
    """A text encoding and how it was found."""

    name: str
    evidence: str


def detect_encoding(path: Path) -> Encoding:
    """Find a text file's encoding; OSError if it cannot be opened."""
    with path.open("rb") as stream:
        return encoding_of(stream.read(HEAD_BYTES))


def encoding_of(head: bytes) -> Encoding:
    """
    Find a text's encoding from its first bytes.

    Returns
    -------
    encoding : Encoding
        By a byte order mark; else UTF-16 where every second byte is zero; else UTF-8 where that is valid; else
        Windows-1252, the extension of Latin-1 that loggers on Windows write.
    """
    # A block of zeros at the end is what a power failure leaves; it says nothing of the encoding.
    head = head.rstrip(b"\0") or head
    for mark, name in BYTE_ORDER_MARKS:
        if head.startswith(mark):
            return Encoding(name, "by its byte order mark")
    zeros_even, zeros_odd = (head[offset::2].count(0) / max(len(head) // 2, 1) for offset in (0, 1))
    if zeros_odd > 0.3 > 0.05 > zeros_even:
        return Encoding("utf-16-le", "every second byte is zero, without a byte order mark")
    if zeros_even > 0.3 > 0.05 > zeros_odd:
        return Encoding("utf-16-be", "every first byte of two is zero, without a byte order mark")
    if head.isascii():
        return Encoding("utf-8", "plain ASCII in the part examined")
    try:
        codecs.getincrementaldecoder("utf-8")().decode(head, final=False)
    except UnicodeDecodeError as error:
        place = head.count(b"\n", 0, error.start) + 1
        return Encoding(
            "cp1252", f"byte 0x{head[error.start]:02x} on line {place} is not UTF-8; Windows-1252 is assumed"
        )
    return Encoding("utf-8", "valid in the part examined")


def known_encoding(name: str) -> str:
    """
    Give an encoding's own name.

    Raises
    ------
    ValueError
        If the encoding is unknown.
    """
    try:
        return codecs.lookup(name).name
    except LookupError:
        raise ValueError('unknown encoding; give for example "utf-8", "utf-16" or "latin-1"') from None


class TextOptions(Options):
    """What can be said about any text."""

    encoding: Annotated[str, AfterValidator(known_encoding)] | None = Field(
        default=None, description='Of the text, such as "utf-8", "utf-16", "latin-1"; found if it is not given.'
    )


def open_text(path: Path, encoding: str) -> TextIO:
    """Open text for reading; line ends are left as they are, bytes that are not characters become U+FFFD."""
    return path.open(encoding=encoding, errors="replace", newline="")


@dataclass(frozen=True)
class Text:
    """
    A text.

    Attributes
    ----------
    path : Path
        The file that it is in.
    encoding : Encoding
    made : str or None
        The text itself where it was made of a file that is none, such as a workbook.
    """

    path: Path
    encoding: Encoding
    made: str | None = None

    def open(self) -> TextIO:
        """Open it as `open_text`."""
        return open_text(self.path, self.encoding.name) if self.made is None else StringIO(self.made, newline="")

    @property
    def ends_within_line(self) -> bool:
        """Whether its last line has no line end."""
        return self.made is None and ends_within_line(self.path)


def text_of(path: Path, encoding: str | None = None) -> Text:
    """Give the text of a file, in an encoding that is given or found."""
    return Text(path, Encoding(encoding, "") if encoding else detect_encoding(path))


def head_lines(text: Text, wanted: int = 0) -> tuple[list[str], bool]:
    """
    Read the first lines of a text.

    Parameters
    ----------
    text : Text
    wanted : int
        Number of lines that have to be among them, if the file has so many.

    Returns
    -------
    lines : list of str
        Without line ends and byte order mark. A last line that was cut by the limit is left out.
    whole : bool
        Whether this is all of the file.
    """
    with text.open() as stream:
        head = block = stream.read(HEAD_BYTES)
        while len(block) == HEAD_BYTES and head.count("\n") + head.count("\r") < wanted:
            block = stream.read(HEAD_BYTES)
            head += block
        whole = not stream.read(1)
    lines = [line.rstrip("\r\n") for line in StringIO(head.removeprefix("\ufeff"), newline="")]
    return (lines if whole or len(lines) == 1 else lines[:-1]), whole


def looks_binary(lines: list[str]) -> str:
    """Say why these lines cannot be text; empty if they can."""
    text = "".join(lines).rstrip("\0\ufffd")
    controls = sum(text.count(chr(code)) for code in range(32) if chr(code) not in PRINTED_CONTROLS)
    unreadable = controls + text.count("\ufffd")
    if text and unreadable > 0.02 * len(text):
        return f"{unreadable} of the first {len(text)} characters are not printable: a binary file, or another encoding"
    return ""


def ends_within_line(path: Path) -> bool:
    """Whether the file's last line has no line end."""
    with path.open("rb") as stream:
        size = stream.seek(0, 2)
        stream.seek(max(size - 8, 0))
        return not stream.read().rstrip(b"\0\x1a").endswith((b"\n", b"\r"))


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
