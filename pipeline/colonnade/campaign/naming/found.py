"""The tests whose raw files are in the watched folder, by the names of these files; nothing is written."""

from __future__ import annotations

import os
import re
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from colonnade.campaign.channel import MAIN
from colonnade.campaign.naming.pattern import COUNTER
from colonnade.campaign.naming.watched import Watched
from colonnade.campaign.syntax.document import validated
from colonnade.campaign.syntax.identifier import folded
from colonnade.campaign.test import KINDS, Test
from colonnade.errors import nearest, quoted
from colonnade.findings import Finding, note, serious

WITHOUT_TEST = "raw file without a test"
"""Kind of the findings about files of which no test was made."""

MOST_FILES = 100_000
"""Files of a folder that are looked at."""

UNFINISHED = (".partial", ".part", ".tmp", ".crdownload")
"""Endings of files that a program has not finished."""


@dataclass(frozen=True)
class Found:
    """
    What is in the watched folder.

    Attributes
    ----------
    tests : tuple of dict
        As they would stand in campaign.toml, in the order of their names.
    findings : tuple of Finding
        Files that fit a pattern and still make no test, and those that fit none.
    """

    tests: tuple[dict[str, Any], ...] = ()
    findings: tuple[Finding, ...] = ()


@dataclass
class _Named:
    """Files whose names have the same parts: one of each recorder."""

    entry: dict[str, Any]
    files: dict[str, list[str]] = field(default_factory=dict)

    @property
    def first(self) -> str:
        """One of the files."""
        return next(iter(self.files.values()))[0]


def find_tests(document: Mapping[str, Any], folder: Path) -> Found:
    """
    Find the tests that [watch] describes.

    Parameters
    ----------
    document : mapping
        The campaign file as written, with the entries of its test log; anything may have the wrong type, which is
        reported elsewhere.
    folder : Path
        Of the campaign file.

    Returns
    -------
    found : Found
        An entry of the campaign file or log that names a file counts alone.
    """
    watched, _ = validated(Watched, _table(document.get("watch")), folder)
    if watched is None or not watched.pattern:
        return Found()
    entries = [_table(entry) for entry in _list(document.get("tests"))]
    listed = {path for entry in entries for path in _paths(entry.get("file"))}
    taken = {folded(entry["id"]): str(entry["id"]) for entry in entries if isinstance(entry.get("id"), str)}
    unlisted = [path for path in files_in(folder / watched.folder) if f"{watched.folder}/{path}" not in listed]
    named, refused, strange = _sorted_by_name(watched, names_in(document, watched.words), unlisted)
    tests = []
    for each in named:
        try:
            made = _test(each, watched.folder, document, folder, taken)
        except ValueError as reason:
            refused.setdefault(str(reason), []).append(each.first)
        else:
            taken[folded(made["id"])] = made["id"]
            tests.append(made)
    return Found(tuple(tests), (*(_refused(reason, paths) for reason, paths in refused.items()), *_strange(strange)))


def files_in(folder: Path) -> Iterator[str]:
    """Give the paths of the regular files in a folder and below it; links, hidden and unfinished files are left out."""
    waiting, count = [folder], 0
    while waiting:
        try:
            entries = sorted(os.scandir(waiting.pop()), key=lambda entry: entry.name)
        except OSError:
            continue
        for entry in entries:
            if entry.name.startswith((".", "~")) or entry.name.casefold().endswith(UNFINISHED):
                continue
            if entry.is_dir(follow_symlinks=False):
                waiting.append(Path(entry.path))
            elif entry.is_file(follow_symlinks=False) and count < MOST_FILES:
                count += 1
                yield Path(entry.path).relative_to(folder).as_posix()


def _sorted_by_name(
    watched: Watched, names: Mapping[str, Mapping[str, str]], unlisted: Iterable[str]
) -> tuple[list[_Named], dict[str, list[str]], list[str]]:
    """Bring files of the same parts together, in the order of their names; with those refused, and those of no name."""
    together: dict[str, _Named] = {}
    refused: dict[str, list[str]] = {}
    strange = []
    for path in sorted(unlisted, key=_natural):
        whole = f"{watched.folder}/{path}"
        matches = [(each, match) for each in watched.pattern if (match := each.pattern.match(path, names)) is not None]
        if not matches:
            strange.append(whole)
        elif len(matches) > 1:
            patterns = " and ".join(quoted(each.pattern.text) for each, _ in matches[:2])
            refused.setdefault(f"The name fits two patterns of [watch]: {patterns}.", []).append(whole)
        else:
            named, parts = matches[0]
            recorder = str(parts.pop("recorder", MAIN))
            same = together.setdefault(repr(sorted(parts.items())), _Named(named.entry(parts)))
            if recorder == MAIN:
                same.entry = named.entry(parts)
            same.files.setdefault(recorder, []).append(whole)
    return list(together.values()), refused, strange


