"""Levels of a harmonic motion on its ramps."""

from __future__ import annotations

import pytest

from colonnade.dynamics.plane.harmonic.envelope import level_at, piece_between


@pytest.mark.parametrize(("smooth", "middle", "slope"), [(None, 1.0, 0.5), (True, 1.0, 0.785398)])
def test_a_ramp_goes_from_level_to_level(smooth, middle, slope):
    ramp = piece_between(0.0, 2.0, 4.0, smooth)
    assert [level_at(ramp, since)[0] for since in (0.0, 2.0, 4.0)] == pytest.approx([0.0, middle, 2.0])
    assert level_at(ramp, 2.0)[1] == pytest.approx(slope, rel=1e-6)


def test_a_constant_level_has_no_slope():
    assert level_at(piece_between(2.0, 2.0, 4.0, True), 1.0) == (2.0, 0.0)
