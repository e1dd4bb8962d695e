"""The rocking angle of a stored test, and its title as a paper gives it."""

from __future__ import annotations

import numpy as np
import pytest

from colonnade.figures.files.table import table_of
from colonnade.figures.stored.angle import angle

STRONG = "sine-3hz-too-strong-for-the-block-1"


def test_measured_and_predicted_are_drawn_and_said(known):
    picture = angle(*known("span-2.0"))
    assert (picture.identity, picture.title) == ("angle-span-2.0", "span-2.0: rocking angle over time")
    assert picture.description.startswith("Measured: rocking, largest |θ|/α 0.19")
    columns = table_of(picture.figure)
    assert {"θ / α, measured", "θ / α, linear model", "θ / α, nonlinear model"} <= columns.keys()
    _, record, *_ = known("span-2.0")
    measured = np.array([value for value in columns["θ / α, measured"] if value is not None], dtype=float)
    assert np.nanmax(np.abs(measured)) == pytest.approx(record.peak_ratio, rel=1e-3)


def title(picture) -> str:
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
