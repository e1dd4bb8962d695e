from __future__ import annotations

import numpy as np
import pytest

from colonnade.identification.restitution.arcs.energy import angle_of_energy, released_energy
from colonnade.identification.restitution.fitting.confidence_band import confidence_band
from prism import PRISM

NUMBER = np.arange(20)
TRUTH = np.log(0.7) + 2 * np.log(0.96) * NUMBER
ERROR = np.full(NUMBER.size, 2e-4)


def peaks(seed):
    angle = np.asarray(angle_of_energy(np.exp(TRUTH), PRISM.critical_angle)) * (-1.0) ** NUMBER
    return angle + ERROR * np.random.default_rng(seed).normal(size=NUMBER.size)


def line(angle):
    """The line with its offset by plain weighted least squares, of tests' own."""
    size = np.abs(angle)
    energy = np.log(released_energy(size, PRISM.critical_angle))
    slope = np.sin(PRISM.critical_angle - size) / (np.cos(PRISM.critical_angle - size) - np.cos(PRISM.critical_angle))
    design = np.column_stack((np.ones(NUMBER.size), NUMBER, np.sign(angle) * slope))
    weight = 1 / (slope * ERROR)
    solved = np.linalg.lstsq(design * weight[:, None], energy * weight, rcond=None)[0]
    return solved[0] + solved[1] * NUMBER


def test_the_band_holds_the_true_line_as_often_as_it_says():
    inside = []
    for seed in range(100):
        angle = peaks(seed)
        half = confidence_band(angle, ERROR, np.ones(NUMBER.size, dtype=bool), PRISM)
        inside.append(np.abs(line(angle) - TRUTH) < half)
    assert 0.92 < np.mean(inside) <= 0.995


def test_the_band_is_narrow_within_the_peaks_used_and_widens_beyond_them():
    used = (NUMBER >= 2) & (NUMBER < 12)
    half = confidence_band(peaks(0), ERROR, used, PRISM)
    assert half[used].max() < half[-1]
    wider = confidence_band(peaks(0), ERROR, used, PRISM, level=0.999)
    assert (wider > half).all()


@pytest.mark.parametrize("count", [0, 2, 3])
def test_too_few_peaks_have_no_band(count):
    half = confidence_band(peaks(0), ERROR, count > NUMBER, PRISM)
    assert np.isnan(half).all()
    assert half.shape == NUMBER.shape
