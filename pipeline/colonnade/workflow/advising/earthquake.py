"""Advice on the earthquakes of a specimen: the Span whose outcome is least certain."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from itertools import pairwise

import numpy as np

from colonnade.campaign import Campaign, Test
from colonnade.campaign.forms.summary import TestSummary
from colonnade.dynamics.models import MODELS
from colonnade.dynamics.motion import Motion
from colonnade.identification.advice import SpanAdvice, advise_span
from colonnade.stages.forecast import felt, plan_of
from colonnade.store.layout import Layout
from colonnade.store.records.advice import Advice, beyond
from colonnade.units.text import format_percent, number, probability
from colonnade.workflow.foresee import inputs_of
from colonnade.workflow.motions import recorded

STEP = 1.2
"""The largest Span that is advised, over the largest that was tested: models err, and a specimen may break."""

CLOSER = 3
"""Halvings between the last Span that stands more often than not, and the next."""

Outcome = tuple[float, float, float]
"""Probabilities of rocking and of overturning, and the peak acceleration of the table, m/s²."""


def advise_earthquakes(
    campaign: Campaign, layout: Layout, specimen: str, tests: Mapping[str, TestSummary]
) -> list[Advice]:
    """
    Advise the next Span of each base motion that a specimen was tested with.

    Parameters
    ----------
    campaign : Campaign
    layout : Layout
    specimen : str
        Its id.
    tests : mapping of str to TestSummary
        Records of the campaign's tests.

    Returns
    -------
    advice : list of Advice
        One for each motion with a recorded table motion and a Span.
    """
    by_motion: dict[str, list[Test]] = {}
    for test in campaign.tests.values():
        if test.specimen == specimen and test.kind == "earthquake" and test.span is not None:
            by_motion.setdefault(test.motion or "earthquake", []).append(test)
    found = (_advise(campaign, layout, specimen, motion, each, tests) for motion, each in by_motion.items())
    return [advice for advice in found if advice is not None]


def _advise(
    campaign: Campaign,
    layout: Layout,
    specimen: str,
    motion: str,
    listed: list[Test],
    tests: Mapping[str, TestSummary],
) -> Advice | None:
    models = [model for model in campaign.processing.predict.models if not MODELS[model].in_space]
    done = {
        test.span: (moved, inputs_of(campaign, layout, specimen, campaign.setups[test.setup].table_tilt or 0.0))
        for test in listed
        if test.span is not None and tests[test.id].status == "done"
        if (moved := recorded(layout, test)) is not None
    }
    if not done or not models:
        return None

    def outcome_at(span: float) -> Outcome:
        nearest = min(done, key=lambda tested: abs(np.log(tested / span)))
        moved, inputs = done[nearest]
        scaled = Motion(moved.acceleration * (span / nearest), moved.dt)
        peaks = plan_of(inputs, models[-1], felt(inputs, scaled)).run().peak_ratio
        return float((peaks > 0.0).mean()), float(np.isnan(peaks).mean()), scaled.peak

    planned = {test.span for test in listed if test.span is not None}
    outcomes = _explored(outcome_at, _candidates(sorted(done), planned))
    spans = sorted(outcomes)
    rocking, overturning, peaks = (np.array(each) for each in zip(*(outcomes[span] for span in spans), strict=True))
    advised = advise_span(spans, rocking, overturning, largest_risk=campaign.next.largest_risk)
    demand = {"acceleration": float(peaks[spans.index(advised.span)])}
    again = " again" if advised.span in done else ""
    return Advice(
        specimen=specimen,
        kind="earthquake",
        test=f"{motion}, Span {number(advised.span)}{again}",
        is_enough=advised.is_enough,
        reason=_reason(advised, models[-1]),
        risk=advised.probabilities[-1],
        demand=demand,
        beyond=beyond(campaign.table, demand),
        values={"span": advised.span, "entropy": advised.entropy},
    )


def _reason(advised: SpanAdvice, model: str) -> str:
    still, rocks, falls = map(probability, advised.probabilities)
    said = f"no rocking {still}, rocking {rocks}, overturned {falls} by the {model} model"
    if advised.is_enough:
        return f"{said}: too certain for a test, as at the other Spans within the risk"
    if advised.is_step:
        return f"{said}: a step of at most {format_percent(STEP - 1)} up, as it stands at all Spans so far"
    return f"{said}: the least certain outcome"


def _explored(outcome_at: Callable[[float], Outcome], spans: list[float]) -> dict[float, Outcome]:
    """Find the outcomes at some Spans, and closer where overturning begins."""
    found = {span: outcome_at(span) for span in spans}
    for _ in range(CLOSER):
        above = min((span for span, outcome in found.items() if outcome[1] >= 0.5), default=None)
        below = max((span for span in found if above is not None and span < above), default=None)
        if above is None or below is None:
            break
        found[(above + below) / 2] = outcome_at((above + below) / 2)
    return found


def _candidates(done: list[float], planned: set[float]) -> list[float]:
    """Give the Spans that are tested or planned, those halfway between tested ones, and one step beyond."""
    between = [(low + high) / 2 for low, high in pairwise(done)]
    largest = done[-1] * STEP
    return sorted({*done, *between, largest, *(span for span in planned if span < largest)})
