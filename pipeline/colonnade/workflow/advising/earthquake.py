"""Advice on the earthquakes of a specimen: the Span whose outcome is least certain."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from itertools import pairwise
from typing import TYPE_CHECKING

import numpy as np

from colonnade.campaign import Campaign, Test
from colonnade.campaign.forms.summary import TestSummary
from colonnade.dynamics.ensembles.ensemble import ensemble
from colonnade.dynamics.ensembles.uncertainty import Uncertainty
from colonnade.dynamics.models.registry import MODELS
from colonnade.dynamics.motion import Motion
from colonnade.errors import StoreError
from colonnade.identification.advice.span import SpanAdvice, advise_span
from colonnade.stages.predict import sides
from colonnade.stages.specimen import restitution_spread
from colonnade.store import files
from colonnade.store.layout import Layout
from colonnade.store.records.advice import Advice, beyond
from colonnade.store.records.wording import number, probability

if TYPE_CHECKING:
    import xarray as xr

STEP = 1.2
"""From one Span to the next beyond those that were tested, as a factor."""

STEPS = 10
"""So many of these, unless one overturns with probability `SURE` before."""

SURE = 0.95

CLOSER = 3
"""Halvings between the last Span that stands more often than not, and the next."""


def advise_earthquakes(
    campaign: Campaign, layout: Layout, specimen: str, pooled: xr.Dataset, tests: Mapping[str, TestSummary]
) -> list[Advice]:
    """
    Advise the next Span of each base motion that a specimen was tested with.

    Parameters
    ----------
    campaign : Campaign
    layout : Layout
    specimen : str
        Its id.
    pooled : xr.Dataset
        Its e, as the stage `specimen` gives it.
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
    found = (_advise(campaign, layout, specimen, pooled, motion, each, tests) for motion, each in by_motion.items())
    return [advice for advice in found if advice is not None]


def _advise(
    campaign: Campaign,
    layout: Layout,
    specimen: str,
    pooled: xr.Dataset,
    motion: str,
    listed: list[Test],
    tests: Mapping[str, TestSummary],
) -> Advice | None:
    done = {test.span: test.id for test in listed if test.span is not None and tests[test.id].status == "done"}
    models = [model for model in campaign.processing.predict.models if not MODELS[model].in_space]
    if not done or not models:
        return None
    records = {span: _motion(layout, test) for span, test in done.items()}

    def outcome_at(span: float) -> tuple[float, float, float] | None:
        nearest = min(done, key=lambda tested: abs(np.log(tested / span)))
        record = records[nearest]
        if record is None:
            return None
        scaled = Motion(record.acceleration * (span / nearest), record.dt)
        return _outcomes(campaign, specimen, pooled, scaled, models[-1])

    planned = sorted(test.span for test in listed if test.span is not None)
    outcomes = _explored(outcome_at, _candidates(sorted(done), planned), max(done))
    if not outcomes:
        return None
    spans = sorted(outcomes)
    rocking, overturning, peaks = (np.array(each) for each in zip(*(outcomes[span] for span in spans), strict=True))
    advised = advise_span(spans, rocking, overturning, largest_risk=campaign.next.largest_risk)
    falls = advised.probabilities[-1]
    demand = {"acceleration": float(peaks[spans.index(advised.span)])}
    again = " again" if advised.span in done else ""
    return Advice(
        specimen=specimen,
        kind="earthquake",
        test=f"{motion}, Span {number(advised.span)}{again}",
        is_enough=advised.is_enough,
        reason=(
            f"{_in_words(advised)} by the {models[-1]} model: {number(advised.entropy, 2)} bit, "
            + ("too little for a test" if advised.is_enough else f"the least certain of {len(spans)} Spans")
        ),
        risk=falls,
        demand=demand,
        beyond=beyond(campaign.table, demand),
        values={"span": advised.span, "entropy": advised.entropy},
    )


def _explored(
    outcome_at: Callable[[float], tuple[float, float, float] | None], spans: list[float], last: float
) -> dict[float, tuple[float, float, float]]:
    """Find the outcomes at some Spans, beyond the last only until it surely overturns, and closer where that begins."""
    found: dict[float, tuple[float, float, float]] = {}
    for span in spans:
        outcome = outcome_at(span)
        if outcome is None:
            return {}
        found[span] = outcome
        if span > last and outcome[1] >= SURE:
            break
    for _ in range(CLOSER):
        above = min((span for span, outcome in found.items() if outcome[1] >= 0.5), default=None)
        below = max((span for span in found if above is not None and span < above), default=None)
        if above is None or below is None:
            break
        found[(above + below) / 2] = outcome_at((above + below) / 2) or found[above]
    return found


def _in_words(advised: SpanAdvice) -> str:
    still, rocks, falls = map(probability, advised.probabilities)
    return f"no rocking {still}, rocking {rocks}, overturned {falls}"


def _candidates(done: list[float], listed: list[float]) -> list[float]:
    """Give the Spans that are tested or planned, those halfway between tested ones, and steps beyond."""
    between = [(low + high) / 2 for low, high in pairwise(done)]
    beyond_them = [done[-1] * STEP**step for step in range(1, STEPS + 1)]
    return sorted({*listed, *between, *beyond_them})


def _motion(layout: Layout, test: str) -> Motion | None:
    try:
        rocking = files.read(layout.stage(test, "rocking"))
    except StoreError:
        return None
    time = rocking["elapsed"].to_numpy()
    if "base_acceleration" not in rocking or time.size < 2:
        return None
    acceleration = np.nan_to_num(rocking["base_acceleration"].to_numpy())
    return Motion(acceleration, float((time[-1] - time[0]) / (time.size - 1)))


def _outcomes(
    campaign: Campaign, specimen: str, pooled: xr.Dataset, motion: Motion, model: str
) -> tuple[float, float, float]:
    """Give the probabilities of rocking and of overturning under a motion, and its peak acceleration (m/s²)."""
    settings = campaign.processing.predict.ensemble
    restitution, freedom = restitution_spread(pooled, settings)
    uncertainty = Uncertainty(
        restitution=restitution,
        restitution_freedom=freedom,
        critical_angle=settings.critical_angle,
        p=settings.p,
        gain=settings.gain,
        clock=settings.clock,
    )
    found = ensemble(
        campaign.block(specimen),
        motion,
        uncertainty=uncertainty,
        restitution=sides(pooled),
        count=max(settings.members, 1),
        model=model,
    )
    falls = float(np.isnan(found.peak_ratio).mean())
    rocks = float((found.peak_ratio > 0.0).mean())
    return rocks, falls, float(np.abs(motion.acceleration).max())
