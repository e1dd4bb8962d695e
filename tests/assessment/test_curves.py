"""Lognormal and isotonic curves: fits, intervals over records, misfits, and reasons for no curve."""

import numpy as np
import pytest
from scipy import stats

from colonnade.assessment.curves import IsotonicCurve, fit_isotonic, fit_lognormal
from colonnade.assessment.intervals import FEWEST_RECORDS, Band, Resampling
from colonnade.assessment.outcomes import gather
from fragility_trial import Population
from virtual_capacities import BETA, MEDIAN, lognormal, names, outcomes_of


def single(peaks):
    peaks = np.asarray(peaks, dtype=float)
    return gather(names(len(peaks)), np.arange(1.0, peaks.shape[1] + 1), peaks)


def test_median_beta_and_probabilities_are_near_the_truth_and_inside_their_intervals():
    fit = fit_lognormal(lognormal(5, records=200), Resampling(500))
    assert (fit.median.low < MEDIAN < fit.median.high, fit.beta.low < BETA < fit.beta.high) == (True, True)
    assert (fit.median.value, fit.beta.value) == pytest.approx((MEDIAN, BETA), rel=0.1)
    at = fit.probability([fit.median.value, MEDIAN * np.exp(BETA)])
    assert at.value == pytest.approx([0.5, 0.841], abs=0.03)
    assert ((at.low < at.value) & (at.value < at.high)).all()
    assert (fit.reason, fit.no_interval) == ("", "")


def test_the_intensity_of_a_probability_has_that_probability():
    fit = fit_lognormal(lognormal(5), Resampling(100))
    found = [fit.reaches(each) for each in (0.05, 0.5, 0.95)]
    assert fit.probability([each.value for each in found]).value == pytest.approx([0.05, 0.5, 0.95])
    assert found[1] == pytest.approx(fit.median)
    assert all(each.low < each.value for each in found)


def test_a_record_at_more_levels_or_draws_does_not_narrow_the_interval_as_more_records_do():
    """32 records with 10 draws of hardly any scatter: the median's error is that of 32 capacities."""
    random = np.random.default_rng(8)
    capacity = MEDIAN * np.exp(random.normal(0, 0.5, (32, 1)) + random.normal(0, 0.01, (32, 10)))
    fit = fit_lognormal(outcomes_of(capacity, MEDIAN * np.exp(np.linspace(-1.5, 1.5, 31))), Resampling(1000))
    assert np.log(fit.median.high / fit.median.low) == pytest.approx(2 * 2.04 * 0.5 / np.sqrt(32), rel=0.25)


@pytest.mark.parametrize(
    ("peaks", "reason"),
    [
        pytest.param([[0.5, 0.5, 2], [0.5, 0.5, 2]], "separated", id="no overlap"),
        pytest.param([[0.5, 0.5, 2], [0.5, 2, 2]], "separated", id="overlap at one level alone"),
        pytest.param([[0.5, 0.5, 0.5], [0.5, 0.2, 0.1]], "never", id="nothing overturns"),
        pytest.param([[2, 2, 2], [2, 2, 2]], "always", id="everything overturns"),
        pytest.param([[2, 0.5, 0.5], [2, 0.5, 2]], "falling", id="less at more"),
        pytest.param([[0.5], [2.0]], "one intensity", id="one intensity"),
    ],
)
def test_no_curve_is_given_if_the_outcomes_have_none(peaks, reason):
    fit = fit_lognormal(single(peaks), Resampling(20))
    assert fit.reason == reason
    assert np.isnan([*fit.median, *fit.beta, *fit.probability([1.0]).low]).all()


@pytest.mark.parametrize(
    ("outcomes", "why"),
    [
        (lognormal(5, records=FEWEST_RECORDS - 1), "There are 9 records. A curve has no interval below 10."),
        (lognormal(2, records=12, draws=1, levels=4), "too far apart for 12 records"),
        (Population(20, 1, 6, of_parameters=0.0).sample(np.random.default_rng(1)), "too far apart for 20 records"),
    ],
    ids=["few records", "few levels between none and all", "levels too far apart"],
)
def test_a_curve_whose_resamples_do_not_show_the_scatter_has_no_interval_and_says_why(outcomes, why):
    fit = fit_lognormal(outcomes, Resampling(200))
    assert (fit.reason, why in fit.no_interval) == ("", True)
    assert np.isfinite([fit.median.value, fit.beta.value]).all()
    assert np.isnan([fit.median.low, fit.beta.high, fit.probability([MEDIAN]).low[0]]).all()


