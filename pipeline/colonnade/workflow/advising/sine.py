"""Advice on the sine tests and the earthquakes of a specimen: what was tried, and what would tell most."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from itertools import pairwise
from math import atan, isfinite, pi, sin, tan

import numpy as np

from colonnade.arrays import Array
from colonnade.campaign import Campaign, Test
from colonnade.campaign.forms.summary import TestSummary
from colonnade.dynamics.block import Block, pair
from colonnade.dynamics.maps import stability_map
from colonnade.dynamics.models import MODELS
from colonnade.dynamics.motion import Motion
from colonnade.identification.advice import SpanAdvice, advise_span
from colonnade.identification.boundary import SineAdvice, SineTests, advise_sine_tests
from colonnade.identification.response.boundaries import SAME_FREQUENCY, MapPoint
from colonnade.stages.forecast import felt, plan_of
from colonnade.store.layout import Layout
from colonnade.store.records.advice import Advice, beyond, demand_of_sine
from colonnade.units.text import format_percent, number, probability, quantity
from colonnade.workflow.foresee import inputs_of
from colonnade.workflow.motions import recorded

AMPLITUDES = np.linspace(0.5, 8.0, 151)
"""A that are scanned for a predicted limit."""


@dataclass(frozen=True)
class Known:
    """What is known of a specimen: e of both sides, its standard deviation, its sine tests, the table's tilt (rad)."""

    restitution: tuple[float, float]
    deviation: float
    points: tuple[MapPoint, ...]
    tilt: float = 0.0


def advise_sines(campaign: Campaign, specimen: str, known: Known) -> list[Advice]:
    """
    Advise the next sine test of a specimen at each frequency that was tested or is planned.

    Parameters
    ----------
    campaign : Campaign
    specimen : str
        Its id.
    known : Known

    Returns
    -------
    advice : list of Advice
        By rising frequency; empty without any sine test.
    """
    block = campaign.block(specimen)
    ratios = np.array(_frequency_ratios(campaign, specimen, block, known))
    models = [model for model in campaign.processing.predict.models if not MODELS[model].in_space]
    if not ratios.size or not models:
        return []
    limits = _limits(block, known, known.restitution, ratios, models[-1])
    sensitivity = _sensitivity(block, known, ratios, models[-1])
    found = [place for place in range(ratios.size) if isfinite(limits[place])]
    tests = [_tests_at(ratios[place], limits[place], sensitivity[place], known) for place in found]
    settings = campaign.next
    advised = advise_sine_tests(
        tests,
        wanted_width=settings.boundary_width,
        largest_risk=settings.largest_risk,
        discrepancy=settings.discrepancy,
    )
    with_limit = {
        place: _advice(campaign, specimen, float(ratios[place]), block, each, models[-1])
        for place, each in zip(found, advised, strict=True)
    }
    return [
        with_limit.get(place) or _without_limit(specimen, float(ratio) * block.p / (2 * pi), models[-1])
        for place, ratio in enumerate(ratios)
    ]


def _frequency_ratios(campaign: Campaign, specimen: str, block: Block, known: Known) -> list[float]:
    """Give Ω of the tests, and of planned ones; those that were meant to be the same once."""
    planned = [
        2 * pi * test.frequency / block.p
        for test in campaign.tests.values()
        if test.specimen == specimen and test.kind == "sine" and test.frequency and campaign.awaited.get(test.id)
    ]
    groups: list[list[float]] = []
    for ratio in sorted([*(point.frequency_ratio for point in known.points), *planned]):
        if groups and ratio / groups[-1][0] - 1 < SAME_FREQUENCY:
            groups[-1].append(ratio)
        else:
            groups.append([ratio])
    return [float(np.mean(group)) for group in groups]


def _limits(block: Block, known: Known, restitution: tuple[float, float], ratios: Array, model: str) -> Array:
    """Give the A from which the specimen overturns; on a tilted table its critical angles are to the vertical."""
    lean = atan(sin(known.tilt))
    negative, positive = (side.critical_angle for side in block.sides)
    leaning = block.override(critical_angle=(negative + lean, positive - lean)) if lean else block
    chart = stability_map(
        leaning, restitution=restitution, frequency_ratio=ratios, amplitude_ratio=AMPLITUDES, model=model
    )
    return chart.lower * tan(leaning.critical_angle) / tan(block.critical_angle)


def _sensitivity(block: Block, known: Known, ratios: Array, model: str) -> Array:
    """Change of ln A of each limit by one standard deviation of e; 0 where that is not known."""
    if not known.deviation > 0.0:
        return np.zeros(ratios.size)
    ends = []
    for sign in (-1.0, 1.0):
        negative, positive = (float(np.clip(e + sign * known.deviation, 0.01, 1.0)) for e in pair(known.restitution))
        ends.append(_limits(block, known, (negative, positive), ratios, model))
    return np.clip(np.nan_to_num(np.log(ends[1] / ends[0]) / 2), -1.0, 1.0)


def _tests_at(ratio: float, limit: float, sensitivity: float, known: Known) -> SineTests:
    at = [point for point in known.points if abs(point.frequency_ratio / ratio - 1) < SAME_FREQUENCY]
    amplitudes = [point.amplitude_ratio for point in at]
    return SineTests(limit, amplitudes, [point.outcome == "overturned" for point in at], float(sensitivity))


def _advice(campaign: Campaign, specimen: str, ratio: float, block: Block, advised: SineAdvice, model: str) -> Advice:
    frequency = ratio * block.p / (2 * pi)
    acceleration = advised.amplitude_ratio * block.gravity * tan(block.critical_angle)
    demand = demand_of_sine(acceleration, frequency)
    low, high = advised.boundary.interval
    known = (
        f"overturning begins between A {number(low)} and {number(high)} ({format_percent(0.9)}; {model} model: "
        f"{number(advised.boundary.tests.predicted)})"
    )
    again = f", and outcomes scatter: test {advised.repeats + 1} at this amplitude" if advised.repeats else ""
    return Advice(
        specimen=specimen,
        kind="sine",
        test=f"{number(frequency)} Hz at {quantity(acceleration, 'g')} (A {number(advised.amplitude_ratio)})",
        is_enough=advised.is_enough,
        reason=known + (", as narrow as wanted" if advised.is_enough else again),
        risk=advised.risk,
        left=0 if advised.is_enough else advised.left,
        demand=demand,
        beyond=beyond(campaign.table, demand),
        values={
            "frequency": frequency,
            "frequency_ratio": ratio,
            "amplitude_ratio": advised.amplitude_ratio,
            "boundary": float(advised.boundary.quantiles(0.5)),
            "boundary_low": low,
            "boundary_high": high,
            "predicted_boundary": advised.boundary.tests.predicted,
            "bits": advised.information,
        },
    )


def _without_limit(specimen: str, frequency: float, model: str) -> Advice:
    return Advice(
        specimen=specimen,
        kind="sine",
        test=f"{number(frequency)} Hz",
        is_enough=False,
        reason=f"the {model} model does not overturn up to A {AMPLITUDES[-1]:g}, so there is no boundary to look for",
        values={"frequency": frequency},
    )


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
