"""What the stored results say of themselves, known again without opening their files."""

from __future__ import annotations

import json
import os
from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import Any

from colonnade.findings import from_text, to_text
from colonnade.store.files import write_text
from colonnade.store.layout import Layout
from colonnade.store.provenance import hash_of
from colonnade.workflow.freshness import stored_attributes

KEPT = ("key", "status", "reason", "content")
"""Attributes of a result that tell whether it is up to date and what it leads to."""


class Catalogue:
    """
    Attributes of results and the summary's records that follow from them, as of the last run.

    A result is put in place by a rename, so one of the same size, time and inode is the same. The catalogue only saves
    time: without it, or if it is not as it was written, the files are opened.

    Parameters
    ----------
    layout : Layout
    verify : bool, optional
        Open every file again.
    """

    def __init__(self, layout: Layout, *, verify: bool = False) -> None:
        self._layout = layout
        self._files: dict[str, Any] = {}
        self._records: dict[str, Any] = {}
        if not verify:
            try:
                known = json.loads(layout.catalogue.read_text(encoding="utf-8"))
                if known.pop("sha256") == hash_of(known):
                    self._files, self._records = dict(known["files"]), dict(known["records"])
            except (OSError, ValueError, KeyError, TypeError, AttributeError, RecursionError):
                pass
        self._seen_files: dict[str, Any] = {}
        self._seen_records: dict[str, Any] = {}

    def attributes(self, path: Path) -> Mapping[str, Any]:
        """`KEPT` of a result and the findings in it; empty where it is not there or damaged."""
        name = path.relative_to(self._layout.processed).as_posix()
        try:
            status = os.stat(path)  # noqa: PTH116 — ten thousand times a run
        except OSError:
            return {}
        mark = [status.st_size, status.st_mtime_ns, status.st_ino]
        for known in (self._seen_files.get(name), self._files.get(name)):
            if isinstance(known, list) and len(known) == 2 and known[0] == mark:
                self._seen_files[name] = known
                return _with_findings(known[1])
        stored = stored_attributes(path)
        said = {part: str(stored[part]) for part in KEPT if part in stored}
        if stored:
            said["warnings"] = to_text(stored.get("warnings", []))
        self._seen_files[name] = [mark, said]
        return _with_findings(said)

    def signature(self, paths: Iterable[Path], *others: Any) -> str:
        """Hash of what results say, and of whatever else a record is made from."""
        known = [self.attributes(path) for path in paths]
        return hash_of([*(dict(said) | {"warnings": to_text(said.get("warnings", []))} for said in known), *others])

    def record(self, test: str, signature: str) -> str | None:
        """Text of a test's record that was made from just this; None where there is none."""
        known = self._records.get(test)
        if isinstance(known, list) and len(known) == 2 and known[0] == signature:
            self._seen_records[test] = known
            return str(known[1])
        return None

    def remember(self, test: str, signature: str, record: str) -> None:
        """Keep a test's record for the next run."""
        self._seen_records[test] = [signature, record]

    def save(self) -> None:
        """Write what was looked at; the rest is gone from the campaign."""
        known: dict[str, Any] = {"files": self._seen_files, "records": self._seen_records}
        known["sha256"] = hash_of(known)
        write_text(self._layout.catalogue, json.dumps(known, separators=(",", ":"), sort_keys=True) + "\n")


def _with_findings(said: Mapping[str, str]) -> Mapping[str, Any]:
    return {**said, "warnings": from_text(said["warnings"])} if "warnings" in said else dict(said)
