"""Next: the test that tells most of each specimen and kind: free vibrations, sine tests and earthquakes."""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from functools import partial
from itertools import pairwise, product
from math import atan, pi, sin, tan
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike
from pydantic import TypeAdapter

from colonnade.arrays import Array
from colonnade.campaign import Campaign, Test
from colonnade.campaign.forms.forecast import ForecastInputs
from colonnade.campaign.forms.summary import TestSummary
from colonnade.dynamics.block import Block
from colonnade.dynamics.maps import stability_map
from colonnade.dynamics.models import NONLINEAR
from colonnade.dynamics.motion import Motion
from colonnade.errors import StoreError
from colonnade.identification.advice import LAST_PEAK, SpanAdvice, advise_free_vibration, advise_span
from colonnade.identification.boundary import SineAdvice, SineTests, advise_sine_tests
from colonnade.identification.response.boundaries import SAME_FREQUENCY, MapPoint, at_one_frequency
from colonnade.stages.forecast import felt, plan_of
from colonnade.stages.predict import sides
from colonnade.stages.specimen import restitution_spread
from colonnade.store.layout import Layout
from colonnade.store.records.advice import Advice, beyond, demand_of_sine, ranked
from colonnade.store.records.summary import map_points, read_summary, records_of_tests
from colonnade.units.text import format_percent, format_uncertain, interval, number, probability, quantity
from colonnade.workflow.asked import recorded
from colonnade.workflow.foresee import inputs_of
from colonnade.workflow.graph import expect_known, restitution_taken
from colonnade.workflow.product import Catalogue, Contents, Product, brought_up_to_date

if TYPE_CHECKING:
    import xarray as xr

MADE_BY = ("colonnade.workflow.advising",)
"""Module whose code makes advice; what it imports counts too."""

_ADVICE = TypeAdapter(list[Advice])

MODEL = NONLINEAR.name
"""By which sine tests and earthquakes are advised."""

KINDS = ("free-vibration", "sine", "earthquake")
"""Kinds of test that are advised, in their order."""


def advise(
    campaign: Campaign, layout: Layout, catalogue: Catalogue, specimens: Sequence[str] = (), workers: int | None = 1
) -> list[Advice]:
    """
    Advise the next tests of a campaign by the results of its last run, what tells most first.

    Parameters
    ----------
    campaign : Campaign
    layout : Layout
    catalogue : Catalogue
        Keeps advice about which nothing changed.
    specimens : sequence of str, optional
        Ids; default all.
    workers : int or None, optional
        Processes; None for one a core.

    Raises
    ------
    CampaignError
        If the campaign has no such specimen.
    StoreError
        If the campaign has never been run.
    """
    expect_known(campaign, "specimen", specimens)
    summary = read_summary(layout)
    if summary is None:
        raise StoreError(f"{campaign.folder}: this campaign has no results yet. Run `colonnade run` first.")
    tests, code = records_of_tests(campaign, summary), catalogue.code(MADE_BY)
    products = []
    for specimen, kind in product(specimens or campaign.of_interest, KINDS):
        own = {
            name: [campaign.told(test), tests[name].model_dump_json(), catalogue.content(layout.stage(name, "rocking"))]
            for name, test in campaign.tests.items()
            if (test.specimen, test.kind) == (specimen, kind)
        }
        shared = [campaign.gravity, campaign.processing, campaign.next, campaign.table, campaign.setups]
        upstream = {"specimen": catalogue.content(layout.stage(specimen, "specimen"))}
        make = partial(_advised, campaign, layout, specimen, kind, tests)
        entry = json.dumps([*map(repr, [campaign.specimens[specimen], *shared]), own])
        products.append(Product(f"advice {specimen} {kind}", entry, upstream, code, make))
    made = brought_up_to_date(products, catalogue, workers=workers)
    return ranked(each for one in products for each in _ADVICE.validate_json(made[str(one.id)].text))


def advise_after(campaign: Campaign, layout: Layout, name: str, measured: Mapping[str, TestSummary]) -> list[Advice]:
    """
    Advise the next test like one that was just measured: of its specimen and kind, and of its frequency.

    `measured` are the records of this test and of those before it; the summary of the last run may not have them yet.
    """
    known, record = records_of_tests(campaign, read_summary(layout)), measured[name]
    tests = {test: measured.get(test, each) if each.status == "pending" else each for test, each in known.items()}
    tests |= {name: record}
    found, ratio = advise_kind(campaign, layout, record.specimen, record.kind, tests), record.frequency_ratio
    return [each for each in found if not ratio or abs(each.values["frequency_ratio"] / ratio - 1) < SAME_FREQUENCY]


