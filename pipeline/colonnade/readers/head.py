"""The first bytes of a file, read once for all formats that look at them; what it is where no format reads it."""

from __future__ import annotations

import re
from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property
from io import StringIO
from itertools import islice
from pathlib import Path

from colonnade.errors import ReadError
from colonnade.readers.files import unreachable
from colonnade.readers.format import Recognition
from colonnade.readers.text.encoding import encoding_of

BYTES, LINES = 1 << 16, 64
"""As much of a file as says what it is: universal files may begin with long data sets of geometry; the longest header
of a strong-motion record has 64 lines (ESM)."""
HDF5 = b"\x89HDF\r\n\x1a\n"
ZIP = b"PK\x03\x04"
OLE = b"\xd0\xcf\x11\xe0\xa1\xb1\x1a\xe1"
NETCDF = (b"CDF\x01", b"CDF\x02")
"""Marks of NetCDF in its classic forms."""
_KNOWN: dict[bytes | tuple[bytes, ...], str] = {
    b"version https://git-lfs": "it is a pointer of git-lfs, not the file itself: fetch that with `git lfs pull`",
    b"TDSm": "it is LabVIEW TDMS",
    b"TDSh": "it is a .tdms_index, which LabVIEW writes next to the .tdms and which holds no samples: give the .tdms",
    b"MATLAB 5.0": "it is a MATLAB file",
    b"MATLAB 7.3": "it is a MATLAB file of version 7.3",
    NETCDF: "it is NetCDF",
    b"CDF\x05": "it is NetCDF of the variant CDF-5, which is not read: convert it, `nccopy -k nc4 old.nc new.nc`",
    HDF5: "it is HDF5",
    OLE: "it is a document of an old Office program",
    ZIP: "it is a zip archive or an Office document",
    b"\x93NUMPY": "it is a NumPy file, which is not read because it may contain a program: save the numbers as text",
    (b"\x80\x02", b"\x80\x03", b"\x80\x04", b"\x80\x05"): (
        "it is a Python pickle, a program that runs when it is opened: never read"
    ),
    b"\x1f\x8b": "it is compressed with gzip: unpack it first",
}
_WEB_PAGE = (b"<!doctype html", b"<html", b"<head")


@dataclass(frozen=True)
class Head:
    """
    The beginning of a file.

    Attributes
    ----------
    path : Path
    content : bytes
        The first `BYTES`, or all.
    """

    path: Path
    content: bytes

    @cached_property
    def lines(self) -> list[str]:
        """The first lines, as text; none if the first is longer than the head."""
        text = self.content.decode(encoding_of(self.content), errors="replace").removeprefix("\ufeff")
        if len(self.content) == BYTES and not {"\n", "\r"} & {*text}:
            return []
        return [line.rstrip("\r\n").replace("\0", "\ufffd") for line in islice(StringIO(text, newline=""), LINES)]

    def look(self) -> str:
        """Say what the file is, in a clause such as "it is a web page …"; empty if nothing is known."""
        first = self.content
        if not first[:640].strip(b"\0"):
            return "the file is empty, or its first bytes are all zero, as an interrupted copy or recorder leaves them"
        if first.lstrip(b"\xef\xbb\xbf \t\r\n").lower().startswith(_WEB_PAGE):
            return "it is a web page, not a recording: download it again, by the link to the file itself"
        return next((what for mark, what in _KNOWN.items() if first.startswith(mark)), "")


def head_of(path: Path) -> Head:
    """Read the beginning of a file; ReadError where it cannot be opened."""
    try:
        with path.open("rb") as stream:
            return Head(path, stream.read(BYTES))
    except OSError as error:
        raise ReadError(unreachable(path, error)) from error


@dataclass(frozen=True)
class from_head:  # noqa: N801 - a decorator
    """What recognises a file by its head, as what recognises it by its path."""

    looks: Callable[[Head], Recognition]

    def __call__(self, path: Path) -> Recognition:
        """Recognise the file of a path."""
        return self.looks(head_of(path))

    def expected(self, path: Path) -> Head:
        """Give the head of a file that is recognised; ReadError with what it is otherwise."""
        head = head_of(path)
        recognition = self.looks(head)
        if not recognition.yes:
            raise ReadError("; ".join(filter(None, (f"{path.name}: {recognition.reason}", head.look()))) + ".")
        return head


def by_mark(marks: tuple[bytes, ...], expected: str) -> from_head:
    """Give what recognises files by how they start, and what that is called: `TDSm, as LabVIEW writes it`."""
    return _by(lambda head: head.content.startswith(marks), expected)


def by_first_line(written: re.Pattern[str], expected: str) -> from_head:
    """Give what recognises files by what is in their first line, and what that is called."""
    return _by(lambda head: written.search(next(iter(head.lines), "")) is not None, f"a line with {expected}")


def _by(has: Callable[[Head], bool], expected: str) -> from_head:
    def looks(head: Head) -> Recognition:
        if has(head):
            return Recognition(True, f"it starts with {expected}")
        return Recognition(False, f"it does not start with {expected}")

    return from_head(looks)