@pytest.mark.whole
def test_intervals_of_few_records_at_few_levels_hold_the_truth_as_often_as_they_say_or_are_not_given():
    """Without the resamples that have no curve, of 12 records at levels of 0.9 β apart, β would be held in 3 of 4."""
    population = Population(records=12, draws=1, levels=6, of_parameters=0.0)
    fits = [fit_lognormal(population.sample(np.random.default_rng(seed)), Resampling(199)) for seed in range(80)]
    given = [fit for fit in fits if not (fit.reason or fit.no_interval)]
    assert 10 < len(given) < 70
    for name, truth in (("median", MEDIAN), ("beta", population.beta)):
        held = np.mean([getattr(fit, name).low <= truth <= getattr(fit, name).high for fit in given])
        assert held > 0.95 - 3 * np.sqrt(0.95 * 0.05 / len(given))


def test_neighbours_that_fall_are_pooled():
    peak = np.array([[0.5, 2, 0.5, 2], [0.5, 2, 2, 2], [0.5, 0.5, 0.5, 2], [0.5, 0.5, 0.5, 2]])
    curve = fit_isotonic(gather(names(4), [1.0, 2, 3, 4], peak), Resampling(50))
    np.testing.assert_allclose(curve.probability.value, [0, 0.375, 0.375, 1])


def test_the_intensity_of_a_probability_is_between_its_stripes():
    band = Band(*(np.array(each) for each in ([0.0, 0.2, 0.6], [0.0, 0.1, 0.4], [0.1, 0.5, 0.9])))
    curve = IsotonicCurve(np.array([1.0, 2.0, 4.0]), band)
    assert curve.reaches(0.4) == pytest.approx((2 * 2**0.5, 2**0.75, 4.0))
    assert curve.reaches(0.05) == pytest.approx((2**0.25, 0.0, 2**0.5))
    assert curve.reaches(0.95) == (np.inf, np.inf, np.inf)


def test_at_the_outermost_levels_of_few_records_the_limits_hold_the_truth():
    """One event of ten, where 1.4 % overturn: the limits of Wilson (1927) missed that, in 16 % of the samples."""
    peak = np.tile([0.5, 2.0], (10, 1))
    peak[0, 0] = 2.0
    curve = fit_isotonic(gather(names(10), [1.0, 2.0], peak), Resampling(500))
    exact = stats.binomtest(1, 10).proportion_ci(0.95, method="exact")
    assert (curve.probability.low[0], curve.probability.high[0]) == pytest.approx(tuple(exact), abs=1e-6)


PEAK = np.array([[0.0, 0.4, 2.0], [0.2, np.nan, 0.9]])
LEVELS = np.array([1.0, 2.0, 3.0])


def test_histories_of_one_level_are_counted_together_and_missing_ones_are_not():
    cells = gather(["a", "b"], LEVELS, PEAK).cells()
    assert cells.histories.tolist() == [[1, 1, 1], [1, 0, 1]]
    assert cells.events.tolist() == [[0, 0, 1], [0, 0, 0]]
    np.testing.assert_allclose(np.exp(cells.log_intensity[0]), LEVELS)


def test_directions_are_cells_of_their_own_over_a_measure_that_differs_between_them():
    outcomes = gather(["a", "b"], [1.0], np.array([[[[0.5, 2.0]]], [[[2.0, 2.0]]]]))
    apart = outcomes.cells(intensity=np.array([[[1.0, 2.0]], [[1.0, 3.0]]]))
    assert (apart.events.tolist(), outcomes.cells().events.tolist()) == ([[0, 1], [1, 1]], [[1], [2]])


def test_one_record_is_not_enough():
    with pytest.raises(ValueError, match="1 name; at least 2"):
        gather(["a"], LEVELS, PEAK[:1])


def test_a_level_at_which_nothing_was_run_makes_no_stripe():
    found = gather(["a", "b"], LEVELS, PEAK * [1.0, 1.0, np.nan]).stripes()
    np.testing.assert_allclose(np.exp(found.log_intensity), [[1.0, 2.0]] * 2)
    assert found.histories.tolist() == [[1, 1], [1, 0]]
