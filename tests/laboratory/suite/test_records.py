"""A suite of synthetic ground motions: the same by its seed, and read back from its files."""

from __future__ import annotations

import numpy as np
import pytest

from colonnade.assessment.intensity.measured import intensity_measures
from colonnade.laboratory.suite.records import LIST, synthetic_records, write_suite
from colonnade.readers.ground_motions.record_set import read_record_set


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
