"""Parts of tests as text: what comes back is what was written."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from colonnade.report.asked import asked_of
from colonnade.report.kept import ALTERED, from_text, to_text
from colonnade.report.parts import parts_of


@pytest.fixture(scope="module")
def parts(filled_campaign):
    """A free vibration, a test with a Span, and one that failed; their pages are not drawn again."""
    campaign, layout = filled_campaign
    asked = [each for each in asked_of(campaign, layout) if each.test in ("free-01", "span-2.0", "sine-dead")]
    return campaign, {
        part.row.id: replace(part, text=None, data=None) for part in parts_of(campaign, layout, "", asked)
    }


def again(campaign, part):
    return from_text(campaign, part.row.id, part.row.record, to_text(part))


@pytest.mark.parametrize("test", ["free-01", "span-2.0", "sine-dead"])
def test_a_part_comes_back_as_it_was(parts, test):
    campaign, part = parts[0], parts[1][test]
    back = again(campaign, part)
    assert (back.row, back.channels, back.thumbnail, back.used) == (part.row, part.channels, part.thumbnail, part.used)
    assert (back.text, back.data, back.made_from) == (None, None, part.made_from)
    assert to_text(back) == to_text(part)
    assert (back.span is None, back.free_vibration is None) == (part.span is None, part.free_vibration is None)


def test_curves_and_peaks_come_back_to_the_last_bit(parts):
    campaign, every = parts
    panel, back = every["span-2.0"].span.panel, again(campaign, every["span-2.0"]).span.panel
    assert back.predicted.keys() == panel.predicted.keys()
    assert np.array_equal(back.measured.values, panel.measured.values, equal_nan=True)
    series, back = (
        every["free-01"].free_vibration.drawn.peaks,
        again(campaign, every["free-01"]).free_vibration.drawn.peaks,
    )
    assert np.array_equal(back.angle, series.angle)
    assert back.used.dtype == np.bool_


def test_a_failure_keeps_its_stage(parts):
    campaign, every = parts
    assert again(campaign, every["sine-dead"]).row.failures[0].stage == "ingest"


@pytest.mark.parametrize(
    "damage", [lambda text: text[:-9], lambda text: "", lambda text: "\n[1, 2]", lambda text: "\n{}"]
)
def test_text_that_was_altered_is_refused(parts, damage):
    campaign, part = parts[0], parts[1]["free-01"]
    with pytest.raises(ALTERED):
        from_text(campaign, "free-01", part.row.record, damage(to_text(part)))
