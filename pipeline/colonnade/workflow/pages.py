"""The report's pages as they were written: which of them are gone or were altered since."""

from __future__ import annotations

import hashlib
import json
from collections.abc import Iterable
from pathlib import Path
from typing import Any

from colonnade.store import files
from colonnade.store.layout import Layout


class WrittenPages:
    """
    What the report was made from, with size, time and SHA-256 of each of its pages.

    Parameters
    ----------
    layout : Layout
    verify : bool, optional
        Read every page whatever its size and time.
    """

    def __init__(self, layout: Layout, *, verify: bool = False) -> None:
        self._layout, self._verify = layout, verify
        try:
            known = json.loads(layout.report_key.read_text(encoding="utf-8"))
        except (OSError, ValueError, RecursionError):
            known = None
        self._known: dict[str, Any] = known if isinstance(known, dict) else {}

    def show(self, key: str) -> bool:
        """Whether all pages are there as they were written, and were made from this."""
        return self._known.get("key") == key and bool(self._pages) and not self._altered

    def remove_altered(self) -> None:
        """Remove the pages that are not as they were written, so that they are drawn again."""
        for address in self._altered:
            files.remove(self._path(address))

    def save(self, key: str, addresses: Iterable[str]) -> None:
        """Keep what the pages at these addresses within the report were made from, and how they are now."""
        pages = {address: [*_mark(path := self._path(address)), _sha256(path)] for address in addresses}
        files.write_text(self._layout.report_key, json.dumps({"key": key, "pages": pages}, indent=1) + "\n")

    @property
    def _pages(self) -> dict[str, Any]:
        pages = self._known.get("pages")
        return pages if isinstance(pages, dict) else {}

    @property
    def _altered(self) -> list[str]:
        return [address for address, known in self._pages.items() if not self._is_whole(self._path(address), known)]

    def _is_whole(self, path: Path, known: Any) -> bool:
        if not (isinstance(known, list) and len(known) == 3):
            return False
        try:
            size, time = _mark(path)
            return known[0] == size and ((known[1] == time and not self._verify) or known[2] == _sha256(path))
        except OSError:
            return False

    def _path(self, address: str) -> Path:
        return self._layout.report.parent / address


def _mark(path: Path) -> list[int]:
    status = path.stat()
    return [status.st_size, status.st_mtime_ns]


def _sha256(path: Path) -> str:
    return hashlib.sha256(path.read_bytes()).hexdigest()
