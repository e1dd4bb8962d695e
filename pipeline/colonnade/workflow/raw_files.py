"""The raw files of tests: the hash of each and of its companion files, and which hold the same recording."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from math import inf
from pathlib import Path

from colonnade.campaign import Campaign, Test
from colonnade.campaign.setup import FileOptions
from colonnade.errors import ReadError, StoreError
from colonnade.findings import Finding, serious
from colonnade.readers.files import sha256_of
from colonnade.readers.registry import companions
from colonnade.units import text
from colonnade.workflow.product import Catalogue, Mark, marks_of


@dataclass(frozen=True)
class RawFile:
    """A raw file as it was hashed: its SHA-256, None if it could not be read, and its mark."""

    sha256: str | None
    mark: Mark = (0, 0, 0)


RawFiles = Mapping[str, RawFile]
"""Raw files by path within the campaign's folder."""

NAMED = 3
"""Number of copies that the warning names."""


def raw_files(campaign: Campaign, test: Test, catalogue: Catalogue) -> RawFiles:
    """Hash the raw files of a test, and their companion files."""
    found: dict[str, RawFile] = {}
    for recorder, path in test.files.items():
        how = campaign.setups[test.setup].recorders[recorder].file
        found[_name(campaign, path)], further = _looked_at(campaign.folder, path, how, catalogue)
        for other in (path.with_name(name or path.name) for name in further):
            found.setdefault(_name(campaign, other), _looked_at(campaign.folder, other, None, catalogue)[0])
    return found


def expect_unchanged(folder: Path, raw: RawFiles) -> None:
    """
    Check that raw files are still as they were hashed; a recorder may still be writing.

    Raises
    ------
    StoreError
        If one has changed.
    """
    there = marks_of(folder / name for name in raw)
    for name, file in raw.items():
        if file.sha256 is not None and there.get(folder / name) != file.mark:
            raise StoreError(
                f"{name}: this file changed while it was being read. Is the recorder still writing? Run again later."
            )


def _name(campaign: Campaign, path: Path) -> str:
    return path.relative_to(campaign.folder).as_posix()


def _looked_at(folder: Path, path: Path, how: FileOptions | None, catalogue: Catalogue) -> tuple[RawFile, list[str]]:
    """Return a raw file and, read by the options `how`, the names of its companion files."""

    def ask(path: Path) -> tuple[str | None, list[str]]:
        digest = sha256_of(path)
        if digest is None or how is None:
            return digest, []
        try:
            return digest, [other.name for other in companions(path, how.format)]
        except ReadError:  # reported when the file is read
            return digest, []

    if not path.resolve().is_relative_to(folder):  # reading refuses it
        return RawFile(None), []
    entry = catalogue.entry("raw", path, ask, *([] if how is None else [how.model_dump()]))
    if entry is None or entry[1][0] is None:
        return RawFile(None), []
    mark, (digest, companion_names) = entry
    return RawFile(digest, tuple(mark)), companion_names


def copies(campaign: Campaign, raw: Mapping[str, RawFiles]) -> list[Finding]:
    """Say which tests, that are not left out, are of one recording or of copies of it."""
    run = {name: files for name, files in raw.items() if not campaign.left_out(name)}
    return [*_copies(run), *_shared(campaign)]


def _shared(campaign: Campaign) -> Iterator[Finding]:
    """Name the tests of one specimen that are of the same part of one raw file."""
    named: dict[tuple[str, str], list[str]] = {}
    for name, test in campaign.tests.items():
        for path in () if campaign.left_out(name) else test.files.values():
            named.setdefault((_name(campaign, path), test.specimen), []).append(name)
    again: dict[str, list[str]] = {}
    for (shared, _), tests in named.items():
        same = [each for each in tests if any(_overlap(campaign, each, other) for other in tests if other != each)]
        if same:
            again.setdefault(listed(same), []).append(shared)
    for tests_of, paths in again.items():
        yield serious(
            "copied file",
            f"{tests_of} are one recording: all name {', '.join(paths)}, and no `window` keeps them apart. What it "
            "shows, e too, counts several times. Correct `file`, or give each its `window`; of two bodies on the "
            "table, each is a specimen.",
        )


def _overlap(campaign: Campaign, test: str, other: str) -> bool:
    """Whether two tests share more than half of the shorter one's window."""
    windows = [campaign.review(each).within(campaign.tests[each].window) for each in (test, other)]
    given = [window or (-inf, inf) for window in windows]
    shared = min(stop for _, stop in given) - max(start for start, _ in given)
    return shared == inf or shared > 0.5 * min(stop - start for start, stop in given)


def _copies(raw: Mapping[str, RawFiles]) -> Iterator[Finding]:
    first: dict[str, tuple[str, str]] = {}
    copied: dict[str, str] = {}
    tests: dict[str, None] = {}
    every = ((test, path, file) for test, files in raw.items() for path, file in files.items())
    for test, path, file in every:
        size, *_ = file.mark
        if file.sha256 is None or not size:
            continue
        original, other = first.setdefault(file.sha256, (path, test))
        if other != test and original != path and path not in copied:
            copied[path] = f"{path} is a copy of {original} of {other}"
            tests |= {test: None}
    if copied:
        named = "; ".join(list(copied.values())[:NAMED])
        more = f"; and {len(copied) - NAMED} more" if len(copied) > NAMED else ""
        are = f"{len(copied)} raw files hold" if len(copied) > 1 else "A raw file holds"
        yield serious(
            "copied file",
            f"{are} the same bytes as that of another test: {named}{more}. Was a folder copied and not yet filled with "
            f"its own recordings? Put them in their place, or delete the entries of {listed(list(tests))}.",
        )


def listed(tests: list[str]) -> str:
    """Name the first of some tests, and count the others."""
    return text.listed(tests, NAMED, "tests")
