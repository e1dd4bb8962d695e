"""
Whether a result, a record or a page is up to date, by what it is made from, never by dates; and if not, why.

A result keeps that as attributes. A page, script, picture or PDF has a stamp: a comment behind its end with the key of
what it was made from, and a hash of the rest.
"""

from __future__ import annotations

import hashlib
import json
import re
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from colonnade.store.provenance import hash_of

NEVER_RUN = "never run"

_CONTENT = 2
"""Counts up when `content_hash` takes in something else: all results are then recomputed."""


@dataclass(frozen=True)
class Recipe:
    """
    All that something is made from: a result, a record of the summary, or a page of the report.

    Attributes
    ----------
    stage : str
        Name of the stage that makes it.
    code : str
        Hash of the code of that stage, see `sources.code_hash`.
    settings : str
        What it reads of the campaign, as text; of a result as JSON.
    upstream : mapping of str to str
        Hash of each result or raw file that it reads; None for a missing one.
    """

    stage: str
    code: str
    settings: str
    upstream: Mapping[str, str | None]

    @property
    def key(self) -> str:
        """Hash that is stored with the result; if it differs, the result is out of date."""
        return hash_of({"stage": self.stage, "content": _CONTENT, **self._ingredients})

    @property
    def _ingredients(self) -> dict[str, Any]:
        return {"code": self.code, "settings": hash_of(self.settings), "upstream": dict(self.upstream)}

    @property
    def attributes(self) -> dict[str, str]:
        """What is stored with the result, so that `why` can say what changed since."""
        ingredients = json.dumps(self._ingredients, sort_keys=True)
        return {"key": self.key, "ingredients": ingredients, "settings": self.settings}

    def why(self, stored: Mapping[str, Any]) -> str:
        """
        Say why a result has to be recomputed.

        Parameters
        ----------
        stored : mapping
            The attributes that are stored with it; empty if it is missing or damaged.

        Returns
        -------
        because : str
            "never run", "raw file changed", "upstream changed", "settings changed" or "code changed"; empty if it is
            up to date.
        """
        if stored.get("key") == self.key:
            return ""
        try:
            before = json.loads(stored.get("ingredients", ""))
        except ValueError:
            return NEVER_RUN
        if before.get("upstream") != self.upstream:
            return "raw file changed" if self.stage == "ingest" else "upstream changed"
        return "settings changed" if before.get("settings") != hash_of(self.settings) else "code changed"


_STAMP = re.compile(rb"(?:<!--|//|%) made from ([0-9a-f]+), content ([0-9a-f]+)(?: -->)?\n\Z")

_COMMENTS = {".html": "<!-- {} -->\n", ".svg": "<!-- {} -->\n", ".js": "// {}\n", ".jpg": "% {}\n", ".pdf": "% {}\n"}
"""How a comment is written behind the end of a file, by its suffix."""


def stamped(data: bytes, key: str, suffix: str) -> bytes:
    """Add to what a file of this suffix holds what it was made from."""
    return data + _COMMENTS[suffix].format(f"made from {key}, content {hashlib.sha256(data).hexdigest()}").encode()


def key_of(path: Path) -> str:
    """Return the key of what a file was made from; empty if it is missing, not stamped, or was altered."""
    try:
        data = path.read_bytes()
    except OSError:
        return ""
    found = _STAMP.search(data[-200:])
    if found is None or found[2].decode() != hashlib.sha256(data[: -len(found[0])]).hexdigest():
        return ""
    return found[1].decode()
