"""Paths of a campaign file: relative to its folder, and never out of it."""

from __future__ import annotations

from pathlib import Path, PureWindowsPath

from colonnade.campaign.syntax.fields import shown

_EXAMPLE = 'A path from the folder of the campaign file was expected, such as "raw/free-01.csv"'


def inside(folder: Path, value: object) -> Path:
    """
    Resolve a path of the campaign file.

    Parameters
    ----------
    folder : Path
        Folder of the campaign file, absolute and resolved.
    value : object
        As written.

    Returns
    -------
    path : Path
        Absolute; the file itself need not exist.

    Raises
    ------
    ValueError
        If it is not a relative path, or leaves the folder, be it through a link.
    """
    if not isinstance(value, str) or not value.strip():
        raise ValueError(f"{shown(value)} was found. {_EXAMPLE}.")
    if "\\" in value:
        raise ValueError(f"{shown(value)} has a backslash. {_EXAMPLE}, with / between folders on every system.")
    if value.startswith("/") or PureWindowsPath(value).drive:
        raise ValueError(f"{shown(value)} is an absolute path. {_EXAMPLE}, so that the campaign can be moved.")
    try:
        path = (folder / value).resolve()
    except (OSError, RuntimeError, ValueError) as error:
        raise ValueError(f"{shown(value)} is an invalid path ({error}). {_EXAMPLE}.") from None
    if not path.is_relative_to(folder) or path == folder:
        raise ValueError(f"{shown(value)} is outside the campaign's folder: {path}. {_EXAMPLE}.")
    return path
