"""Advice on earthquakes: the Span whose outcome is least certain, by ensembles on the recorded table motion."""

import numpy as np
import pytest

from colonnade.campaign import load
from colonnade.store.records.summary import read_summary
from colonnade.workflow.advising.sine import STEP, advise_earthquakes
from colonnade.workflow.foresee import foresee


def as_earthquake(small, setup=""):
    """Call the first pulse of the small campaign an earthquake of Span 1, and give its one piece of advice."""
    small.edit('id = "pulse-01"\nkind = "pulse"', EARTHQUAKE)
    small.edit("[setups.frame.channels]", f"[setups.frame]\n{setup}\n[setups.frame.channels]")
    small.edit("members = 20", "members = 100\ngain = 0.05")  # one of 20 is too large a risk
    campaign, summary = load(small.folder), read_summary(small.layout)
    assert summary is not None
    (advice,) = advise_earthquakes(campaign, small.layout, "prism", summary.tests)
    return campaign, summary, advice


EARTHQUAKE = 'id = "pulse-01"\nkind = "earthquake"\nmotion = "half a sine"\nspan = 1.0'


def test_the_next_span_is_a_bounded_step_beyond_those_that_only_rocked(small):
    campaign, summary, advice = as_earthquake(small)
    assert advice.test.startswith("half a sine, Span ")
    assert 1.0 < advice.values["span"] <= STEP
    assert advice.risk <= campaign.next.largest_risk
    assert "bit" not in advice.reason
    stronger = advice.values["span"] * summary.tests["pulse-01"].pga
    assert advice.demand["acceleration"] == pytest.approx(stronger, rel=0.05)


def test_the_tilt_of_the_table_counts_as_in_a_forecast(small):
    """The advice and the forecast of one motion, on a table that leans, give one probability."""
    _, _, advice = as_earthquake(small, setup='table_tilt = "4 deg"')
    (made,) = foresee(small.folder, motion="pulse-01", levels=[f"{advice.values['span']!r}x"])
    assert advice.risk == pytest.approx(made.forecast.models["nonlinear"].overturned)
    assert np.degrees(made.forecast.inputs.table_tilt) == pytest.approx(4.0)
    assert advice.risk > 0.0
