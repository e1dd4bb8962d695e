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
    known = _Known()
    tests: dict[str, dict[str, RawFile]] = {}
    for file in files:
        twin = next((other for other in known.of_stem[file.stem] if _columns(other) == _columns(file)), None)
        if twin is not None:
            copies.append((file.relative, twin.relative))
        else:
            known.add(file)
            tests[file.relative] = {MAIN: file}
    for file in [recorded[MAIN] for recorded in tests.values()]:
        for other, tag in known.mains_of(file):
            certain = re.fullmatch(_RECORDER, tag, re.IGNORECASE) is not None
            if other.relative in tests and (certain or not set(_columns(file)) & set(_columns(other))):
                recorders = tests[other.relative]
                recorders[unique([*recorders, as_id(tag, "recorder")], "recorder")[-1]] = file
                del tests[file.relative]
                break
    setups: dict[tuple[object, ...], DraftSetup] = {}
    for recorded in tests.values():
        layout = tuple((name, file.layout) for name, file in recorded.items())
        setups.setdefault(layout, DraftSetup()).tests.append(DraftTest(recorded))
    return list(setups.values()), copies


class _Known:
    """Files by the common part of their names, for speed; earlier files are preferred as main recorders."""

    def __init__(self) -> None:
        self._order: dict[str, int] = {}
        self.of_stem: defaultdict[str, list[RawFile]] = defaultdict(list)
        self._of_base: defaultdict[str, list[RawFile]] = defaultdict(list)
        self._of_name: defaultdict[tuple[str, str], list[RawFile]] = defaultdict(list)

    def add(self, file: RawFile) -> None:
        path = PurePosixPath(file.stem)
        self._order[file.relative] = len(self._order)
        self.of_stem[file.stem].append(file)
        self._of_base[_base(file.stem)[0]].append(file)
        self._of_name[str(path.parent.parent), path.name].append(file)

    def mains_of(self, file: RawFile) -> Iterator[tuple[RawFile, str]]:
        """Give files whose tests this file may belong to, each with the name of this file's recorder."""
        path = PurePosixPath(file.stem)
        for end in range(len(file.stem) - 1, len(file.stem) - len(path.name), -1):
            if tag := _TAG.fullmatch(file.stem[end:]):
                yield from ((other, tag[1]) for other in self.of_stem.get(file.stem[:end], []))
        base, tag_of_base = _base(file.stem)
        alike = [(other, tag_of_base) for other in self._of_base[base]]
        alike += [(other, PurePosixPath(file.relative).suffix.lstrip(".")) for other in self.of_stem[file.stem]]
        alike += [(other, path.parent.name) for other in self._of_name[str(path.parent.parent), path.name]]
        place = self._order[file.relative]
        yield from ((other, name) for other, name in alike if name and self._order[other.relative] < place)


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
