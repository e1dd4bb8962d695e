"""A folder of the report as one file, to be sent or kept."""

from __future__ import annotations

import zipfile
from collections.abc import Collection, Mapping
from pathlib import Path
from typing import IO

from colonnade.errors import StoreError
from colonnade.store import files
from colonnade.store.files import own_files

SUFFIX = ".zip"
FIRST_DAY = (1980, 1, 1, 0, 0, 0)
"""Time of every file in the bundle, the first one that a zip file can hold: the same report gives the same bytes."""
READABLE = 0o100644 << 16
"""A plain file that everybody may read, as zip files say it."""


def write_bundle(folder: Path, target: Path, *, own: Collection[str], instead: Mapping[str, str] | None = None) -> None:
    """
    Put the report's own files into a zip file.

    Parameters
    ----------
    folder : Path
        The report's. Links in it are left out.
    target : Path
        The zip file, outside the folder; written whole or not at all.
    own : collection of str
        Names in the folder of what belongs to the report: a file that somebody put there is not sent with it.
    instead : dict of str to str, optional
        Texts by name in the folder; each replaces the file there.

    Raises
    ------
    StoreError
        If the target is in the folder, does not end in .zip, or cannot be written.
    """
    if target.suffix.lower() != SUFFIX:
        raise StoreError(f"{target}: the name of a bundle has to end in {SUFFIX}, such as report{SUFFIX}.")
    if target.resolve().is_relative_to(folder.resolve()):
        raise StoreError(f"{target}: this is in the report itself. Name a file outside {folder}.")
    if target.is_dir():
        raise StoreError(f"{target}: this is a folder. Name the file that the bundle is written to.")
    found = {path.relative_to(folder).as_posix(): path for path in own_files(folder) if not path.is_symlink()}
    names = {name: found[name] for name in own if name in found}
    texts = instead or {}

    def write_to(stream: IO[bytes]) -> None:
        with zipfile.ZipFile(stream, "w", zipfile.ZIP_DEFLATED) as archive:
            for name in sorted({*names, *texts}):
                entry = zipfile.ZipInfo(f"{folder.name}/{name}", FIRST_DAY)
                entry.external_attr, entry.compress_type = READABLE, zipfile.ZIP_DEFLATED
                archive.writestr(entry, texts[name] if name in texts else names[name].read_bytes())

    files.write_stream(target, write_to)
