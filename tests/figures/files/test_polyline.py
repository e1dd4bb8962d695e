"""Paths by steps lead through the same points as they did before."""

import re

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from colonnade.figures.files.output import shorter

POINTS = st.lists(st.tuples(*[st.floats(-5000, 5000)] * 2), min_size=1, max_size=40)


def absolute(lines, is_closed):
    parts = (" L ".join(f"{x:.6f} {y:.6f}" for x, y in points) for points in lines)
    return " ".join(f"M {part} \n{'z' if is_closed else ''}" for part in parts)


def followed(path):
    """Points of each line of a path of M, l and z, walked as the SVG standard says."""
    lines = []
    for part in path.split("M")[1:]:
        first, _, rest = part.rstrip("z").partition("l")
        start, steps = (
            np.array(re.findall(r"-?(?:\d+\.?\d*|\.\d+)", text), dtype=float).reshape(-1, 2) for text in (first, rest)
        )
        lines.append(np.concatenate((start, start + np.cumsum(steps, axis=0))))
    return lines


@given(lines=st.lists(POINTS, min_size=1, max_size=3), is_closed=st.booleans())
def test_the_points_are_the_same_to_half_a_hundredth_however_long_the_line(lines, is_closed):
    path = shorter(absolute(lines, is_closed))
    assert path.count("z") == (len(lines) if is_closed else 0)
    for found, given_points in zip(followed(path), lines, strict=True):
        assert found == pytest.approx(np.array(given_points), abs=0.00501)


def test_a_path_with_a_curve_stays():
    curve = "M 0 -3 C 0.8 -3 1.6 -2.7 2.1 -2.1 z"
    assert shorter(curve) == curve


def test_a_curve_of_many_points_takes_two_thirds_of_the_room_at_most():
    time = np.arange(1000)
    path = absolute([list(zip(72 + 0.35 * time, 200 + 50 * np.sin(0.3 * time), strict=True))], False)
    assert len(shorter(path)) < 2 / 3 * len(re.sub(r"(?<=\.\d\d)\d+", "", path))
