"""The raw files of tests: the hash of each and of its companion files, and which hold the same recording."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from functools import partial
from pathlib import Path

from colonnade.campaign import Campaign, Test
from colonnade.errors import ReadError, StoreError
from colonnade.findings import Finding, serious
from colonnade.readers.files import sha256_of
from colonnade.readers.registry import companions
from colonnade.units.text import listed
from colonnade.workflow.product import Catalogue, Mark, marks_of


@dataclass(frozen=True)
class RawFile:
    """A raw file as it was hashed: its SHA-256, None if it could not be read, and its mark."""

    sha256: str | None
    mark: Mark = (0, 0, 0)


RawFiles = Mapping[str, RawFile]
"""Raw files by path within the campaign's folder."""


def raw_files(campaign: Campaign, test: Test, catalogue: Catalogue) -> RawFiles:
    """Hash the raw files of a test, and their companion files."""
    found: dict[str, RawFile] = {}
    for recorder, path in test.files.items():
        known_as = campaign.setups[test.setup].recorders[recorder].file.format
        own = found[_name(campaign, path)] = _hashed(campaign, path, catalogue)
        is_there = own.sha256 is not None
        named = catalogue.entry("raw", path, partial(_companions, known_as), known_as) if is_there else None
        for other in (path.with_name(name) for name in (named[1] if named else ())):
            found.setdefault(_name(campaign, other), _hashed(campaign, other, catalogue))
    return found


def _hashed(campaign: Campaign, path: Path, catalogue: Catalogue) -> RawFile:
    """Hash a file, unless it is outside the campaign's folder: reading refuses it."""
    is_inside = path.resolve().is_relative_to(campaign.folder)
    entry = catalogue.entry("raw", path, sha256_of) if is_inside else None
    return RawFile(entry[1], tuple(entry[0])) if entry else RawFile(None)


def _companions(known_as: str | None, path: Path) -> list[str]:
    try:
        return [other.name for other in companions(path, known_as) if other.name]
    except ReadError:  # reported when the file is read
        return []


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


def copies(campaign: Campaign, raw: Mapping[str, RawFiles]) -> Iterator[Finding]:
    """Say which tests are of one recording: of a file and its copy, or of one specimen and the same part of a file."""
    found: dict[object, dict[str, str]] = {}
    for test, files in raw.items():
        window = campaign.review(test).within(campaign.tests[test].window)
        for path, file in {} if campaign.left_out(test) else files.items():
            if file.sha256 is not None and file.mark[0]:
                found.setdefault((file.sha256, window), {})[test] = path
    for tests in {tuple(tests): tests for tests in found.values()}.values():
        paths = dict.fromkeys(tests.values())
        if len(paths) > 1 or len({campaign.tests[test].specimen for test in tests}) < len(tests):
            yield serious(
                "copied file",
                f"{listed(list(tests))} are one recording: {listed(list(paths))}. What "
                "it shows, e too, counts several times. Was a folder copied and not yet filled with its own "
                "recordings? Correct `file`, or give each test its `window` of the file; of two bodies on the table, "
                "each is a specimen.",
            )
