"""What a sine asks of the table, and which of its limits that passes."""

from math import pi

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from colonnade.campaign.setup import ShakeTable
from colonnade.store.records.advice import Advice, beyond, demand_of_sine, ranked


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
