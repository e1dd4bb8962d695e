import numpy as np
import pytest

from colonnade.figures.histories import Panel
from colonnade.figures.panels.curve import Curve
from colonnade.figures.panels.layout import PAGE
from colonnade.figures.stored.record import SpanPanel, spans_side_by_side, whole_record
from colonnade.figures.style import journal, styled

TIME = np.linspace(0.0, 10.0, 2001)


def swing(amplitude):
    return Curve(TIME, amplitude * np.sin(2 * np.pi * TIME))


def whole(*panels, **options):
    return whole_record({"measured": swing(0.4), "linear": swing(0.3)}, panels, **options)


MISFIT = Panel("Misfit", "predicted −\nmeasured, / α", "", {"linear": swing(0.1)})
BASE = Panel("Base", "base", "m/s²", {"": swing(12.0)}, 2.0, "g tan α")


def test_no_label_leaves_the_figure_or_meets_another():
    figure = whole(
        MISFIT,
        Panel("Out of plane", "out of plane", "mrad", {"": swing(-0.0123)}),
        Panel("Slide, y", "slide, y", "mm", {"": swing(1234.0)}),
        BASE,
    )
    figure.draw_without_rendering()
    page = figure.bbox
    boxes = [axes.yaxis.get_label().get_window_extent() for axes in figure.axes]
    with styled():  # the ticks are made here: none is for drawing
        numbers = [label.get_window_extent() for axes in figure.axes for label in axes.get_yticklabels()]
    for box in boxes:
        assert box.x0 >= page.x0
        assert not any(box.overlaps(other) for other in (*boxes, *numbers) if other is not box)
    for axes in figure.axes:
        for text in axes.texts:
            assert text.get_window_extent().x1 <= page.x1


def panels(count=3, models=("linear", "nonlinear"), base=True):
    return [
        SpanPanel(
            f"Span {k}",
            {"measured": swing(0.1 * k)} | {model: swing(0.12 * k) for model in models},
            swing(k) if base else None,
        )
        for k in range(1, count + 1)
    ]


def test_all_spans_have_the_same_scales():
    figure = spans_side_by_side(panels())
    limits = [axes.get_ylim() for axes in figure.axes]
    angles, bases = limits[0:9:3] + limits[1:9:3], limits[2:9:3]
    assert angles == [pytest.approx((-0.4032, 0.4032), rel=1e-3)] * 6
    assert bases == [pytest.approx((-3.36, 3.36), rel=1e-3)] * 3
    assert {axes.get_xlim() for axes in figure.axes} == {(0.0, 10.0)}


def test_three_spans_fit_a_column_of_a_page_each_with_its_labels():
    with journal("single"):
        figure = spans_side_by_side(panels())
    assert figure.get_figheight() <= PAGE + 0.3  # a second row of the legend
    assert [axes.get_ylabel() for axes in figure.axes] == ["θ / α", "θ / α", "base\n(m/s²)"] * 3
