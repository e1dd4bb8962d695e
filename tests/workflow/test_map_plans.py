"""What a map is asked to show, and the axes, base motion and rules that follow from it and from what was measured."""

import numpy as np
import pytest

from colonnade.campaign import load
from colonnade.campaign.syntax.fields import MOST_CYCLES
from colonnade.dynamics.models import MODELS
from colonnade.errors import CampaignError
from colonnade.identification.response.boundaries import MapPoint
from colonnade.workflow import maps as plans
from colonnade.workflow.asked import picked
from colonnade.workflow.maps import Measured, Wanted
from every import every

FEW = Wanted(models=("linear",), points=(3, 4), cycles=2.0)


def changed(wanted, **changes):
    return Wanted(**(wanted.model_dump() | changes))


def planned(small, wanted=FEW, *points, model="linear"):
    return plans.plan_of(load(small.folder), small.layout, wanted, model, Measured("prism", points, 0.93, "given"))


def sine(frequency_ratio, amplitude_ratio):
    return MapPoint("sine-01", frequency_ratio, amplitude_ratio, "rocking")


def test_without_sine_tests_the_axes_are_the_usual_ones(untouched):
    plan = planned(untouched)
    assert (plan.frequency_ratio[0], plan.frequency_ratio[-1]) == plans.USUAL_FREQUENCIES
    assert (plan.amplitude_ratio[0], plan.amplitude_ratio[-1]) == (plans.LOWEST_AMPLITUDE, plans.USUAL_AMPLITUDE)
    assert (plan.frequency_ratio.size, plan.amplitude_ratio.size) == (3, 4)
    assert plan.restitution == (0.93, 0.93)
    plan = planned(untouched, changed(FEW, points=None))
    assert (plan.frequency_ratio.size, plan.amplitude_ratio.size) == MODELS["linear"].map_points


def test_sine_tests_are_within_the_axes_with_a_margin_of_a_tenth_and_more(untouched):
    plan = planned(untouched, FEW, sine(2.0, 1.0), sine(4.0, 9.0))
    assert (plan.frequency_ratio[0], plan.frequency_ratio[-1]) == (1.8, 4.4)
    assert plan.amplitude_ratio[-1] == 11.0  # 1.2 times 9 is 10.8


def test_given_axes_come_before_those_of_the_tests(untouched):
    plan = planned(untouched, changed(FEW, omega=(3.0, 5.0), amplitude=(1.0, 2.0)), sine(2.0, 9.0))
    np.testing.assert_allclose(plan.frequency_ratio, [3.0, 4.0, 5.0])
    np.testing.assert_allclose(plan.amplitude_ratio, np.linspace(1.0, 2.0, 4))


@every(
    ("changes", "said"),
    [
        ({"omega": (1.0, 1e9)}, "--omega: "),
        ({"omega": (3.0, 2.0)}, "--omega: 3 and 2 (SI) were found. The second has to be the larger one."),
        ({"amplitude": (0.0, 1.0)}, "--amplitude: "),
        ({"cycles": 2 * MOST_CYCLES}, "--cycles: "),
        ({"ramp": float("nan")}, "--ramp: "),
        ({"points": (3, 10_001)}, "--points: "),
    ],
)
def test_what_cannot_be_asked_is_refused_by_its_option(changes, said):
    with pytest.raises(CampaignError) as caught:
        picked(Wanted, changes)
    assert str(caught.value).startswith(said)
