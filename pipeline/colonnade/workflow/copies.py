"""Tests of one recording: raw files with the same bytes, as in a folder that was copied, or the same file."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from math import inf
from pathlib import Path

from colonnade.campaign import Campaign
from colonnade.findings import Finding, serious
from colonnade.readers.files import sha256_of

NAMED = 3
"""Number of copies that the warning names."""

Digests = Mapping[str, Mapping[str, str | None]]
"""SHA-256 of each raw file, by test and by path within the campaign's folder; None if it is unknown."""


def with_copies(campaign: Campaign, digests: Digests) -> Campaign:
    """Return the campaign, with a warning if different tests are of one recording or of copies of it."""
    return campaign.but(warnings=(*campaign.warnings, *_copies(digests), *_shared(campaign)))


def _shared(campaign: Campaign) -> Iterator[Finding]:
    """Name the tests of one specimen that are of the same part of one raw file."""
    named: dict[tuple[str, str], list[str]] = {}
    for name, test in campaign.tests.items():
        for path in () if campaign.left_out(name) else test.files.values():
            named.setdefault((_within(campaign, path), test.specimen), []).append(name)
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


def _within(campaign: Campaign, path: Path) -> str:
    return path.relative_to(campaign.folder).as_posix()


def _overlap(campaign: Campaign, test: str, other: str) -> bool:
    """Whether two tests share more than half of the shorter one's window."""
    windows = [campaign.review(each).within(campaign.tests[each].window) for each in (test, other)]
    given = [window or (-inf, inf) for window in windows]
    shared = min(stop for _, stop in given) - max(start for start, _ in given)
    return shared == inf or shared > 0.5 * min(stop - start for start, stop in given)


def _copies(digests: Digests) -> Iterator[Finding]:
    first: dict[str, tuple[str, str]] = {}
    copied: dict[str, str] = {}
    tests: dict[str, None] = {}
    for test, files in digests.items():
        for path, digest in files.items():
            if digest is None:
                continue
            original, other = first.setdefault(digest, (path, test))
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
    return ", ".join(tests[:NAMED]) + (f" and {len(tests) - NAMED} more tests" if len(tests) > NAMED else "")


def digests_of_equal_sizes(campaign: Campaign) -> Digests:
    """Hash the raw files that have the same size as another one; the others cannot be copies."""
    names: dict[Path, int] = {}
    for test in campaign.tests.values():
        for path in test.files.values():
            if path not in names and path.is_file() and path.resolve().is_relative_to(campaign.folder):
                names[path] = path.stat().st_size
    sizes = list(names.values())
    alike = {path for path, size in names.items() if size and sizes.count(size) > 1}
    hashed = {path: sha256_of(path) for path in alike}
    return {
        name: {_within(campaign, path): hashed.get(path) for path in test.files.values()}
        for name, test in campaign.tests.items()
        if not campaign.left_out(name)
    }
