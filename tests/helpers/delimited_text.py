"""Text written to a file and read as delimited."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from colonnade.readers.recording import Recording
from colonnade.readers.registry import read


def recorded(tmp_path: Path, text: str, **options: Any) -> Recording:
    path = tmp_path / "record.csv"
    path.write_bytes(text.encode())
    return read(path, "delimited", options)


def values(recording: Recording, column: str | int) -> list[float]:
    return recording.channel(column).values.tolist()
