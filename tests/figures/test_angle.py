"""The rocking angle alone: measured and predicted in one panel, over the time that they have."""

import numpy as np
import pytest

from colonnade.figures.panels.curve import Curve
from colonnade.figures.stored.record import HEIGHT, LOWER, rocking_angle
from colonnade.figures.style import COLUMNS, MEASURED, journal

TIME = np.linspace(0.0, 10.0, 2001)
MEASURED_CURVE = Curve(TIME, 0.4 * np.sin(6 * TIME))
LINEAR = Curve(TIME, 0.3 * np.sin(6 * TIME))


def test_measured_and_models_are_drawn_with_what_was_done_above_them():
    (axes,) = rocking_angle(MEASURED_CURVE, {"linear": LINEAR}, title="prism, Ω = 4.00").axes
    assert axes.get_title(loc="left") == "prism, Ω = 4.00"
    assert axes.get_xlabel() == "time (s)"
    measured, linear = axes.lines[:2]
    assert measured.get_color() == MEASURED["color"]
    np.testing.assert_allclose(np.abs(linear.get_ydata()).max(), 0.3, rtol=1e-3)
    assert axes.get_xlim() == pytest.approx((0.0, 10.0), abs=0.5)


def test_in_a_single_column_the_panel_is_lower():
    with journal("double"):
        wide = rocking_angle(MEASURED_CURVE, {}).get_size_inches()
    with journal("single"):
        narrow = rocking_angle(MEASURED_CURVE, {}).get_size_inches()
    assert (wide[0], narrow[0]) == pytest.approx((COLUMNS["double"], COLUMNS["single"]))
    assert wide[1] - narrow[1] == pytest.approx(HEIGHT - LOWER, abs=0.2)
