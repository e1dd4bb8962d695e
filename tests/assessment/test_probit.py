"""The binomial fit against an independent maximiser, and its weights and errors against brute force."""

import numpy as np
import pytest
import scipy

from colonnade.assessment.outcomes import Cells
from colonnade.assessment.probit import fit_parameters
from virtual_capacities import lognormal


@pytest.fixture(scope="module")
def cells():
    return lognormal(1).cells()


def independent(cells, weights):
    """Median and β by a general minimiser of scipy's binomial likelihood."""

    def negative(at):
        likely = scipy.stats.norm.cdf((cells.log_intensity - at[0]) / np.exp(at[1]))
        return -(weights[:, None] * scipy.stats.binom.logpmf(cells.events, cells.histories, likely)).sum()

    return scipy.optimize.minimize(
        negative, [-1.0, -1.0], method="Nelder-Mead", options={"xatol": 1e-9, "fatol": 1e-9}
    ).x


def test_median_and_beta_are_those_of_an_independent_maximiser(cells):
    weights = np.vstack((np.ones(30), np.random.default_rng(2).integers(0, 3, (3, 30))))
    found, _, status = fit_parameters(cells, weights)
    assert (status == "").all()
    for place, row in enumerate(weights):
        expected = independent(cells, row)
        np.testing.assert_allclose((found.log_median[place], found.log_beta[place]), expected, atol=2e-6)


def test_a_record_of_weight_two_is_that_record_twice(cells):
    weights = np.ones((1, 30))
    weights[0, 4] = 2
    doubled = Cells(*(np.vstack((each, each[4:5])) for each in cells))
    one, other = fit_parameters(cells, weights), fit_parameters(doubled, np.ones((1, 31)))
    np.testing.assert_allclose(one[0].log_median, other[0].log_median, rtol=1e-9)
    assert one[1] == pytest.approx(other[1])


def test_standard_errors_are_those_of_leaving_out_records_in_turn():
    cells = lognormal(1, records=200).cells()
    found = fit_parameters(cells, np.vstack((np.ones(200), 1 - np.eye(200))))[0]
    jackknife = [199 / 200 * ((each[1:] - each[1:].mean()) ** 2).sum() for each in (found.log_median, found.log_beta)]
    np.testing.assert_allclose(np.sqrt([found.mm[0], found.bb[0]]), np.sqrt(jackknife), rtol=0.05)


def test_a_far_tail_is_fitted_without_overflow():
    y = np.log(np.array([[1e-9, 0.9, 1.0, 1.1, 1e9]] * 2))
    events = np.array([[0, 1, 2, 4, 5], [0, 0, 3, 4, 5.0]])
    found, log_likelihood, status = fit_parameters(Cells(y, events, np.full((2, 5), 5.0)), np.ones((1, 2)))
    assert status.tolist() == [""]
    assert (np.abs(found.log_median[0]) < 0.1, np.isfinite(log_likelihood[0])) == (True, True)


def test_the_likelihood_of_separated_outcomes_is_its_limit():
    y = np.log([[1.0, 2.0, 3.0]] * 2)
    events = np.array([[0, 1, 4], [0, 3, 4.0]])
    _, log_likelihood, status = fit_parameters(Cells(y, events, np.full((2, 3), 4.0)), np.ones((1, 2)))
    assert status.tolist() == ["separated"]
    assert log_likelihood[0] == pytest.approx(8 * np.log(0.5))
