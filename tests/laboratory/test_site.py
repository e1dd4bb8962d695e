"""The site of a virtual campaign: motions of known strength, columns and questions that load, a hazard that falls."""

import math

import numpy as np
import pytest

from colonnade.assessment.measures import intensity_measures
from colonnade.dynamics.motion import Motion
from colonnade.laboratory import site
from colonnade.laboratory.site import LIST, LOWEST, broad_band, synthetic_records
from colonnade.readers.record_set import read_record_set

STEP = 0.02


@pytest.fixture(scope="module")
def made():
    return [broad_band(0.8, 9.0, 6.0, STEP, np.random.default_rng(seed)) for seed in range(12)]


def test_it_has_its_arias_intensity_and_in_the_mean_its_duration(made):
    found = [intensity_measures(Motion(each, STEP), measures=["arias", "d5_95"]).values for each in made]
    assert [each["arias"] for each in found] == pytest.approx([0.8] * len(made), rel=1e-9)
    assert np.mean([each["d5_95"] for each in found]) == pytest.approx(9.0, rel=0.1)


def test_its_energy_is_in_its_band_and_it_comes_to_rest(made):
    power = np.mean([np.abs(np.fft.rfft(each, 4096)) ** 2 for each in made], axis=0)
    frequency = np.fft.rfftfreq(4096, STEP)
    inside = (frequency > LOWEST) & (frequency < 6.0)
    assert power[inside].sum() / power.sum() > 0.8
    assert power[frequency < LOWEST / 4].max() < 0.05 * power[inside].mean()

    assert max(intensity_measures(Motion(each, STEP), measures=["pgv"]).drift for each in made) < 0.01


def test_a_stronger_and_a_nearer_earthquake_shakes_more():
    """ln I_A is 1.432 times a normal variable that grows by 2.944 M/7, falls by 1.356 ln R and scatters by 0.65."""
    records = [each for each in synthetic_records(90, seed=2) if each.pulse_period is None]
    arias = [intensity_measures(each.motion, measures=["arias"]).values["arias"] for each in records]
    terms = np.array([[1.0, each.magnitude, math.log(each.distance)] for each in records])
    slopes, left, *_ = np.linalg.lstsq(terms, np.log(arias), rcond=None)
    errors = np.sqrt(left[0] / (len(records) - 3) * np.diag(np.linalg.inv(terms.T @ terms)))
    np.testing.assert_array_less(np.abs(slopes[1:] - 1.432 * np.array([2.944 / 7, -1.356])), 3 * errors[1:])
    assert np.sqrt(left[0] / len(records)) == pytest.approx(1.432 * 0.65, rel=0.3)


@pytest.fixture(scope="module")
def suite():
    return synthetic_records(3, seed=4)


def test_a_record_is_the_same_whatever_the_count_and_every_third_has_a_pulse(suite):
    alone = synthetic_records(1, seed=4)[0]
    np.testing.assert_array_equal(alone.motion.acceleration, suite[0].motion.acceleration)
    assert synthetic_records(1, seed=5)[0].motion.peak != alone.motion.peak
    assert [each.pulse_period is not None for each in suite] == [False, False, True]
    assert all(intensity_measures(each.motion, measures=["pgv"]).reasons == {} for each in suite)


def test_the_files_and_their_list_are_read_back(suite, tmp_path):
    path = site.write_suite(tmp_path / "records", suite)
    assert path == tmp_path / "records" / LIST
    found = read_record_set(path)
    assert [each.name for each in found.records] == [each.name for each in suite]
    for read, made in zip(found.records, suite, strict=True):
        np.testing.assert_allclose(read.motion.acceleration, made.motion.acceleration, atol=1e-6)
        assert read.motion.dt == made.motion.dt
        assert read.magnitude == pytest.approx(made.magnitude, abs=0.01)
        assert read.distance == pytest.approx(made.distance, abs=100)
    assert found.left_out == {}
    assert all(each.name.startswith("synthetic") for each in found.records)
