"""Numbers of the virtual campaign's tests, as they are stored; among them the paper's misfit at Span 2.5."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
from scipy.ndimage import maximum_filter1d
from scipy.optimize import minimize_scalar

from colonnade.arrays import Array
from colonnade.campaign import Campaign
from colonnade.campaign.forms.summary import Summary, TestSummary
from colonnade.dynamics.block import Block
from colonnade.dynamics.history import amplitude, capped
from colonnade.dynamics.motion import Motion
from colonnade.dynamics.rock import rock
from colonnade.figures.stored.subject import OfTest
from colonnade.identification.response.boundaries import MapPoint, bracket_boundaries
from colonnade.identification.response.order import response_order
from colonnade.signals.metrics import nrmse
from colonnade.store.records.stored import Stored
from reproduction.campaign import ANALYTICAL, NUMERICAL
from reproduction.computed import Numbers
from reproduction.printed import SPANS


@dataclass(frozen=True)
class Criterion:
    """
    Numbers of the criterion, fixed before anything was computed (`span-2.5-design.md`).

    Attributes
    ----------
    quiet : float
        |θ|/α below which a response has died down.
    before : float
        s that it has been quiet.
    loud : float
        |θ|/α above which a response is large. The quiet response stays below half of it.
    after : float
        s within which the other one becomes large.
    """

    quiet: float = 0.1
    before: float = 1.0
    loud: float = 0.4
    after: float = 2.0


@dataclass(frozen=True)
class Response:
    """
    A measured or predicted history, at equal steps.

    Attributes
    ----------
    angle : ndarray, shape (n,)
        rad.
    dt : float
        s.
    overturning_time : float
        s; NaN for a block that stands. From there on the block stays at its critical angle.
    block : Block
        Whose critical angles the angle is compared with.
    """

    angle: Array
    dt: float
    overturning_time: float
    block: Block

    @cached_property
    def ratio(self) -> Array:
        """|θ|/α, at most 1, shape (n,)."""
        inside = capped(np.arange(self.angle.size) * self.dt, self.angle, self.overturning_time, self.block)
        return amplitude(inside, self.block)

    @cached_property
    def largest_so_far(self) -> Array:
        """Largest |θ|/α up to each sample, shape (n,)."""
        return np.maximum.accumulate(self.ratio)

    def largest_before(self, window: float) -> Array:
        """Largest |θ|/α in the `window` (s) that ends at each sample, shape (n,)."""
        return self._largest(window, ahead=False)

    def largest_after(self, window: float) -> Array:
        """Largest |θ|/α in the `window` (s) that begins at each sample, shape (n,); at the end as much as there is."""
        return self._largest(window, ahead=True)

    def _largest(self, window: float, *, ahead: bool) -> Array:
        samples = round(window / self.dt)
        values = self.ratio[::-1] if ahead else self.ratio
        largest = maximum_filter1d(values, samples + 1, origin=samples // 2, mode="constant", cval=0.0)
        return largest[::-1] if ahead else largest


def place_of_growth(quiet: Response, growing: Response, criterion: Criterion) -> float:
    """
    Find where one response grows large after the other has died down.

    Parameters
    ----------
    quiet, growing : Response
        Of the same clock. For the paper's pattern the measured and the predicted one.
    criterion : Criterion

    Returns
    -------
    place : float
        s, of the largest |growing| within `criterion.after` of the first instant t for which: |quiet| was above
        `criterion.quiet` earlier; was below it for `criterion.before` up to t; stays below half of `criterion.loud` for
        `criterion.after` from t on; and |growing| passes `criterion.loud` within that time, and is larger in it than in
        the `criterion.before` up to t. NaN if there is no such instant.
    """
    if growing.largest_so_far[-1] <= criterion.loud or quiet.largest_so_far[-1] < criterion.quiet:
        return float("nan")
    later = growing.largest_after(criterion.after)
    found = (
        (later > criterion.loud)
        & (later > growing.largest_before(criterion.before))
        & (quiet.largest_before(criterion.before) < criterion.quiet)
        & (quiet.largest_so_far >= criterion.quiet)
        & (quiet.largest_after(criterion.after) < 0.5 * criterion.loud)
    )
    if not found.any():
        return float("nan")
    first = int(np.argmax(found))
    until = first + round(criterion.after / growing.dt) + 1
    return float((first + np.argmax(growing.ratio[first:until])) * growing.dt)


LARGE_ARCS = 4
"""Arcs after the start of a prediction whose amplitudes are the initial large ones."""

FITTED, TRIED = (0.9, 0.9995), 200
"""Values of e with which the linearised solution is held against a free vibration."""

RECORDED = ("rocking_angle", "base_acceleration", "base_displacement")
"""What an earthquake test records."""

STAGE = 10
"""Periods of the table at the beginning of a steady sine whose response has an order of its own."""


def restitution(summary: Summary, truth: Mapping[str, Any]) -> Numbers:
    """Give e of each specimen: true, pooled, and of the whole history of each free vibration."""
    found: Numbers = {}
    for name, true in truth["specimens"].items():
        pooled = summary.specimens[name].restitution
        fitted = [
            each.restitution.whole_history["nonlinear"].value
            for each in summary.tests.values()
            if each.specimen == name and each.restitution and each.restitution.whole_history
        ]
        found[name] = {
            "true": true["restitution"],
            **pooled.model_dump(include={"value", "low", "high", "source"}),
            "by_whole_histories": fitted,
        }
    return found


def tests(summary: Summary, truth: Mapping[str, Any]) -> Numbers:
    """Give of each test what was true, measured and predicted."""
    return {name: _test(each, truth["tests"][name]) for name, each in summary.tests.items()}


def _test(record: TestSummary, true: Mapping[str, Any]) -> Numbers:
    predicted = {
        model: each.model_dump(include={"outcome", "peak_ratio", "nrmse"}) for model, each in record.predicted.items()
    }
    fields = {"kind", "specimen", "span", "outcome", "peak_ratio", "impacts", "order", "pga", "duration", "peak_slide"}
    fields |= {"frequency", "frequency_ratio", "amplitude_ratio"}
    return {
        **record.model_dump(include=fields),
        "true": {key: true[key] for key in ("outcome", "peak_ratio")},
        "predicted": predicted,
    }


def free_vibration(one: OfTest) -> Numbers:
    """Give how far each model is from the measured angle, in its first large arcs and after them, RMS over α."""
    predicted = one.ratios()
    measured = predicted.pop("measured")
    found: Numbers = {}
    impacts = one.stored.array("predict", "impact_time", ANALYTICAL)
    for model, curve in predicted.items():
        early = curve.time < impacts[LARGE_ARCS]
        late = (curve.time >= impacts[LARGE_ARCS]) & (curve.time < impacts[4 * LARGE_ARCS])
        found[model] = {
            "early": nrmse(measured.values[early], curve.values[early], 1.0),
            "late": nrmse(measured.values[late], curve.values[late], 1.0),
        }
    linear, numerical = predicted[ANALYTICAL], predicted[NUMERICAL]
    return found | {
        "numerical_to_analytical": nrmse(linear.values, numerical.values, 1.0),
        "best_linear": _best_linear(measured.time, measured.values, linear.values, one.block),
    }


def _best_linear(time: Array, measured: Array, predicted: Array, block: Block) -> Numbers:
    """Give the e with which the linearised solution follows θ/α best from the peak where `predicted` begins."""
    begin = int(np.argmax(np.isfinite(predicted)))
    start = float(predicted[begin]) * block.critical_angle
    still = Motion(np.zeros(time.size - begin), float(time[1] - time[0]))

    def misfit(restitution: float) -> float:
        moved = rock(block, still, restitution=restitution, model=ANALYTICAL, theta0=start)
        return nrmse(measured[begin:], moved.angle / block.critical_angle, 1.0)

    # A misfit over e has several dips: arcs of another e fall in and out of step. The deepest is refined.
    tried = np.linspace(*FITTED, TRIED)
    best = float(tried[np.argmin([misfit(float(each)) for each in tried])])
    step = (FITTED[1] - FITTED[0]) / (TRIED - 1)
    found = minimize_scalar(misfit, bounds=(best - step, best + step), method="bounded", options={"xatol": 1e-6})
    return {"restitution": float(found.x), "misfit": float(found.fun)}


def sine(one: OfTest) -> Numbers:
    """Give how a test built up, the order of its response to the first periods, and what the contact model adds."""
    curves, stored, block = one.ratios(), one.stored, one.block
    measured, angle = curves["measured"], curves[NUMERICAL].values
    frequency, begin = (stored.value("compare", name) for name in ("forcing_frequency", "steady_start"))
    impacts, fall = stored.array("rocking", "impact_time"), stored.value("rocking", "overturning_time")
    first = response_order(
        measured.time,
        measured.values,
        frequency,
        start=begin,
        stop=begin + STAGE / frequency,
        threshold=stored.value("rocking", "noise_threshold") / block.critical_angle,
    )
    slide = stored.array("predict", "slide", NUMERICAL)
    standing = np.isfinite(angle) & (np.abs(angle) < 1.0)
    return {
        "impacts_before_overturning": None if np.isnan(fall) else int((impacts < fall).sum()),
        "cycles_to_overturning": None if np.isnan(fall) or not impacts.size else float((fall - impacts[0]) * frequency),
        "first_order": first.order,
        "driven_by": stored.text("predict", "driven_by", NUMERICAL),
        "computed_slide": float(np.nanmax(np.abs(slide[standing]), initial=0.0)),
        "computed_top": float(2 * block.pole_distance * np.nanmax(np.abs(np.sin(block.critical_angle * angle)))),
    }


def boundaries(points: list[MapPoint]) -> list[Numbers]:
    """Give both measured boundaries at each frequency."""
    return [
        {
            "frequency_ratio": each.frequency_ratio,
            "rocking": [each.rocking.below, each.rocking.above],
            "overturning": [each.overturning.below, each.overturning.above],
            "stood_above": list(each.overturning.exceptions),
            "rocked_below": any(
                point.outcome == "rocking" and abs(point.frequency_ratio / each.frequency_ratio - 1) < 0.02
                for point in points
            ),
        }
        for each in bracket_boundaries(points)
    ]


def earthquake(one: OfTest) -> Numbers:
    """Give what an earthquake test recorded, and how far the two computed responses are from each other."""
    stored, curves = one.stored, one.ratios()
    return {
        "pattern": {model: _pattern(stored, one.block, model) for model in (ANALYTICAL, NUMERICAL)},
        "recorded": [name for name in RECORDED if np.isfinite(stored.array("rocking", name)).any()],
        "numerical_to_analytical": nrmse(curves[ANALYTICAL].values, curves[NUMERICAL].values, 1.0),
        "restitution_source": stored.text("predict", "restitution_source", ANALYTICAL),
        "driven_by": stored.text("predict", "driven_by", ANALYTICAL),
    }


def _pattern(stored: Stored, block: Block, model: str) -> Numbers:
    """Look for the paper's misfit: the computed response is large where the measured one has died down."""
    criterion, first, second = Criterion(), *stored.array("rocking", "elapsed")[:2]

    def response(stage: str, which: str | None) -> Response:
        angle, fall = stored.array(stage, "rocking_angle", which), stored.value(stage, "overturning_time", which)
        return Response(np.nan_to_num(angle), float(second - first), fall, block)

    measured, computed = response("rocking", None), response("predict", model)
    place = place_of_growth(measured, computed, criterion)
    calm = measured.largest_before(criterion.before) < criterion.quiet
    calm &= measured.largest_so_far >= criterion.quiet
    later = computed.largest_after(criterion.after)[calm]
    return {"is_there": bool(np.isfinite(place)), "place": place, "largest_after_calm": later.max(initial=0.0)}


def span_tests(campaign: Campaign, specimen: str) -> dict[str, str]:
    """Give the earthquake test of each of the paper's Spans, by "2.0", "2.5", "3.0"."""
    return {
        f"{test.span:.1f}": test.id
        for test in campaign.tests.values()
        if test.specimen == specimen and test.span in SPANS
    }
