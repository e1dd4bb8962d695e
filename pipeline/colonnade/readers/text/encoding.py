"""Text of unknown encoding: opened, looked at, and cut into pieces of whole lines."""

from __future__ import annotations

import codecs
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from io import StringIO
from pathlib import Path
from typing import Annotated, NamedTuple, TextIO

from pydantic import AfterValidator, Field

from colonnade.errors import ReadError
from colonnade.readers.format import Options

HEAD_BYTES = 1 << 18
"""As much of a file as is looked at to find out how it is written."""
LONGEST_LINE = 1 << 20
"""Characters of a line; no recorder writes longer ones."""
PIECE = 1 << 21
"""Characters that are cut into cells at once."""
ROWS_AT_ONCE = 20_000
"""Lines that are cut into cells at once, if they are there already."""
UNREADABLE = "\ufffd"

# UTF-32 before UTF-16: the little-endian mark of the former starts with that of the latter.
BYTE_ORDER_MARKS = (
    (codecs.BOM_UTF8, "utf-8-sig"),
    (codecs.BOM_UTF32_LE, "utf-32"),
    (codecs.BOM_UTF32_BE, "utf-32"),
    (codecs.BOM_UTF16_LE, "utf-16"),
    (codecs.BOM_UTF16_BE, "utf-16"),
)
PRINTED_CONTROLS = frozenset("\t\n\r\f\v\x1a")


class Encoding(NamedTuple):
    """A text encoding and how it was found."""

    name: str
    evidence: str


def encoding_of(head: bytes) -> Encoding:
    """Find a text's encoding: by its mark, by zeros at every second byte, UTF-8 if that is valid, else Windows-1252."""
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
    A text.

    NUL characters, which recorders leave when their power fails and which C takes for the end of a cell, come out as
    U+FFFD, as do bytes that are not characters.

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

    @classmethod
    def of(cls, path: Path, encoding: str | None = None) -> Text:
        """Take a file, in an encoding that is given or found; OSError if it cannot be opened."""
        if encoding is not None:
            return cls(path, Encoding(encoding, ""))
        with path.open("rb") as stream:
            return cls(path, encoding_of(stream.read(HEAD_BYTES)))

    def open(self) -> TextIO:
        """Open it for reading; whatever its line ends are, they come out as line feeds."""
        if self.made is not None:
            return StringIO(self.made)
        name = "utf-8-sig" if self.encoding.name == "utf-8" else self.encoding.name
        return self.path.open(encoding=name, errors="replace")

    def head(self) -> list[str]:
        """Give the first lines; one that is cut by the limit is left out."""
        with self.open() as stream:
            head = stream.read(HEAD_BYTES)
            is_whole = not stream.read(1)
        lines = head.removeprefix("\ufeff").split("\n")
        return lines[:-1] if lines[-1] == "" or (not is_whole and len(lines) > 1) else lines

    def lines(self) -> list[str]:
        """All lines; the last one is empty if it has a line end. ReadError if one is too long for a recorder's."""
        with self.open() as stream:
            lines = stream.read().replace("\0", UNREADABLE).split("\n")
        if long := next((number for number, line in enumerate(lines, 1) if len(line) > LONGEST_LINE), None):
            raise ReadError(
                f"{self.path.name}: line {long} has more than {LONGEST_LINE} characters; rows of numbers were "
                "expected. The file is damaged or of another kind."
            )
        return lines

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
    """Join lines, from the index `first` to before `stop`, into pieces; the last line of the text has no line end."""
    for start in range(first, stop, ROWS_AT_ONCE):
        end = min(start + ROWS_AT_ONCE, stop)
        yield Piece(start + 1, "\n".join(lines[start:end]) + ("\n" if end < len(lines) else ""))


def looks_binary(lines: list[str]) -> str:
    """Say why these lines cannot be text; empty if they can."""
    text = "".join(lines).rstrip("\0\ufffd")
    controls = sum(text.count(chr(code)) for code in range(32) if chr(code) not in PRINTED_CONTROLS)
    unreadable = controls + text.count("\ufffd")
    if text and unreadable > 0.02 * len(text):
        return f"{unreadable} of the first {len(text)} characters are not printable: a binary file, or another encoding"
    return ""
