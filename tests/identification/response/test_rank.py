"""Runs as they would have been measured, and the measured one among them."""

from dataclasses import replace

import numpy as np
import pytest

from colonnade.identification.response.rank import FEWEST, Measurement, as_measured, distances, is_within, rank
from colonnade.signals.filters import lowpass


def histories(random, number, *, length=60):
    """Histories that drift apart, some of them suddenly: their errors are neither normal nor independent."""
    steps = random.standard_normal((number, length)) * np.linspace(0.1, 1.0, length)
    late = random.uniform(size=(number, 1)) < 0.1
    return np.cumsum(steps, axis=1) + late * np.where(np.arange(length) > 40, 25.0, 0.0)


@pytest.mark.parametrize("members", [20, 59])
def test_a_true_model_is_called_outside_as_often_as_it_is_said(members):
    random = np.random.default_rng(members)
    drawn = [histories(random, members + 1) for _ in range(1500)]
    ranks = [rank(*distances(each[0], each[1:])) for each in drawn]
    nominal = (np.floor(0.95 * members) + 1) / (members + 1)
    allowed = 3.0 * np.sqrt(nominal * (1 - nominal) / len(ranks))
    assert np.mean([is_within(each) for each in ranks]) == pytest.approx(nominal, abs=allowed)
    assert np.mean(ranks) == pytest.approx(0.5, abs=3 * np.sqrt(1 / 12 / len(ranks)))


def test_each_history_is_measured_by_the_median_and_band_of_all_others():
    everyone = histories(np.random.default_rng(5), 31)
    measured, members = distances(everyone[0], everyone[1:])
    for number, expected in enumerate((measured, *members)):
        low, middle, high = np.quantile(np.delete(everyone, number, axis=0), (0.025, 0.5, 0.975), axis=0)
        deviation = everyone[number] - middle
        half = np.where(deviation > 0, high - middle, middle - low)
        assert expected == pytest.approx((np.abs(deviation) / half).max(), rel=1e-9)


def test_a_history_that_leaves_the_runs_for_a_moment_is_outside():
    random = np.random.default_rng(7)
    everyone = histories(random, 101)
    everyone[0, 20] += 8.0
    assert not is_within(rank(*distances(everyone[0], everyone[1:])))


def test_missing_samples_of_the_measured_history_count_for_none():
    everyone = histories(np.random.default_rng(8), 41)
    gap = everyone[0].copy()
    gap[10:20] = np.nan
    found, short = (
        distances(gap, everyone[1:]),
        distances(*(np.delete(each, np.s_[10:20], -1) for each in (gap, everyone[1:]))),
    )
    assert found[0] == short[0]
    np.testing.assert_array_equal(found[1], short[1])


def test_equal_distances_count_by_half():
    assert rank(1.0, np.array([0.5, 1.0, 1.0, 2.0])) == 0.5


def test_without_a_rank_there_is_no_verdict():
    assert is_within(float("nan")) is None
    everyone = histories(np.random.default_rng(9), FEWEST + 1)
    assert distances(everyone[0], everyone[1:]) is not None
    assert distances(everyone[0], everyone[2:]) is None
    assert distances(np.full(60, np.nan), everyone[1:]) is None


RUNS, LENGTH, INTERVAL = 400, 500, 0.004
EXACT = Measurement(INTERVAL, gain=0.0, zero=0.0, noise=0.0, drift=np.zeros(LENGTH), cutoff_hz=None)
TIME = np.arange(LENGTH) * INTERVAL
HISTORIES = np.tile(0.1 * np.cos(2 * np.pi * 2.0 * TIME), (RUNS, 1)).astype(np.float32)


def recorded(measurement, histories=HISTORIES, starts=None):
    starts = np.zeros(len(histories)) if starts is None else starts
    return as_measured(histories, starts, measurement, np.random.default_rng(1))


