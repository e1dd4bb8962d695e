import numpy as np

from colonnade.figures.panels.curve import Curve
from colonnade.figures.spans import SpanPanel
from colonnade.figures.stored import record


def test_a_test_is_drawn_and_described(known):
    picture = record.record(*known("span-2.0"))
    assert picture.identity == "record-span-2.0"
    assert picture.description.startswith("Measured: rocking, largest |θ|/α 0.19 at 2.536 s. Linear model: rocking")
    assert len(picture.figure.axes) == 4  # angle, misfit, slide, base


def test_a_test_that_was_not_run_has_no_picture(known):
    test, _, stored, block = known("later")
    assert record.record(*known("later")) is None
    assert record.bands(test, stored, block) is None


def test_the_base_of_a_free_vibration_is_drawn_only_if_it_drives(known):
    labels = {
        name: [axes.get_ylabel() for axes in record.record(*known(name)).figure.axes]
        for name in ("free-01", "free-refused")
    }
    assert not any(label.startswith("base") for label in labels["free-01"])
    assert any(label.startswith("base") for label in labels["free-refused"])


def test_each_model_has_a_panel_of_its_spread(known):
    test, _, stored, block = known("span-3.0")
    picture = record.bands(test, stored, block)
    assert len(picture.figure.axes) == 2
    assert "of its runs overturn." in picture.description


def test_of_many_spans_some_are_drawn_and_the_caption_says_so():
    curve = Curve(np.array([0.0, 1.0]), np.array([0.0, 0.1]))
    panels = [SpanPanel(f"Span {k}", curve, {"linear": curve}, curve) for k in range(40)]
    picture = record.spans("spans", "Spans", "", panels)
    titles = [title for axes in picture.figure.axes if (title := axes.get_title(loc="left"))]
    assert len(titles) == record.MOST_SPANS
    assert (titles[0], titles[-1]) == ("Span 0", "Span 39")
    assert picture.note.startswith("12 of 40 tests are drawn")
    assert record.spans("spans", "Spans", "", panels[:12]).note == ""
