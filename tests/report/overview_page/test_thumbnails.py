import re

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from colonnade.figures.panels.curve import Curve
from colonnade.report.overview_page.thumbnails import HEIGHT, WIDTH, polyline


def points(text: str) -> list[tuple[int, int]]:
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
