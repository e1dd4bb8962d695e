"""What hostile files share: where they are, what they would read, and what they would make."""

import os
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

SECRET = 31337.25 + np.arange(100.0)
"""Values that are in no raw file, but in files beside the campaign's folder."""
SWOLLEN = 1 << 28
"""Bytes that a small file unpacks to."""
TIME = np.arange(200) / 100
COUNTS = np.arange(200, dtype="i2")


class Hostile(NamedTuple):
    """A file, and how it is to be read."""

    path: Path
    format: str | None = None
    options: dict[str, Any] | None = None


class Place(NamedTuple):
    """Where a file is written, what it would read, and what it would make."""

    folder: Path
    secrets: Path
    victim: Path


class Program:
    """What a pickle may hold."""

    def __init__(self, victim):
        self.victim = victim

    def __reduce__(self):
        return os.mkdir, (str(self.victim),)


def secrets(folder):
    """Write what must not be read."""
    import h5py

    folder.mkdir()
    (folder / "secret").write_bytes(SECRET.astype("<i4").tobytes())
    (folder / "secret.txt").write_text("\n".join(map(str, SECRET)), encoding="ascii")
    with h5py.File(folder / "secret.h5", "w") as file:
        file["x"] = SECRET
