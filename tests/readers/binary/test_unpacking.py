"""What comes out of a compressed file is counted, and refused before it is too much."""

from __future__ import annotations

import pytest

from colonnade.readers.binary.unpacking import LARGEST, Unpacking, UnreadableError, swollen


def test_a_small_file_may_unpack_to_a_large_part_and_a_large_one_to_more() -> None:
    assert not swollen(LARGEST, 10)
    assert not swollen(100 * LARGEST, LARGEST)


def test_all_that_came_out_of_a_file_counts_and_what_was_refused_does_not() -> None:
    unpacking = Unpacking(10)
    unpacking.take(LARGEST - 1)
    with pytest.raises(UnreadableError, match="more than 100 times as many: it is not unpacked"):
        unpacking.take(2)
    unpacking.take(1)
