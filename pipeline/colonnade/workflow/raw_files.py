"""The raw files of tests: the hash of each, and of the companion files that hold a part of it."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

from colonnade.campaign import Campaign, Test
from colonnade.campaign.setup import FileOptions
from colonnade.errors import ReadError, StoreError
from colonnade.readers.files import sha256_of
from colonnade.readers.registry import companions
from colonnade.workflow.catalogue import Catalogue, Mark, mark_of


@dataclass(frozen=True)
class RawFile:
    """A raw file as it was hashed: its SHA-256, None if it could not be read, and its mark."""

    sha256: str | None
    mark: Mark = (0, 0, 0)

    @property
    def is_empty(self) -> bool:
        """Whether it holds nothing, or cannot be read."""
        return self.mark[0] == 0


RawFiles = Mapping[str, RawFile]
"""Raw files by path within the campaign's folder."""


def raw_files(campaign: Campaign, test: Test, catalogue: Catalogue) -> RawFiles:
    """Hash the raw files of a test, and their companion files."""
    found: dict[str, RawFile] = {}
    for recorder, path in test.files.items():
        how = campaign.setups[test.setup].recorders[recorder].file
        found[_name(campaign, path)], companion_names = _looked_at(campaign.folder, path, how, catalogue)
        for name in companion_names:
            other = path.with_name(Path(name).name or path.name)
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
    for name, file in raw.items():
        try:
            is_changed = file.sha256 is not None and mark_of(folder / name) != file.mark
        except OSError:
            is_changed = True
        if is_changed:
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
            return digest, [other.name for other in companions(path, how.format, how.options, within=folder)]
        except ReadError:  # reported when the file is read
            return digest, []

    if not path.resolve().is_relative_to(folder):  # reading refuses it
        return RawFile(None), []
    entry = catalogue.lookup("raw", path, ask, *([] if how is None else [how.model_dump()]))
    if entry is None or entry[1][0] is None:
        return RawFile(None), []
    mark, (digest, companion_names) = entry
    return RawFile(digest, mark), companion_names
