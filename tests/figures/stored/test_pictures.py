"""Pictures of stored tests: what is drawn, said and left out."""

from dataclasses import replace

import numpy as np
import pytest

from colonnade.figures.histories import Panel
from colonnade.figures.panels.curve import Curve
from colonnade.figures.panels.layout import PAGE
from colonnade.figures.restitution import decay, estimators
from colonnade.figures.stored import record
from colonnade.figures.stored.subject import MOST
from colonnade.figures.style import journal, styled
from colonnade.stages.parts.beginning import AT_REST, RECORDED
from colonnade.store.records.test import driven_by


def test_a_test_is_drawn_and_described(reported):
    picture = record.record(reported["span-2.0"])
    assert picture.identity == "record-span-2.0"
    assert picture.description.startswith("Measured: rocking, largest |θ|/α 0.19 at 2.536 s. Linear model: rocking")
    assert len(picture.figure.axes) == 4  # angle, misfit, slide, base


def test_the_base_of_a_free_vibration_is_drawn_only_if_it_drives(reported):
    # The table of `free-refused` moves; its accelerometer is the wrong way round.
    for name, driving in (("free-01", AT_REST), ("free-refused", RECORDED)):
        one = reported[name]
        assert one.stored.array("rocking", "base_acceleration").any()
        assert driven_by(one.stored) == driving
        assert not _draws_base(record.record(_driven_by(one, AT_REST)))
        assert _draws_base(record.record(_driven_by(one, RECORDED)))


def _draws_base(picture):
    return any(axes.get_ylabel().startswith("base") for axes in picture.figure.axes)


def _driven_by(one, motion):
    datasets = {
        key: dataset.assign_attrs(driven_by=motion) if key[0] == "predict" else dataset
        for key, dataset in one.stored.datasets.items()
    }
    return replace(one, stored=replace(one.stored, datasets=datasets))


def test_of_many_spans_some_are_drawn_and_the_caption_says_so():
    curve = Curve(np.array([0.0, 1.0]), np.array([0.0, 0.1]))
    panels = [record.SpanPanel(f"Span {k}", {"measured": curve, "linear": curve}, curve) for k in range(40)]
    picture = record.spans("spans", "Spans", "", panels)
    titles = [title for axes in picture.figure.axes if (title := axes.get_title(loc="left"))]
    assert len(titles) == MOST
    assert (titles[0], titles[-1]) == ("Span 0", "Span 39")
    assert picture.note.startswith("12 of 40 tests are drawn")
    assert record.spans("spans", "Spans", "", panels[:12]).note == ""


STRONG = "sine-3hz-too-strong-for-the-block-1"


def title(picture):
    (axes,) = picture.figure.axes
    return axes.get_title(loc="left")


def test_an_earthquake_is_named_by_its_motion_and_span_and_a_sine_by_its_ratios(reported):
    one = reported["span-2.0"]
    assert title(record.angle(one)) == f"prism, {one.test.motion}, Span 2.0"
    nameless = replace(one, test=one.test.model_copy(update={"motion": None}))
    assert title(record.angle(nameless)) == "prism, earthquake, Span 2.0"
    sine = replace(one, record=one.record.model_copy(update={"frequency_ratio": 3.456, "amplitude_ratio": 2.0}))
    assert title(record.angle(sine)) == "prism, Ω = 3.46, A = 2.00"


def test_without_an_angle_there_is_nothing_to_draw(reported):
    assert record.angle(reported["later"]) is None


def test_a_free_vibration_has_every_picture(reported):
    one = reported["free-01"]
    level = decay.level_of(one.stored, "restitution", "e identified")
    assert level.low < level.value < level.high
    series = decay.peak_series(one)
    drawn = decay.peaks("peaks", [series], one.block)
    assert drawn.description == f"free-01: 19 of {series.used.size} peaks used."
    assert decay.impacts("impacts", [decay.impact_series(one)], level, 0.95) is not None
    assert estimators.fitted(one).title.startswith("free-01: measured free vibration and the nonlinear")
    assert estimators.region(one).description.startswith("Together: e = 0.93")


def test_misfits_end_where_the_comparison_ends(reported):
    one = reported["span-3.0"]
    for model, misfit in one.misfits().items():
        assert misfit.time[-1] <= one.stored.compared("compared_until", model) < one.measured_ratio().time[-1]


def test_a_curve_ends_where_it_overturns(reported):
    one = reported[STRONG]
    curve, fall = one.measured_ratio(), one.stored.value("rocking", "overturning_time")
    last = int(np.flatnonzero(np.isfinite(curve.values))[-1])
    assert (one.record.outcome, one.record.peak_time) == ("overturned", fall)
    assert curve.time[last] == pytest.approx(fall, abs=0.005)
    assert abs(curve.values[last]) == pytest.approx(1.0, abs=0.1)


def swing(amplitude):
    time = np.linspace(0.0, 10.0, 2001)
    return Curve(time, amplitude * np.sin(2 * np.pi * time))


def test_no_label_leaves_the_figure_or_meets_another():
    panels = [
        Panel("Misfit", "predicted −\nmeasured, / α", "", {"linear": swing(0.1)}),
        Panel("Out of plane", "out of plane", "mrad", {"": swing(-0.0123)}),
        Panel("Slide, y", "slide, y", "mm", {"": swing(1234.0)}),
        Panel("Base", "base", "m/s²", {"": swing(12.0)}, 2.0, "g tan α"),
    ]
    figure = record.whole_record({"measured": swing(0.4), "linear": swing(0.3)}, panels)
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


def test_three_spans_fit_a_column_of_a_page_each_with_its_labels_and_have_the_same_scales():
    panels = [
        record.SpanPanel(
            f"Span {k}",
            {"measured": swing(0.1 * k), "linear": swing(0.12 * k), "nonlinear": swing(0.12 * k)},
            swing(k),
        )
        for k in (1, 2, 3)
    ]
    with journal("single"):
        figure = record.spans_side_by_side(panels)
    assert figure.get_figheight() <= PAGE + 0.3  # a second row of the legend
    assert [axes.get_ylabel() for axes in figure.axes] == ["θ / α", "θ / α", "base\n(m/s²)"] * 3
    limits = [axes.get_ylim() for axes in figure.axes]
    angles, bases = limits[0:9:3] + limits[1:9:3], limits[2:9:3]
    assert angles == [pytest.approx((-0.4032, 0.4032), rel=1e-3)] * 6
    assert bases == [pytest.approx((-3.36, 3.36), rel=1e-3)] * 3
    assert {axes.get_xlim() for axes in figure.axes} == {(0.0, 10.0)}
