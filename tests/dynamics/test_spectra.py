"""The rocking spectrum of a recorded motion."""

import math

import numpy as np
import pytest

from colonnade.dynamics.block import Block
from colonnade.dynamics.motion import Motion
from colonnade.dynamics.rock import rock
from colonnade.dynamics.spectra import rocking_spectrum

TIME = np.linspace(0, 1.0, 1001)
PULSE = Motion(4.0 * np.sin(4 * np.pi * TIME), 0.001)


@pytest.mark.parametrize("model", ["linear", "nonlinear"])
def test_each_entry_is_the_peak_of_that_rectangular_block(model):
    spectrum = rocking_spectrum(PULSE, critical_angle=[0.25], period=[12.0], model=model)
    p = 2 * math.pi / 12.0
    radius = 0.75 * 9.81 / p**2
    block = Block.prism(
        width=2 * radius * math.sin(0.25), depth=1.0, height=2 * radius * math.cos(0.25), mass=7.0, gravity=9.81
    )
    assert block.p == pytest.approx(p)
    history = rock(block, PULSE, model=model)
    assert spectrum.peak_ratio[0, 0] == pytest.approx(history.peak_ratio, rel=1e-9)


def test_stocky_blocks_stay_and_small_slender_ones_overturn():
    spectrum = rocking_spectrum(PULSE, critical_angle=[0.15, 0.25, 0.5], period=[0.5, 3.0, 30.0])
    assert spectrum.peak_ratio[2].tolist() == [0, 0, 0]
    assert spectrum.overturned[0, 0]
    assert math.isnan(spectrum.peak_ratio[0, 0])
    assert not spectrum.overturned[:, 2].any()
    assert np.nanmax(spectrum.peak_ratio[1]) > 0.1


def test_larger_blocks_of_one_slenderness_rock_less_under_a_pulse():
    spectrum = rocking_spectrum(PULSE, critical_angle=[0.25], period=[2.0, 4.0, 6.0, 9.0])
    assert (np.diff(spectrum.peak_ratio[0]) < 0).all()


def test_a_vertical_motion_uplifts_a_block_that_the_horizontal_one_alone_does_not():
    lifted = Motion(1.9 * np.sin(4 * np.pi * TIME), 0.001, vertical=-4.0 * np.ones(TIME.size))
    angles, periods = [0.25], [2.0]
    assert rocking_spectrum(Motion(lifted.acceleration, 0.001), critical_angle=angles, period=periods).peak_ratio == 0.0
    assert rocking_spectrum(lifted, critical_angle=angles, period=periods).peak_ratio > 0.01


@pytest.mark.parametrize(("period", "angle"), [(0.0, 0.2), (1.0, 2.0)])
def test_impossible_blocks_are_clear_errors(period, angle):
    with pytest.raises(ValueError, match=r"period is 0.0|critical_angle is 2.0"):
        rocking_spectrum(PULSE, critical_angle=[angle], period=[period])
