"""When a block at rest uplifts under a harmonic motion, held against a fine scan, and under a sampled one."""

from __future__ import annotations

import math

import numpy as np
import pytest

from colonnade.dynamics.plane.harmonic.envelope import level_at, piece_between
from colonnade.dynamics.plane.uplift import harmonic_uplift, level_uplift, sampled_uplift
from every import every

TIME = np.linspace(0.0, 4.0, 400_001)


@every("smooth", [None, True])
@every("levels", [(0.5, 0.5), (0.0, 0.5), (0.5, 0.0), (0.1, 0.25)])
@every("phase", [0.0, 2.0, 4.0])
def test_uplift_is_where_a_scan_first_passes_a_threshold(smooth, levels, phase):
    piece = piece_between(*levels, 4.0, smooth)
    level = np.array([level_at(piece, since)[0] for since in TIME[::100]])
    base = np.interp(TIME, TIME[::100], level) * np.sin(7.0 * TIME + phase)
    first = int(np.argmax((base > 0.2) | (-base > 0.22)))
    instant, side = harmonic_uplift(0.0, 4.0, 0.0, 7.0, phase, piece, 0.2, 0.22)
    assert instant == pytest.approx(TIME[first], abs=2e-5)
    assert side == -np.sign(base[first])


def test_a_weak_motion_leaves_the_block_at_rest():
    assert harmonic_uplift(0.0, 4.0, 0.0, 7.0, 0.0, piece_between(0.0, 0.1, 4.0, None), 0.2, 0.2) == (math.inf, 0.0)


@pytest.mark.parametrize(
    ("base", "expected"),
    [((0.1, 0.3), (0.5, 0)), ((-0.1, -0.4), (0.5, 1)), ((0.25, 0.0), (0.0, 0)), ((0.2, -0.25), (math.inf, 0))],
    ids=["rises past one threshold", "falls past the other", "begins beyond", "stays within"],
)
def test_sampled_uplift_is_where_the_moment_or_the_base_acceleration_passes_its_threshold(base, expected):
    thresholds = np.array([0.2, 0.25])
    first, last = ((level - thresholds[0], -level - thresholds[1]) for level in base)
    level = level_uplift(0.0, 1.0, base[0], base[1] - base[0], thresholds)
    assert level == pytest.approx(expected)
    assert sampled_uplift(0.0, 1.0, first, last) == pytest.approx(expected)
