"""The content of a folder of raw files: columns, and which files belong to one test."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from colonnade.campaign.channel import MAIN
from colonnade.campaign.draft.words import unique
from colonnade.campaign.syntax.document import natural
from colonnade.campaign.syntax.names import inside
from colonnade.errors import ColonnadeError
from colonnade.readers.recording import RecordedChannel
from colonnade.readers.registry import read

OWN_FOLDERS = ("processed", "report")
"""Folders that colonnade itself writes next to a campaign file."""

NO_RECORDINGS = (
    *(".toml", ".md", ".rst", ".json", ".yaml", ".yml", ".html", ".htm", ".pdf", ".doc", ".docx", ".odt", ".ppt"),
    *(".pptx", ".png", ".jpg", ".jpeg", ".gif", ".svg", ".bmp", ".mp4", ".avi", ".mov", ".zip", ".gz", ".7z", ".py"),
    *(".m", ".ipynb", ".tdms_index", ".lnk", ".ini", ".bak", ".tmp"),
)
"""Endings of files that are kept with recordings but are not recordings."""


@dataclass(frozen=True)
class Column:
    """One column of a raw file, by its number from 1; `spread`: largest less smallest value, −1 without a number."""

    number: int
    name: str
    heading: str
    unit: str | None
    is_clock: bool
    has_clock: bool
    spread: float


@dataclass(frozen=True)
class RawFile:
    """A raw file: its path from the folder, with /, and its columns."""

    relative: str
    format: str
    columns: tuple[Column, ...]

    @property
    def layout(self) -> tuple[str, ...]:
        """What files of one recorder have in common: format and headings."""
        return self.format, *(column.heading for column in self.columns)

    @property
    def names(self) -> frozenset[str]:
        """Names of its columns but the clock, in small letters."""
        return frozenset(column.name.casefold() for column in self.columns if not column.is_clock)

    @property
    def stem(self) -> str:
        """Its path without the ending."""
        return self.relative.removesuffix(Path(self.relative).suffix)


def survey(
    folder: Path, progress: Callable[[int, int], None] | None = None
) -> tuple[list[RawFile], list[tuple[str, str]]]:
    """Read every file of a folder, and of those in it, in the order of their names; and say why others are not used."""
    folder = folder.resolve()
    found, refused = [], []
    paths = sorted(_candidates(folder), key=lambda path: (natural(path.with_suffix("").as_posix()), path.suffix))
    for number, path in enumerate(paths, start=1):
        relative = path.relative_to(folder).as_posix()
        try:
            relative.encode()
            path = inside(folder, relative)
            recording = read(path, within=folder)
            columns = tuple(look_at(number, channel) for number, channel in enumerate(recording.channels, start=1))
            found.append(RawFile(relative, recording.format, columns))
        except UnicodeEncodeError:
            refused.append((ascii(relative)[1:-1], "its name is not UTF-8; rename it"))
        except (ColonnadeError, ValueError, OSError) as error:
            # The second line of a refusal by all formats is that of the most general one.
            lines = str(error).removeprefix(f"{path.name}: ").splitlines()
            refused.append((relative, " ".join(line.strip() for line in lines[:2])))
        if progress is not None:
            progress(number, len(paths))
    return found, refused


def _candidates(folder: Path) -> Iterator[Path]:
    for path in folder.rglob("*"):
        parts = path.relative_to(folder).parts
        is_own = parts[0] in OWN_FOLDERS or any(part.startswith((".", "~")) for part in parts)
        if not (is_own or path.is_dir() or path.suffix.lower() in NO_RECORDINGS):
            yield path


def look_at(number: int, channel: RecordedChannel) -> Column:
    """Look at a column: what it is called, and whether it moves."""
    known = channel.values[np.isfinite(channel.values)]
    with np.errstate(over="ignore"):
        spread = float(np.ptp(known)) if known.size else -1.0
    has_clock = channel.time is not None
    return Column(number, channel.name, channel.heading, channel.unit, channel.is_clock, has_clock, spread)


Files = dict[str, RawFile]
"""Files of a test by recorder, the main one first."""

_RECORDER = re.compile(
    r"(.+?)[ _.\-/]+((?:daq|das|rec|recorder|logger|box|unit|device|scope|system)[ _-]?[0-9]*)",
    re.IGNORECASE | re.DOTALL,
)


def arrange(files: Sequence[RawFile]) -> tuple[list[list[Files]], list[tuple[str, str]]]:
    """
    Arrange raw files into setups and tests.

    Files of the same format and columns are of one recorder. `span-2.csv` and `span-2-daq2.csv`, or `x_box1.csv` and
    `x_box2.csv`, are of two recorders of one test. Second copies of a recording are left out, with the reason.
    """
    copies: list[tuple[str, str]] = []
    tests: dict[str, Files] = {}
    for file in files:
        tagged = _RECORDER.fullmatch(file.stem)
        name, tag = tagged.groups() if tagged else (file.stem, Path(file.relative).suffix.lstrip("."))
        test = tests.setdefault(name, {})
        alike = [each.relative for each in test.values() if (each.stem, each.names) == (file.stem, file.names)]
        if alike:
            copies.append((file.relative, f"the same columns as {alike[0]}, so it is treated as a copy"))
        else:
            test[unique([*test, tag], "recorder")[-1] if test else MAIN] = file
    setups: dict[tuple[object, ...], list[Files]] = {}
    for test in tests.values():
        setups.setdefault(tuple((name, file.layout) for name, file in test.items()), []).append(test)
    return list(setups.values()), copies
