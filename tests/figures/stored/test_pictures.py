"""Pictures of stored tests: what is drawn, said and left out."""

from dataclasses import replace

import numpy as np
import pytest

from colonnade.figures.files.table import columns_of
from colonnade.figures.maps import response_orders
from colonnade.figures.panels.curve import Curve
from colonnade.figures.stored import record, restitution
from colonnade.figures.stored.record import angle, measured_ratio, misfits, motion, ratios, spreads
from colonnade.identification.response.boundaries import MapPoint
from colonnade.stages.parts.beginning import AT_REST, RECORDED
from colonnade.store.records.test import driven_by


def test_a_test_is_drawn_and_described(known):
    picture = record.record(*known("span-2.0"))
    assert picture.identity == "record-span-2.0"
    assert picture.description.startswith("Measured: rocking, largest |θ|/α 0.19 at 2.536 s. Linear model: rocking")
    assert len(picture.figure.axes) == 4  # angle, misfit, slide, base


def test_the_base_of_a_free_vibration_is_drawn_only_if_it_drives(known):
    # The table of `free-refused` moves; its accelerometer is the wrong way round.
    for name, driving in (("free-01", AT_REST), ("free-refused", RECORDED)):
        test, summary, stored, block = known(name)
        assert stored.array("rocking", "base_acceleration").any()
        assert driven_by(stored) == driving
        assert not _draws_base(record.record(test, summary, _driven_by(stored, AT_REST), block))
        assert _draws_base(record.record(test, summary, _driven_by(stored, RECORDED), block))


def _draws_base(picture):
    return any(axes.get_ylabel().startswith("base") for axes in picture.figure.axes)


def _driven_by(stored, motion):
    datasets = {
        key: dataset.assign_attrs(driven_by=motion) if key[0] == "predict" else dataset
        for key, dataset in stored.datasets.items()
    }
    return replace(stored, datasets=datasets)


def test_each_model_has_a_panel_of_its_spread(known):
    test, _, stored, block = known("span-3.0")
    picture = record.bands(test, stored, block)
    assert len(picture.figure.axes) == 2
    assert "of its runs overturn." in picture.description


def test_of_many_spans_some_are_drawn_and_the_caption_says_so():
    curve = Curve(np.array([0.0, 1.0]), np.array([0.0, 0.1]))
    panels = [record.SpanPanel(f"Span {k}", {"measured": curve, "linear": curve}, curve) for k in range(40)]
    picture = record.spans("spans", "Spans", "", panels)
    titles = [title for axes in picture.figure.axes if (title := axes.get_title(loc="left"))]
    assert len(titles) == record.MOST_SPANS
    assert (titles[0], titles[-1]) == ("Span 0", "Span 39")
    assert picture.note.startswith("12 of 40 tests are drawn")
    assert record.spans("spans", "Spans", "", panels[:12]).note == ""


STRONG = "sine-3hz-too-strong-for-the-block-1"


def test_measured_and_predicted_are_drawn_and_said(known):
    picture = angle(*known("span-2.0"))
    assert (picture.identity, picture.title) == ("angle-span-2.0", "span-2.0: rocking angle over time")
    assert picture.description.startswith("Measured: rocking, largest |θ|/α 0.19")
    columns = columns_of(picture.figure)
    assert {"θ / α, measured", "θ / α, linear model", "θ / α, nonlinear model"} <= columns.keys()
    _, record, *_ = known("span-2.0")
    measured = np.array([value for value in columns["θ / α, measured"] if value is not None], dtype=float)
    assert np.nanmax(np.abs(measured)) == pytest.approx(record.peak_ratio, rel=1e-3)


def title(picture):
    (axes,) = picture.figure.axes
    return axes.get_title(loc="left")