def test_without_errors_the_runs_are_recorded_as_they_are():
    np.testing.assert_array_equal(recorded(EXACT), HISTORIES)


@pytest.mark.parametrize("cutoff", [None, 20.0], ids=["unfiltered", "filtered"])
def test_noise_has_its_deviation_and_is_filtered(cutoff):
    noise = recorded(replace(EXACT, noise=1e-3, cutoff_hz=cutoff)) - recorded(replace(EXACT, cutoff_hz=cutoff))
    assert noise.std() == pytest.approx(1e-3, rel=0.02)
    neighbours = np.corrcoef(noise[:, :-1].ravel(), noise[:, 1:].ravel())[0, 1]
    assert neighbours > 0.8 if cutoff else abs(neighbours) < 0.02


def test_gain_and_zero_are_one_draw_a_run():
    found = recorded(replace(EXACT, gain=0.01, zero=2e-3))
    slope, level = np.polyfit(HISTORIES[0].astype(float), found.T, 1)
    assert slope.std() == pytest.approx(0.01, rel=0.15)
    assert level.std() == pytest.approx(2e-3, rel=0.15)
    np.testing.assert_allclose(found, slope[:, None] * HISTORIES + level[:, None], atol=1e-6)


def test_an_error_that_grows_is_one_draw_times_its_deviation():
    growing = 1e-3 * TIME
    found = recorded(replace(EXACT, drift=growing)) - HISTORIES
    assert found[:, -1].std() == pytest.approx(growing[-1], rel=0.15)
    np.testing.assert_allclose(found[:, 250] / growing[250], found[:, -1] / growing[-1], rtol=1e-3)


def test_a_run_that_began_higher_has_the_calibration_that_explains_it():
    start, gain, zero = 0.1, 0.01, 5e-4
    released = replace(EXACT, gain=gain, zero=zero, start=start, start_error=2e-4)
    starts = np.random.default_rng(2).normal(0.0, released.start_deviation, RUNS)
    histories = (HISTORIES + starts[:, None] * np.cos(2 * np.pi * 2.0 * TIME)).astype(np.float32)
    found = recorded(released, histories, starts)
    # All are read to begin at the measured start, but for what is unknown of it beside.
    assert (found[:, 0] - start).std() == pytest.approx(2e-4, rel=0.2)
    slope = np.polyfit(starts, found[:, 0], 1)[0]
    assert abs(slope) < 0.1
    assert released.start_deviation == pytest.approx(np.sqrt((gain * start) ** 2 + zero**2 + 2e-4**2))


def test_a_release_is_filtered_as_a_record_that_began_before():
    """Even about its peak, the history before the start is its mirror image."""
    whole = 0.1 * np.cos(2 * np.pi * 2.0 * np.arange(-LENGTH + 1, LENGTH) * INTERVAL)
    expected = lowpass(whole, INTERVAL, 15.0)[LENGTH - 1 :]
    found = recorded(replace(EXACT, cutoff_hz=15.0), HISTORIES[:1])[0]
    np.testing.assert_allclose(found[:-100], expected[:-100], atol=1e-6)


def test_every_second_sample_has_the_errors_of_every_second_sample():
    half = replace(EXACT, drift=TIME).thinned(10, 2)
    assert half.interval == 2 * INTERVAL
    np.testing.assert_array_equal(half.drift, TIME[10::2])


def test_many_runs_are_filtered_together_as_one_record_is_alone():
    histories = np.cumsum(np.random.default_rng(3).standard_normal((7, LENGTH)), axis=1).astype(np.float32)
    found = recorded(replace(EXACT, cutoff_hz=15.0, filter_order=3), histories)
    memory = int(3 * 3 / (15.0 * INTERVAL))
    mirrored = np.concatenate((histories[:, memory:0:-1], histories), axis=1).astype(float)
    np.testing.assert_allclose(found, lowpass(mirrored, INTERVAL, 15.0, 3)[:, memory:], rtol=1e-12, atol=1e-12)
