"""The content of a folder of raw files: each readable file, its columns and what their signals look like."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from datetime import date
from pathlib import Path

import numpy as np

from colonnade.campaign.draft.lines import value
from colonnade.campaign.draft.signal import Shape, shape_of
from colonnade.campaign.syntax.rawpath import inside
from colonnade.errors import ColonnadeError
from colonnade.readers.irregular import irregular
from colonnade.readers.recording import RecordedChannel, Recording
from colonnade.readers.registry import MOST_GENERAL, read

OWN_FOLDERS = ("processed", "report")
"""Folders that colonnade itself writes next to a campaign file."""

NO_RECORDINGS = (
    *(".toml", ".md", ".rst", ".json", ".yaml", ".yml", ".html", ".htm", ".pdf", ".doc", ".docx", ".odt", ".ppt"),
    *(".pptx", ".png", ".jpg", ".jpeg", ".gif", ".svg", ".bmp", ".mp4", ".avi", ".mov", ".zip", ".gz", ".7z", ".py"),
    *(".m", ".ipynb", ".tdms_index", ".lnk", ".ini", ".bak", ".tmp"),
)
"""Endings of files that are kept with recordings but are not recordings."""

WRITING = ("delimiter ", "decimal sign ", "one column", "numbers run on")
"""Notes of readers about how numbers are written."""

LOG_HEADS = {"id", "kind", "specimen"}
"""Column heads by which a table is a log of tests."""


@dataclass(frozen=True)
class Column:
    """
    One column of a raw file.

    Attributes
    ----------
    number : int
        From 1.
    name, heading : str
    unit : str or None
        As written in the file.
    is_clock, has_clock : bool
    shape : Shape
        What its signal looks like.
    """

    number: int
    name: str
    heading: str
    unit: str | None
    is_clock: bool
    has_clock: bool
    shape: Shape


@dataclass(frozen=True)
class RawFile:
    """
    One raw file that could be read.

    Attributes
    ----------
    relative : str
        Its path from the folder, with / between folders.
    format : str
    columns : tuple of Column
    rate, duration : float or None
        Hz and s, if it has a clock.
    warnings : tuple of str
        Of the reader.
    writing : str
        How its numbers are written, as far as the reader says so.
    day : date or None
        Of its first sample, if the file gives it.
    """

    relative: str
    format: str
    columns: tuple[Column, ...]
    rate: float | None
    duration: float | None
    warnings: tuple[str, ...]
    writing: str = ""
    day: date | None = None

    @property
    def layout(self) -> tuple[object, ...]:
        """
        What files of one recorder have in common: format and headings.

        Without headings it is how they are written, their rate and their ending; the number of columns says nothing.
        """
        headings = tuple(column.heading for column in self.columns)
        if any(column.heading != f"column {column.number}" for column in self.columns):
            return self.format, *headings
        rate = None if self.rate is None else f"{self.rate:.3g}"
        return self.format, *headings, self.writing, rate, Path(self.relative).suffix.casefold()

    @property
    def stem(self) -> str:
        """Its path without the ending."""
        return self.relative.removesuffix(Path(self.relative).suffix)


@dataclass(frozen=True)
class Survey:
    """
    All that was found in a folder.

    Attributes
    ----------
    files : tuple of RawFile
        In the order of their names, numbers as numbers.
    refused : tuple of (str, str)
        Files that are not recordings, with the reason.
    """

    files: tuple[RawFile, ...]
    refused: tuple[tuple[str, str], ...]


def survey(folder: Path, progress: Callable[[int, int], None] | None = None) -> Survey:
    """
    Read every file of a folder, and of the folders in it.

    Parameters
    ----------
    folder : Path
    progress : callable, optional
        Called with the number of files examined, and their total.
    """
    folder = folder.resolve()
    found, refused = [], []
    paths = sorted(_candidates(folder), key=lambda path: _order(path.relative_to(folder)))
    for number, path in enumerate(paths, start=1):
        relative = path.relative_to(folder).as_posix()
        try:
            relative.encode()
            path = inside(folder, relative)
            if kind := irregular(path):
                refused.append((relative, f"it is {kind}, not a file"))
            elif _is_log(path):
                key = f"tests = {value(relative)} above [specimens]"
                refused.append((relative, f"it looks like a test log; use it with {key} instead of [[tests]]"))
            else:
                found.append(_seen(relative, read(path, within=folder)))
        except UnicodeEncodeError:
            refused.append((ascii(relative)[1:-1], "its name is not UTF-8; rename it"))
        except (ColonnadeError, ValueError, OSError) as error:
            refused.append((relative, _first_reason(str(error), path.name)))
        if progress is not None:
            progress(number, len(paths))
    return Survey(tuple(found), tuple(refused))


def natural(name: str) -> tuple[tuple[int, str], ...]:
    """
    Sort names as people do, `free-2` before `free-10`.

    Examples
    --------
    >>> sorted(["free-10", "free-2"], key=natural)
    ['free-2', 'free-10']
    """
    parts = re.split(r"([0-9]+)", name.casefold())
    return tuple((int(part), "") if part.isdecimal() else (-1, part) for part in parts)


def _order(relative: Path) -> tuple[object, ...]:
    return natural(relative.with_suffix("").as_posix()), relative.suffix


def _candidates(folder: Path) -> Iterator[Path]:
    for path in folder.rglob("*"):
        parts = path.relative_to(folder).parts
        hidden = any(part.startswith((".", "~")) for part in parts)
        is_one = path.is_file() or (bool(irregular(path)) and not path.is_dir())
        if is_one and not hidden and parts[0] not in OWN_FOLDERS and path.suffix.lower() not in NO_RECORDINGS:
            yield path


def _is_log(path: Path) -> bool:
    """Whether the first row of a text table has the heads of a test log."""
    if path.suffix.lower() not in (".csv", ".txt"):
        return False
    with path.open("rb") as stream:
        head = stream.readline(4096).decode("utf-8-sig", errors="replace")
    return {cell.strip(' "\r\n').casefold() for cell in re.split(r"[;,\t]", head)} >= LOG_HEADS


def _first_reason(refusal: str, name: str) -> str:
    """Keep the part of a refusal that shows that a file is not a recording, or names the extra that reads it."""
    lines = [line.strip() for line in refusal.removeprefix(f"{name}: ").splitlines() if line.strip()]
    extra = next((line for line in lines if "pip install" in line), None)
    general = next((line for line in lines[1:] if line.startswith(f"{MOST_GENERAL}: ")), None)
    return extra or (f"{lines[0].rstrip('.')} ({general})" if general else lines[0])


def _seen(relative: str, recording: Recording) -> RawFile:
    clocked = next((channel for channel in recording.channels if channel.time is not None), None)
    rate = duration = None
    if clocked is not None and clocked.time is not None:
        steps = np.diff(clocked.time[np.isfinite(clocked.time)])
        if steps.size and (step := float(np.median(steps))) > 0:
            rate, duration = 1 / step, float(np.nansum(steps))
    columns = tuple(_column(number, channel) for number, channel in enumerate(recording.channels, start=1))
    # Of `delimiter ";" (3 cells on …)` what files have in common.
    writing = "; ".join(note.partition(" (")[0] for note in recording.notes if note.startswith(WRITING))
    day = recording.start and recording.start.date()
    return RawFile(relative, recording.format, columns, rate, duration, recording.warnings, writing, day)


def _column(number: int, channel: RecordedChannel) -> Column:
    return Column(
        number,
        channel.name,
        channel.heading,
        channel.unit,
        channel.is_clock,
        channel.time is not None,
        shape_of(channel.values, channel.time),
    )
