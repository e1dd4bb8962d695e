"""Rocking stepped through samples: Housner's periods, energies at impacts, and derivatives as differences have them."""

import numpy as np
import pytest
from scipy.special import ellipkinc

from colonnade.identification.restitution.follower import (
    CRITICAL,
    FIXED,
    MEAN,
    PEAK,
    TILT,
    TIME,
    P,
    follow,
)

ALPHA, RATE = np.array([0.186, 0.19]), np.array([5.6, 5.5])
TIMES = np.arange(0, 14, 0.02 / 5.6)
SHAKEN = 0.02 * np.sin(7 * TIMES)
AT_REST = np.zeros(TIMES.size)
E = 0.95 + 0.005 * np.sin(np.arange(29))


def followed(base=AT_REST, peak=0.1, time=0.9, critical=ALPHA, p=RATE, e=E):
    return follow(TIMES, base, peak, time, 1, e, critical, p)


def test_each_arc_lasts_as_the_elliptic_integral_says():
    found = followed()
    sides = (1 + np.arange(E.size + 1)) % 2
    alpha, p = ALPHA[sides], RATE[sides]
    fallen = np.sin(alpha / 2) ** 2 - np.sin((alpha - found.peaks) / 2) ** 2
    turning = np.sin((alpha - found.peaks) / 2) ** 2
    phase = np.arctan2(np.sqrt(fallen), np.sqrt(turning * (1 - np.sin(alpha / 2) ** 2)))
    half = ellipkinc(phase, 1 - turning) / p
    np.testing.assert_allclose(np.diff(found.ends), 2 * half[1:], rtol=1e-6)
    assert found.ends[0] == pytest.approx(0.9 + half[0], rel=1e-8)


def test_small_arcs_have_housners_quarter_period():  # Housner 1963, eq. 3
    found = followed(peak=0.02 * 0.19, e=np.empty(0))
    assert found.ends[0] - 0.9 == pytest.approx(np.arccosh(1 / (1 - 0.02)) / 5.5, rel=1e-2)


def test_an_impact_keeps_e_times_the_angular_velocity():
    found = followed()
    sides = (1 + np.arange(E.size + 1)) % 2
    alpha, p = ALPHA[sides], RATE[sides]
    after = np.sqrt(2 * p**2 * (np.cos(alpha - found.peaks) - np.cos(alpha)))[1:]
    np.testing.assert_allclose(after, E * found.speeds[:-1], rtol=1e-5)


def test_a_block_that_would_overturn_has_no_further_arcs():
    found = followed(critical=np.array([0.05, 0.19]), peak=0.18)
    assert np.isfinite(found.ends[0])
    assert np.isnan(found.ends[1:]).all()


STEP = 1e-6
SIDES = np.array([-1.0, 1.0])
CHANGES = {
    PEAK: lambda x: {"peak": 0.1 + x},
    TIME: lambda x: {"time": 0.9 + x},
    CRITICAL: lambda x: {"critical": ALPHA * np.exp(x)},
    TILT: lambda x: {"critical": ALPHA * np.exp(x * SIDES)},
    P: lambda x: {"p": RATE * np.exp(x)},
    MEAN: lambda x: {"e": E * np.exp(x)},
    FIXED: lambda x: {"e": E * np.exp(x * (np.arange(E.size) == 0))},
    FIXED + 7: lambda x: {"e": E * np.exp(x * (np.arange(E.size) == 7))},
}


@pytest.mark.parametrize("base", [AT_REST, SHAKEN], ids=["table at rest", "moving table"])
def test_derivatives_are_those_of_differences(base):
    found = followed(base)
    by_start = (found.local[:, :2, None] * found.starts[found.arc]).sum(axis=1)
    by_start[:, [CRITICAL, P]] += found.local[:, 2:]
    by_start[:, TILT] += np.where((1 + found.arc) % 2, 1.0, -1.0) * found.local[:, 2]
    columns = np.where(found.arc >= 0, by_start.T, 0.0)
    for unknown, change in CHANGES.items():
        ahead, behind = followed(base, **change(STEP)), followed(base, **change(-STEP))
        same = (ahead.arc == behind.arc) & (ahead.arc >= 0)
        differences = ((ahead.angle - behind.angle) / (2 * STEP))[same]
        np.testing.assert_allclose(columns[unknown, same], differences, atol=1e-6 * np.abs(columns[unknown]).max())
