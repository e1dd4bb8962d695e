"""Free rocking by its unknowns, e of each impact, and rocking on a table that moves."""

from dataclasses import replace
from math import acosh, sqrt

import numpy as np
import pytest

from colonnade.dynamics.block import Block
from colonnade.identification.restitution.arcs.energy import released_energy
from colonnade.identification.restitution.fitting.driven_decay import BaseMotion, DrivenDecay
from colonnade.identification.restitution.fitting.forecast import stretch_of
from colonnade.identification.restitution.fitting.free_decay import ALWAYS, OPTIONAL, Decay, first_values
from colonnade.identification.restitution.fitting.least_squares import UnfollowedError, blur
from colonnade.identification.restitution.fitting.rocking_path import RockingPath, fit_path, fit_path_forward
from colonnade.identification.restitution.fitting.samples import AngleSamples
from colonnade.identification.restitution.identify import identify_restitution
from colonnade.laboratory.truth import Integration
from prism import PRISM

LOPSIDED = Block.measured(mass=80.0, pole_distance=0.61, critical_angle=(0.21, 0.15), inertia=41.2)
E = 0.92


def test_peaks_follow_housners_relation_on_both_models(known):
    """1 − φ = sqrt(1 − e² [1 − (1 − φ₀)²]) of the linear model."""
    decay = known(linearised=True).decay
    peaks = decay.arcs()[0] / decay.critical[0]
    np.testing.assert_allclose((1 - (1 - peaks) ** 2) / 0.75, E ** (2 * np.arange(8)), rtol=1e-12)


def test_sides_alternate_and_each_has_its_own_block():
    values = {
        "restitution": np.log(0.9),
        "peak": 0.05,
        "time": 0.0,
        "zero_offset": 0.01,
        **dict.fromkeys(OPTIONAL, 0.0),
    }
    decay = Decay(values, 0, 3, LOPSIDED, True)
    np.testing.assert_allclose(decay.critical, [0.21, 0.15])
    assert decay.sides.tolist() == [0, 1, 0]
    angle, arc = decay.followed(decay.arcs()[1])
    np.testing.assert_allclose(angle, 0.01 + np.array([-1, 1, -1]) * decay.arcs()[0], rtol=1e-12)
    assert arc.tolist() == [0, 1, 2]
    assert decay.arcs()[2][0] == pytest.approx(acosh(0.21 / (0.21 - 0.05)) / decay.p[0], rel=1e-12)


def test_each_impact_may_have_an_e_of_its_own(known):
    plain, other = known(), known(deviations=[0.01, -0.02])
    first, second = (released_energy(each.decay.arcs()[0], each.decay.critical[0]) for each in (plain, other))
    lift = np.exp(2 * np.array([0.0, 0.01, -0.01, -0.01, -0.01, -0.01, -0.01, -0.01]))
    np.testing.assert_allclose(second / first, lift, rtol=1e-12)
    np.testing.assert_allclose(other.decay.by_impact, [0.01, -0.02, 0, 0, 0, 0, 0])


@pytest.mark.parametrize("linearised", [False, True])
def test_its_derivatives_are_those_of_differences(known, linearised):
    decay, samples = known(linearised=linearised, deviations=[0.01, -0.02])
    names = ALWAYS + OPTIONAL
    fixed, by_impact = decay.jacobian(samples.time, names)
    for column, name in enumerate(names):
        step = 1e-6
        ahead, behind = (decay.moved({name: sign * step}).angle_alone(samples.time) for sign in (1, -1))
        assert_close(fixed[:, column], (ahead - behind) / (2 * step))
    for impact in range(decay.count - 1):
        step = 1e-6 * (np.arange(decay.count - 1) == impact)
        ahead, behind = (decay.moved_by_impact({}, sign * step).angle_alone(samples.time) for sign in (1, -1))
        assert_close(by_impact[:, impact], (ahead - behind) / 2e-6)


def assert_close(found, expected):
    """Hold derivatives together; a sample next to an impact is on either side of it in the difference."""
    assert np.quantile(np.abs(found - expected), 0.99) < 1e-4 * np.abs(expected).max()


def test_it_starts_from_the_e_of_the_peaks():
    energy = 0.75 * E ** (2 * np.arange(6))
    found = first_values(energy, np.sqrt(energy), peak=0.1, time=2.0)
    assert found["restitution"] == pytest.approx(np.log(E), rel=1e-12)
    assert (found["peak"], found["time"], found["p"], found["zero_offset"]) == (0.1, 2.0, 0.0, 0.0)


