import numpy as np
import pytest

from colonnade.dynamics.motion import Motion


def test_motion_knows_its_clock_and_peak():
    motion = Motion([0.0, -2.0, 1.0], 0.5)
    assert motion.time.tolist() == [0.0, 0.5, 1.0]
    assert motion.duration == 1.0
    assert motion.peak == 2.0


@pytest.mark.parametrize(
    ("acceleration", "dt", "words"),
    [
        ([], 0.1, "at least one sample"),
        ([[1.0]], 0.1, "one-dimensional"),
        ([1.0, np.nan], 0.1, "sample 1"),
        ([1.0], 0.0, "dt is"),
    ],
)
def test_a_record_that_cannot_be_a_motion_is_refused_with_the_place(acceleration, dt, words):
    with pytest.raises(ValueError, match=words):
        Motion(acceleration, dt)


def test_a_vertical_record_of_another_length_is_refused():
    with pytest.raises(ValueError, match="vertical has 2 samples; 3 were expected"):
        Motion([0.0, 1.0, 2.0], 0.1, vertical=[0.0, 1.0])


def test_a_motion_says_how_long_and_how_strong_it_is():
    motion = Motion([0.0, -2.0, 1.0], 0.01, vertical=[0.0, 0.5, 0.0])
    assert repr(motion) == "<Motion: duration 0.02 s, interval 0.01 s, max |a| 2 m/s², components along x, vertical>"
