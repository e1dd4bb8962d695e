"""e of single impacts, from fits made by hand: scatter that only a moving table explains, and a trend."""

import numpy as np
import pytest
from scipy.stats import norm, t

from colonnade.identification.restitution.departures.single_impacts import (
    LARGEST_SCATTER,
    MOVING,
    NAME,
    found_by_impact,
    speed_dependence,
)
from colonnade.identification.restitution.estimators.history_scatter import SURE_TREND, ScatteredFit
from colonnade.identification.restitution.result import Estimate

VALUE = Estimate("history-scatter", 0.95, 0.94, 0.96, 0.005, 0.95, "")


def fit(*, scatter=0.0, seen=0.0, count=16, change=np.nan, change_error=np.nan):
    """A fit whose single e have a standard deviation of `seen`."""
    pattern = np.linspace(-1.0, 1.0, count)
    restitution = 0.95 + seen * pattern / pattern.std(ddof=1)
    return ScatteredFit(VALUE, scatter=scatter, change=change, change_error=change_error, restitution=restitution)


def names(found):
    return [departure.name for departure in found]


def test_much_scatter_is_a_moving_table_and_refuses():
    (departure,) = found_by_impact(fit(scatter=0.03, seen=0.02))
    assert departure.name == MOVING
    assert departure.refuses
    assert departure.size == 0.03
    # Standard error of a standard deviation of n normal values: σ / sqrt(2 n).
    assert departure.standard_error == pytest.approx(0.03 / np.sqrt(32))
    assert "record the table's acceleration" in departure.sentence


def test_a_recorded_motion_that_does_not_explain_the_scatter_is_asked_for():
    (departure,) = found_by_impact(fit(scatter=0.03, seen=0.02), driven=True)
    assert "the recorded motion of the table does not explain it" in departure.sentence


@pytest.mark.parametrize(
    "given",
    [
        {"scatter": 0.03, "seen": 0.9 * LARGEST_SCATTER},
        {"scatter": 0.9 * LARGEST_SCATTER, "seen": 0.03},
        {"scatter": 0.03, "seen": 0.03, "count": 4},
        {},
    ],
    ids=["not seen in single e", "explained by noise", "too few impacts", "none"],
)
def test_scatter_that_may_be_noise_is_no_departure(given):
    assert found_by_impact(fit(**given)) == ()


@pytest.mark.parametrize(
    ("change", "error", "name"),
    [(-0.04, 0.005, NAME), (-0.04, 0.02, MOVING), (-0.02, 0.001, MOVING)],
    ids=["a sure trend", "a trend that is not sure", "a trend that is smaller than the scatter"],
)
def test_a_sure_trend_explains_the_scatter(change, error, name):
    assert names(found_by_impact(fit(scatter=0.03, seen=0.03, change=change, change_error=error))) == [name]


@pytest.mark.parametrize(("change", "found"), [(0.0049, False), (-0.0051, True)])
def test_a_change_is_named_from_its_least_size_on(change, found):
    departures = speed_dependence(fit(change=change, change_error=1e-5))
    assert bool(departures) is found
    if found:
        assert departures[0].size == change
        assert not departures[0].refuses
        assert "changes by -0.0051 ± 0.0000" in departures[0].sentence


@pytest.mark.parametrize("sign", [-1, 1])
@pytest.mark.parametrize(("share", "found"), [(0.98, False), (1.02, True)], ids=["by chance", "hardly by chance"])
def test_a_change_is_named_where_students_t_is_sure_of_it(share, found, sign):
    limit = t.isf(SURE_TREND / 2, 14)
    assert bool(speed_dependence(fit(change=sign * 0.02, change_error=0.02 / (share * limit)))) is found


@pytest.mark.parametrize("share", [0.98, 1.02], ids=["less sure", "sure"])
@pytest.mark.parametrize("change", [0.049, 0.051])
def test_a_large_change_refuses_where_it_is_as_sure_as_four_deviations(change, share):
    limit = t.isf(norm.sf(4.0), 14)
    (departure,) = speed_dependence(fit(change=change, change_error=change / (share * limit)))
    assert departure.refuses is (change > 0.05 and share > 1)
    assert ("would mislead" in departure.sentence) is departure.refuses


@pytest.mark.parametrize("error", [np.nan, 0.0], ids=["not known", "none"])
def test_a_change_without_an_error_is_not_named(error):
    assert speed_dependence(fit(change=0.1, change_error=error)) == ()
