"""The paper's pattern at Span 2.5, on histories made by hand."""

from dataclasses import replace

import numpy as np
import pytest

from reproduction.printed import TABLE_1
from reproduction.responses import Criterion, Response, place_of_growth

DT = 0.01
TIME = np.arange(1000) * DT
BLOCK = TABLE_1["prism"].block


def response(*bursts, overturning_time=np.nan):
    """Rock in bursts of (start s, stop s, amplitude in α)."""
    ratio = np.zeros(TIME.size)
    for start, stop, size in bursts:
        inside = (start <= TIME) & (stop > TIME)
        ratio[inside] = size * np.sin(20.0 * TIME[inside])
    return Response(ratio * BLOCK.critical_angle, DT, overturning_time, BLOCK)


MEASURED = response((1.0, 4.0, 0.3), (4.0, 9.0, 0.05))
PREDICTED = response((1.0, 4.0, 0.3), (4.0, 5.8, 0.05), (5.8, 6.4, 0.5), (6.4, 9.0, 0.2))
DECLINE = [(start, start + 0.4, 0.8 - 0.06 * start) for start in np.arange(1.0, 9.0, 0.4)]


def test_the_papers_pattern_is_found_with_its_place():
    place = place_of_growth(MEASURED, PREDICTED, Criterion())
    assert 5.8 <= place <= 6.4
    assert np.abs(np.interp(place, TIME, PREDICTED.angle)) == pytest.approx(0.5 * BLOCK.critical_angle, rel=0.01)


@pytest.mark.parametrize(
    ("measured", "predicted"),
    [
        pytest.param(MEASURED, MEASURED, id="neither grows"),
        pytest.param(response((4.0, 9.0, 0.05)), PREDICTED, id="the measured one never rocked"),
        pytest.param(response((1.0, 5.5, 0.3)), PREDICTED, id="quiet for too short a time"),
        pytest.param(response((1.0, 4.0, 0.3), (5.5, 9.0, 0.25)), PREDICTED, id="the measured one does not stay small"),
        pytest.param(MEASURED, response(*DECLINE), id="predicted only dies down later"),
        pytest.param(MEASURED, replace(PREDICTED, overturning_time=2.0), id="predicted has overturned before"),
    ],
)
def test_what_is_not_the_papers_pattern(measured, predicted):
    assert np.isnan(place_of_growth(measured, predicted, Criterion()))


def test_a_prediction_that_overturns_late_is_the_pattern():
    falling = response((1.0, 4.0, 0.3), (5.8, 6.0, 0.9), overturning_time=6.0)
    assert place_of_growth(MEASURED, falling, Criterion()) == pytest.approx(6.0, abs=2 * DT)
