"""A test in the report: what its page shows, and its part of the pages about all tests, as text and back."""

import numpy as np
import pytest

from colonnade.report.asked import asked_of
from colonnade.report.build import Part, drawn
from colonnade.report.pictures import read_of_specimen, read_of_test, span_of

pytestmark = pytest.mark.whole

SHAKEN = "span-2.0"


def asked(campaign, layout, test, outdated=()):
    return next(each for each in asked_of(campaign, layout, outdated) if each.test == test)


def part_of(campaign, layout, test=SHAKEN, outdated=()):
    """The page of a test, and its part after it was kept as text."""
    wanted = asked(campaign, layout, test, outdated)
    (text, _), kept = drawn(layout, wanted)
    return text, Part.of(wanted, kept)


@pytest.mark.parametrize(
    ("test", "has_span", "has_free_vibration"),
    [
        ("free-01", False, True),
        ("span-2.0", True, False),
        ("sine-dead", False, False),
        ("watched", False, False),
        ("later", False, False),
    ],
)
def test_a_test_is_part_of_the_pages_of_its_kind(filled_campaign, test, has_span, has_free_vibration):
    _, part = part_of(*filled_campaign, test)
    assert (part.span is not None, part.kept.free_vibration is not None) == (has_span, has_free_vibration)
    if has_span:
        assert part.span.row is part.row
    if has_free_vibration:
        assert part.kept.free_vibration.test == test
        assert part.kept.free_vibration.e


def test_curves_and_peaks_come_back_to_the_last_bit(filled_campaign):
    shaken, free = (part_of(*filled_campaign, test)[1] for test in (SHAKEN, "free-01"))
    for name, curve in span_of(read_of_test(*filled_campaign, SHAKEN)).panel.curves.items():
        kept = shaken.span.panel.curves[name]  # thinned to what a picture shows
        assert np.isin(kept.time, curve.time).all()
        np.testing.assert_array_equal(kept.values, curve.values[np.searchsorted(curve.time, kept.time)])
    [decay, _] = read_of_specimen(*filled_campaign, "prism").decays
    np.testing.assert_array_equal(free.kept.free_vibration.peaks.angle, decay.peaks.angle)
    assert free.kept.free_vibration.peaks.used.dtype == np.bool_