def _test(
    named: _Named, watched: str, document: Mapping[str, Any], folder: Path, taken: Mapping[str, str]
) -> dict[str, Any]:
    """
    Make the entry of a test.

    Raises
    ------
    ValueError
        If the files make none; the message is a sentence.
    """
    for paths in named.files.values():
        if len(paths) > 1:
            raise ValueError(f"By their names, {' and '.join(paths[:3])} are the same test.")
    if MAIN not in named.files:
        raise ValueError("The file of the main recorder is missing.")
    main = named.files[MAIN][0]
    name = _id(main.removeprefix(f"{watched}/"))
    if folded(name) in taken:
        raise ValueError(f'The name gives the id "{name}", which another test has.')
    entry = {**_only_ones(document), **named.entry}
    entry.pop(COUNTER, None)
    files = {MAIN: main} | {recorder: paths[0] for recorder, paths in named.files.items()}
    entry |= {"id": name, "file": main if len(files) == 1 else files}
    _, wrong = validated(Test, entry, folder)
    for place, message in wrong:
        raise ValueError(f"{'.'.join(map(str, place))}: {message}")
    for key, table in (("specimen", "specimens"), ("setup", "setups")):
        known = _table(document.get(table))
        if entry[key] not in known:
            raise ValueError(f"Unknown {key} {quoted(str(entry[key]))}.{nearest(str(entry[key]), known)}")
    return entry


def _refused(reason: str, paths: list[str]) -> Finding:
    return serious(
        WITHOUT_TEST,
        f"{_first(paths)}: no test was made of it. {reason} Rename it, give it an entry in [[tests]], or change "
        "`pattern` in [watch].",
    )


def _strange(paths: list[str]) -> Iterator[Finding]:
    if paths:
        yield note(
            WITHOUT_TEST,
            f"{_first(paths)}: no test names it, and its name fits no pattern of [watch]. It is not read.",
        )


def _first(paths: list[str]) -> str:
    return f"{paths[0]} and {len(paths) - 1} more" if len(paths) > 1 else paths[0]


def names_in(document: Mapping[str, Any], words: Mapping[str, str]) -> dict[str, dict[str, str]]:
    """Give what each part may be in a file name, in lower case, and what it stands for."""
    setups = _table(document.get("setups"))
    own = {
        "kind": [*KINDS],
        "specimen": [*_table(document.get("specimens"))],
        "setup": [*setups],
        "motion": [*_table(document.get("motions"))],
        "recorder": [name for setup in setups.values() for name in _table(_table(setup).get("recorders"))],
    }
    names = {part: {name.casefold(): name for name in each} for part, each in own.items()}
    for word, meaning in words.items():
        for part, each in names.items():
            if meaning in each.values() or (part == "motion" and not _is_known(meaning, names)):
                each[word] = meaning
    return names


def _is_known(meaning: str, names: Mapping[str, Mapping[str, str]]) -> bool:
    return any(meaning in names[part].values() for part in ("kind", "specimen", "setup", "recorder"))


def _only_ones(document: Mapping[str, Any]) -> dict[str, str]:
    """Give the specimen and the setup of a campaign that has only one."""
    kinds = {"specimen": "specimens", "setup": "setups"}
    tables = {key: list(_table(document.get(table))) for key, table in kinds.items()}
    return {key: names[0] for key, names in tables.items() if len(names) == 1}


def _id(path: str) -> str:
    """Make the id of a test from the path of its main file."""
    stem = path.rpartition(".")[0] or path
    return re.sub(r"[^A-Za-z0-9._-]+", "-", stem).strip("-._")


def _natural(path: str) -> list[tuple[int, str]]:
    """Sort numbers in names by value: free-2 before free-10."""
    return [(int(part), "") if part.isdigit() else (-1, part) for part in re.split(r"(\d+)", path)]


def _paths(file: object) -> list[str]:
    return [str(path) for path in file.values()] if isinstance(file, Mapping) else [str(file)]


def _table(value: object) -> dict[str, Any]:
    return dict(value) if isinstance(value, Mapping) else {}


def _list(value: object) -> list[Any]:
    return value if isinstance(value, list) else []
