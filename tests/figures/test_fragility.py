"""Curves of overturning, and columns that stand or lie."""

import numpy as np
import pytest

from colonnade.figures.agreement import pit_histogram
from colonnade.figures.fragility import COLUMNS, Curve, fragility, response_spectra, twenty_columns

CURVE = Curve(
    np.array([1.0, 2.0, 4.0]), np.array([0.0, 0.4, 1.0]), np.array([0.0, 0.2, 0.8]), np.array([0.1, 0.6, 1.0])
)


def test_curves_and_shares_are_where_they_belong():
    [axes] = fragility(CURVE, CURVE, label="PGV (m/s)", taken="isotonic", shares=np.array([0.1, 0.3, 0.9])).axes
    drawn = {line.get_label(): line for line in axes.lines}
    assert drawn["lognormal curve"].get_ydata() == pytest.approx(CURVE.probability)
    assert drawn["share at a level"].get_ydata() == pytest.approx([0.1, 0.3, 0.9])
    assert drawn["curve that only rises"].get_linewidth() > drawn["lognormal curve"].get_linewidth()
    assert axes.get_xlabel() == "PGV (m/s)"


def test_without_a_lognormal_curve_only_the_other_is_drawn():
    [axes] = fragility(None, CURVE, label="PGA (g)", taken="isotonic", shares=None).axes
    assert "lognormal curve" not in {line.get_label() for line in axes.lines}


@pytest.mark.parametrize(("share", "lie", "words"), [(0.0, 0, "hardly any falls"), (0.06, 1, "1 of 20 falls")])
@pytest.mark.parametrize("more", [0, 5])
def test_as_many_columns_lie_as_fall(share, lie, words, more):
    [axes] = twenty_columns(["PGV 1 m/s"], np.array([share + more / COLUMNS])).axes
    lying = [patch for patch in axes.patches if patch.get_width() > patch.get_height()]
    assert len(axes.patches) == COLUMNS
    assert len(lying) == lie + more
    if not more:
        assert words in {text.get_text() for text in axes.texts}


def test_spectra_are_drawn_with_their_median():
    period, values = np.array([0.1, 1.0]), np.array([[0.1, 0.2], [0.3, 0.4], [0.5, 0.9]])
    [axes] = response_spectra(period, values).axes
    *each, median = axes.lines
    assert [line.get_ydata().tolist() for line in each] == values.tolist()
    assert median.get_ydata().tolist() == [0.3, 0.4]


def evenly(tests):
    return (np.arange(tests) + 0.5) / tests


def test_the_histogram_of_an_even_pit_is_even():
    [axes] = pit_histogram({"linear": evenly(20)}).axes
    (histogram,) = (patch for patch in axes.patches if patch.get_label() == "linear model")
    assert histogram.get_data().values == pytest.approx(np.full(5, 0.2))
