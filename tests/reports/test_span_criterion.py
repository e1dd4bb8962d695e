"""The criterion of the Span 2.5 study, on histories made by hand."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from span_two_and_a_half.criterion import (
    AS_FIXED,
    Criterion,
    Response,
    agrees,
    misfit,
    place_of_growth,
    variants,
)
from span_two_and_a_half.design import nominal
from span_two_and_a_half.fixed import text

PAGE = Path(__file__).resolve().parents[2] / "reports" / "manos" / "span-2.5-design.md"
DT = 0.01
TIME = np.arange(1000) * DT
BLOCK = nominal()[0]


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
        pytest.param(PREDICTED, PREDICTED, id="both grow"),
        pytest.param(MEASURED, MEASURED, id="neither grows"),
        pytest.param(PREDICTED, MEASURED, id="the measured one grows"),
        pytest.param(response((4.0, 9.0, 0.05)), PREDICTED, id="the measured one never rocked"),
        pytest.param(response((1.0, 5.5, 0.3)), PREDICTED, id="quiet for too short a time"),
        pytest.param(response((1.0, 4.0, 0.3), (5.5, 9.0, 0.25)), PREDICTED, id="the measured one does not stay small"),
        pytest.param(MEASURED, response((1.0, 4.0, 0.3), (5.8, 6.4, 0.38)), id="predicted is not large enough"),
        pytest.param(MEASURED, response(*DECLINE), id="predicted only dies down later"),
        pytest.param(MEASURED, response((1.0, 4.0, 0.3), (9.0, 9.5, 0.3)), id="too small and too late"),
        pytest.param(MEASURED, replace(PREDICTED, overturning_time=2.0), id="predicted has overturned before"),
    ],
)
def test_what_is_not_the_papers_pattern(measured, predicted):
    assert np.isnan(place_of_growth(measured, predicted, Criterion()))


def test_a_prediction_that_overturns_late_is_the_pattern():
    falling = response((1.0, 4.0, 0.3), (5.8, 6.0, 0.9), overturning_time=6.0)
    assert place_of_growth(MEASURED, falling, Criterion()) == pytest.approx(6.0, abs=2 * DT)


@pytest.mark.parametrize("window", [1.0, 1.01])
def test_windows_look_before_and_after(window):
    one = response((5.0, 5.0 + DT, 1.0))
    before, after = one.largest_before(window) > 0, one.largest_after(window) > 0
    assert (TIME[before].min(), TIME[before].max()) == (pytest.approx(5.0), pytest.approx(5.0 + window))
    assert (TIME[after].min(), TIME[after].max()) == (pytest.approx(5.0 - window), pytest.approx(5.0))


@pytest.mark.parametrize(
    ("name", "measured", "predicted", "found"),
    [
        ("quiet / 2", response((1.0, 4.0, 0.3), (4.0, 9.0, 0.07)), PREDICTED, False),
        ("quiet × 2", response((1.0, 4.0, 0.3), (4.0, 9.0, 0.15)), PREDICTED, True),
        ("before / 2", response((1.0, 5.3, 0.3)), PREDICTED, True),
        ("before × 2", response((1.0, 4.5, 0.3)), response((1.0, 4.0, 0.3), (6.0, 6.4, 0.5)), False),
        ("loud / 2", MEASURED, response((1.0, 4.0, 0.1), (5.8, 6.4, 0.3)), True),
        ("loud × 2", MEASURED, PREDICTED, False),
        ("after × 2", response((1.0, 3.0, 0.3)), response((1.0, 3.0, 0.3), (7.0, 7.4, 0.5)), True),
    ],
)
def test_each_number_of_the_criterion_matters(name, measured, predicted, found):
    assert np.isfinite(place_of_growth(measured, predicted, variants()[name])) == found


def test_variants_change_one_number_each_by_two():
    fixed = variants()[AS_FIXED]
    assert fixed == Criterion(quiet=0.1, before=1.0, loud=0.4, after=2.0, nrmse=0.1)
    assert len(variants()) == 11
    for name, varied in variants().items():
        changed = [key for key in vars(fixed) if vars(varied)[key] != vars(fixed)[key]]
        assert len(changed) == (0 if name == AS_FIXED else 1)
        assert all(vars(varied)[key] / vars(fixed)[key] in (0.5, 2.0) for key in changed)


def test_agreement_needs_rocking_one_outcome_and_a_small_misfit():
    first, near = response((1.0, 5.0, 0.3)), response((1.0, 5.0, 0.35))
    assert agrees(first, near, Criterion())
    assert misfit(first, near) == pytest.approx(0.05 * np.sqrt(0.4 / 2), rel=0.02)
    assert not agrees(first, near, replace(Criterion(), nrmse=0.01))
    assert not agrees(first, replace(near, overturning_time=8.0), Criterion())
    still = response((1.0, 5.0, 0.05))
    assert not agrees(still, still, Criterion())


def test_the_page_of_what_was_fixed_is_made_from_the_code():
    assert PAGE.read_text(encoding="utf-8") == text()
