"""The whole history: the truth within its interval, and no consistency where the block is another."""

from functools import cache
from types import SimpleNamespace

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.signal import lfilter

from colonnade.identification.restitution.estimators.history import LinearHistory, NonlinearHistory, fitted_history
from colonnade.identification.restitution.fitting.noise import fit_noise
from colonnade.identification.restitution.fitting.samples import thinned
from colonnade.identification.restitution.free_vibration import FreeVibration
from colonnade.signals.filters import lowpass
from prism import PRISM

ALPHA, P = PRISM.critical_angle, PRISM.p
RATE = 500.0
NOISE = 1e-3 * ALPHA


def test_a_record_that_begins_late_in_its_clock_overflows_nothing():
    names = ("restitution", "release")
    late = SimpleNamespace(values={"restitution": np.log(0.95), "release": 86400.0})
    stretch = SimpleNamespace(time=np.zeros(1), cutoff_hz=None)
    with np.errstate(over="raise"):
        fitted = fitted_history(late, stretch, np.zeros(1), np.zeros(1), np.eye(2), names)
    assert fitted.values.tolist() == pytest.approx([0.95, 86400.0])


@cache
def decay(restitution, released=0.6, duration=8.0, block=PRISM, linear=False):
    """Release at t = 0, by an adaptive integrator from impact to impact."""
    time = np.arange(-0.4, duration, 1 / RATE)
    angle = np.full(time.size, released * block.critical_angle)
    start, state, side = 0.0, [released * block.critical_angle, 0.0], 1.0
    while start < duration and abs(state[0]) + abs(state[1]) > 1e-4:
        landing = lambda t, y: y[0]  # noqa: E731
        landing.terminal, landing.direction = True, -side
        bend = (lambda x: x) if linear else np.sin
        solution = solve_ivp(
            lambda t, y, s=side, f=bend: [y[1], -(block.p**2) * f(block.critical_angle * s - y[0])],
            (start, duration), state, method="DOP853", rtol=1e-11, atol=1e-13, events=landing, dense_output=True,
        )  # fmt: skip
        inside = (time >= start) & (time < solution.t[-1])
        angle[inside] = solution.sol(time[inside])[0] if inside.any() else 0.0
        start, side, state = solution.t[-1], -side, [0.0, restitution * solution.y[1, -1]]
    angle[time >= start] = 0.0
    return time, angle


def fitted(time, angle, block=PRISM, estimator=NonlinearHistory, **settings):
    samples = thinned(time, angle, block)
    return estimator().fit(FreeVibration.seen(samples, block, lowest_amplitude=0.02, noise=None, **settings))


@pytest.mark.parametrize("estimator", [LinearHistory, NonlinearHistory])
@pytest.mark.parametrize("restitution", [0.8, 0.93, 0.99])
def test_the_truth_is_found_by_the_model_that_made_it(estimator, restitution):
    time, angle = decay(restitution, linear=estimator is LinearHistory)
    fit = fitted(time, angle + 3e-4 * ALPHA, estimator=estimator)
    assert fit.estimate.value == pytest.approx(restitution, abs=1e-6)
    assert fit.decay.values["zero_offset"] == pytest.approx(3e-4 * ALPHA, abs=1e-6 * ALPHA)


def test_an_e_above_the_rigid_bodys_is_not_held_back():
    time, angle = decay(0.99)
    fit = fitted(time, angle + np.random.default_rng(0).normal(0, NOISE, time.size))
    assert fit.estimate.low > PRISM.restitution == pytest.approx(0.9485, abs=1e-4)


def white(rng, angle):
    return angle + rng.normal(0, NOISE, angle.size)


def filtered(rng, angle):
    return lowpass(white(rng, angle), 1 / RATE, 25.0)


@cache
def fits(kind, given=None):
    """Fits of one true history under forty seeds of a noise."""
    time, angle = decay(0.92, duration=5.0)
    return [fitted(time, kind(np.random.default_rng(seed), angle), lowpass=given) for seed in range(40)]


@pytest.mark.parametrize(
    ("kind", "given"),
    [(white, None), (filtered, None), (filtered, 25.0)],
    ids=["white noise", "low-passed, not told", "low-passed, told"],
)
def test_intervals_hold_the_truth_as_often_as_they_say(kind, given):
    found = fits(kind, given)
    errors = np.array([(fit.estimate.value - 0.92) / fit.estimate.standard_error for fit in found])
    assert sum(fit.estimate.low <= 0.92 <= fit.estimate.high for fit in found) >= 34
    assert 0.7 < errors.std() < 1.35
    assert abs(errors.mean()) < 0.6
    assert sum(fit.is_consistent for fit in found) >= 38


