"""Advice on the sine tests and the earthquakes of a specimen: what was tried, and what would tell most."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from functools import partial
from itertools import pairwise
from math import atan, pi, sin, tan

import numpy as np
from numpy.typing import ArrayLike

from colonnade.arrays import Array
from colonnade.campaign import Campaign, Test
from colonnade.campaign.forms.forecast import ForecastInputs
from colonnade.campaign.forms.summary import TestSummary
from colonnade.dynamics.block import Block
from colonnade.dynamics.maps import stability_map
from colonnade.dynamics.models import PLANE_MODELS
from colonnade.dynamics.motion import Motion
from colonnade.identification.advice import SpanAdvice, advise_span
from colonnade.identification.boundary import SineAdvice, SineTests, advise_sine_tests
from colonnade.identification.response.boundaries import MapPoint, at_one_frequency
from colonnade.stages.forecast import felt, plan_of
from colonnade.store.layout import Layout
from colonnade.store.records.advice import Advice, beyond, demand_of_sine
from colonnade.units.text import format_percent, number, probability, quantity
from colonnade.workflow.foresee import inputs_of
from colonnade.workflow.motions import recorded

AMPLITUDES = np.linspace(0.5, 8.0, 151)
"""A that are scanned for a predicted limit."""


def advise_sines(
    campaign: Campaign,
    specimen: str,
    points: Sequence[MapPoint],
    restitution: tuple[float, float],
    deviation: float,
    tilt: float = 0.0,
) -> list[Advice]:
    """
    Advise the next sine test of a specimen at each frequency that was tested or is planned, by rising frequency.

    Parameters
    ----------
    campaign : Campaign
    specimen : str
        Its id.
    points : sequence of MapPoint
        Its sine tests.
    restitution : tuple of float
        e of both sides.
    deviation : float
        Standard deviation of e; NaN if it is not known.
    tilt : float, optional
        Of the table, rad.

    Returns
    -------
    advice : list of Advice
        None at a frequency at which the model does not overturn up to the largest of `AMPLITUDES`.
    """
    block, settings, model = campaign.block(specimen), campaign.next, _model(campaign)
    planned: list[tuple[float, MapPoint | None]] = [
        (2 * pi * test.frequency / block.p, None)
        for test in campaign.tests.values()
        if test.specimen == specimen and test.kind == "sine" and test.frequency and campaign.awaited.get(test.id)
    ]
    groups = at_one_frequency([*planned, *((point.frequency_ratio, point) for point in points)], lambda each: each[0])
    if not groups or model is None:
        return []
    ratios = np.array([np.mean([ratio for ratio, _ in group]) for group in groups])
    limits_of = partial(_limits, block, tilt, ratios, model)
    limits, sensitivity = limits_of(restitution), np.zeros(ratios.size)
    if deviation > 0.0:
        low, high = (limits_of(np.clip(np.add(restitution, change), 0.01, 1.0)) for change in (-deviation, deviation))
        sensitivity = np.clip(np.nan_to_num(np.log(high / low) / 2), -1.0, 1.0)
    places = np.flatnonzero(np.isfinite(limits))
    tests = []
    for place in places.tolist():
        tested = [point for _, point in groups[place] if point is not None]
        fell = [point.outcome == "overturned" for point in tested]
        amplitudes = [point.amplitude_ratio for point in tested]
        tests.append(SineTests(float(limits[place]), amplitudes, fell, float(sensitivity[place])))
    advised = advise_sine_tests(
        tests,
        wanted_width=settings.boundary_width,
        largest_risk=settings.largest_risk,
        discrepancy=settings.discrepancy,
    )
    found = zip(ratios[places].tolist(), advised, strict=True)
    return [_advice(campaign, specimen, ratio, block, each, model) for ratio, each in found]


def _model(campaign: Campaign) -> str | None:
    """Name the model that tests are advised by: the last one in the plane."""
    in_plane = [model for model in campaign.processing.predict.models if model in PLANE_MODELS]
    return in_plane[-1] if in_plane else None


def _limits(block: Block, tilt: float, ratios: Array, model: str, restitution: ArrayLike) -> Array:
    """Give the A from which the specimen overturns; on a tilted table its critical angles are to the vertical."""
    lean = atan(sin(tilt))
    negative, positive = (side.critical_angle for side in block.sides)
    leaning = block.override(critical_angle=(negative + lean, positive - lean)) if lean else block
    left, right = np.asarray(restitution).tolist()
    chart = stability_map(
        leaning, restitution=(left, right), frequency_ratio=ratios, amplitude_ratio=AMPLITUDES, model=model
    )
    return chart.lower * tan(leaning.critical_angle) / tan(block.critical_angle)


def _advice(campaign: Campaign, specimen: str, ratio: float, block: Block, advised: SineAdvice, model: str) -> Advice:
    """Write the advice at one frequency."""
    frequency, amplitude = ratio * block.p / (2 * pi), advised.amplitude_ratio
    acceleration = amplitude * block.gravity * tan(block.critical_angle)
    demand = demand_of_sine(acceleration, frequency)
    low, high = advised.boundary.interval
    known = (
        f"overturning begins between A {number(low)} and {number(high)} ({format_percent(0.9)}; {model} model: "
        f"{number(advised.boundary.tests.predicted)})"
    )
    return Advice(
        specimen=specimen,
        kind="sine",
        test=f"{number(frequency)} Hz at {quantity(acceleration, 'g')} (A {number(amplitude)})",
        is_enough=advised.is_enough,
        reason=f"{known}, as narrow as wanted" if advised.is_enough else known,
        risk=advised.risk,
        left=advised.left,
        demand=demand,
        beyond=beyond(campaign.table, demand),
        values={
            "frequency": frequency,
            "frequency_ratio": ratio,
            "amplitude_ratio": amplitude,
            "bits": advised.information,
        },
    )


STEP = 1.2
"""The largest Span that is advised, over the largest that was tested: models err, and a specimen may break."""

STEPS = 5
"""Spans that are looked at from the largest that was tested to the largest that is advised."""


def advise_earthquakes(
    campaign: Campaign, layout: Layout, specimen: str, tests: Mapping[str, TestSummary]
) -> list[Advice]:
    """
    Advise the next Span of each base motion that was recorded with a specimen at some Span.

    Parameters
    ----------
    campaign : Campaign
    layout : Layout
    specimen : str
        Its id.
    tests : mapping of str to TestSummary
        Records of the campaign's tests.
    """
    by_motion: dict[str, list[tuple[Test, float]]] = {}
    for test in campaign.tests.values():
        if test.specimen == specimen and test.kind == "earthquake" and test.span is not None:
            by_motion.setdefault(test.motion or "earthquake", []).append((test, test.span))
    found = []
    for name, listed in by_motion.items():
        done = {
            span: (motion, inputs_of(campaign, layout, specimen, campaign.setups[test.setup].table_tilt or 0.0))
            for test, span in listed
            if tests[test.id].status == "done" and (motion := recorded(layout, test)) is not None
        }
        if done and (model := _model(campaign)) is not None:
            found.append(_next_span(campaign, specimen, name, done, {span for _, span in listed}, model))
    return found


def _next_span(
    campaign: Campaign,
    specimen: str,
    name: str,
    done: Mapping[float, tuple[Motion, ForecastInputs]],
    planned: set[float],
    model: str,
) -> Advice:
    """Advise the next Span of a motion, by its recordings and what the model was given at the Spans so far."""

    spans, outcomes = _candidates(sorted(done), planned), []
    for span in spans:
        nearest = min(done, key=lambda tested: abs(np.log(tested / span)))
        moved, inputs = done[nearest]
        scaled = Motion(moved.acceleration * (span / nearest), moved.dt)
        largest = plan_of(inputs, model, felt(inputs, scaled)).run().peak_ratio
        outcomes.append(((largest > 0.0).mean(), np.isnan(largest).mean(), scaled.peak))
    rocking, overturning, peaks = np.transpose(outcomes)
    advised = advise_span(spans, rocking, overturning, largest_risk=campaign.next.largest_risk)
    demand = {"acceleration": float(peaks[spans.index(advised.span)])}
    return Advice(
        specimen=specimen,
        kind="earthquake",
        test=f"{name}, Span {number(advised.span)}",
        is_enough=advised.is_enough,
        reason=_reason(advised, model),
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


def _candidates(done: list[float], planned: set[float]) -> list[float]:
    """Give the Spans that are tested or planned, those halfway between tested ones, and steps beyond."""
    between = [(low + high) / 2 for low, high in pairwise(done)]
    beyond = np.linspace(done[-1], STEP * done[-1], STEPS).tolist()
    return sorted({*done, *between, *beyond, *(span for span in planned if span < beyond[-1])})
