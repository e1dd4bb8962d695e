"""The catalogue: what raw files, results and pages held when they were last opened, and texts that are kept."""

from __future__ import annotations

import json
import os
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import Any

from colonnade.dynamics.models import MODELS
from colonnade.errors import StoreError
from colonnade.findings import from_text, to_text
from colonnade.interruption import expect_none
from colonnade.sources import code_hash, package_hash
from colonnade.store import files
from colonnade.store.layout import Layout
from colonnade.store.provenance import hash_of, key_of

KEPT = ("key", "status", "reason", "content", "ingredients")
"""Attributes of a result that decide whether it, and what follows from it, is up to date."""

OWN_CODE_ONLY = ("colonnade.campaign", "colonnade.store", "colonnade.workflow")
"""Rooms whose own code counts for a result, but not what they import: that reaches a stage as settings and results."""

Mark = tuple[int, int, int]
"""Size (bytes), time (ns) and inode of a file. A file that replaces another by a rename has another inode."""

_KINDS = ("raw", "results", "pages", "kept", "code")


def mark_of(path: Path) -> Mark:
    """Return the present mark of a file; raises OSError if there is no such file."""
    status = os.stat(path)  # noqa: PTH116 — ten thousand times a run
    return status.st_size, status.st_mtime_ns, status.st_ino


class Catalogue:
    """
    What the files of a campaign held when they were last opened, kept from run to run.

    A file of the same size, time and inode holds the same. The catalogue only saves time: if it is missing or was
    altered, the files are opened.

    Parameters
    ----------
    layout : Layout
    verify : bool, optional
        Open every file again, and read all of it.
    """

    def __init__(self, layout: Layout, *, verify: bool = False) -> None:
        self._layout, self._verify = layout, verify
        self._home = os.path.join(layout.home, "")  # noqa: PTH118 — a text, with the separator at its end
        self._known: dict[str, dict[str, Any]] = {kind: {} for kind in _KINDS}
        try:
            known = json.loads(layout.catalogue.read_text(encoding="utf-8"))
            if known.pop("sha256") == hash_of(known):
                self._known |= {kind: dict(known[kind]) for kind in _KINDS}
        except (OSError, ValueError, KeyError, TypeError, AttributeError, RecursionError):
            pass
        self._seen: dict[str, dict[str, Any]] = {kind: {} for kind in _KINDS}

    def lookup(self, path: Path, ask: Callable[[Path], Any], *more: Any) -> tuple[Mark, Any] | None:
        """
        Return what a raw file holds; it is opened only if it changed.

        Parameters
        ----------
        path : Path
        ask : callable
            Opens the file and returns what it holds, as JSON can hold it.
        *more
            What else the answer depends on.

        Returns
        -------
        found : (Mark, answer) or None
            None if there is no such file.
        """
        entry = self._entry("raw", path, ask, *more)
        return None if entry is None else (tuple(entry[0]), entry[1])

    def _entry(self, kind: str, path: Path, ask: Callable[[Path], Any], *more: Any) -> list[Any] | None:
        """Return mark and answer, with what else was found out from the answer; None if there is no such file."""
        place = os.fspath(path).removeprefix(self._home)
        if os.path.isabs(place):  # noqa: PTH117
            place = os.path.relpath(path, self._home)  # ten times as slow
        name = " ".join([place.replace(os.sep, "/"), *map(hash_of, more)])
        try:
            mark = mark_of(path)
        except OSError:
            return None
        for known in (self._seen[kind].get(name), None if self._verify else self._known[kind].get(name)):
            if known is not None and known[0] == list(mark):
                break
        else:
            known = [list(mark), ask(path)]
        self._seen[kind][name] = known
        return known

    def attributes(self, path: Path) -> Mapping[str, Any]:
        """Attributes `KEPT` of a result and its findings; empty if it is missing or damaged."""
        entry = self._entry("results", path, _kept)
        kept = entry[1] if entry else {}
        return {**kept, "warnings": from_text(kept["warnings"])} if "warnings" in kept else kept

    def stamp(self, page: Path) -> str:
        """Key of what a page shows; empty if it is missing or was altered."""
        entry = self._entry("pages", page, key_of)
        return str(entry[1]) if entry else ""

    def code(self, made_by: Sequence[str], model: str | None = None) -> str:
        """
        Hash the code that makes a result, by names of modules; of a model's result without the code of other models.

        The sources are parsed only if one of them changed.
        """
        if "package" not in self._seen["code"]:
            self._seen["code"]["package"] = package_hash()
        package = self._seen["code"]["package"]
        name = " ".join([*made_by, *([model] if model else [])])
        if name not in self._seen["code"]:
            known = self._known["code"] if self._known["code"].get("package") == package else {}
            self._seen["code"][name] = known.get(name) or code_hash(
                made_by, alone=OWN_CODE_ONLY, without=[] if model is None else _of_other_models(model)
            )
        return str(self._seen["code"][name])

    def remove_altered(self) -> list[str]:
        """
        Remove results that were altered since they were written; return a sentence on each.

        What has not changed since the last run is not read, unless everything is verified.
        """
        notices = []
        for path in self._layout.results_there():
            expect_none()
            entry = self._entry("results", path, _whole)
            if entry is not None and not entry[1]:
                files.remove(path)
                name = path.relative_to(self._layout.home).as_posix()
                notices.append(f"{name}: it was altered or damaged, so it is recomputed.")
        return notices

    def content(self, path: Path) -> str | None:
        """Hash of the attributes `KEPT` of a result and its findings; None if it is missing."""
        entry = self._entry("results", path, _kept)
        if entry is not None and len(entry) == 2:
            entry.append(hash_of(entry[1]))
        return None if entry is None else str(entry[2])

    def kept(self, product: str, key: str) -> tuple[str, str] | None:
        """Text that was kept of a product under this key, and why it could not be made; None if there is none."""
        for known in (self._seen["kept"].get(product), self._known["kept"].get(product)):
            if known is not None and known[0] == key:
                self._seen["kept"][product] = known
                return str(known[1]), str(known[2])
        return None

    def keep(self, product: str, key: str, text: str, reason: str = "") -> None:
        """Keep the text of a product for the next run, or why it could not be made."""
        self._seen["kept"][product] = [key, text, reason]

    def save(self, *, is_whole: bool = True) -> None:
        """Write what was looked at; other entries belong to files that are gone, unless the run was not whole."""
        known: dict[str, Any] = dict(self._seen)
        if not is_whole:
            known |= {kind: self._known[kind] | self._seen[kind] for kind in _KINDS if kind != "code"}
        known["sha256"] = hash_of(known)
        files.write_text(self._layout.catalogue, json.dumps(known, separators=(",", ":"), sort_keys=True) + "\n")


def _of_other_models(name: str) -> set[str]:
    """Give the modules that only other models use."""
    return {model.engine for model in MODELS.values()} - {MODELS[name].engine}


def stored_attributes(path: Path) -> dict[str, Any]:
    """Attributes of a result; empty if it is missing or damaged, and so has to be recomputed."""
    try:
        return files.read_attributes(path)
    except StoreError:
        return {}


def _whole(path: Path) -> dict[str, str]:
    """Read all of a result; give what is kept of it, nothing if it was altered."""
    try:
        return _kept(path, files.read(path).attrs)
    except StoreError:
        return {}


def _kept(path: Path, attributes: Mapping[str, Any] | None = None) -> dict[str, str]:
    stored = stored_attributes(path) if attributes is None else attributes
    kept = {part: str(stored[part]) for part in KEPT if part in stored}
    return kept | {"warnings": to_text(stored.get("warnings", []))} if stored else kept
