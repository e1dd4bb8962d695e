"""The tests whose raw files are in the watched folder, by the names of these files; nothing is written."""

from __future__ import annotations

import os
import re
from collections import defaultdict
from collections.abc import Collection, Iterable, Iterator, Mapping
from pathlib import Path
from typing import Any

from colonnade.campaign.campaign import CampaignFile
from colonnade.campaign.channel import MAIN
from colonnade.campaign.syntax.document import natural, unknown, validated
from colonnade.campaign.syntax.names import folded
from colonnade.campaign.test import KINDS, Test
from colonnade.campaign.watched import COUNTER
from colonnade.errors import quoted
from colonnade.findings import Finding, note, serious
from colonnade.units.text import listed

WITHOUT_TEST = "raw file without a test"
"""Kind of the findings about files of which no test was made."""

UNFINISHED = (".partial", ".part", ".tmp", ".crdownload")
"""Endings of files that a program has not finished."""


def find_tests(campaign: CampaignFile, folder: Path) -> tuple[tuple[Test, ...], tuple[Finding, ...]]:
    """
    Find the tests that [watch] describes, in the order of the names of their files; and tell of files that make none.

    An entry of the campaign file or its test log that names a raw file counts alone.
    """
    watched, names = campaign.watch, names_in(campaign)
    if not watched.pattern:
        return (), ()
    listed_files = {path for test in campaign.tests for path in test.files.values()}
    together: dict[str, tuple[dict[str, Any], dict[str, list[str]]]] = {}
    refused: defaultdict[str, list[str]] = defaultdict(list)
    strange = []
    for path in sorted(files_in(folder / watched.folder), key=natural):
        whole = f"{watched.folder}/{path}"
        matches = [(each, parts) for each in watched.pattern if (parts := each.match(path, names)) is not None]
        if folder / whole in listed_files:
            continue
        if len(matches) > 1:
            patterns = " and ".join(quoted(each.text) for each, _ in matches[:2])
            refused[f"The name fits two patterns of [watch]: {patterns}."].append(whole)
        elif not matches:
            strange.append(whole)
        else:  # files of the same parts are of one test, each of another recorder
            ((pattern, parts),) = matches
            recorder = str(parts.pop("recorder", MAIN))
            entry, files = together.setdefault(repr(sorted(parts.items())), ({}, {}))
            if recorder == MAIN or not entry:
                entry.update(pattern.entry(parts))
            files.setdefault(recorder, []).append(whole)
    taken = {folded(test.id) for test in campaign.tests}
    tests: list[Test] = []
    for entry, files in together.values():
        try:
            tests.append(_test(campaign, entry, files, folder, taken))
            taken.add(folded(tests[-1].id))
        except ValueError as reason:
            refused[str(reason)].append(next(iter(files.values()))[0])
    what = "Rename it, give it an entry in [[tests]], or change `pattern` in [watch]."
    findings = [
        serious(WITHOUT_TEST, f"{listed(paths, 1)}: no test was made of it. {reason} {what}")
        for reason, paths in refused.items()
    ]
    if strange:
        said = f"{listed(strange, 1)}: no test names it, and its name fits no pattern of [watch]. It is not read."
        findings.append(note(WITHOUT_TEST, said))
    return tuple(tests), tuple(findings)


def files_in(folder: Path) -> Iterator[str]:
    """Give the paths of the regular files in a folder and below it; links, hidden and unfinished files are left out."""
    for root, folders, names in os.walk(folder):
        folders[:] = sorted(name for name in folders if not name.startswith((".", "~")))
        for name in sorted(names):
            path = Path(root, name)
            left_out = name.startswith((".", "~")) or name.casefold().endswith(UNFINISHED) or path.is_symlink()
            if not left_out and path.is_file():
                yield path.relative_to(folder).as_posix()


def _test(
    campaign: CampaignFile,
    named: Mapping[str, Any],
    files: Mapping[str, list[str]],
    folder: Path,
    taken: Collection[str],
) -> Test:
    """Make a test; a ValueError says in a sentence why the files make none."""
    several = next((paths for paths in files.values() if len(paths) > 1), [])
    if several:
        raise ValueError(f"By their names, {' and '.join(several[:3])} are the same test.")
    if MAIN not in files:
        raise ValueError("The file of the main recorder is missing.")
    stem = str(Path(files[MAIN][0].removeprefix(f"{campaign.watch.folder}/")).with_suffix(""))
    name = re.sub(r"[^A-Za-z0-9._-]+", "-", stem).strip("-._")
    if folded(name) in taken:
        raise ValueError(f'The name gives the id "{name}", which another test has.')
    known: dict[str, Collection[str]] = {"specimen": campaign.specimens, "setup": campaign.setups}
    # The specimen and the set-up of a campaign that has only one need not be named.
    only = {key: next(iter(names)) for key, names in known.items() if len(names) == 1}
    entry = only | dict(named) | {"id": name, "file": {each: paths[0] for each, paths in files.items()}}
    entry.pop(COUNTER, None)
    test, wrong = validated(Test, entry, folder)
    if test is None:
        place, message = wrong[0]
        raise ValueError(f"{'.'.join(map(str, place))}: {message}")
    for key, names in known.items():
        for _, message in unknown((key,), key, getattr(test, key), names):
            raise ValueError(message)
    return test


def names_in(campaign: CampaignFile) -> dict[str, dict[str, str]]:
    """Give what each part may be in a file name, in lower case, and what it stands for."""
    own: dict[str, Iterable[str]] = {
        "kind": KINDS,
        "specimen": campaign.specimens,
        "setup": campaign.setups,
        "motion": campaign.motions,
        "recorder": [name for setup in campaign.setups.values() for name in setup.further_recorders],
    }
    names = {part: {name.casefold(): name for name in each} for part, each in own.items()}
    for word, meaning in campaign.watch.words.items():
        parts = [part for part, each in names.items() if meaning in each.values()]
        # What is no other name of the campaign is that of a motion: those of tests need no entry.
        for part in parts or ["motion"]:
            names[part][word] = meaning
    return names
