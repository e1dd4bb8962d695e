"""All of it in one call; scatter of records and of parameters, records that decide, and resampling."""

import numpy as np
import pytest
import scipy

from colonnade.assessment.curves import fit_lognormal
from colonnade.assessment.fragility import Fragility, split_beta
from colonnade.assessment.hazard import hazard_curve, lognormal_rate
from colonnade.assessment.intervals import Resampling, studentised
from colonnade.assessment.outcomes import Outcomes, gather
from fragility_trial import Population
from virtual_capacities import MEDIAN, lognormal, names, outcomes_of


def test_everything_is_of_the_same_outcomes():
    outcomes = lognormal(1)
    found = Fragility(
        outcomes,
        Resampling(100),
        hazard=hazard_curve([0.05, 2.0], [1e-1, 1e-5]),
        compared={"pgv": np.tile(outcomes.levels[:, None], (30, 1, 1))},
        magnitude=np.linspace(5, 7, 30),
    )
    assert found.lognormal.median.low < MEDIAN < found.lognormal.median.high
    total = np.hypot(*found.betas)
    assert total == pytest.approx(found.lognormal.beta.value)
    assert found.rate.rate.low < np.mean([each.rate for each in found.influence]) < found.rate.rate.high
    assert (found.resurrected, found.measures[0].measure) == (0.0, "pgv")
    assert found.misfit > 0.05


def test_without_a_threshold_the_start_of_rocking_is_a_curve_of_the_histories_that_rocked():
    peak = np.where(np.random.default_rng(1).normal(2.0, 0.5, (40, 1)) < np.linspace(1, 3, 8), 0.3, 0.0)
    records = [str(number) for number in range(40)]
    found = Fragility(gather(records, np.linspace(1, 3, 8), peak), Resampling(100)).uplift
    assert found.median.low < 2.0 < found.median.high


def test_without_a_curve_the_isotonic_one_and_the_reason_remain():
    found = Fragility(outcomes_of(np.full((4, 3), MEDIAN)), Resampling(20), hazard=hazard_curve([0.1, 1.0], [1.0, 0.1]))
    assert (found.lognormal.reason, found.rate, found.measures) == ("separated", None, ())
    assert found.isotonic.probability.value.tolist() == [0.0] * 5 + [1.0] * 5
    assert found.taken == "isotonic"
    assert found.reaches(0.5) == found.isotonic.reaches(0.5)


def split(outcomes):
    return split_beta(outcomes, fit_lognormal(outcomes, Resampling(2)))


def test_over_many_sets_of_records_they_are_the_truth():
    found = np.mean([split(lognormal(seed)) for seed in range(40)], axis=0)
    truth = (Population.of_records, Population.of_parameters)
    assert found == pytest.approx(truth, rel=0.04)


def test_levels_that_end_below_most_capacities_do_not_mislead_it():
    outcomes = lognormal(3, records=400)
    low = Outcomes(outcomes.records, outcomes.levels[:5], outcomes.peak[:, :5], outcomes.overturned[:, :5])
    assert low.overturned.mean() < 0.25
    assert split(low) == pytest.approx((Population.of_records, Population.of_parameters), rel=0.12)


def test_what_cannot_be_split_has_no_value():
    random = np.random.default_rng(6)
    records = MEDIAN * np.exp(random.normal(0, 0.4, (20, 1)))
    assert np.isnan(split(outcomes_of(records))).all()
    assert np.isnan(split(outcomes_of(np.tile(records, 5) * 1e6))).all()
    alike = split(outcomes_of(np.tile(records, 5)))
    assert alike.parameters < 0.1 * alike.records


def test_it_is_the_curve_of_all_other_records():
    outcomes = lognormal(2)
    found = Fragility(outcomes, Resampling(2), hazard=hazard_curve([0.1, 1.0], [1e-2, 1e-5])).influence
    [one] = [each for each in found if each.record == "record 3"]
    kept = np.arange(30) != 3
    others = gather(names(29), outcomes.levels, outcomes.peak[kept], outcomes.overturned[kept])
    without = fit_lognormal(others, Resampling(2))
    assert one.median == pytest.approx(without.median.value)
    expected = lognormal_rate(hazard_curve([0.1, 1.0], [1e-2, 1e-5]), without.median.value, without.beta.value)
    assert one.rate == pytest.approx(expected[0])


def test_a_record_without_which_there_is_no_curve_comes_first():
    capacity = np.full((6, 2), MEDIAN)
    capacity[4] *= 3
    found = Fragility(outcomes_of(capacity), Resampling(2)).influence
    assert (found[0].record, np.isnan(found[0].median)) == ("record 4", True)


def test_of_a_mean_of_normal_values_it_is_about_students_interval():
    values = np.random.default_rng(3).normal(0, 1, 40)
    weights = Resampling(20000, 2).weights(40)[1:]
    means = weights @ values / 40
    errors = np.sqrt((weights @ values**2 / 40 - means**2) / 40)
    mean, error = values.mean(), values.std() / np.sqrt(40)
    band = studentised(np.array([mean]), np.array([error]), means[:, None], errors[:, None], 0.95, 40)
    reach = scipy.stats.t.ppf(0.975, 39) * error
    assert (band.low[0], band.high[0]) == pytest.approx((mean - reach, mean + reach), abs=0.25 * reach)


def test_histories_that_survive_more_than_overturned_their_record_and_draw_are_counted():
    peak = [[[0.5, 0.5], [2, 0.5], [0.5, 0.5], [0.5, 2]], [[0.5, 0.5], [2, 2], [2, 2], [2, 2]]]
    found = Fragility(gather(["one", "two"], [1, 2, 3, 4.0], peak), Resampling(2))
    assert found.resurrected == pytest.approx(2 / 16)