@pytest.mark.parametrize(("ratio", "limit"), [(1.2, 0.9999), (0.01, 0.3)])
def test_an_e_that_cannot_be_starts_from_the_nearest_that_can(ratio, limit):
    found = first_values(ratio ** np.arange(5.0), np.ones(5), peak=sqrt(0.1), time=0.0)
    assert found["restitution"] == pytest.approx(np.log(limit))


OWN = 0.004 * np.array([0.5, -1.0, 0.3, 1.2, -0.8, 0.4, -0.6])


def noisy(known, **given):
    truth = known(deviations=OWN, **given)
    noise = np.random.default_rng(2).normal(0.0, 1e-6, truth.samples.time.size)
    return truth, replace(truth.samples, angle=truth.samples.angle + noise)


def test_the_e_of_each_impact_is_found(known):
    truth, samples = noisy(known)
    start = RockingPath(replace(truth.decay, deviations=np.empty(0)))
    found = fit_path(start, stretch_of(samples, truth.decay), ALWAYS, 4e-3)
    logarithms = found.decay.values["restitution"] + found.decay.by_impact
    np.testing.assert_allclose(logarithms, truth.decay.values["restitution"] + OWN, atol=1e-4)


def test_without_scatter_all_impacts_have_one_e(known):
    truth, samples = noisy(known)
    found = fit_path(RockingPath(truth.decay), stretch_of(samples, truth.decay), ALWAYS, 1e-9)
    assert np.abs(found.decay.by_impact).max() < 1e-6


def test_a_zero_that_drifts_is_told_from_the_offset(known):
    truth, samples = noisy(known)
    stretch = stretch_of(samples, truth.decay)
    drifting = np.linspace(-0.5, 0.5, stretch.time.size) * 2e-4
    found = fit_path(RockingPath(truth.decay), replace(stretch, angle=stretch.angle + drifting), ALWAYS, 4e-3)
    assert found.drift == pytest.approx(2e-4, rel=0.02)
    assert found.decay.values["zero_offset"] == pytest.approx(0.0, abs=2e-6)


def test_it_is_seen_through_the_low_pass_of_the_record(known):
    truth, samples = noisy(known)
    stretch = stretch_of(samples, truth.decay, cutoff_hz=20.0)
    path = RockingPath(truth.decay, 1e-4)
    sharp = truth.decay.angle_alone(stretch.time)
    clock = (stretch.time - stretch.time[0]) / (stretch.time[-1] - stretch.time[0]) - 0.5
    np.testing.assert_allclose(path.seen(stretch), sharp + blur(truth.decay, stretch) + 1e-4 * clock, atol=1e-15)


def test_a_record_is_followed_forward_to_its_end(known):
    own = np.random.default_rng(5).normal(0.0, 3e-3, 23)
    truth = known(count=24, deviations=own)
    noise = np.random.default_rng(6).normal(0.0, 1e-5, truth.samples.time.size)
    samples = AngleSamples(truth.samples.time, truth.samples.angle + noise, 0.01)
    start = RockingPath(replace(truth.decay, count=5, deviations=np.empty(0)))
    found = fit_path_forward(samples, start, 1e-4)
    assert found.decay.count >= 22
    logarithms = (found.decay.values["restitution"] + found.decay.by_impact)[:15]
    np.testing.assert_allclose(logarithms, truth.decay.values["restitution"] + own[:15], atol=1e-3)


def test_a_path_that_overturns_is_refused(known):
    truth, samples = noisy(known)
    stretch = stretch_of(samples, truth.decay)
    with pytest.raises(UnfollowedError):
        fit_path(RockingPath(truth.decay.moved({"peak": 0.2})), stretch, ALWAYS, 1e-3)


ALPHA = PRISM.critical_angle
STEP = 0.002
TIME = np.arange(0.0, 7.0, STEP)
DRIVEN_E = 0.93
VALUES = {"restitution": np.log(DRIVEN_E), "peak": 0.5 * ALPHA, "time": 0.3, "zero_offset": 1e-3 * ALPHA}
DECAY = Decay(VALUES | {"critical_angle": 0.0, "p": 0.0}, 1, 12, PRISM, linearised=False)


