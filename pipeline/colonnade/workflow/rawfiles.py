"""Raw files by content: a file of unchanged size and time is not hashed again."""

from __future__ import annotations

import hashlib
import json
from dataclasses import asdict, dataclass
from pathlib import Path

from colonnade.errors import StoreError
from colonnade.store import files

MISSING = "missing"
"""Stands for the hash of a file that is not there; it changes when the file comes."""

_BLOCK = 1 << 20


@dataclass(frozen=True)
class RawFile:
    """
    A raw file as it was when the run began.

    Attributes
    ----------
    path : Path
    name : str
        From the campaign's folder, with ``/``.
    size, mtime_ns : int
        Bytes and nanoseconds.
    sha256 : str
        Of its bytes; else "missing" or what the system says.
    """

    path: Path
    name: str
    size: int
    mtime_ns: int
    sha256: str

    @property
    def is_readable(self) -> bool:
        """Whether its content is known."""
        return len(self.sha256) == hashlib.sha256().digest_size * 2

    def check_unchanged(self) -> None:
        """
        Make sure that what was read is what was hashed.

        Raises
        ------
        StoreError
            If the file was written to meanwhile.
        """
        if not self.is_readable:
            return
        try:
            now = self.path.stat()
        except OSError as error:
            raise StoreError(f"{self.name}: it went away while it was read ({error.strerror}). Run again.") from error
        if (now.st_size, now.st_mtime_ns) != (self.size, self.mtime_ns):
            raise StoreError(
                f"{self.name}: it was written to while it was read. Run again when the recording is complete."
            )


class RawIndex:
    """
    Hashes of the raw files of a campaign, kept in processed/raw-files.json.

    Parameters
    ----------
    folder : Path
        The campaign's folder.
    path : Path
        The index.
    verify : bool
        Hash every file, even where size and time are unchanged.
    """

    def __init__(self, folder: Path, path: Path, *, verify: bool = False) -> None:
        self._folder, self._path, self._verify = folder, path, verify
        self._known = _known(path)
        self._seen: dict[Path, RawFile] = {}

    def look(self, path: Path) -> RawFile:
        """Return a raw file with its hash; one that cannot be read has the system's words in place of the hash."""
        if path not in self._seen:
            self._seen[path] = self._look(path)
        return self._seen[path]

    def save(self) -> None:
        """Write the index, if it has changed."""
        entries = self._known | {
            raw.name: {key: value for key, value in asdict(raw).items() if key in ("size", "mtime_ns", "sha256")}
            for raw in self._seen.values()
            if raw.is_readable
        }
        files.write_text(self._path, json.dumps(entries, indent=1, sort_keys=True, ensure_ascii=False) + "\n")

    def _look(self, path: Path) -> RawFile:
        name = path.relative_to(self._folder).as_posix()
        try:
            found = path.stat()
            known = self._known.get(name, {})
            if not self._verify and (known.get("size"), known.get("mtime_ns")) == (found.st_size, found.st_mtime_ns):
                sha256 = str(known["sha256"])
            else:
                sha256 = _hash(path)
        except FileNotFoundError:
            return RawFile(path, name, 0, 0, MISSING)
        except OSError as error:
            return RawFile(path, name, 0, 0, error.strerror or str(error))
        return RawFile(path, name, found.st_size, found.st_mtime_ns, sha256)


def _hash(path: Path) -> str:
    digest = hashlib.sha256()
    with path.open("rb") as stream:
        while block := stream.read(_BLOCK):
            digest.update(block)
    return digest.hexdigest()


def _known(path: Path) -> dict[str, dict[str, object]]:
    try:
        found = json.loads(path.read_text(encoding="utf-8"))
    except (OSError, ValueError):  # not there yet, or not ours: every file is hashed again
        return {}
    if not isinstance(found, dict):
        return {}
    return {name: entry for name, entry in found.items() if isinstance(entry, dict) and "sha256" in entry}
