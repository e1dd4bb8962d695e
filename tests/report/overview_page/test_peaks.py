import pytest

from colonnade.report.overview_page import peaks

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
    found = peaks.worst(rows, MODELS)
    assert [(each.row.id, each.model) for each in found] == [
        ("small", "linear"),
        ("large", "linear"),
        ("right", "nonlinear"),
        ("right", "linear"),
    ]
    assert found[0].factor == pytest.approx(0.25)


def test_no_more_than_ten_are_named(row_of):
    rows = [row_of(f"test-{n}", "rocking", 0.1, linear=("rocking", 0.1 + 0.01 * n)) for n in range(20)]
    found = peaks.worst(rows, MODELS)
    assert [each.row.id for each in found] == [f"test-{n}" for n in range(19, 9, -1)]


def test_every_prediction_of_a_test_that_rocked_is_a_point_with_its_band(row_of):
    rows = [
        row_of("a", "rocking", 0.4, linear=("rocking", 0.5, {"peak_low": 0.3, "peak_high": 0.6})),
        row_of("b", "rocking", 0.4, linear=("overturned", None)),
        row_of("c", "overturned", linear=("overturned", None)),
    ]
    found = peaks.points(rows, MODELS, peaks.worst(rows, MODELS))
    assert found.keys() == {"linear"}
    assert found["linear"] == [(0.4, 0.5, 0.3, 0.6, "a", 1), (0.4, None, None, None, "b", None)]


def test_the_picture_leads_to_each_test(row_of):
    rows = [row_of(name, "rocking", 0.4, linear=("rocking", 0.5)) for name in ("a", "b")]
    picture = peaks.picture(peaks.points(rows, MODELS, []))
    assert 'role="group"' in picture.svg
    for name in ("a", "b"):
        assert f'<a href="test:{name}" aria-label="{name}">' in picture.svg
    assert peaks.picture({}) is None
