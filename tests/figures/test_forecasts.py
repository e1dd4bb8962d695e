import numpy as np
import pytest

from colonnade.figures.forecasts import Calibration, reliability_and_pit
from colonnade.identification.calibration import Reliability


def calibration(tests=20):
    values = np.array([0.1, 0.5, 0.9])
    diagram = Reliability(values, values**2, np.array([5, 7, 8]), values - 0.1, values + 0.1, 0.95)
    return Calibration(diagram, (np.arange(tests) + 0.5) / tests)


def test_marks_are_at_the_shares_and_the_histogram_is_even():
    left, right = reliability_and_pit({"linear": calibration()}).axes
    drawn = next(line for line in left.lines if line.get_marker() == "o")
    assert drawn.get_ydata() == pytest.approx([0.01, 0.25, 0.81])
    assert sorted(text.get_text() for text in left.texts) == ["5", "7", "8"]
    (histogram,) = (patch for patch in right.patches if patch.get_label() == "linear model")
    assert histogram.get_data().values == pytest.approx(np.full(5, 0.2))


def test_more_tests_get_more_bins():
    right = reliability_and_pit({"linear": calibration(200), "nonlinear": calibration(200)}).axes[1]
    (histogram,) = (patch for patch in right.patches if patch.get_label() == "nonlinear model")
    assert histogram.get_data().values.size == 10
