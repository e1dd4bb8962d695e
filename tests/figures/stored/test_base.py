"""The recorded base motion with the motion that it was to follow, and their spectra."""

from dataclasses import replace

import numpy as np
import pytest

from colonnade.figures import base_motion
from colonnade.figures.base_motion import BaseMotion, BaseSpectra, base_of, base_picture
from colonnade.figures.files.table import columns_of
from colonnade.figures.panels.curve import Curve
from colonnade.signals.named_motion import Laid

STEP = 0.01
TIME = STEP * np.arange(1000)
SHAKING = np.sin(2 * np.pi * TIME) * np.exp(-(((TIME - 5.0) / 2.0) ** 2))
ALONE = BaseMotion(TIME, SHAKING, None)


def replaced(one, **changes):
    return replace(one, test=one.test.model_copy(update=changes))


def test_a_hole_in_it_a_standing_table_and_a_test_that_was_not_run_have_none(reported):
    one = reported["span-2.0"]
    rocking = one.stored.datasets["rocking", None].copy(deep=True)
    rocking["base_acceleration"][10] = np.nan
    holed = replace(one.stored, datasets=one.stored.datasets | {("rocking", None): rocking})
    without = (replace(one, stored=holed), replaced(one, kind="tilt"), reported["free-01"], reported["later"])
    assert {base_of(each) for each in without} == {None}


def test_a_target_half_as_strong_has_half_the_spectrum(reported):
    half = Laid(SHAKING / 2, 1.0, 1.0, 1.0)
    drawn = base_picture(reported["span-2.0"], BaseMotion(TIME, SHAKING, half))
    assert "Achieved over target 2 to 2." in drawn.description
    assert len(drawn.figure.axes) == 3
    alone = base_picture(reported["span-2.0"], ALONE)
    assert "target" not in alone.description
    assert alone.description.startswith("Largest achieved response")
    assert columns_of(alone.figure)


def test_no_period_is_shorter_than_eight_samples_or_longer_than_a_quarter_of_the_record():
    period = base_motion._spectra(ALONE).period
    assert (period[0], period[-1]) == pytest.approx((base_motion.FEWEST * STEP, 10.0 / 4))
    # A stiff oscillator follows the table: its response is the largest acceleration.
    assert base_motion._spectra(ALONE).achieved[0] == pytest.approx(np.abs(SHAKING).max(), rel=0.05)


def test_a_table_that_stood_and_kinds_whose_spectrum_is_nothing_or_one_line_have_no_picture(reported):
    one = reported["span-2.0"]
    assert base_picture(one, None) is base_picture(one, BaseMotion(TIME, np.zeros_like(TIME), None)) is None
    assert {base_picture(replaced(one, kind=kind), ALONE) for kind in base_motion.WITHOUT_SPECTRUM} == {None}


ACHIEVED, PERIOD = Curve(TIME, SHAKING), np.geomspace(0.02, 2, 30)


@pytest.mark.parametrize(("ratio", "reach"), [(1.02, 0.2), (0.6, 0.44), (4.0, 1.0)])
def test_the_axis_of_the_ratio_fits_what_it_shows(ratio, reach):
    spectra = BaseSpectra(PERIOD, ratio * np.sqrt(PERIOD), np.sqrt(PERIOD))
    axes = base_motion.base_motion(ACHIEVED, ACHIEVED, spectra, uplift=9.0).axes[2]
    assert axes.get_ylim() == pytest.approx((1 - reach, 1 + reach))
    assert axes.lines[0].get_ydata() == pytest.approx(min(ratio, 1 + reach))
