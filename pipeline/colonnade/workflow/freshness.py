"""Whether a result is up to date: by the content of what it was made from, never by dates."""

from __future__ import annotations

import functools
import hashlib
import json
from collections.abc import Callable, Collection, Iterable, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import colonnade
from colonnade.campaign import Campaign
from colonnade.campaign.setup import FileOptions
from colonnade.errors import ReadError, StoreError
from colonnade.interruption import expect_none
from colonnade.readers.irregular import irregular
from colonnade.readers.registry import companions
from colonnade.store.files import write_text
from colonnade.store.layout import Layout
from colonnade.store.provenance import hash_of

WITHOUT_RESULTS = ("cli", "figures", "report", "laboratory")
"""Rooms whose code changes no result."""

Look = Callable[[Path], Mapping[str, Any]]
"""Tells `key`, `status`, `reason` and `content` of a result."""

_CHUNK = 1 << 20


@functools.cache
def source_hash(*, without: tuple[str, ...] = WITHOUT_RESULTS) -> str:
    """Hash of the package's sources and templates but for some rooms; by default those that results depend on."""
    root = Path(colonnade.__file__).parent
    digest = hashlib.sha256()
    for path in sorted(path for path in root.rglob("*") if path.suffix in (".py", ".jinja", ".css", ".mplstyle")):
        relative = path.relative_to(root)
        if relative.parts[0] not in without:
            digest.update(relative.as_posix().encode() + b"\0" + path.read_bytes() + b"\0")
    return digest.hexdigest()


def ingredients(instructions: str, upstream: Mapping[str, str | None]) -> dict[str, Any]:
    """
    Gather what a result is made from.

    Parameters
    ----------
    instructions : str
        JSON of what the stage reads of the campaign.
    upstream : mapping of str to str
        Hash of each result or raw file that it reads; None where it is not there.
    """
    return {"code": source_hash(), "settings": hash_of(instructions), "upstream": dict(upstream)}


def key_of(stage: str, made_from: Mapping[str, Any]) -> str:
    """Key of a result: hash of its stage and ingredients."""
    return hash_of({"stage": stage, **made_from})


def why_stale(stored: Mapping[str, Any], made_from: Mapping[str, Any], *, from_raw: bool) -> str:
    """Say what changed since a stored result (its attributes) was made."""
    try:
        before = json.loads(stored.get("ingredients", ""))
    except ValueError:
        return "never run"
    if before.get("upstream") != made_from["upstream"]:
        return "raw file changed" if from_raw else "upstream changed"
    return "settings changed" if before.get("settings") != made_from["settings"] else "code changed"


def report_key(campaign: Campaign, layout: Layout, outdated: Collection[str], look: Look) -> str:
    """Hash of all that the report shows: the campaign as read, the results as `look` tells of them, and the code."""
    shown = {
        path.relative_to(layout.processed).as_posix(): [look(path).get(part) for part in ("key", "status", "content")]
        for path in layout.results_there()
    }
    return hash_of(
        {
            "code": source_hash(without=("cli", "laboratory")),
            "campaign": repr(campaign.wherever_it_lies()),
            "results": shown,
            "outdated": sorted(outdated),
        }
    )


@dataclass(frozen=True)
class RawFile:
    """A raw file as it was hashed: SHA-256, None where it could not be read, with size (bytes) and time (ns)."""

    sha256: str | None
    size: int = 0
    time: int = 0

    def is_still(self, path: Path) -> bool:
        """Whether size and time are those of when it was hashed; a recorder may still be writing."""
        if self.sha256 is None:
            return True
        try:
            status = path.stat()
        except OSError:
            return False
        return (status.st_size, status.st_mtime_ns) == (self.size, self.time)


class RawIndex:
    """
    Size, time and SHA-256 of the raw files as last seen; a file whose size and time are the same is not read again.

    Parameters
    ----------
    layout : Layout
    verify : bool
        Read every file whatever its size and time.
    """

    def __init__(self, layout: Layout, *, verify: bool) -> None:
        self._layout, self._verify = layout, verify
        self._folder = layout.folder.resolve()
        self._seen: dict[str, RawFile] = {}
        try:
            known = json.loads(layout.raw_index.read_text(encoding="utf-8"))
        except (OSError, ValueError, RecursionError):
            known = None
        self._known: dict[str, Any] = known if isinstance(known, dict) else {}

    def look(self, files: Iterable[tuple[Path, FileOptions]]) -> dict[str, RawFile]:
        """Look at each raw file, and at the other files that it is in; by their paths from the campaign's folder."""
        found: dict[str, RawFile] = {}
        for path, how in files:
            name = self._name(path)
            found[name] = self._file(name, path)
            for other in self._companions(name, path, how):
                found.setdefault(self._name(other), self._file(self._name(other), other))
        return found

    def _companions(self, name: str, path: Path, how: FileOptions) -> list[Path]:
        """Other files that a raw file is in; asked again where it, or how it is read, is not as it was."""
        known = self._known.get(name)
        if not isinstance(known, dict) or "sha256" not in known:
            return []
        asked = hash_of([known["sha256"], how.format, how.options])
        if known.get("asked") != asked or self._verify:
            try:
                others = companions(path, how.format, how.options, within=self._folder)
            except ReadError:
                return []  # told where the file is read
            known |= {"asked": asked, "companions": [other.name for other in others]}
        names = known.get("companions")
        return [path.with_name(Path(str(name)).name or path.name) for name in names] if isinstance(names, list) else []

    def _name(self, path: Path) -> str:
        return path.relative_to(self._folder).as_posix()

    def _file(self, name: str, path: Path) -> RawFile:
        if name not in self._seen:
            self._seen[name] = self._hashed(name, path)
        return self._seen[name]

    def _hashed(self, name: str, path: Path) -> RawFile:
        try:
            if not path.resolve().is_relative_to(self._folder):  # reading refuses it
                return RawFile(None)
            status = path.stat()
            if irregular(path):
                return RawFile(None)
            known = self._known.get(name)
            seen = (known.get("size"), known.get("time")) if isinstance(known, dict) and "sha256" in known else None
            if not self._verify and seen == (status.st_size, status.st_mtime_ns):
                return RawFile(str(self._known[name]["sha256"]), status.st_size, status.st_mtime_ns)
            digest = hashlib.sha256()
            with path.open("rb") as stream:
                while chunk := stream.read(_CHUNK):
                    digest.update(chunk)
        except OSError:
            self._known.pop(name, None)
            return RawFile(None)
        self._known[name] = {"size": status.st_size, "time": status.st_mtime_ns, "sha256": digest.hexdigest()}
        return RawFile(digest.hexdigest(), status.st_size, status.st_mtime_ns)

    def save(self) -> None:
        """Write the index, if it changed."""
        write_text(self._layout.raw_index, json.dumps(self._known, indent=1, sort_keys=True) + "\n")


def remove_altered(layout: Layout) -> list[str]:
    """Remove the results of tests and specimens that are not as they were written; return a sentence on each."""
    from colonnade.store.files import read, remove

    told = []
    for path in layout.results_there():
        expect_none()
        try:
            read(path)
        except StoreError:
            remove(path)
            told.append(f"{path.relative_to(layout.home).as_posix()}: it was altered or damaged; it is made again.")
    return told


def stored_attributes(path: Path) -> dict[str, Any]:
    """Attributes of a result, empty where it is not there or damaged (and so has to be made again)."""
    from colonnade.store.files import read_attributes

    try:
        return read_attributes(path)
    except StoreError:
        return {}
