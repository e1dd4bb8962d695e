"""Free rocking in closed form against an adaptive integrator; its series against the model."""

from itertools import pairwise

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from colonnade.dynamics.block import Block
from colonnade.dynamics.motion import Motion
from colonnade.dynamics.rock import rock
from colonnade.identification.restitution.arcs.rocking_arc import (
    angle_and_sensitivity,
    angle_of_arcs,
    free_arcs,
    half_duration,
    kinetic,
    peak_of,
)
from colonnade.identification.restitution.arcs.series import arc_series
from every import every

P = 5.6


@every("critical", [0.08, 0.19, 0.32, 1.0], ids=lambda value: f"α = {value:g}")
@every("share", [0.03, 0.3, 0.9, 0.999])
def test_an_arc_is_that_of_the_full_equation(critical, share):
    peak = share * critical
    landing = lambda t, y: y[0]  # noqa: E731
    landing.terminal = True
    truth = solve_ivp(
        lambda t, y: [y[1], -np.sin(critical - y[0])], (0, 40), [peak, 0.0],
        method="DOP853", rtol=1e-12, atol=1e-14, events=landing, dense_output=True,
    )  # fmt: skip
    half = half_duration(peak, critical, False)
    assert half == pytest.approx(truth.t[-1], abs=1e-10)
    assert kinetic(peak, critical, False) == pytest.approx(truth.y[1, -1] ** 2 / 2, rel=1e-9)
    assert peak_of(kinetic(peak, critical, False), critical, False) == pytest.approx(peak, rel=1e-12)
    time = np.linspace(0, half, 40)
    arc = (np.array([peak]), np.array([0.0]), np.array([half / P]), 1, 0.0, np.full(2, critical), np.full(2, P), False)
    np.testing.assert_allclose(angle_of_arcs(time / P, *arc), truth.sol(time)[0], atol=1e-11)


@pytest.mark.parametrize("amplitude", [0.1, 0.5, 0.9])
def test_the_linear_arc_has_housners_quarter_period(amplitude):  # Housner 1963, eq. 3
    assert half_duration(0.2 * amplitude, 0.2, True) == pytest.approx(np.arccosh(1 / (1 - amplitude)))
    assert kinetic(0.2 * amplitude, 0.2, True) == pytest.approx(0.02 * (1 - (1 - amplitude) ** 2))


@pytest.mark.parametrize("linearised", [False, True], ids=["nonlinear", "linear"])
def test_sensitivities_are_those_of_differences(linearised):
    time, critical, p = np.linspace(0.01, 0.3, 60), np.full(2, 0.19), np.full(2, P)

    def angle(peak=0.1, at=0.1, offset=1e-3, by_critical=0.0, by_p=0.0):
        scaled = critical * np.exp(by_critical), p * np.exp(by_p)
        ends = np.array([9.0])
        return angle_and_sensitivity(time, np.array([peak]), np.array([at]), ends, 0, offset, *scaled, linearised)

    _, sensitivity, _ = angle()
    steps = [("peak", 0.1), ("at", 0.1), ("offset", 1e-3), ("by_critical", 0.0), ("by_p", 0.0)]
    for column, (name, value) in enumerate(steps):
        high, low = (angle(**{name: value + sign * 1e-6})[0] for sign in (1, -1))
        np.testing.assert_allclose(sensitivity[:, column], (high - low) / 2e-6, atol=2e-5)


def test_two_sides_keep_the_ratio_of_velocities():
    critical, p = np.array([0.15, 0.2]), np.array([5.0, 6.0])
    peaks, times, ends = free_arcs(np.full(3, 0.9), 0.05, 0.0, 1, critical, p, 4, False)
    side = [1, 0, 1, 0]
    speed = [p[s] * np.sqrt(2 * kinetic(peak, critical[s], False)) for s, peak in zip(side, peaks, strict=True)]
    np.testing.assert_allclose(np.diff(np.log(speed)), np.log(0.9), rtol=1e-12)
    assert (ends[:-1] < times[1:]).all()


def test_a_block_that_overturns_after_an_impact_has_no_further_arcs():
    critical = np.array([0.05, 0.2])
    peaks, _, _ = free_arcs(np.full(2, 0.95), 0.15, 0.0, 1, critical, np.full(2, P), 3, False)
    assert np.isfinite(peaks).tolist() == [True, False, False]


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
