"""What a sine asks of the table, and which of its limits that passes."""

from math import pi
from types import SimpleNamespace

import numpy as np
import pytest
import xarray as xr
from hypothesis import given
from hypothesis import strategies as st

from colonnade.campaign.setup import ShakeTable
from colonnade.store.records.advice import Advice, beyond, demand_of_sine, ranked
from colonnade.store.records.forecast import FEWEST, SCORES, judge


@given(st.floats(0.01, 30.0), st.floats(0.1, 50.0))
def test_the_demand_of_a_sine_is_that_of_its_derivatives(acceleration, frequency):
    moment = np.linspace(0.0, 1 / frequency, 2001)
    demand = demand_of_sine(acceleration, frequency)
    displacement = demand["stroke"] * np.sin(2 * pi * frequency * moment)
    velocity = np.gradient(displacement, moment)
    assert np.abs(velocity).max() == pytest.approx(demand["velocity"], rel=1e-3)
    assert np.abs(np.gradient(velocity, moment)).max() == pytest.approx(acceleration, rel=1e-2)


def test_only_passed_limits_are_said():
    table = ShakeTable.model_validate({"stroke": "40 mm", "velocity": "2 m/s"})
    assert beyond(table, {"acceleration": 50.0, "velocity": 1.0, "stroke": 0.05}) == (
        "needs 50 mm of stroke; the table has 40 mm",
    )


def test_a_line_says_test_risk_and_reason():
    advice = Advice("prism", "sine", "5 Hz at 0.3 g", False, "because", risk=0.42, left=1, beyond=("too far",))
    assert advice.text() == "next sine of prism: 5 Hz at 0.3 g, risk 42\u00a0%, 1 test left; because; too far"
    enough = Advice("prism", "sine", "5 Hz at 0.3 g", True, "known", risk=0.42, left=0)
    assert enough.text() == "next sine of prism: enough; known"


def test_what_tells_most_comes_first():
    free = Advice("prism", "free-vibration", "release from 0.6 α", False, "e is not identified")
    enough = Advice("prism", "free-vibration", "release from 0.6 α", True, "as narrow as wanted")
    less, more = (Advice("prism", "sine", "3 Hz", False, "", values={"bits": bits}) for bits in (0.5, 0.6))
    span = Advice("cone", "earthquake", "Span 3", False, "", values={"entropy": 0.55})
    impossible = Advice("cone", "earthquake", "Span 9", False, "", beyond=("needs 2 g",), values={"entropy": 1.5})
    assert ranked([less, impossible, enough, span, more, free]) == [free, more, span, less, impossible, enough]


def campaign(tests, *, recorded=True):
    """As many tests, each with a forecast of members evenly between 0 and 1, and scores that are their numbers."""
    forecasts, scores = {}, {}
    for number in range(1, tests + 1):
        name = f"test-{number}"
        peaks = SimpleNamespace(peak_ratio=tuple(np.linspace(0.01, 0.99, 21)))
        forecasts[name] = SimpleNamespace(models={"linear": peaks})
        values = [[float(number), float(number) if recorded else np.nan, 4.0 * number]]
        variables = {f"forecast_{key}": (("model", "basis"), np.array(values)) for key in SCORES}
        variables |= {"forecast_pit": (("model", "basis"), np.full((1, 3), number / (tests + 1)))}
        scores[name] = xr.Dataset(
            variables | {"observed_amplitude": ((), number / (tests + 1))},
            coords={"model": ["linear"], "basis": ["on_target", "on_recorded", "rigid_body"]},
            attrs={"outcome": "rocking"},
        )
    return forecasts, scores


def test_means_skill_and_coverage():
    judged = judge(*campaign(19))["linear"]
    assert judged.tests == 19
    assert judged.on_target.crps == pytest.approx(10.0)
    assert judged.skill_rigid_body.brier == pytest.approx(0.75)
    assert judged.skill_base_rate.crps < 0
    assert [band.probability for band in judged.coverage] == [0.5, 0.8, 0.95]
    assert [band.share for band in judged.coverage] == pytest.approx([11 / 19, 15 / 19, 19 / 19], abs=2.1 / 19)
    assert all(band.low <= band.share <= band.high for band in judged.coverage)


def test_of_few_tests_only_means_are_given():
    judged = judge(*campaign(FEWEST - 1))["linear"]
    assert (judged.skill_rigid_body, judged.skill_base_rate, judged.coverage) == (None, None, None)
    assert judged.on_target.brier == pytest.approx(FEWEST / 2)


def test_scores_that_are_not_known_do_not_count():
    judged = judge(*campaign(3, recorded=False))["linear"]
    assert judged.on_recorded.crps is None
