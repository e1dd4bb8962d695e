"""Drawn inputs and motions have the stated deviations, and what is exact stays as it is."""

import numpy as np
import pytest
from scipy import stats

from colonnade.dynamics.block import Block
from colonnade.dynamics.motion import Motion
from colonnade.dynamics.uncertainty import INPUTS, MotionDraws, Uncertainty, draw_inputs, member_block
from colonnade.dynamics.uncertainty import member_restitution as restitution_of

BLOCK = Block.measured(mass=80.0, pole_distance=(0.6, 0.61), critical_angle=(0.2, 0.22), inertia=(41.0, 42.0))
DT = 0.005
RECORDED = Motion(np.sin(np.arange(4000) * DT * 2 * np.pi * 3.0) * np.hanning(4000), DT)


def motions(uncertainty, number, **factors):
    draws = MotionDraws(RECORDED, uncertainty)
    given = {"gain": 1.0, "clock": 1.0, "cutoff": 1.0} | factors
    return [draws.draw(np.random.default_rng(seed), **given) for seed in range(number)]


def test_inputs_have_the_stated_deviations():
    stated = Uncertainty(restitution=0.01, critical_angle=0.02, p=0.03, gain=0.005, clock=1e-4, theta0=0.001)
    random = np.random.default_rng(5)
    drawn = np.array([draw_inputs(stated, random) for _ in range(4000)])
    np.testing.assert_allclose(drawn.std(axis=0), stated.deviations, rtol=0.05)
    np.testing.assert_allclose(drawn.mean(axis=0), [0, 1, 1, 1, 1, 1, 0], atol=3e-3)
    assert dict(zip(INPUTS, np.ptp(drawn, axis=0), strict=True))["cutoff"] == 0.0


def test_members_have_the_mean_and_covariance_of_e_alpha_and_p_together():
    """As many as ten thousand: means within 4 standard errors, correlations as well (Fisher)."""
    stated = Uncertainty(restitution=0.002, critical_angle=0.004, p=0.006, correlations=(0.6, -0.3, -0.8))
    random, number = np.random.default_rng(11), 10_000
    drawn = np.array([draw_inputs(stated, random)[:3] for _ in range(number)])
    logarithms = np.column_stack((drawn[:, 0], np.log(drawn[:, 1:])))
    np.testing.assert_allclose(logarithms.mean(axis=0) / stated.deviations[:3], 0.0, atol=4 / number**0.5)
    np.testing.assert_allclose(logarithms.std(axis=0), stated.deviations[:3], rtol=4 / (2 * number) ** 0.5)
    found = np.corrcoef(logarithms.T)[np.triu_indices(3, 1)]
    np.testing.assert_allclose(np.arctanh(found), np.arctanh(stated.correlations), atol=4 / number**0.5)


@pytest.mark.parametrize("freedom", [1, 2, 9])
def test_e_of_few_tests_is_drawn_from_students_t(freedom):
    few, many = (Uncertainty(restitution=0.003, p=0.02, restitution_freedom=each) for each in (freedom, None))
    random, others = np.random.default_rng(6), np.random.default_rng(6)
    drawn, normal = (
        np.array([draw_inputs(each, of) for _ in range(2000)]) for each, of in ((few, random), (many, others))
    )
    assert stats.kstest(drawn[:, 0] / 0.003, stats.t(freedom).cdf).pvalue > 0.01
    np.testing.assert_array_equal(drawn[:, 1:], normal[:, 1:])


def test_a_member_has_the_drawn_angle_and_p_on_both_sides():
    member = member_block(BLOCK, 1.01, 0.98)
    for before, after in ((BLOCK.negative, member.negative), (BLOCK.positive, member.positive)):
        assert after.critical_angle == pytest.approx(1.01 * before.critical_angle, rel=1e-14)
        assert after.pole_distance == before.pole_distance
        assert member.side_p(after) == pytest.approx(0.98 * BLOCK.side_p(before), rel=1e-14)


