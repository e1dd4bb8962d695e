"""The stamp of a page, script or PDF: its last line holds the key of what it was made from, and a hash of the rest."""

from __future__ import annotations

import hashlib
import re
from pathlib import Path

_STAMP = re.compile(rb"(?:<!--|//|%) made from ([0-9a-f]+), content ([0-9a-f]+)(?: -->)?\n\Z")


def stamped(text: str, key: str, *, script: bool = False) -> str:
    """Add to a page of HTML or to a script, which ends in a line break, what it was made from."""
    said = f"made from {key}, content {_hash(text.encode())}"
    return f"{text}// {said}\n" if script else f"{text}<!-- {said} -->\n"


def stamped_pdf(data: bytes, key: str) -> bytes:
    """Add to a PDF, as a comment behind its end, what it was made from."""
    return data + f"% made from {key}, content {_hash(data)}\n".encode()


def key_of(path: Path) -> str:
    """Return the key of what a page or script was made from; empty if it is missing, not stamped, or was altered."""
    try:
        data = path.read_bytes()
    except OSError:
        return ""
    found = _STAMP.search(data[-200:])
    if found is None or found[2].decode() != _hash(data[: -len(found[0])]):
        return ""
    return found[1].decode()


def _hash(data: bytes) -> str:
    return hashlib.sha256(data).hexdigest()
