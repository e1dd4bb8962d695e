"""Seismic formats in several files: the names of these files, which must be next to the header."""

from __future__ import annotations

from pathlib import Path, PureWindowsPath

from colonnade.errors import ReadError

PLACES = {"CSS": (slice(148, 212), slice(213, 245)), "NNSA_KB_CORE": (slice(149, 213), slice(214, 246))}
"""Where a line of the header names a folder and a file, by kind."""
HERE = ("", ".", "./", "-")
"""How a header says that the file is in its own folder."""


def companions_of(path: Path, kind: str) -> tuple[str, ...]:
    """
    Find the files with the samples of a header.

    Parameters
    ----------
    path : Path
    kind : str
        As ObsPy calls it.

    Returns
    -------
    names : tuple of str
        Names of the files next to the header; empty if the format is a single file.

    Raises
    ------
    ReadError
        If the header names a file elsewhere: it would be opened anywhere.
    """
    if kind == "Q":
        return (f"{path.stem}.QBN",)
    if kind not in PLACES:
        return ()
    names: dict[str, None] = {}
    with path.open("rb") as lines:
        for number, line in enumerate(lines, 1):
            folder, name = (line[place].strip().decode(errors="replace") for place in PLACES[kind])
            if folder not in HERE or name in ("", ".", "..") or PureWindowsPath(name).name != name:
                raise ReadError(
                    f'{path.name}, line {number}: its samples are in "{folder}/{name}". Only a file in the '
                    "folder of the header is opened: put it there, and write . for its folder in the "
                    "header."
                )
            packed = f"{name}.gz"
            is_packed = not path.with_name(name).exists() and path.with_name(packed).exists()
            names[packed if is_packed and kind == "CSS" else name] = None
    return tuple(names)
