"""What the reading of a file may take grows with the file."""

from __future__ import annotations

from pathlib import Path

from colonnade.readers.bounded import bounds


def test_a_long_file_has_more_time_and_memory_up_to_the_machine(tmp_path: Path) -> None:
    short, long = tmp_path / "short", tmp_path / "long"
    short.write_bytes(b"1")
    with long.open("wb") as stream:
        stream.truncate(50_000_000)
    small, large = bounds.bounds_of(short), bounds.bounds_of(short, long)
    assert small.processor == 8
    assert large.processor == 208
    assert small.memory < large.memory <= small.memory + 64 * 50_000_001
    assert bounds.bounds_of(tmp_path / "missing") == bounds.Bounds(bounds.MEMORY, 8, 24)