def test_the_cutoff_that_rounded_the_corners_is_found():
    histories = [fit.fitted for fit in fits(filtered)]
    cutoffs = [fit_noise(each.residual, each.time[1] - each.time[0]).cutoff_hz for each in histories]
    assert np.median(cutoffs) == pytest.approx(25.0, rel=0.1)


def test_the_error_is_that_of_the_cramer_rao_bound():
    time, _ = decay(0.92, duration=5.0)
    fit = fits(white)[0]
    inside = (time >= fit.fitted.time[0]) & (time <= fit.fitted.time[-1])
    steps = {"restitution": 1e-4, "peak": 1e-4 * ALPHA, "time": 1e-4, "zero_offset": 1e-4 * ALPHA}
    columns = []
    for name, step in steps.items():
        high, low = (fit.decay.moved({name: sign * step}).angle_alone(time[inside]) for sign in (1, -1))
        columns.append((high - low) / (2 * step))
    sensitivity = np.column_stack(columns)
    bound = NOISE * np.sqrt(np.linalg.inv(sensitivity.T @ sensitivity)[0, 0]) * 0.92
    assert np.mean([each.estimate.standard_error for each in fits(white)]) == pytest.approx(bound, rel=0.05)


def test_noise_that_lasts_for_arcs_is_no_noise_and_widens_the_interval():
    time, angle = decay(0.92, duration=5.0)
    memory = np.exp(-1 / (0.5 * RATE))
    found = []
    for seed in range(12):
        slow = lfilter([1.0], [1, -memory], np.random.default_rng(seed).normal(0, 1, time.size))
        found.append(fitted(time, white(np.random.default_rng(seed), angle) + 3e-3 * ALPHA * slow / slow.std()))
    assert sum(fit.is_consistent for fit in found) <= 2
    errors = [fit.estimate.standard_error for fit in found]
    assert np.mean(errors) > 3 * np.mean([fit.estimate.standard_error for fit in fits(white)])
    assert np.std([fit.estimate.value for fit in found]) < 2 * np.mean(errors)


@pytest.mark.parametrize(("factor", "consistent"), [(1.0, True), (1.05, False)])
def test_a_wrong_inertia_is_not_consistent_until_p_is_freed(factor, consistent):
    time, angle = decay(0.976)
    seen = white(np.random.default_rng(3), angle)
    assumed = PRISM.override(inertia=factor * PRISM.inertia)
    assert fitted(time, seen, assumed).is_consistent == consistent
    freed = fitted(time, seen, assumed, free=("p",))
    assert freed.is_consistent
    assert freed.estimate.low <= 0.976 <= freed.estimate.high
    place = freed.fitted.names.index("p")
    assert freed.fitted.values[place] == pytest.approx(
        np.sqrt(factor), abs=4 * np.sqrt(freed.fitted.covariance[place, place])
    )


def test_worn_edges_are_found_as_a_smaller_critical_angle():
    worn = PRISM.override(critical_angle=0.95 * ALPHA)
    time, angle = decay(0.976, block=worn)
    fit = fitted(time, white(np.random.default_rng(1), angle), free=("critical_angle",))
    place = fit.fitted.names.index("critical_angle")
    assert fit.fitted.values[place] == pytest.approx(0.95, abs=4 * np.sqrt(fit.fitted.covariance[place, place]))
    assert fit.estimate.value == pytest.approx(0.976, abs=4 * fit.estimate.standard_error)


def test_missing_samples_are_passed_over():
    time, angle = decay(0.95)
    seen = white(np.random.default_rng(4), angle)
    seen[1000:1040] = np.nan
    fit = fitted(time, seen)
    assert fit.estimate.low <= 0.95 <= fit.estimate.high


def test_a_clock_that_is_uneven_is_followed_too():
    time, angle = decay(0.95)
    rng = np.random.default_rng(5)
    keep = np.sort(rng.choice(time.size, time.size // 2, replace=False))
    fit = fitted(time[keep], white(rng, angle)[keep])
    assert fit.estimate.value == pytest.approx(0.95, abs=4 * fit.estimate.standard_error)


def test_what_cannot_be_followed_has_a_reason_and_no_value():
    time, angle = decay(0.95)
    few = fitted(time[time < 1.0], angle[time < 1.0])
    assert few.estimate.value is None
    assert "needed" in few.estimate.reason