def test_an_earthquake_is_named_by_its_motion_and_span_and_a_sine_by_its_ratios(known):
    test, record, stored, block = known("span-2.0")
    assert title(angle(test, record, stored, block)) == f"prism, {test.motion}, Span 2.0"
    nameless = test.model_copy(update={"motion": None})
    assert title(angle(nameless, record, stored, block)) == "prism, earthquake, Span 2.0"
    sine = record.model_copy(update={"frequency_ratio": 3.456, "amplitude_ratio": 2.0})
    assert title(angle(test, sine, stored, block)) == "prism, Ω = 3.46, A = 2.00"


def test_any_other_test_is_named_by_its_id(known):
    assert title(angle(*known("free-01"))) == "prism, free-01"


def test_without_an_angle_there_is_nothing_to_draw(known):
    assert angle(*known("later")) is None


def test_a_free_vibration_has_every_picture(known):
    test, _, stored, block = known("free-01")
    level = restitution.level_of(stored, "restitution", "e identified")
    assert level.low < level.value < level.high
    series = restitution.peak_series(test, stored, block)
    assert restitution.peaks("peaks", [series], block).description == f"free-01: 19 of {series.used.size} peaks used."
    assert restitution.impacts("impacts", [restitution.impact_series(test, stored)], level, 0.95) is not None
    assert restitution.fitted(test, stored, block).title.startswith(
        "free-01: measured free vibration and the nonlinear"
    )
    assert restitution.region(test, stored).description.startswith("Together: e = 0.93")


def test_the_recommended_estimator_is_marked(known):
    rows = restitution.estimate_rows(known("free-01")[2])
    assert [row.name for row in rows if row.recommended] == ["whole history"]


def test_another_kind_of_test_has_none(known):
    test, _, stored, block = known("span-2.0")
    assert restitution.peak_series(test, stored, block) is None
    assert restitution.impact_series(test, stored) is None
    assert restitution.fitted(test, stored, block) is None
    assert restitution.region(test, stored) is None
    assert restitution.estimators("estimators", [], 0.95) is None


def test_sine_tests_are_counted_by_outcome():
    points = [
        MapPoint("a", 3.0, 1.2, "rocking"),
        MapPoint("b", 3.0, 2.0, "overturned"),
        MapPoint("c", 4.0, 1.4, "rocking"),
    ]
    picture = response_orders.tested("map-prism", points)
    assert picture.identity == "map-prism"
    assert picture.description == "3 tests: 2 rocking, 1 overturned."


def test_measured_and_predicted_are_over_the_critical_angle(known):
    _, record, stored, block = known("span-2.0")
    measured = measured_ratio(stored, block)
    assert np.nanmax(np.abs(measured.values)) == pytest.approx(record.peak_ratio, rel=1e-6)
    assert set(ratios(stored, block)) == {"measured", "linear", "nonlinear"}


def test_misfits_end_where_the_comparison_ends(known):
    _, _, stored, block = known("span-3.0")
    curves = ratios(stored, block)
    for model, misfit in misfits(stored, curves).items():
        assert misfit.time[-1] <= stored.compared("compared_until", model) < curves["measured"].time[-1]


def test_each_model_has_the_bands_of_its_ensemble(known):
    _, _, stored, block = known("span-2.0")
    for spread in spreads(stored, block).values():
        assert spread.bands.shape == (spread.levels.size, spread.time.size)
        assert 0.0 < spread.horizon <= spread.time[-1]


def test_what_was_not_measured_is_none(known):
    _, _, stored, block = known("watched")
    assert measured_ratio(stored, block) is None
    assert motion(stored, "slide", "mm") is None
    assert motion(stored, "base_acceleration", "m/s²") is not None


def test_a_curve_ends_where_it_overturns(known):
    _, record, stored, block = known(STRONG)
    curve = measured_ratio(stored, block)
    fall = stored.value("rocking", "overturning_time")
    last = int(np.flatnonzero(np.isfinite(curve.values))[-1])
    assert record.outcome == "overturned"
    assert record.peak_time == fall
    assert curve.time[last] == pytest.approx(fall, abs=0.005)
    assert abs(curve.values[last]) == pytest.approx(1.0, abs=0.1)
