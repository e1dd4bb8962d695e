"""What a file is by its first bytes, to explain why a binary format refuses it."""

from __future__ import annotations

from pathlib import Path

from colonnade.readers.format import Recognition

HEAD = 640
"""As many bytes as say what a file is: HDF5's signature may stand behind 512 bytes of another header."""
HDF5 = b"\x89HDF\r\n\x1a\n"
ZIP = b"PK\x03\x04"
OLE = b"\xd0\xcf\x11\xe0\xa1\xb1\x1a\xe1"
NETCDF = (b"CDF\x01", b"CDF\x02", b"CDF\x05")
"""Marks of NetCDF in its classic forms."""
_KNOWN: dict[bytes | tuple[bytes, ...], str] = {
    b"version https://git-lfs": "it is a pointer of git-lfs, not the file itself: fetch that with `git lfs pull`",
    b"TDSm": "it is LabVIEW TDMS",
    b"TDSh": "it is a .tdms_index, which LabVIEW writes next to the .tdms and which holds no samples: give the .tdms",
    b"MATLAB 5.0": "it is a MATLAB file",
    b"MATLAB 7.3": "it is a MATLAB file of version 7.3",
    NETCDF: "it is NetCDF",
    HDF5: "it is HDF5",
    OLE: "it is a document of an old Office program",
    ZIP: "it is a zip archive or an Office document",
    b"\x1f\x8b": "it is compressed with gzip: unpack it first",
    b"%PDF": "it is a PDF",
    b"\x93NUMPY": "it is a NumPy file, which is not read because it may contain a program: save the numbers as text",
    (b"\x80\x02", b"\x80\x03", b"\x80\x04", b"\x80\x05"): (
        "it is a Python pickle, a program that runs when it is opened: never read"
    ),
}
_WEB_PAGE = (b"<!doctype html", b"<html", b"<head")


def head(path: Path) -> bytes:
    """Read the first bytes of a file; OSError where it cannot be opened."""
    with path.open("rb") as stream:
        return stream.read(HEAD)


def look(first: bytes) -> str:
    """
    Say what a file is instead of what was expected.

    Parameters
    ----------
    first : bytes
        As given by `head`.

    Returns
    -------
    what : str
        A clause such as "it is a web page …"; empty if nothing is known.

    Examples
    --------
    >>> look(b"%PDF-1.4 ...")
    'it is a PDF'
    """
    if not first:
        return "the file is empty"
    if not first.strip(b"\0"):
        return "its first bytes are all zero, as an interrupted copy or recorder leaves them"
    if first.lstrip(b"\xef\xbb\xbf \t\r\n").lower().startswith(_WEB_PAGE):
        return "it is a web page, not a recording: download it again, by the link to the file itself"
    return next((what for mark, what in _KNOWN.items() if first.startswith(mark)), "")


def by_mark(path: Path, marks: tuple[bytes, ...], expected: str) -> Recognition:
    """
    Recognise a file by how it starts.

    Parameters
    ----------
    path : Path
        The file; OSError where it cannot be opened.
    marks : tuple of bytes
        Marks of the format; a file starts with one of them.
    expected : str
        What that is called: `TDSm, as LabVIEW writes it`.
    """
    first = head(path)
    if first.startswith(marks):
        return Recognition(True, f"starts with {expected}")
    what = look(first)
    return Recognition(False, f"it does not start with {expected}" + (f"; {what}" if what else ""))