def advise_kind(
    campaign: Campaign, layout: Layout, specimen: str, kind: str, tests: dict[str, TestSummary]
) -> list[Advice]:
    """Advise the next tests of one kind of a specimen, by the records of all tests; none if it is not one block."""
    if not campaign.specimens[specimen].is_in_plane:
        return []
    pooled = restitution_taken(campaign, layout, specimen)
    if kind == "free-vibration":
        return advise_free(campaign, specimen, pooled, tests)
    if kind == "sine":
        return advise_sines(campaign, specimen, pooled, map_points(tests, specimen))
    return advise_earthquakes(campaign, layout, specimen, tests) if kind == "earthquake" else []


def _advised(campaign: Campaign, layout: Layout, specimen: str, kind: str, tests: dict[str, TestSummary]) -> Contents:
    return [], _ADVICE.dump_json(advise_kind(campaign, layout, specimen, kind, tests)).decode()


LARGEST_RELEASE = 0.6
"""|θ|/α from which a specimen is released at most: large first amplitudes disagree with every model."""


def advise_free(
    campaign: Campaign, specimen: str, pooled: xr.Dataset, tests: Mapping[str, TestSummary]
) -> list[Advice]:
    """
    Advise on the next free vibration; not at all if e is given in the campaign file.

    Parameters
    ----------
    campaign : Campaign
    specimen : str
        Its id.
    pooled : xr.Dataset
        Its e, as the stage `specimen` gives it.
    tests : mapping of str to TestSummary
        Records of the campaign's tests.
    """
    if pooled.attrs["restitution_source"] == "given":
        return []
    released = _released(pooled, tests)
    if not released:
        reason = "e is not identified, so predictions use the rigid-body value"
        return [Advice(specimen, "free-vibration", f"release from {LARGEST_RELEASE:g} α", False, reason)]
    names, angles = list(released), np.array(list(released.values()))
    places = [list(pooled["test_id"].to_numpy()).index(name) for name in names]
    advised = advise_free_vibration(
        pooled["test_restitution"].to_numpy()[places],
        pooled["test_restitution_standard_error"].to_numpy()[places],
        angles,
        wanted_half_width=campaign.next.restitution_width / 2,
        largest_release=LARGEST_RELEASE,
        level=float(pooled["level"]),
    )
    # One test shows nothing of the scatter between tests.
    of = "1, for that record alone" if len(names) == 1 else str(len(names))
    e, half = advised.pooled.value, advised.half_width
    known = f"e {interval(e, e - half, e + half)} from {of}"
    after = format_uncertain(e, float(advised.predicted_half_width[0]))
    advice = Advice(
        specimen=specimen,
        kind="free-vibration",
        test=f"release from {number(LARGEST_RELEASE, 2)} α",  # the records keep no side
        is_enough=advised.is_enough,
        reason=known + (", as narrow as wanted" if advised.is_enough else f"; one more test: about {after}"),
        left=advised.needed,
    )
    return [advice]


def _released(pooled: xr.Dataset, tests: Mapping[str, TestSummary]) -> dict[str, float]:
    """Give |θ|/α of the release of each free vibration whose e is pooled."""
    names = [str(name) for name in pooled["test_id"].to_numpy()] if "test_id" in pooled else []
    ratios = {name: tests[name].release_ratio or tests[name].peak_ratio for name in names if name in tests}
    return {name: ratio for name, ratio in ratios.items() if ratio is not None and LAST_PEAK < ratio < 1.0}


AMPLITUDES = np.linspace(0.5, 8.0, 151)
"""A that are scanned for a predicted limit."""


