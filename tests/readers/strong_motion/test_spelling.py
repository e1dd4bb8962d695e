"""Units of the networks: spelled as everywhere, or as they are."""

from __future__ import annotations

import pytest

from colonnade.readers.strong_motion.spelling import spelled


@pytest.mark.parametrize(
    ("written", "usual"),
    [("CM/S/S", "cm/s^2"), ("cm/sec", "cm/s"), ("G", "g"), ("g/10", "g/10"), ("Furlong", "furlong")],
)
def test_a_unit_is_spelled_as_usual(written: str, usual: str) -> None:
    assert spelled(written) == usual
