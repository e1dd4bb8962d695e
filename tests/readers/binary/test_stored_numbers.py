"""Numbers at a place in a file: scaled, with gaps between them, cut off, or nowhere."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from colonnade.readers.binary.stored_numbers import StoredNumbers, read_stored, values_at

CONTENT = np.frombuffer(np.arange(12, dtype="<i2").tobytes(), dtype=np.uint8)
EVERY_THIRD = StoredNumbers("top", "mm", "", "<i2", first=2, count=4, stride=6, offset=10.0, factor=0.5)


def test_numbers_are_taken_at_their_stride_and_scaled() -> None:
    values, warnings = values_at(CONTENT, EVERY_THIRD)
    assert values.tolist() == [10.5, 12.0, 13.5, 15.0]
    assert warnings == []


@pytest.mark.parametrize(
    ("change", "there"),
    [({"count": 9}, 4), ({"end": 10}, 2), ({"first": 400}, 0), ({"first": -2}, 0)],
    ids=["more than the file", "more than the block", "behind the file", "before the file"],
)
def test_numbers_that_are_not_there_are_told(change: dict[str, int], there: int) -> None:
    values, warnings = values_at(CONTENT, replace(EVERY_THIRD, **change))
    assert values.size == there
    assert warnings == [f'"top": the file ends after {there} of its {change.get("count", 4)} values']


def test_a_channel_that_is_not_stored_rises_evenly(tmp_path: Path) -> None:
    even = StoredNumbers("x", "", "", "<f8", 0, 10, 8, offset=1.0, factor=2.0)
    assert read_stored(tmp_path / "header", even, longest=3)[0].tolist() == [1, 3, 5]


def test_a_file_without_bytes_has_no_values(tmp_path: Path) -> None:
    (tmp_path / "bytes").touch()
    values, warnings = read_stored(tmp_path / "header", replace(EVERY_THIRD, file="bytes"), longest=4)
    assert values.size == 0
    assert warnings == ['"top": bytes ends after 0 of its 4 values']
