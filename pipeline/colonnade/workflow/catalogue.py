"""What raw files, results and pages say of themselves, known again without opening them."""

from __future__ import annotations

import json
import os
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import Any

from colonnade.dynamics import models
from colonnade.dynamics.models.registry import MODELS
from colonnade.errors import StoreError
from colonnade.findings import from_text, to_text
from colonnade.interruption import expect_none
from colonnade.sources import code_hash, package_hash
from colonnade.store import files, stamps
from colonnade.store.freshness import Recipe
from colonnade.store.layout import Layout
from colonnade.store.provenance import hash_of

KEPT = ("key", "status", "reason", "content", "ingredients")
"""Attributes of a result that tell whether it is up to date and what it leads to."""

BESIDE = ("colonnade.campaign", "colonnade.store", "colonnade.workflow")
"""Rooms of which a stage's own imports count, not theirs: what they read reaches it as settings and results."""

Mark = tuple[int, int, int]
"""Size (bytes), time (ns) and inode of a file. A file that is put in place by a rename gets another inode."""

_KINDS = ("raw", "results", "pages", "records", "code")


def mark_of(path: Path) -> Mark:
    """Return what a file's mark is now; raises OSError if it is not there."""
    status = os.stat(path)  # noqa: PTH116 — ten thousand times a run
    return status.st_size, status.st_mtime_ns, status.st_ino


class Catalogue:
    """
    What the files of a campaign said when they were last opened, kept from run to run.

    A file of the same size, time and inode says the same. The catalogue only saves time: without it, or if it is not as
    it was written, the files are opened.

    Parameters
    ----------
    layout : Layout
    verify : bool, optional
        Open every file again, and read all of it.
    """

    def __init__(self, layout: Layout, *, verify: bool = False) -> None:
        self._layout, self._verify = layout, verify
        self._known: dict[str, dict[str, Any]] = {kind: {} for kind in _KINDS}
        try:
            known = json.loads(layout.catalogue.read_text(encoding="utf-8"))
            if known.pop("sha256") == hash_of(known):
                self._known |= {kind: dict(known[kind]) for kind in _KINDS}
        except (OSError, ValueError, KeyError, TypeError, AttributeError, RecursionError):
            pass
        self._seen: dict[str, dict[str, Any]] = {kind: {} for kind in _KINDS}

    def told(self, kind: str, path: Path, ask: Callable[[Path], Any], *more: Any) -> tuple[Mark, Any] | None:
        """
        Return what a file says, asked only where it changed.

        Parameters
        ----------
        kind : str
            raw, results or pages.
        path : Path
        ask : callable
            Opens the file and returns what it says, as JSON can hold it.
        *more
            What else its answer follows from.

        Returns
        -------
        told : (Mark, answer) or None
            None if there is no such file.
        """
        name = " ".join([os.path.relpath(path, self._layout.home).replace(os.sep, "/"), *map(hash_of, more)])
        try:
            mark = mark_of(path)
        except OSError:
            return None
        for known in (self._seen[kind].get(name), None if self._verify else self._known[kind].get(name)):
            if known is not None and known[0] == list(mark):
                self._seen[kind][name] = known
                return mark, known[1]
        self._seen[kind][name] = [list(mark), ask(path)]
        return mark, self._seen[kind][name][1]

    def attributes(self, path: Path) -> Mapping[str, Any]:
        """`KEPT` of a result and the findings in it; empty where it is not there or damaged."""
        told = self.told("results", path, _said)
        said = told[1] if told else {}
        return {**said, "warnings": from_text(said["warnings"])} if "warnings" in said else said

    def stamp(self, page: Path) -> str:
        """Key of what a page shows; empty where it is not there or was altered."""
        told = self.told("pages", page, stamps.key_of)
        return str(told[1]) if told else ""

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
                made_by, alone=BESIDE, without=[] if model is None else _of_other_models(model)
            )
        return str(self._seen["code"][name])

    def content(self, path: Path) -> str | None:
        """Hash of what a result says of itself; None where it is not there."""
        told = self.told("results", path, _said)
        return hash_of(told[1]) if told else None

    def record(self, subject: str, recipe: Recipe) -> str | None:
        """Text of the record of a test or specimen that was made from just this, or None."""
        for known in (self._seen["records"].get(subject), self._known["records"].get(subject)):
            if known is not None and not recipe.why({"key": known[0]}):
                self._seen["records"][subject] = known
                return str(known[1])
        return None

    def remember(self, subject: str, recipe: Recipe, record: str) -> None:
        """Keep a record for the next run."""
        self._seen["records"][subject] = [recipe.key, record]

    def save(self) -> None:
        """Write what was looked at; the rest is gone from the campaign."""
        known: dict[str, Any] = dict(self._seen)
        known["sha256"] = hash_of(known)
        files.write_text(self._layout.catalogue, json.dumps(known, separators=(",", ":"), sort_keys=True) + "\n")


def _of_other_models(name: str) -> set[str]:
    """Give the modules by which only other models are reached."""
    others = [other for other in MODELS if other != name]
    kinds = {type(MODELS[other]).__module__ for other in others} - {type(MODELS[name]).__module__}
    return kinds | {f"{models.__name__}.{other}" for other in others}


def stored_attributes(path: Path) -> dict[str, Any]:
    """Attributes of a result, empty where it is not there or damaged (and so has to be made again)."""
    try:
        return files.read_attributes(path)
    except StoreError:
        return {}


def _said(path: Path) -> dict[str, str]:
    stored = stored_attributes(path)
    said = {part: str(stored[part]) for part in KEPT if part in stored}
    return said | {"warnings": to_text(stored.get("warnings", []))} if stored else said


def remove_altered(layout: Layout) -> list[str]:
    """Remove the results of tests and specimens that are not as they were written; return a sentence on each."""
    told = []
    for path in layout.results_there():
        expect_none()
        try:
            files.read(path)
        except StoreError:
            files.remove(path)
            told.append(f"{path.relative_to(layout.home).as_posix()}: it was altered or damaged, so it is made again.")
    return told
