"""The motion of a table against its target: with a target three panels, without one two."""

import numpy as np
import pytest

from colonnade.figures.base_motion import BaseSpectra, base_motion
from colonnade.figures.panels.curve import Curve

TIME = np.arange(0, 5, 0.01)
ACHIEVED = Curve(TIME, 2 * np.sin(6 * TIME))
PERIOD = np.geomspace(0.02, 2, 30)


def test_the_ratio_of_the_spectra_is_drawn_about_one():
    spectra = BaseSpectra(PERIOD, 1.1 * np.sqrt(PERIOD), np.sqrt(PERIOD))
    figure = base_motion(ACHIEVED, Curve(TIME, 1.8 * np.sin(6 * TIME)), spectra, uplift=1.9)
    history, spectrum, ratio = figure.axes
    assert [line.get_label() for line in history.lines[:2]] == ["target", "achieved"]
    assert ratio.lines[0].get_ydata() == pytest.approx(1.1)
    assert ratio.get_ylim() == pytest.approx((0.8, 1.2))
    assert spectrum.get_xlim() == pytest.approx((0.02, 2))
    assert "g tan α" in [text.get_text() for text in history.texts]


def test_without_a_target_there_is_no_ratio():
    figure = base_motion(ACHIEVED, None, BaseSpectra(PERIOD, np.sqrt(PERIOD), None), uplift=9.0)
    assert len(figure.axes) == 2


@pytest.mark.parametrize(("ratio", "reach"), [(1.02, 0.2), (0.6, 0.44), (4.0, 1.0)])
def test_the_axis_of_the_ratio_fits_what_it_shows(ratio, reach):
    spectra = BaseSpectra(PERIOD, ratio * np.sqrt(PERIOD), np.sqrt(PERIOD))
    axes = base_motion(ACHIEVED, ACHIEVED, spectra, uplift=9.0).axes[2]
    assert axes.get_ylim() == pytest.approx((1 - reach, 1 + reach))
    assert axes.lines[0].get_ydata() == pytest.approx(min(ratio, 1 + reach))
