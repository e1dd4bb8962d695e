from __future__ import annotations

from itertools import pairwise

import numpy as np
import pytest

from colonnade.dynamics.block import Block
from colonnade.dynamics.motion import Motion
from colonnade.dynamics.rock import rock
from colonnade.identification.restitution.arcs.series import arc_series

BLOCK = Block.measured(mass=80.0, pole_distance=0.61, critical_angle=(0.21, 0.24), inertia=41.2)


@pytest.fixture(scope="module")
def history():
    return rock(BLOCK, Motion(np.zeros(40_000), 2e-4), restitution=0.93, model="nonlinear", theta0=0.15)


def series_of(history, **changed):
    impacts = history.impact_times[:9]
    sides = np.searchsorted(history.time, impacts)
    arcs = [history.angle[slice(*pair)] for pair in pairwise(sides)]
    given = {
        "impact_time": impacts,
        "impact_error": np.full(impacts.size, 1e-4),
        "peak_angle": np.array([arc[np.abs(arc).argmax()] for arc in arcs]),
        "peak_error": np.full(len(arcs), 1e-5),
        "used": np.ones(len(arcs), dtype=bool),
    }
    return arc_series(BLOCK, **(given | changed))


def test_peaks_give_the_speeds_and_durations_of_the_model(history):
    series = series_of(history)
    assert series.speed == pytest.approx(np.abs(history.impact_velocities[1:9]), rel=1e-5)
    assert series.period == pytest.approx(np.zeros(8), abs=1e-5)


@pytest.mark.parametrize("name", ["energy", "period"])
def test_derivatives_by_the_peak_are_those_of_differences(history, name):
    base, step = series_of(history), 1e-6
    signed = base.side * base.peak
    moved = series_of(history, peak_angle=signed + step * base.side)
    sign = 1 if name == "energy" else -1  # `period` falls where the peak would ask for a longer arc
    slope = (getattr(moved, name) - getattr(base, name)) / step
    assert slope == pytest.approx(sign * getattr(base, f"{name}_by_peak"), rel=1e-3)


def test_neighbouring_durations_share_the_error_of_the_impact_between_them(history):
    series = series_of(history)
    covariance = series.covariance()
    durations = covariance[8:, 8:]
    expected = -(1e-4**2) / (series.duration[3] * series.duration[4])
    assert durations[3, 4] == pytest.approx(expected)
    assert durations[3, 5] == 0.0
    assert np.linalg.eigvalsh(covariance).min() > 0


def test_arcs_that_are_not_used_or_not_timed_leave_the_numbers_of_the_others(history):
    times = history.impact_times[:9].copy()
    times[3] = np.nan
    used = np.ones(8, dtype=bool)
    used[6] = False
    series = series_of(history, impact_time=times, used=used)
    assert series.number.tolist() == [0, 1, 4, 5, 7]
    assert np.linalg.eigvalsh(series.covariance()).min() > 0
