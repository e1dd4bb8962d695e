"""The content of a folder of raw files: columns, what their signals look like, and which files belong to one test."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from datetime import date
from pathlib import Path, PurePosixPath

import numpy as np
import scipy

from colonnade.arrays import Array
from colonnade.campaign.channel import MAIN
from colonnade.campaign.draft.words import as_id, unique
from colonnade.campaign.syntax.document import natural, toml_value
from colonnade.campaign.syntax.names import inside
from colonnade.errors import ColonnadeError
from colonnade.readers.clock import may_be_clock
from colonnade.readers.files import irregular
from colonnade.readers.recording import RecordedChannel, Recording
from colonnade.readers.registry import MOST_GENERAL, read
from colonnade.signals.timing import sampling_interval

OWN_FOLDERS = ("processed", "report")
"""Folders that colonnade itself writes next to a campaign file."""

NO_RECORDINGS = (
    *(".toml", ".md", ".rst", ".json", ".yaml", ".yml", ".html", ".htm", ".pdf", ".doc", ".docx", ".odt", ".ppt"),
    *(".pptx", ".png", ".jpg", ".jpeg", ".gif", ".svg", ".bmp", ".mp4", ".avi", ".mov", ".zip", ".gz", ".7z", ".py"),
    *(".m", ".ipynb", ".tdms_index", ".lnk", ".ini", ".bak", ".tmp"),
)
"""Endings of files that are kept with recordings but are not recordings."""

LOG_HEADS = {"id", "kind", "specimen"}
"""Column heads by which a table is a log of tests."""

LONGEST = 1 << 20
"""Samples of a signal that are examined; enough to see the shape of any test."""

SINE_SHARE = 0.6
"""A signal with this share of its power at one frequency is a steady sine."""

FEWEST_CYCLES = 4
"""Of a sine that is distinguished from a pulse."""

QUIET_END = 0.1
"""A signal whose last sixth varies by less than this fraction of the first half has died away."""


@dataclass(frozen=True)
class Column:
    """
    One column of a raw file, by its number from 1, and what its signal looks like.

    `spread` is its standard deviation in the file's unit, NaN without a number; `counts`: it rises by one from sample
    to sample; `sine`: Hz of a steady one; `hint`: it may be the clock of a file in which none was found.
    """

    number: int
    name: str
    heading: str
    unit: str | None
    is_clock: bool
    has_clock: bool
    spread: float
    counts: bool = False
    sine: float | None = None
    dies_away: bool = False
    hint: str = ""


@dataclass(frozen=True)
class RawFile:
    """A raw file: its path from the folder, with /; Hz and s if it has a clock; the day of its first sample if told."""

    relative: str
    format: str
    columns: tuple[Column, ...]
    rate: float | None
    duration: float | None
    warnings: tuple[str, ...]
    day: date | None = None

    @property
    def layout(self) -> tuple[object, ...]:
        """What files of one recorder have in common: format and headings; without headings their rate and ending."""
        headings = tuple(column.heading for column in self.columns)
        if any(column.heading != f"column {column.number}" for column in self.columns):
            return self.format, *headings
        rate = None if self.rate is None else f"{self.rate:.3g}"
        return self.format, *headings, rate, Path(self.relative).suffix.casefold()

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
            if kind := irregular(path):
                refused.append((relative, f"it is {kind}, not a file"))
            elif _is_log(path):
                key = f"tests = {toml_value(relative)} above [specimens]"
                refused.append((relative, f"it looks like a test log; use it with {key} instead of [[tests]]"))
            else:
                found.append(_seen(relative, read(path, within=folder)))
        except UnicodeEncodeError:
            refused.append((ascii(relative)[1:-1], "its name is not UTF-8; rename it"))
        except (ColonnadeError, ValueError, OSError) as error:
            refused.append((relative, _first_reason(str(error), path.name)))
        if progress is not None:
            progress(number, len(paths))
    return found, refused


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
    clock = next((channel.time for channel in recording.channels if channel.time is not None), np.empty(0))
    interval = sampling_interval(clock)
    rate, duration = (1 / interval, float(np.nanmax(clock) - np.nanmin(clock))) if interval > 0 else (None, None)
    columns = tuple(look_at(number, channel) for number, channel in enumerate(recording.channels, start=1))
    day = recording.start and recording.start.date()
    return RawFile(relative, recording.format, columns, rate, duration, recording.warnings, day)


def look_at(number: int, channel: RecordedChannel) -> Column:
    """Look at a column and its signal; without its times no frequency is found."""
    time = np.zeros(channel.values.size) if channel.time is None else channel.time
    known = np.isfinite(channel.values) & np.isfinite(time)
    signal, time = channel.values[known][:LONGEST], time[known][:LONGEST]
    of_file = (number, channel.name, channel.heading, channel.unit, channel.is_clock, channel.time is not None)
    hint = may_be_clock(channel.heading, channel.values) if channel.time is None else ""
    if signal.size < 2 or not np.ptp(signal) > 0:
        return Column(*of_file, 0.0 if signal.size else np.nan, hint=hint)
    counts = bool(np.all(np.diff(signal) == 1.0))
    interval, half, sixth = float(np.median(np.diff(time))), signal.size // 2, signal.size // 6
    with np.errstate(over="ignore", invalid="ignore"):
        dies_away = sixth > 8 and float(signal[-sixth:].std()) < QUIET_END * float(signal[:half].std())
        sine = steady_sine(signal, interval) if interval > 0 and not counts else None
        return Column(*of_file, float(signal.std()), counts, sine, dies_away, hint)


def steady_sine(signal: Array, interval: float) -> float | None:
    """
    Frequency of a signal that is a steady sine while it moves, Hz; None if it is not.

    Examples
    --------
    >>> round(steady_sine(np.sin(2 * np.pi * 3.0 * np.arange(0, 10, 0.005)), 0.005), 2)
    3.0
    """
    distance = np.abs(signal - np.median(signal))
    moving = np.flatnonzero(distance > 0.3 * distance.max())
    part = signal[moving[0] : moving[-1] + 1]
    if part.size < 32:
        return None
    power = scipy.signal.periodogram(part, window="hann", scaling="spectrum")[1]
    peak = int(power.argmax())
    if not FEWEST_CYCLES <= peak < power.size - 2 or not power[peak - 3 : peak + 4].sum() >= SINE_SHARE * power.sum():
        return None
    left, middle, right = np.log(np.maximum(power[peak - 1 : peak + 2], 1e-300))
    shift = 0.5 * (left - right) / (left - 2 * middle + right)
    return float((peak + shift) / (part.size * interval))


Files = dict[str, RawFile]
"""Files of a test by recorder, the main one first."""

_RECORDER = re.compile(r"(?:daq|das|rec|recorder|logger|box|unit|device|scope|system)[ _-]?[0-9]*", re.IGNORECASE)
_TAGGED = re.compile(r"(.*[^ _.\-/])[ _.\-]+([A-Za-z]+[ _\-]?[0-9]*)", re.DOTALL)


def arrange(files: Sequence[RawFile]) -> tuple[list[list[Files]], list[tuple[str, str]]]:
    """
    Arrange raw files into setups and tests.

    Files of the same format and columns are of one recorder. `span-2.csv` and `span-2-daq2.csv`, `x_box1.csv` and
    `x_box2.csv`, or `daq1/x.csv` and `daq2/x.csv` are of two recorders of one test; so are `x.csv` and `x-top.csv`
    if they have no column in common. Second copies of a recording are left out, with the reason.
    """
    copies: list[tuple[str, str]] = []
    first: dict[tuple[str, frozenset[str]], str] = {}
    tests: list[Files] = []
    named: dict[str, Files] = {}
    for file in files:
        if (used := first.setdefault((file.stem, file.names), file.relative)) != file.relative:
            copies.append((file.relative, f"the same columns as {used}, so it is treated as a copy"))
            continue
        for name, tag in _names(file):
            test = named.get(name)
            if test and tag and (_RECORDER.fullmatch(tag) or not test[MAIN].names & file.names):
                test[unique([*test, as_id(tag, "recorder")], "recorder")[-1]] = file
                break
        else:
            tests.append({MAIN: file})
            named = {name: tests[-1] for name, _ in _names(file, as_main=True)} | named
    setups: dict[tuple[object, ...], list[Files]] = {}
    for test in tests:
        setups.setdefault(tuple((name, file.layout) for name, file in test.items()), []).append(test)
    return list(setups.values()), copies


def _names(file: RawFile, *, as_main: bool = False) -> Iterator[tuple[str, str]]:
    """Give the names of the tests that a file may belong to, each with the recorder that it is then of."""
    path, tagged = PurePosixPath(file.stem), _TAGGED.fullmatch(file.stem)
    if tagged and (not as_main or _RECORDER.fullmatch(tagged[2])):
        yield tagged[1], tagged[2]
    yield file.stem, PurePosixPath(file.relative).suffix.lstrip(".")
    yield str(path.parent.parent / path.name), path.parent.name