@pytest.mark.parametrize(
    ("change", "expected"), [(0.01, (0.91, 0.96)), (0.2, (1.0, 1.0)), (-2.0, (0.0, 0.0))], ids=["inside", "one", "zero"]
)
def test_restitution_changes_alike_on_both_sides_and_stays_between_0_and_1(change, expected):
    assert restitution_of((0.9, 0.95), change) == pytest.approx(expected)


def test_an_exact_motion_is_drawn_as_recorded():
    (motion,) = motions(Uncertainty(), 1)
    np.testing.assert_array_equal(motion.acceleration, RECORDED.acceleration)
    assert motion.dt == RECORDED.dt


def test_calibration_and_clock_scale_the_samples_and_the_interval():
    (motion,) = motions(Uncertainty(gain=0.01, clock=1e-4), 1, gain=1.02, clock=1.0001)
    np.testing.assert_allclose(motion.acceleration, 1.02 * RECORDED.acceleration, rtol=1e-14)
    assert motion.dt == 1.0001 * DT


@pytest.mark.parametrize("cutoff", [None, 20.0], ids=["white", "filtered"])
def test_noise_has_the_stated_deviation_at_every_time_and_is_another_in_every_member(cutoff):
    drawn = motions(Uncertainty(noise=0.05, cutoff=cutoff), 300)
    noise = np.array([motion.acceleration for motion in drawn]) - RECORDED.acceleration
    assert noise.std() == pytest.approx(0.05, rel=0.01)
    np.testing.assert_allclose(noise.std(axis=0), 0.05, rtol=0.2)
    between = np.corrcoef(noise[:40])[~np.eye(40, dtype=bool)]
    assert np.abs(between).max() < 0.15


def test_filtered_noise_has_the_filters_spectrum():
    drawn = motions(Uncertainty(noise=0.05, cutoff=20.0), 200)
    noise = np.array([motion.acceleration for motion in drawn]) - RECORDED.acceleration
    power = np.mean(np.abs(np.fft.rfft(noise)) ** 2, axis=0)
    frequency = np.fft.rfftfreq(RECORDED.acceleration.size, DT)

    def mean(low, high):
        return power[(frequency > low) & (frequency < high)].mean()

    assert mean(9, 11) == pytest.approx(mean(2, 4), rel=0.1)
    assert mean(19.5, 20.5) == pytest.approx(mean(2, 4) / 4, rel=0.15)  # half the amplitude at the cut-off
    assert mean(60, 90) < 1e-4 * mean(2, 4)


def test_another_cutoff_is_the_record_filtered_by_it():
    """Against scipy's own zero-phase filter, on a record that was made by it."""
    from scipy.signal import butter, sosfiltfilt

    raw = np.random.default_rng(2).standard_normal(8000) * np.hanning(8000)
    first, second = (sosfiltfilt(butter(4, cutoff, fs=1 / DT, output="sos"), raw) for cutoff in (10.0, 11.0))
    draws = MotionDraws(Motion(first, DT), Uncertainty(cutoff=10.0, filter=0.1))
    drawn = draws.draw(np.random.default_rng(0), gain=1.0, clock=1.0, cutoff=1.1).acceleration
    # The digital filter is bent a little by its sampling (bilinear transform).
    assert np.std(drawn - second) < 0.05 * np.std(second - first)
    same = draws.draw(np.random.default_rng(0), gain=1.0, clock=1.0, cutoff=1.0).acceleration
    np.testing.assert_allclose(same, first, atol=1e-12)


@pytest.mark.parametrize(
    ("given", "found"),
    [
        ({"noise": -1.0}, "noise is -1.0"),
        ({"p": float("nan")}, "p is nan"),
        ({"cutoff": 0.0}, "cutoff is 0.0"),
        ({"restitution_freedom": 0}, "restitution_freedom is 0"),
        ({"filter": 0.1}, "no cutoff is given"),
        ({"correlations": (0.9, 0.9, -0.9)}, "of three quantities"),
    ],
    ids=["negative", "not finite", "no frequency", "no freedom", "no filter", "no correlations"],
)
def test_what_cannot_be_an_uncertainty_is_refused(given, found):
    with pytest.raises(ValueError, match=found):
        Uncertainty(**given)
