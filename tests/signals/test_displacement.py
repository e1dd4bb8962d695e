"""The displacement of a table from its acceleration."""

from __future__ import annotations

import numpy as np
import pytest

from colonnade.signals.displacement import displacement


def test_a_motion_that_begins_and_ends_at_rest_comes_out_of_its_acceleration_and_an_offset():
    time = np.arange(0, 20, 0.002)
    moved = 0.01 * np.sin(2 * np.pi * 2.0 * time) * np.exp(-(((time - 10) / 3) ** 2))
    acceleration = np.gradient(np.gradient(moved, time), time)
    np.testing.assert_allclose(displacement(time, 0.05 + acceleration), moved, atol=2e-4)


@pytest.mark.parametrize("count", [1, 5])
def test_too_short_a_record_stands_still(count):
    assert not displacement(np.arange(count) / 100, np.ones(count)).any()