def shaken(amplitude, frequency, phase=0.0, restitution=DRIVEN_E):
    """Base acceleration, m/s², and the angle by the laboratory's own adaptive integration of it."""

    def acceleration(instant):
        return amplitude * PRISM.gravity * ALPHA * np.sin(2 * np.pi * frequency * instant + phase)

    run = Integration(PRISM, TIME, restitution, np.pi / 2, 0.6 * ALPHA)
    run.move_to(0.5)
    run.release(0.6 * ALPHA, 0.0)
    run.go(0.5, float(TIME[-1]), acceleration)
    return acceleration(TIME), run.angles


def test_on_a_table_at_rest_it_is_free_rocking():
    driven = DrivenDecay.of(DECAY, BaseMotion(np.zeros(50), 0.0, 0.1))
    time = np.linspace(0.1, 0.999 * DECAY.arcs()[2][-1], 2000)
    np.testing.assert_allclose(driven.followed(time)[0], DECAY.followed(time)[0], rtol=0, atol=1e-7 * ALPHA)
    for ours, theirs in zip(driven.jacobian(time, ALWAYS), DECAY.jacobian(time, ALWAYS), strict=True):
        # One sample may lie within the difference about a corner.
        assert np.quantile(np.abs(ours - theirs), 0.999) < 1e-4 * np.abs(theirs).max()


def test_a_moving_table_is_followed_as_another_integrator_does():
    _, angle = shaken(0.05, 1.3)
    # Linear between samples: with steps this fine it is a sine.
    fine = 0.05 * ALPHA * np.sin(2 * np.pi * 1.3 * np.arange(0.0, 7.0, STEP / 10))
    start = Decay(DECAY.values | {"peak": 0.6 * ALPHA, "time": 0.5, "zero_offset": 0.0}, 1, 12, PRISM, False)
    driven = DrivenDecay.of(start, BaseMotion(fine, 0.0, STEP / 10))
    last = driven.arcs()[2][-1]
    inside = (TIME >= 0.5) & (last > TIME)
    np.testing.assert_allclose(driven.followed(TIME[inside])[0], angle[inside], rtol=0, atol=1e-5 * ALPHA)


@pytest.mark.parametrize(("frequency", "phase"), [(1.3, 1.0), (3.0, 2.0)])
def test_its_recorded_acceleration_drives_the_identification(frequency, phase):
    acceleration, angle = shaken(0.05, frequency, phase)
    random = np.random.default_rng(4)
    angle = angle + random.normal(0.0, 5e-4 * ALPHA, TIME.size)
    recorded = acceleration + random.normal(0.0, 0.005, TIME.size)
    result = identify_restitution(TIME, angle, PRISM, base_acceleration=recorded)
    assert result.low <= DRIVEN_E <= result.high
    assert result.high - result.low < 2e-3
    assert result.recommended == "history-scatter"
    blind = identify_restitution(TIME, angle, PRISM)
    assert blind.value is None
    assert "the table moves" in blind.reason
    assert "moving table" in {each.name for each in blind.departures}


def test_a_table_at_rest_with_a_noisy_accelerometer_changes_nothing():
    _, angle = shaken(0.0, 1.0)
    random = np.random.default_rng(5)
    angle = angle + random.normal(0.0, 5e-4 * ALPHA, TIME.size)
    recorded = random.normal(0.0, 0.02, TIME.size)
    assert identify_restitution(TIME, angle, PRISM, base_acceleration=recorded).value == pytest.approx(
        identify_restitution(TIME, angle, PRISM).value, abs=1e-12
    )


def test_a_moving_table_with_samples_missing_is_refused_with_the_reason():
    acceleration, angle = shaken(0.05, 1.3)
    acceleration[100:120] = np.nan
    result = identify_restitution(TIME, angle, PRISM, base_acceleration=acceleration)
    assert result.value is None
    assert "missing 20 of 3500 samples" in result.reason


@pytest.mark.parametrize("amplitude", [0.03, 0.05, 0.1])
def test_a_table_that_moves_is_not_taken_for_noise(amplitude):
    acceleration, angle = shaken(amplitude, 1.3, 1.0)
    random = np.random.default_rng(7)
    angle = angle + random.normal(0.0, 5e-4 * ALPHA, TIME.size)
    noisy = acceleration + random.normal(0.0, 0.05, TIME.size)
    result = identify_restitution(TIME, angle, PRISM, base_acceleration=noisy)
    assert result.recommended in ("", "history-scatter")
    assert result.value is None or result.low <= DRIVEN_E <= result.high
    for wrong in (-acceleration, random.normal(0.0, 0.2, TIME.size)):
        assert identify_restitution(TIME, angle, PRISM, base_acceleration=wrong).value is None
