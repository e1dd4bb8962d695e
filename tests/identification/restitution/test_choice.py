"""Arguments of an identification, which estimate is recommended, and tests pooled."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy import stats

from colonnade.identification.restitution.choice import choose
from colonnade.identification.restitution.estimators.history_scatter import ScatteredFit
from colonnade.identification.restitution.estimators.peaks import PeakFit
from colonnade.identification.restitution.fitting.free_decay import Decay
from colonnade.identification.restitution.identify import check_records, check_settings
from colonnade.identification.restitution.pooling import pool
from colonnade.identification.restitution.result import Estimate
from every import every
from prism import PRISM

SETTINGS = {"block": PRISM, "level": 0.95, "lowest_amplitude": 0.02, "noise": None, "lowpass": None, "free": ()}
TIME = np.arange(5.0)


def settings(**changed):
    given = SETTINGS | changed
    return check_settings(given.pop("block"), **given)


@pytest.mark.parametrize("free", [(), ("p",), ["p", "critical_angle"]])
def test_what_is_freed_comes_back_as_a_tuple(free):
    assert settings(free=free) == tuple(free)


@every(
    ("changed", "said"),
    [
        ({"block": "prism"}, "block"),
        ({"level": 1.0}, "level"),
        ({"level": "95 %"}, "level"),
        ({"lowest_amplitude": -0.1}, "lowest_amplitude"),
        ({"noise": -1e-5}, "noise"),
        ({"lowpass": 0.0}, "lowpass"),
        ({"free": "p"}, "free is"),
        ({"free": ("restitution",)}, "free names 'restitution'"),
    ],
)
def test_a_setting_out_of_its_range_is_named(changed, said):
    with pytest.raises(ValueError, match=said):
        settings(**changed)


def test_records_become_arrays_and_gaps_stay():
    times, angles = check_records(TIME.tolist(), [0, 1, np.nan, 3, 4], slide=np.zeros(5), uplift=None)
    assert times.dtype == angles.dtype == np.float64
    assert np.isnan(angles[2])


@pytest.mark.parametrize(
    ("time", "angle", "others", "said"),
    [
        (TIME, TIME[:4], {}, r"time has shape \(5,\) and angle \(4,\)"),
        (TIME, TIME, {"slide": TIME[:2]}, r"and slide \(2,\)"),
        (TIME[::-1], TIME, {}, "time does not increase after sample 0"),
        ([0, 1, 1, 2, 3], TIME, {}, "time does not increase after sample 1"),
        (["a"] * 5, TIME, {}, "time"),
    ],
)
def test_records_that_do_not_belong_together_are_refused(time, angle, others, said):
    with pytest.raises(ValueError, match=said):
        check_records(time, angle, **others)


DECAY = Decay({}, 1, 10, PRISM, linearised=False)
PEAKS = Estimate("peaks", 0.951, 0.949, 0.953, 0.001, 0.95, "")
WHOLE = Estimate("history-scatter", 0.95, 0.9498, 0.9502, 1e-4, 0.95, "")


def history(estimate=WHOLE, probability=0.4):
    return ScatteredFit(estimate, None, DECAY, probability)


def chosen_of(history, peaks):
    return choose([history, PeakFit(peaks)])


def test_a_consistent_whole_history_is_recommended():
    assert chosen_of(history(), PEAKS) == (WHOLE, "")


def test_an_inconsistent_one_gives_way_to_the_peaks():
    assert chosen_of(history(probability=1e-4), replace(PEAKS, standard_error=5e-4))[0].name == "peaks"
    assert chosen_of(history(replace(WHOLE, value=0.9), 1e-4), PEAKS)[0].name == "peaks"


def test_an_inconsistent_one_that_agrees_with_poor_peaks_is_widened():
    chosen, _ = chosen_of(history(probability=1e-4), replace(PEAKS, standard_error=0.004))
    assert chosen.name == "history-scatter"
    assert chosen.standard_error > 0.02 * (1 - 0.95)
    assert chosen.low < WHOLE.low


@pytest.mark.parametrize(
    ("whole", "words"),
    [
        (replace(WHOLE, high=1.001), "does not decay"),
        (replace(WHOLE, standard_error=0.004), "standard error of 0.004"),
    ],
    ids=["no decay", "too uncertain"],
)
def test_what_gives_no_value_has_a_reason(whole, words):
    chosen, reason = chosen_of(history(whole), PEAKS)
    assert chosen is None
    assert words in reason


def test_neither_history_nor_peaks_is_a_refusal_with_both_reasons():
    without = Estimate("peaks", None, None, None, None, 0.95, "", "3 peaks are too few.")
    refused = ScatteredFit(replace(without, name="history-scatter", reason="No arcs."))
    chosen, reason = chosen_of(refused, without)
    assert chosen is None
    assert "3 peaks are too few." in reason
    assert "No arcs." in reason


def test_agreeing_tests_are_weighted_by_their_errors():
    pooled = pool([0.976, 0.977], [0.001, 0.002])
    assert pooled.value == pytest.approx((0.976 * 4 + 0.977) / 5)
    assert pooled.between == 0.0


def test_one_test_keeps_its_own_interval():
    pooled = pool([0.976], [0.001])
    assert (pooled.low, pooled.high) == pytest.approx((0.976 - 0.00196, 0.976 + 0.00196), abs=1e-6)


def test_scatter_between_tests_is_found_apart_from_their_errors():
    rng = np.random.default_rng(0)
    pooled = pool(rng.normal(0.95, 0.005, 400) + rng.normal(0, 0.001, 400), np.full(400, 0.001))
    assert pooled.between == pytest.approx(0.005, rel=0.1)
    assert abs(pooled.value - 0.95) < 3 * pooled.standard_error


def test_intervals_of_three_tests_hold_the_truth_as_often_as_they_say():
    rng = np.random.default_rng(1)
    held = 0
    for _ in range(400):
        error = rng.uniform(2e-4, 6e-4, 3)
        pooled = pool(0.976 + rng.normal(0, 3e-4, 3) + rng.normal(0, error), error)
        held += pooled.low <= 0.976 <= pooled.high
    assert held >= 0.94 * 400


@pytest.mark.parametrize("tests", [2, 3, 10, 20])
@pytest.mark.parametrize("share", [0.5, 0.95])
def test_so_many_new_tests_are_within_their_range_as_it_says(tests, share):
    """e scatters by 0.003 from test to test; the error of the mean alone holds 85, 49, 37 % after 3, 10, 20 tests."""
    rng, held = np.random.default_rng(tests), []
    for _ in range(600):
        found = pool(rng.normal(0.97, 0.003, tests) + rng.normal(0, 3e-4, tests), np.full(tests, 3e-4))
        deviation, freedom = found.of_new_test(usual=np.nan)
        held.append(abs(rng.normal(0.97, 0.003) - found.value) < stats.t.ppf((1 + share) / 2, freedom) * deviation)
    assert np.mean(held) == pytest.approx(share, abs=3 * np.sqrt(share * (1 - share) / 600))


@pytest.mark.parametrize("tests", [2, 3, 10, 20])
@pytest.mark.parametrize("ratio", [0.5, 1.0, 2.0])
def test_a_95_percent_range_holds_new_tests_however_large_the_errors_of_the_tests_are(tests, ratio):
    """93 to 97 %, within 2 % for 900 repetitions; the scatter alone without what it hides holds 84 to 100 %."""
    rng, held = np.random.default_rng(tests), []
    for scatter in (0.0005, 0.001, 0.003):
        for _ in range(300):
            e = rng.normal(0.97, scatter, tests) + rng.normal(0, ratio * scatter, tests)
            found = pool(e, np.full(tests, ratio * scatter))
            deviation, freedom = found.of_new_test(usual=np.nan)
            held.append(abs(rng.normal(0.97, scatter) - found.value) < stats.t.ppf(0.975, freedom) * deviation)
    assert 0.91 <= np.mean(held) <= 0.985


def test_tests_that_agree_by_chance_leave_a_range_as_wide_as_their_errors():
    deviation, freedom = pool([0.97, 0.97], [0.002, 0.002]).of_new_test(usual=np.nan)
    assert stats.t.ppf(0.975, freedom) * deviation == pytest.approx(0.002 / np.sqrt(2))


def test_one_test_leaves_the_scatter_between_tests_to_what_is_usual():
    assert pool([0.97], [0.003]).of_new_test(usual=0.004) == (pytest.approx(0.005), None)


@given(st.lists(st.tuples(st.floats(0.5, 1.0), st.floats(1e-5, 1e-2)), min_size=1, max_size=8))
def test_the_pooled_value_lies_among_the_tests(rows):
    values, errors = zip(*rows, strict=True)
    assert min(values) - 1e-12 <= pool(values, errors).value <= max(values) + 1e-12


def test_no_test_is_an_error():
    with pytest.raises(ValueError, match="at least one test"):
        pool([], [])
