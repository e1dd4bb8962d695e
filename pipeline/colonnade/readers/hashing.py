"""What files hash to, before and after they are read."""

from __future__ import annotations

import hashlib
from pathlib import Path

from colonnade.readers.irregular import irregular


def sha256_of(path: Path) -> str | None:
    """
    Hash the content of a file.

    Parameters
    ----------
    path : Path

    Returns
    -------
    digest : str or None
        SHA-256 in hexadecimal digits. None if there is no such file, it cannot be read, or it is a pipe, a device or a
        folder, which is never opened: reading it says why.
    """
    try:
        if irregular(path):
            return None
        with path.open("rb") as stream:
            return hashlib.file_digest(stream, "sha256").hexdigest()
    except OSError:
        return None
