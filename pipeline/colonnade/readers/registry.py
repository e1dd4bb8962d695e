"""The formats by name, and the choice of the one that reads a file."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from functools import cache, partial
from importlib import import_module
from importlib.metadata import entry_points
from pathlib import Path
from typing import Any

import numpy as np
from pydantic import BaseModel, ValidationError

from colonnade.errors import ReadError, nearest
from colonnade.readers.bounded.messages import Arrays, recording_of, told
from colonnade.readers.bounded.process import run_bounded
from colonnade.readers.files import in_one_line, irregular, refusing
from colonnade.readers.format import Format, Recognition
from colonnade.readers.head import Head, from_head, head_of
from colonnade.readers.recording import Recording
from colonnade.readers.refused import retired

OWN = (
    *("binary.c3d", "binary.catman", "text.cosmos", "text.delimited", "binary.diadem", "binary.excel"),
    *("binary.famos", "text.lvm", "binary.matlab", "text.mts", "binary.netcdf", "text.peer"),
    *("binary.tdms", "binary.uff", "binary.waveform"),
)
"""Modules of this folder with a format, as their `FORMAT`."""
GROUP = "colonnade.formats"
"""Group of the entry points by which other packages add formats."""
MOST_GENERAL = "delimited"
"""The format that recognises almost any text: it is tried last."""


@cache
def formats() -> dict[str, Format]:
    """All formats by name, in the order in which they are tried; the most general one last."""
    own: list[Format] = [import_module(f"colonnade.readers.{module}").FORMAT for module in OWN]
    known = {format.name: format for format in own}
    known |= {point.name: point.load() for point in entry_points(group=GROUP) if point.name not in known}
    return {name: known[name] for name in sorted(known, key=lambda name: (name == MOST_GENERAL, name))}


def read(
    path: Path | str,
    format: str | None = None,
    options: Mapping[str, Any] | None = None,
    *,
    within: Path | None = None,
) -> Recording:
    """
    Read a raw file; one that is not plain text in the bounded process.

    Parameters
    ----------
    path : Path or str
        The file.
    format : str, optional
        Name of its format; without it, the first format that recognises the file is used.
    options : mapping, optional
        Options of that format.
    within : Path, optional
        Folder whose files may be read, that of the campaign; the file's own by default.

    Raises
    ------
    ReadError
        If the file is missing, no format recognises it (with each format's reason), the format or an option does not
        exist, or the content cannot be read.
    """
    path = Path(path)
    if kind := irregular(path):
        raise ReadError(f"{path.name}: this is {kind}; a raw file was expected.")
    chosen, evidence = (_named(format), ()) if format is not None else _recognised(path)
    try:
        checked = chosen.options.model_validate(dict(options or {}))
    except ValidationError as error:  # campaign.toml was refused for it before, with its line
        told = "; ".join(f"{'.'.join(map(str, each['loc']))}: {each['msg']}" for each in error.errors())
        raise ReadError(f'{path.name}: format "{chosen.name}" cannot be read with these options: {told}.') from error
    recording = (_read if chosen.in_process else _read_bounded)(chosen, path, checked, within)
    return replace(recording, notes=(*evidence, *recording.notes))


def companions(path: Path, format: str | None = None) -> tuple[Path, ...]:
    """
    Find the other files that a raw file is in, such as the values of a header.

    Parameters
    ----------
    path : Path
    format : str, optional
        Name of its format, if it is known.

    Returns
    -------
    others : tuple of Path
        All in its folder; one that is missing, or a link to elsewhere, too.

    Raises
    ------
    ReadError
        If the file cannot be opened, or its format is not known.
    """
    if irregular(path):
        return ()
    chosen = _recognised(path)[0] if format is None else _named(format)
    return () if chosen.companions is None else chosen.companions(path)


def read_here(path: Path, format: str, options: Mapping[str, Any]) -> tuple[dict[str, Any], Arrays]:
    """Read a raw file in this process for another one, whatever its format; see `read`."""
    chosen = _named(format)
    return told(_read(chosen, path, chosen.options(**options)))


def _read_bounded(format: Format, path: Path, options: BaseModel, within: Path | None) -> Recording:
    """Have the bounded process read a file."""
    folder = path.resolve().parent if within is None else within.resolve()
    others = () if format.companions is None else format.companions(path)
    for other in others:
        if not (to := other.resolve()).is_relative_to(folder):
            raise ReadError(
                f"{path.name}: its values are in {other.name}, which is a link to {to}, outside {folder}. "
                "It is not followed. Copy the file itself there."
            )
    return run_bounded(
        f"{__name__}:read_here",
        path,
        {"format": format.name, "options": options.model_dump(mode="json", exclude_unset=True)},
        partial(recording_of, path),
        kind=format.name,
        within=folder,
        modules=format.modules,
        others=others,
    )


def _read(format: Format, path: Path, options: BaseModel, within: Path | None = None) -> Recording:
    with refusing(path, f'"{format.name}"'):
        recording = format.read(path, options)
    if any(np.isfinite(channel.values).any() for channel in recording.channels):
        return recording
    left_out = (note for note in recording.notes if "left out" in note)
    known = "; ".join([*recording.warnings, *left_out][:5])
    raise ReadError(
        f'{path.name}: read as "{format.name}", no channel holds numbers{f" ({known})" if known else ""}. The file is '
        "damaged, was cut off or is of another format, or nothing was recorded. Copy it from the recorder again."
    )


def _named(name: str) -> Format:
    if name not in formats():
        raise ReadError(f'Unknown format "{name}".{retired(name) or nearest(name, formats())}')
    return formats()[name]


def _recognised(path: Path) -> tuple[Format, tuple[str]]:
    """Find the format of a file, with the reason."""
    refusals = []
    head = head_of(path)
    if not head.content:
        raise ReadError(
            f"{path.name}: the file is empty (0 bytes): nothing was recorded, or a copy was interrupted. Put the "
            "recording in its place."
        )
    for format in formats().values():
        recognition = _recognition(format, head)
        if recognition.yes:
            return format, (f'format "{format.name}" ({recognition.reason})',)
        if recognition.is_known:
            raise ReadError(f"{path.name}: {recognition.reason}")
        refusals.append(f"  {format.name}: {recognition.reason}")
    raise ReadError(
        # What it is not as text comes last among the formats, and says most.
        f"{path.name}: no format recognises this file{f': {what}' if (what := head.look()) else ''}.\n"
        + "\n".join(reversed(refusals))
        + '\n  If you know that it is one of these, name it: file = {format = "…"}.'
    )


def _recognition(format: Format, head: Head) -> Recognition:
    """Ask a format about a file; one that stumbles over it does not take it."""
    try:
        if isinstance(format.recognise, from_head):
            return format.recognise.looks(head)
        return format.recognise(head.path)
    except Exception as error:
        return Recognition(False, f"it could not be examined ({in_one_line(error)})")