def advise_sines(campaign: Campaign, specimen: str, pooled: xr.Dataset, points: Sequence[MapPoint]) -> list[Advice]:
    """
    Advise the next sine test of a specimen at each frequency that was tested or is planned, by rising frequency.

    Parameters
    ----------
    campaign : Campaign
    specimen : str
        Its id.
    pooled : xr.Dataset
        Its e, as the stage `specimen` gives it.
    points : sequence of MapPoint
        Its sine tests.

    Returns
    -------
    advice : list of Advice
        None at a frequency at which the model does not overturn up to the largest of `AMPLITUDES`.
    """
    block, settings, restitution = campaign.block(specimen), campaign.next, sides(pooled)
    own = [test for test in campaign.tests.values() if (test.specimen, test.kind) == (specimen, "sine")]
    tilt = max((campaign.setups[test.setup].table_tilt or 0.0 for test in own), key=abs, default=0.0)
    deviation, _ = restitution_spread(pooled, campaign.processing.predict.ensemble.restitution)
    awaited = [test.frequency for test in own if test.frequency and campaign.awaited.get(test.id)]
    planned: list[tuple[float, MapPoint | None]] = [(2 * pi * frequency / block.p, None) for frequency in awaited]
    groups = at_one_frequency([*planned, *((point.frequency_ratio, point) for point in points)], lambda each: each[0])
    if not groups:
        return []
    ratios = np.array([np.mean([ratio for ratio, _ in group]) for group in groups])
    limits_of = partial(_limits, block, tilt, ratios)
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
    return [_advice(campaign, specimen, ratio, block, each) for ratio, each in found]


def _limits(block: Block, tilt: float, ratios: Array, restitution: ArrayLike) -> Array:
    """Give the A from which the specimen overturns; on a tilted table its critical angles are to the vertical."""
    lean = atan(sin(tilt))
    negative, positive = (side.critical_angle for side in block.sides)
    leaning = block.override(critical_angle=(negative + lean, positive - lean)) if lean else block
    left, right = np.asarray(restitution).tolist()
    chart = stability_map(
        leaning, restitution=(left, right), frequency_ratio=ratios, amplitude_ratio=AMPLITUDES, model=MODEL
    )
    return chart.lower * tan(leaning.critical_angle) / tan(block.critical_angle)


def _advice(campaign: Campaign, specimen: str, ratio: float, block: Block, advised: SineAdvice) -> Advice:
    """Write the advice at one frequency."""
    frequency, amplitude, bits = ratio * block.p / (2 * pi), advised.amplitude_ratio, advised.information
    acceleration = amplitude * block.gravity * tan(block.critical_angle)
    demand = demand_of_sine(acceleration, frequency)
    low, high = advised.boundary.interval
    known = (
        f"overturning begins between A {number(low)} and {number(high)} ({format_percent(0.9)}; {MODEL} model: "
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
        values={"frequency": frequency, "frequency_ratio": ratio, "amplitude_ratio": amplitude, "bits": bits},
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
        if done:
            found.append(_next_span(campaign, specimen, name, done, {span for _, span in listed}))
    return found


def _next_span(
    campaign: Campaign,
    specimen: str,
    name: str,
    done: Mapping[float, tuple[Motion, ForecastInputs]],
    planned: set[float],
) -> Advice:
    """Advise the next Span of a motion, by its recordings and what the model was given at the Spans so far."""

    spans, outcomes = _candidates(sorted(done), planned), []
    for span in spans:
        nearest = min(done, key=lambda tested: abs(np.log(tested / span)))
        moved, inputs = done[nearest]
        scaled = Motion(moved.acceleration * (span / nearest), moved.dt)
        largest = plan_of(inputs, MODEL, felt(inputs, scaled)).run().peak_ratio
        outcomes.append(((largest > 0.0).mean(), np.isnan(largest).mean(), scaled.peak))
    rocking, overturning, peaks = np.transpose(outcomes)
    advised = advise_span(spans, rocking, overturning, largest_risk=campaign.next.largest_risk)
    demand = {"acceleration": float(peaks[spans.index(advised.span)])}
    return Advice(
        specimen=specimen,
        kind="earthquake",
        test=f"{name}, Span {number(advised.span)}",
        is_enough=advised.is_enough,
        reason=_reason(advised),
        risk=advised.probabilities[-1],
        demand=demand,
        beyond=beyond(campaign.table, demand),
        values={"span": advised.span, "entropy": advised.entropy},
    )


def _reason(advised: SpanAdvice) -> str:
    still, rocks, falls = map(probability, advised.probabilities)
    said = f"no rocking {still}, rocking {rocks}, overturned {falls} by the {MODEL} model"
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
