"""Bounds tell of a piece whether the block comes down, or that they cannot tell."""

from __future__ import annotations

import pytest

from colonnade.dynamics.plane.landing import verdict


@pytest.mark.parametrize(
    ("start", "end", "told"),
    [
        ((1.0, 0.1, -0.2, 0.0), (0.9, -0.3, -0.2, 0.0), 1),
        ((0.1, -0.5, -0.1, 0.0), (-0.4, -0.6, -0.1, 0.0), -1),
        ((0.01, -0.5, 5.0, 0.0), (0.02, 0.5, 5.0, 0.0), 0),
    ],
    ids=["high above", "falls through", "close to the base"],
)
def test_a_verdict_on_a_piece(start, end, told):
    assert verdict(1.0, start, end, 0.1, 0.1) == told
