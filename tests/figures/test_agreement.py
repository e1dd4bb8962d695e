import numpy as np
import pytest

from colonnade.figures.agreement import PeakPoint, predicted_over_measured
from colonnade.figures.style import journal
from every import every

MODELS = ("linear", "nonlinear", "contact")


def point(measured, predicted, low=None, high=None, number=None, test="a"):
    return PeakPoint(measured, predicted, low, high, test, number)


def panel(*points):
    return predicted_over_measured({"linear": points}).axes[0]


def test_each_model_has_a_panel_with_the_same_logarithmic_axes():
    figure = predicted_over_measured({"linear": [point(0.2, 0.3)], "nonlinear": [point(0.02, 0.02)]})
    one, other = figure.axes
    assert (one.get_title(loc="left"), other.get_title(loc="left")) == ("linear model", "nonlinear model")
    assert one.get_xlim() == one.get_ylim() == other.get_xlim() == other.get_ylim()
    assert one.get_xscale() == one.get_yscale() == "log"
    assert one.get_xlim()[0] < 0.02


def test_what_has_no_place_on_the_axis_is_marked_at_its_edge():
    axes = panel(point(0.2, 0.3), point(0.3, None), point(0.4, 1e-9))
    low, high = axes.get_ylim()
    heights = [float(np.asarray(marks.get_offsets())[0, 1]) for marks in axes.collections]
    assert heights[0] == 0.3
    assert 0.9 * high < heights[1] < high
    assert low < heights[2] < 1.1 * low


def test_a_band_that_ends_with_overturning_reaches_the_upper_edge():
    axes = panel(point(0.2, 0.3, 0.25, 0.4), point(0.5, 0.6, 0.45, None))
    bars = np.asarray(axes.lines[1].get_ydata())
    assert bars[:2].tolist() == [0.25, 0.4]
    assert bars[3:5].tolist() == [0.45, axes.get_ylim()[1]]


@pytest.mark.whole
@every("column", ["", "single", "double"])
@every("models", [MODELS[:1], MODELS[:2], MODELS], ids=len)
def test_titles_and_labels_are_inside_the_figure(models, column):
    with journal(column):
        figure = predicted_over_measured({model: [point(0.4, 0.5)] for model in models})
    figure.draw_without_rendering()
    box, (wide, high) = figure.get_tightbbox(), figure.get_size_inches()
    assert box.x0 >= 0.0
    assert box.y0 >= 0.0
    assert box.x1 <= wide
    assert box.y1 <= high


@every("column", ["single", "double"])
def test_numbers_keep_clear_of_the_bars_of_their_neighbours(column):
    points = [
        point(0.30, 0.30, 0.1, 0.9, 1),
        point(0.33, 0.2, 0.1, 0.9),
        point(0.5, 0.3, 0.1, None, 2),
        point(0.6, 0.9),
    ]
    with journal(column):
        axes = panel(*points)
    axes.figure.draw_without_rendering()
    for text in axes.texts:
        box = text.get_window_extent()
        for each in points[:3]:
            across = axes.transData.transform((each.measured, 1.0))[0]
            assert not box.x0 < across < box.x1, (text.get_text(), each.measured)
