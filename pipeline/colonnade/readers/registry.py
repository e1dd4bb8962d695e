"""Which formats there are, and which one reads a file."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from functools import cache
from importlib.metadata import EntryPoint, entry_points
from pathlib import Path
from typing import Any

from pydantic import BaseModel, ValidationError

from colonnade.errors import ReadError, nearest
from colonnade.readers.recording import Recording

GROUP = "colonnade.formats"
"""Entry points of this group are formats; other packages may add theirs."""

# Known without an installed package too. It takes almost any text, so every other format is asked before it.
MOST_GENERAL = EntryPoint(name="delimited", value="colonnade.readers.delimited:FORMAT", group=GROUP)


@dataclass(frozen=True)
class Recognition:
    """Whether a file looks like a format's, with the reason, which is shown where no format takes it."""

    yes: bool
    reason: str


@dataclass(frozen=True)
class Format:
    """
    One raw format.

    Attributes
    ----------
    name : str
        As in `file = {format = "…"}`.
    summary : str
        One line for `show formats`.
    suffixes : tuple of str
        Usual file name endings, such as `.csv`; they are told, never relied on.
    options : type of BaseModel
        What can be said about a file of this format; all of it optional.
    recognise : callable
        Path -> Recognition, from the head of the file.
    read : callable
        (Path, options) -> Recording; raises ReadError.
    """

    name: str
    summary: str
    suffixes: tuple[str, ...]
    options: type[BaseModel]
    recognise: Callable[[Path], Recognition]
    read: Callable[[Path, Any], Recording]


@cache
def formats() -> dict[str, Format]:
    """All formats by name, in the order in which they are asked about a file; the most general one last."""
    special = {point.name: point for point in entry_points(group=GROUP) if point.name != MOST_GENERAL.name}
    points = [special[name] for name in sorted(special)] + [MOST_GENERAL]
    return {point.name: point.load() for point in points}


def read(path: Path | str, format: str | None = None, options: Mapping[str, Any] | None = None) -> Recording:
    """
    Read a raw file.

    Parameters
    ----------
    path : Path or str
        The file.
    format : str, optional
        Name of its format; without it the first format that recognises the file is taken.
    options : mapping, optional
        Options of that format.

    Raises
    ------
    ReadError
        If the file is not there, nobody recognises it (with each format's reason), the format or an option does not
        exist, or the content cannot be read.
    """
    path = Path(path)
    chosen, evidence = _named(format) if format is not None else _recognised(path)
    checked = check_options(chosen, options or {}, where=path.name)
    try:
        recording = chosen.read(path, checked)
    except OSError as error:
        raise ReadError(_unreachable(path, error)) from error
    return recording if evidence is None else _with_note(recording, evidence)


def check_options(format: Format, options: Mapping[str, Any], where: str) -> BaseModel:
    """
    Parse a format's options.

    Raises
    ------
    ReadError
        If one does not exist or has the wrong form; every one is told, starting with `where`.
    """
    try:
        return format.options.model_validate(dict(options))
    except ValidationError as error:
        problems = []
        for problem in error.errors():
            key = ".".join(str(part) for part in problem["loc"])
            if problem["type"] == "extra_forbidden":
                hint = nearest(key, format.options.model_fields)
                problems.append(f'{where}: format "{format.name}" has no option "{key}".{hint}')
            else:
                message = problem["msg"].removeprefix("Value error, ")
                problems.append(
                    f'{where}: option "{key}" of format "{format.name}" is {problem["input"]!r}: {message}.'
                )
        raise ReadError("\n".join(problems)) from error


def _named(name: str) -> tuple[Format, None]:
    if name not in formats():
        raise ReadError(f'There is no format "{name}".{nearest(name, formats())}')
    return formats()[name], None


def _recognised(path: Path) -> tuple[Format, str]:
    refusals = []
    for format in formats().values():
        try:
            recognition = format.recognise(path)
        except OSError as error:
            raise ReadError(_unreachable(path, error)) from error
        if recognition.yes:
            return format, f'format "{format.name}" ({recognition.reason})'
        refusals.append(f"  {format.name}: {recognition.reason}")
    raise ReadError(
        f"{path.name}: no format recognises this file.\n" + "\n".join(refusals) + "\n"
        '  If it is one of these nevertheless, say so: file = {format = "…"}.'
    )


def _with_note(recording: Recording, note: str) -> Recording:
    return replace(recording, notes=(note, *recording.notes))


def _unreachable(path: Path, error: OSError) -> str:
    if isinstance(error, FileNotFoundError):
        there = sorted(entry.name for entry in path.parent.glob(f"*{path.suffix}")) if path.parent.is_dir() else []
        folder = f"in {path.parent}" if path.parent.is_dir() else f", as there is no folder {path.parent}"
        return f"{path.name}: there is no such file {folder}.{nearest(path.name, there)}".replace(" ,", ",")
    if isinstance(error, IsADirectoryError):
        return f"{path.name}: this is a folder; a raw file was expected."
    return (
        f"{path.name}: it cannot be opened ({error.strerror}). Check that you may read it and that its disk is there."
    )
