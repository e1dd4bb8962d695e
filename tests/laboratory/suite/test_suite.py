"""A suite of synthetic ground motions: drawn parameters, each motion, its files and the site that they shake."""

from __future__ import annotations

import math

import numpy as np
import pytest
import scipy

from colonnade.assessment.measures import intensity_measures
from colonnade.dynamics.motion import Motion
from colonnade.laboratory.suite.motion import broad_band, pulse
from colonnade.laboratory.suite.parameters import CORRELATION, FLATTEST, STEEPEST, Shaking, drawn_shaking, shaking_of
from colonnade.laboratory.suite.records import LIST, synthetic_records, write_suite
from colonnade.readers.ground_motions.record_set import read_record_set

SHAKING = Shaking(arias=0.8, duration=9.0, middle=5.0, frequency=4.0, slope=-0.2, damping=0.2)
STEP = 0.02
SEEDS = range(12)


@pytest.fixture(scope="module")
def made():
    return [broad_band(SHAKING, STEP, np.random.default_rng(seed)) for seed in SEEDS]


def test_it_has_its_arias_intensity_and_in_the_mean_its_duration(made):
    found = [intensity_measures(Motion(each, STEP), measures=["arias", "d5_95"]).values for each in made]
    assert [each["arias"] for each in found] == pytest.approx([0.8] * len(made), rel=1e-9)
    assert np.mean([each["d5_95"] for each in found]) == pytest.approx(9.0, rel=0.1)


def test_half_its_energy_comes_when_it_should(made):
    middles = []
    for each in made:
        energy = np.cumsum(each**2)
        middles.append(STEP * np.searchsorted(energy, 0.45 * energy[-1]))
    assert np.mean(middles) == pytest.approx(5.0, rel=0.1)


def test_its_frequency_falls_with_time(made):
    def rate(part):
        return np.mean([np.sum(each[part][1:] * each[part][:-1] < 0) / 2 / (STEP * each[part].size) for each in made])

    early, late = rate(slice(round(1.5 / STEP), round(4.5 / STEP))), rate(slice(round(8 / STEP), round(12 / STEP)))
    # The filter is at 4.4 Hz in the middle of the first part, and at 3 Hz in that of the second.
    assert early == pytest.approx(4.4, rel=0.2)
    assert late == pytest.approx(3.0, rel=0.2)


def test_it_comes_to_rest(made):
    assert max(intensity_measures(Motion(each, STEP), measures=["pgv"]).drift for each in made) < 0.01


def test_a_pulse_has_its_velocity():
    time = np.arange(0, 12, 0.002)
    velocity = scipy.integrate.cumulative_trapezoid(pulse(0.7, 2.5, 2.0, 0.0, 6.0, time), time, initial=0.0)
    assert velocity.max() == pytest.approx(0.7, rel=1e-4)
    assert time[velocity.argmax()] == pytest.approx(6.0, abs=0.01)
    assert abs(velocity[-1]) < 1e-4


def test_at_zero_every_parameter_is_its_median():
    found = shaking_of(np.zeros(6))
    # ∫ a² dt in g² s has the median exp(−4.8255); π/2 g turns it into an Arias intensity.
    assert found.arias == pytest.approx(math.pi / 2 * 9.81 * math.exp(-4.8255))
    assert found.duration == pytest.approx(5 + 40 * scipy.stats.beta.median(1.1314, 2.4474))
    assert found.frequency == pytest.approx(scipy.stats.gamma.median(4.0982, scale=1.4330))
    assert -0.1 < found.slope < -0.03


def test_extremes_stay_within_their_bounds():
    low, high = shaking_of(np.full(6, -6.0)), shaking_of(np.full(6, 6.0))
    assert low.slope == pytest.approx(STEEPEST, abs=0.3)
    assert high.slope <= FLATTEST
    assert 5.0 <= low.duration < high.duration <= 45.0
    assert 0.02 <= low.damping < high.damping <= 1.0
    assert all(each.middle < each.duration for each in (low, high))


def test_the_two_sided_exponential_distribution_is_that_of_its_density():
    shares = np.linspace(0.02, 0.98, 25)
    slopes = [shaking_of(np.array([0, 0, 0, 0, scipy.stats.norm.ppf(share), 0])).slope for share in shares]

    def density(slope):
        return 4.8512 * math.exp(6.7729 * slope if slope < 0 else -17.095 * slope)

    found = [scipy.integrate.quad(density, STEEPEST, slope, points=[0.0])[0] for slope in slopes]
    np.testing.assert_allclose(found, shares, atol=2e-4)


def test_a_stronger_and_a_nearer_earthquake_shakes_more():
    def median(magnitude, distance):
        random = np.random.default_rng(0)
        return np.median([drawn_shaking(magnitude, distance, random).arias for _ in range(51)])

    # ln I_A is 1.4318 times a normal variable that grows by 2.944 M/7 and falls by 1.3564 ln R.
    assert median(7.5, 20e3) / median(6.5, 20e3) == pytest.approx(math.exp(1.4318 * 2.944 / 7))
    assert median(7.0, 10e3) / median(7.0, 40e3) == pytest.approx(4 ** (1.4318 * 1.3564))


def test_the_correlations_are_those_of_a_covariance():
    np.testing.assert_array_equal(CORRELATION, CORRELATION.T)
    assert np.linalg.eigvalsh(CORRELATION).min() > 0


@pytest.fixture(scope="module")
def suite():
    return synthetic_records(3, seed=4)


def test_a_record_is_the_same_whatever_the_count(suite):
    alone = synthetic_records(1, seed=4)[0]
    np.testing.assert_array_equal(alone.motion.acceleration, suite[0].motion.acceleration)
    assert synthetic_records(1, seed=5)[0].motion.peak != alone.motion.peak


def test_every_third_has_a_pulse_that_is_found(suite):
    assert [each.pulse_period is not None for each in suite] == [False, False, True]
    found = intensity_measures(suite[2].motion, measures=["pulse_period", "pulse_indicator"])
    assert found.values["pulse_period"] == pytest.approx(suite[2].pulse_period, rel=0.4)
    assert all(intensity_measures(each.motion, measures=["pgv"]).reasons == {} for each in suite)


def test_the_files_and_their_list_are_read_back(suite, tmp_path):
    path = write_suite(tmp_path / "records", suite)
    assert path == tmp_path / "records" / LIST
    found = read_record_set(path)
    assert [each.name for each in found.records] == [each.name for each in suite]
    for read, made in zip(found.records, suite, strict=True):
        np.testing.assert_allclose(read.motion.acceleration, made.motion.acceleration, atol=1e-6)
        assert read.motion.dt == made.motion.dt
        assert read.magnitude == pytest.approx(made.magnitude, abs=0.01)
        assert read.distance == pytest.approx(made.distance, abs=100)
    assert found.left_out == ()
    assert all(each.name.startswith("synthetic") for each in found.records)
