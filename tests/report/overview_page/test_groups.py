"""Tests of the overview in groups, with their maps, peaks and thumbnails."""

import json
import re
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from colonnade.dynamics.maps import stability_map
from colonnade.figures.panels.curve import Curve
from colonnade.report.overview_page import agreement, groups
from colonnade.report.pictures.registry import picture
from colonnade.report.pictures.subjects import of_specimen, span_of
from colonnade.report.rows import HEIGHT, WIDTH, polyline
from colonnade.store import files
from colonnade.store.layout import Layout
from colonnade.store.records.stored import as_dataset


def test_sines_of_known_amplitude_are_in_the_ladder(rows):
    found = {frequency: [row.id for row in tests] for frequency, tests in groups.ladder(rows).items()}
    assert found == {"3 Hz": ["sine-3hz-too-strong-for-the-block-1"]}


def test_one_span_alone_is_not_set_beside_itself(reported):
    assert groups.span_groups([span_of(reported["span-2.0"])]) == []


STRONG = "sine-3hz-too-strong-for-the-block-1"


def with_another(rows, frequency_ratio):
    """Add a sine test of another Ω that rocked."""
    (row,) = (row for row in rows if row.id == STRONG)
    changes = {"frequency_ratio": frequency_ratio, "amplitude_ratio": 1.5, "outcome": "rocking"}
    record = row.record.model_copy(update=changes)
    return [*rows, replace(row, test=row.test.model_copy(update={"id": "another"}), record=record)]


def with_records(campaign, layout, rows):
    """The prism with these tests."""
    return of_specimen(campaign, layout, "prism", {row.id: row.record for row in rows}, [], [])


def test_two_frequencies_make_a_map_whose_marks_lead_to_their_tests(rows, filled_campaign):
    subject = with_records(*filled_campaign, with_another(rows, 5.0))
    assert picture("map", subject) is None
    drawn = picture("measured-map", subject)
    assert [f'href="test:{name}"' in drawn.svg for name in (STRONG, "another")] == [True, True]
    assert len(groups.boundaries_of(subject.points)) == 2


def test_computed_maps_are_drawn_with_the_tests_and_a_failed_one_is_not(rows, filled_campaign, tmp_path):
    campaign, layout = filled_campaign[0], Layout(tmp_path)
    chart = stability_map(
        campaign.block("prism"),
        restitution=0.93,
        frequency_ratio=[3.0, 5.5],
        amplitude_ratio=[1.0, 2.0],
        cycles=3,
        model="nonlinear",
    )
    attributes = {"stage": "map", "settings": json.dumps(chart.options)}
    files.write_failed(layout.stage("prism", "map", "linear"), "no", attributes=attributes)
    files.write(as_dataset(chart), layout.stage("prism", "map", "nonlinear"), attributes=attributes)
    drawn = picture("map", with_records(campaign, layout, with_another(rows, 5.0)))
    assert "nonlinear: lower limit" in drawn.svg
    assert ">linear: lower limit" not in drawn.svg
    assert 'href="test:another"' in drawn.svg


MODELS = ("linear", "nonlinear")


def test_the_peaks_that_agree_least_come_first_too_large_or_too_small(row_of):
    rows = [
        row_of("right", "rocking", 0.4, linear=("rocking", 0.4), nonlinear=("rocking", 0.44)),
        row_of("large", "rocking", 0.1, linear=("rocking", 0.3)),
        row_of("small", "rocking", 0.4, linear=("rocking", 0.1)),
        row_of("fallen", "overturned", linear=("rocking", 0.9)),
        row_of("still", "no-rocking", 0.001, linear=("rocking", 0.2)),
        row_of("falls", "rocking", 0.4, linear=("overturned", None)),
    ]
    found = agreement.worst(rows, MODELS)
    assert [(each.row.id, each.model) for each in found] == [
        ("small", "linear"),
        ("large", "linear"),
        ("right", "nonlinear"),
        ("right", "linear"),
    ]
    assert found[0].factor == pytest.approx(0.25)


def test_no_more_than_ten_are_named(row_of):
    rows = [row_of(f"test-{n}", "rocking", 0.1, linear=("rocking", 0.1 + 0.01 * n)) for n in range(20)]
    found = agreement.worst(rows, MODELS)
    assert [each.row.id for each in found] == [f"test-{n}" for n in range(19, 9, -1)]


def test_every_prediction_of_a_test_that_rocked_is_a_point_with_its_band(row_of):
    rows = [
        row_of("a", "rocking", 0.4, linear=("rocking", 0.5, {"peak_low": 0.3, "peak_high": 0.6})),
        row_of("b", "rocking", 0.4, linear=("overturned", None)),
        row_of("c", "overturned", linear=("overturned", None)),
    ]
    found = agreement.peak_points(rows, MODELS, agreement.worst(rows, MODELS))
    assert found.keys() == {"linear"}
    assert found["linear"] == [(0.4, 0.5, 0.3, 0.6, "a", 1), (0.4, None, None, None, "b", None)]


def test_the_picture_leads_to_each_test(row_of):
    rows = [row_of(name, "rocking", 0.4, linear=("rocking", 0.5)) for name in ("a", "b")]
    picture = agreement.peaks_picture(agreement.peak_points(rows, MODELS, []))
    assert 'role="group"' in picture.svg
    for name in ("a", "b"):
        assert f'<a href="test:{name}" aria-label="{name}">' in picture.svg
    assert agreement.peaks_picture({}) is None


def points(text):
    return [tuple(map(int, point.split(","))) for point in text.split()]


@given(st.lists(st.floats(-5, 5) | st.just(float("nan")), min_size=2, max_size=400))
def test_it_is_some_hundred_bytes_of_whole_numbers_within_the_picture(values):
    text = polyline(Curve(np.linspace(0.0, 7.0, len(values)), np.array(values)))
    assert re.fullmatch(r"(\d+,\d+( |$))*", text)
    assert len(text) < 600
    assert all(0 <= across <= WIDTH and 0 <= down <= HEIGHT for across, down in points(text))
    assert [across for across, _ in points(text)] == sorted(across for across, _ in points(text))


def test_the_highest_peak_is_not_lost(row_of):
    time = np.linspace(0.0, 30.0, 30_001)
    angle = np.zeros(time.size)
    angle[12_345] = 0.8
    angle[20_000] = -3.0
    found = [down for _, down in points(polyline(Curve(time, angle)))]
    assert (min(found), max(found)) == (2, HEIGHT)


def test_a_still_test_is_two_points():
    time = np.linspace(0.0, 30.0, 3001)
    assert polyline(Curve(time, np.full(time.size, 1e-4))) == "0,10 64,10"


def test_nothing_measured_gives_nothing():
    assert polyline(None) == polyline(Curve(np.array([1.0]), np.array([0.0]))) == ""
