"""Files before they are read: what a path leads to, what it hashes to, and why one cannot be opened."""

from __future__ import annotations

import errno
import hashlib
import stat
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path, PureWindowsPath

from colonnade.errors import ReadError, nearest, quoted

_KINDS = {
    stat.S_IFDIR: "a folder",
    stat.S_IFIFO: "a named pipe",
    stat.S_IFSOCK: "a socket",
    stat.S_IFCHR: "a device",
    stat.S_IFBLK: "a device",
}


def irregular(path: Path) -> str:
    """
    Say what a path leads to.

    Returns
    -------
    kind : str
        Such as "a named pipe"; empty for a file, and if nothing is found: opening that says why.
    """
    try:
        mode = path.stat().st_mode
    except (OSError, ValueError):
        return ""
    return "" if stat.S_ISREG(mode) else _KINDS.get(stat.S_IFMT(mode), "not a file")


def inside(folder: Path, text: str, place: str) -> Path:
    """
    Resolve a path that is written in a file.

    Parameters
    ----------
    folder : Path
        From which it is written, absolute and resolved.
    text : str
    place : str
        That folder for messages: "the campaign's folder".

    Returns
    -------
    path : Path
        Absolute; the file itself need not exist.

    Raises
    ------
    ValueError
        If it is not a relative path, or leaves the folder, be it through a link; the message is a sentence.
    """
    if text.startswith("/") or PureWindowsPath(text).drive:
        raise ValueError(f"{quoted(text)} is an absolute path.")
    try:
        path = (folder / text).resolve()
    except (OSError, RuntimeError, ValueError) as error:
        raise ValueError(f"{quoted(text)} is an invalid path ({error}).") from None
    if not path.is_relative_to(folder) or path == folder:
        raise ValueError(f"{quoted(text)} is outside {place}: {path}.")
    return path


def sha256_of(path: Path) -> str | None:
    """
    Hash the content of a file.

    Parameters
    ----------
    path : Path

    Returns
    -------
    digest : str or None
        SHA-256 in hexadecimal digits. None if there is no such file, it cannot be read, or it is a pipe, a device or a
        folder, which is never opened: reading it says why.
    """
    try:
        if irregular(path):
            return None
        with path.open("rb") as stream:
            return hashlib.file_digest(stream, "sha256").hexdigest()
    except OSError:
        return None


@contextmanager
def refusing(path: Path, kind: str) -> Iterator[None]:
    """Turn any exception of a parser into a message that says what to do."""
    try:
        yield
    except (ReadError, MemoryError):
        raise
    except Exception as error:
        # A damaged file may send its parser to a place before its start.
        if isinstance(error, OSError) and error.errno not in (None, errno.EINVAL):
            raise ReadError(unreachable(path, error)) from error
        raise ReadError(
            f"{path.name}: it cannot be read as {kind} ({in_one_line(error)}). The file is damaged, was cut off, or is "
            "of an unknown version. Copy it from the recorder again, or export it as text."
        ) from (None if isinstance(error, OSError) else error)


def in_one_line(error: BaseException) -> str:
    """What a parser says of itself, in one line."""
    said = " ".join(str(error).split())[:200]
    return f"{type(error).__name__}: {said}" if said else type(error).__name__


def unreachable(path: Path, error: OSError) -> str:
    """Say why a file cannot be opened, with the nearest name if it is missing."""
    if isinstance(error, FileNotFoundError):
        there = sorted(entry.name for entry in path.parent.glob(f"*{path.suffix}")) if path.parent.is_dir() else []
        folder = f"in {path.parent}" if path.parent.is_dir() else f", as there is no folder {path.parent}"
        return f"{path.name}: there is no such file {folder}.{nearest(path.name, there)}".replace(" ,", ",")
    if isinstance(error, IsADirectoryError):
        return f"{path.name}: this is a folder; a raw file was expected."
    return f"{path.name}: it cannot be opened ({error.strerror}). Check its permissions and that its disk is connected."
