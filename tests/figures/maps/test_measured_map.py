"""The measured map shows each test by its outcome, and bars where the boundaries lie."""

import numpy as np
import pytest

from colonnade.figures.maps.stability_map import measured_map
from colonnade.identification.response.boundaries import MapPoint

POINTS = [
    MapPoint("a", 3.35, 0.9, "no-rocking"),
    MapPoint("b", 3.35, 1.1, "rocking", 2),
    MapPoint("c", 3.35, 1.5, "overturned"),
    MapPoint("d", 4.46, 0.95, "no-rocking"),
    MapPoint("e", 4.46, 1.2, "rocking", "irregular"),
    MapPoint("f", 5.58, 0.95, "no-rocking"),
    MapPoint("g", 5.58, 1.2, "rocking", 1),
    MapPoint("h", 5.58, 2.5, "overturned"),
]


def drawn(points):
    axes = measured_map(points).axes[0]
    return axes, {
        collection.get_label(): collection.get_offsets().tolist()
        for collection in axes.collections
        if not str(collection.get_label()).startswith("_")
    }


def test_each_test_stands_at_its_place_under_its_outcome():
    _, groups = drawn(POINTS)
    assert groups == {
        "no rocking": [[3.35, 0.9], [4.46, 0.95], [5.58, 0.95]],
        "rocking": [[3.35, 1.1], [4.46, 1.2], [5.58, 1.2]],
        "overturned": [[3.35, 1.5], [5.58, 2.5]],
    }


def test_bars_span_the_brackets_and_the_line_breaks_where_there_is_none():
    axes, _ = drawn(POINTS)
    lines = {line.get_label(): line for line in axes.lines}
    assert lines["rocking begins"].get_ydata() == pytest.approx([1.0, 1.075, 1.075])
    assert lines["overturning begins"].get_ydata() == pytest.approx([1.3, float("nan"), 1.85], nan_ok=True)
    bars = [bar for group in axes.collections if hasattr(group, "get_segments") for bar in group.get_segments()]
    np.testing.assert_allclose(bars[-2:], [[[3.35, 1.1], [3.35, 1.5]], [[5.58, 1.2], [5.58, 2.5]]])


def test_sub_harmonic_tests_are_labelled_by_their_order_and_others_not():
    axes, _ = drawn(POINTS)
    assert [text.get_text() for text in axes.texts] == ["1/2"]


@pytest.mark.parametrize(("largest", "scale"), [(2.5, "linear"), (9.0, "log")])
def test_amplitudes_far_apart_are_drawn_on_a_logarithmic_axis(largest, scale):
    axes, _ = drawn([*POINTS, MapPoint("i", 7.8, largest, "rocking")])
    assert axes.get_yscale() == scale
    assert axes.get_ylim()[0] < 0.9
    assert axes.get_ylim()[1] > largest
