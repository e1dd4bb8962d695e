"""Advice on earthquakes: the Span whose outcome is least certain, by ensembles on the recorded table motion."""

from __future__ import annotations

from typing import Any

import pytest

from colonnade.campaign import load
from colonnade.store.records.summary import read_summary
from colonnade.workflow.advising.earthquake import advise_earthquakes
from colonnade.workflow.pooling import restitution_taken


def test_the_least_certain_span_is_beyond_those_that_only_rocked(small: Any) -> None:
    text = (small.folder / "campaign.toml").read_text(encoding="utf-8")
    first, *others = text.split('id = "pulse-01"\nkind = "pulse"')
    (rest,) = others
    changed = f'{first}id = "pulse-01"\nkind = "earthquake"\nmotion = "half a sine"\nspan = 1.0{rest}'
    (small.folder / "campaign.toml").write_text(changed, encoding="utf-8")
    campaign, summary = load(small.folder), read_summary(small.layout)
    assert summary is not None
    pooled = restitution_taken(campaign, small.layout, "prism")
    (advice,) = advise_earthquakes(campaign, small.layout, "prism", pooled, summary.tests)
    assert advice.test.startswith("half a sine, Span ")
    assert advice.values["span"] > 1.0
    assert 0.0 < advice.risk <= campaign.next.largest_risk
    assert advice.demand["acceleration"] == pytest.approx(
        advice.values["span"] * summary.tests["pulse-01"].pga, rel=0.05
    )
