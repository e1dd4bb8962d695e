"""Files that were recorded in the same way: setups with their recorders, and tests with a file of each recorder."""

from __future__ import annotations

import re
from collections import Counter, defaultdict
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from pathlib import PurePosixPath

from colonnade.campaign.channel import MAIN
from colonnade.campaign.draft.guess import DraftChannels, DraftTest, draft_channels
from colonnade.campaign.draft.survey import Column, RawFile
from colonnade.campaign.draft.words import as_id, unique

_RECORDER = r"(?:daq|das|rec|recorder|logger|box|unit|device|scope|system)[ _-]?[0-9]*"
_TAG = re.compile(r"[ _.\-]+([A-Za-z]+[ _\-]?[0-9]*)")


@dataclass
class DraftSetup:
    """Tests that were recorded in the same way."""

    tests: list[DraftTest] = field(default_factory=list)

    @property
    def recorders(self) -> tuple[str, ...]:
        """Names of the recorders, "main" first."""
        return tuple(self.tests[0].files)

    @cached_property
    def drafted(self) -> DraftChannels:
        """Its channels."""
        return draft_channels({recorder: self.columns(recorder) for recorder in self.recorders})

    def columns(self, recorder: str) -> tuple[Column, ...]:
        """Columns of a recorder, each as it is in the file where it moves most."""
        files = [test.files[recorder] for test in self.tests]
        return tuple(
            max(alike, key=lambda column: column.shape.spread if column.shape.spread > 0 else -1.0)
            for alike in zip(*(file.columns for file in files), strict=True)
        )


def arrange(files: Sequence[RawFile]) -> tuple[list[DraftSetup], list[tuple[str, str]]]:
    """
    Arrange raw files into setups and tests.

    Files of the same format and columns are of one recorder. `span-2.csv` and `span-2-daq2.csv`, `x_box1.csv` and
    `x_box2.csv`, or `daq1/x.csv` and `daq2/x.csv` are of two recorders of one test; so are `x.csv` and `x-top.csv`
    if they have no column in common.

    Parameters
    ----------
    files : sequence of RawFile
        In the order of the tests.

    Returns
    -------
    setups : list of DraftSetup
    copies : list of (str, str)
        Files left out as a second copy of the same recording, with the one that is used.
    """
    copies: list[tuple[str, str]] = []
    tests: dict[str, dict[str, RawFile]] = {}
    known: defaultdict[tuple[str, ...], list[RawFile]] = defaultdict(list)
    for file in files:
        if twin := next((other for other in known["stem", file.stem] if _columns(other) == _columns(file)), None):
            copies.append((file.relative, twin.relative))
            continue
        mains = ((other, tag) for key, tag in _shared(file) if tag for other in known[key] if other.relative in tests)
        for main, tag in mains:
            certain = re.fullmatch(_RECORDER, tag, re.IGNORECASE) is not None
            if certain or not set(_columns(file)) & set(_columns(main)):
                recorders = tests[main.relative]
                recorders[unique([*recorders, as_id(tag, "recorder")], "recorder")[-1]] = file
                break
        else:
            tests[file.relative] = {MAIN: file}
        for key, _ in _own(file):
            known[key].append(file)
    setups: dict[tuple[object, ...], DraftSetup] = {}
    for recorded in tests.values():
        layout = tuple((name, file.layout) for name, file in recorded.items())
        setups.setdefault(layout, DraftSetup()).tests.append(DraftTest(recorded))
    return list(setups.values()), copies


def _own(file: RawFile) -> Iterator[tuple[tuple[str, ...], str]]:
    """Give the parts of a file's name that a file of another recorder has too, each with what is then its recorder."""
    path = PurePosixPath(file.stem)
    base, tag = _base(file.stem)
    yield ("base", base), tag
    yield ("stem", file.stem), PurePosixPath(file.relative).suffix.lstrip(".")
    yield ("name", str(path.parent.parent), path.name), path.parent.name


def _shared(file: RawFile) -> Iterator[tuple[tuple[str, ...], str]]:
    """Give the names of files whose tests this file may belong to: its own without a word at the end come first."""
    for end in range(len(file.stem) - 1, len(file.stem) - len(PurePosixPath(file.stem).name), -1):
        if tag := _TAG.fullmatch(file.stem[end:]):
            yield ("stem", file.stem[:end]), tag[1]
    yield from _own(file)


def _base(stem: str) -> tuple[str, str]:
    """Stem without the name of a recorder at its end, and that name."""
    found = re.fullmatch(rf"(.*[^ _.\-/])[ _.\-]+({_RECORDER})", stem, re.IGNORECASE)
    return (found[1], found[2]) if found else (stem, "")


def _columns(file: RawFile) -> list[str]:
    return sorted(column.name.casefold() for column in file.columns if not column.is_clock)


def names_of(tests: Iterable[DraftTest]) -> list[str]:
    """Names of tests, from their files; with the folder if several files have the same name."""
    stems = [PurePosixPath(test.main.stem) for test in tests]
    names = [_base(stem.name)[0] for stem in stems]
    often = Counter(names)
    return [
        name if often[name] == 1 or not stem.parent.name else f"{stem.parent.name}-{name}"
        for stem, name in zip(stems, names, strict=True)
    ]
