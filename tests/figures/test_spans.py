import numpy as np
import pytest
from matplotlib.colors import to_hex

from colonnade.figures.panels.curve import Curve
from colonnade.figures.panels.layout import PAGE
from colonnade.figures.record import SpanPanel, spans_side_by_side
from colonnade.figures.style import journal, model_style

TIME = np.linspace(0.0, 10.0, 2001)


def swing(amplitude):
    return Curve(TIME, amplitude * np.sin(2 * np.pi * TIME))


def panels(count=3, models=("linear", "nonlinear"), base=True):
    return [
        SpanPanel(f"Span {k}", swing(0.1 * k), {model: swing(0.12 * k) for model in models}, swing(k) if base else None)
        for k in range(1, count + 1)
    ]


def titles(figure):
    return [axes.get_title(loc="left") for axes in figure.axes if axes.get_title(loc="left")]


def test_spans_stand_beside_each_other_in_their_order():
    figure = spans_side_by_side(panels())
    first_row = [axes for axes in figure.axes if axes.get_title(loc="left")]
    assert titles(figure) == ["Span 1", "Span 2", "Span 3"]
    places = [axes.get_position() for axes in first_row]
    assert len({place.y0 for place in places}) == 1
    assert places[0].x0 < places[1].x0 < places[2].x0


def test_all_spans_have_the_same_scales():
    figure = spans_side_by_side(panels())
    limits = [axes.get_ylim() for axes in figure.axes]
    angles, bases = limits[0:9:3] + limits[1:9:3], limits[2:9:3]
    assert angles == [pytest.approx((-0.4032, 0.4032), rel=1e-3)] * 6
    assert bases == [pytest.approx((-3.36, 3.36), rel=1e-3)] * 3
    assert {axes.get_xlim() for axes in figure.axes} == {(0.0, 10.0)}


def test_each_model_has_a_row_on_the_measured():
    figure = spans_side_by_side(panels(1))
    linear, nonlinear, base = figure.axes
    assert [to_hex(axes.lines[1].get_color()) for axes in (linear, nonlinear)] == [
        model_style("linear")["color"],
        model_style("nonlinear")["color"],
    ]
    assert len(base.lines) == 1


def test_a_fourth_span_begins_a_new_band():
    figure = spans_side_by_side(panels(4, ("linear",), base=False))
    bottoms = [axes.get_position().y0 for axes in figure.axes]
    assert bottoms[0] == bottoms[1] == bottoms[2] > bottoms[3]


def test_without_prediction_and_base_the_measured_stands_alone():
    figure = spans_side_by_side(panels(2, (), base=False))
    assert [len(axes.lines) for axes in figure.axes] == [1, 1]


def test_three_spans_fit_a_column_of_a_page_each_with_its_labels():
    with journal("single"):
        figure = spans_side_by_side(panels())
    assert figure.get_figheight() <= PAGE + 0.3  # a second row of the legend
    assert [axes.get_ylabel() for axes in figure.axes] == ["θ / α", "θ / α", "base\n(m/s²)"] * 3
