from __future__ import annotations

import numpy as np
import pytest

from colonnade.figures import Curve, fitted_history
from colonnade.figures.style import MEASURED, model_style

TIME = np.linspace(0, 6, 601)
MEASURED_ANGLE = Curve(TIME, 0.5 * np.exp(-TIME / 3) * np.cos(4 * TIME))
PART = slice(100, 500)


def named(axes):
    return axes.get_legend_handles_labels()[1]


def test_a_fitted_history_shows_measured_fit_and_what_is_left_over():
    fitted = Curve(TIME[PART], MEASURED_ANGLE.values[PART] + 1e-3)
    residual = Curve(TIME[PART], np.full(400, -1e-3))
    figure = fitted_history(MEASURED_ANGLE, fitted, residual, model="nonlinear")
    above, below = figure.axes
    assert named(above) == ["measured", "fitted, nonlinear model"]
    assert above.lines[0].get_color() == MEASURED["color"]
    assert above.lines[1].get_color() == model_style("nonlinear")["color"]
    assert below.lines[0].get_ydata() == pytest.approx(np.full(400, -1.0))  # 10⁻³ α
    assert below.texts[0].get_text() == "RMS 1·10⁻³ α"
    assert above.get_xlim() == (0, 6)


def test_a_fit_without_a_sample_is_refused():
    empty = Curve(np.empty(0), np.empty(0))
    with pytest.raises(ValueError, match="no sample"):
        fitted_history(MEASURED_ANGLE, empty, empty, model="nonlinear")
