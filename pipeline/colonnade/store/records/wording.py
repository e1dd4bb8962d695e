"""Records in words: what a test gave, the verdict on a prediction, how far the models agree, all that is known."""

from __future__ import annotations

from collections.abc import Mapping
from functools import cache
from math import hypot, nan
from statistics import median
from typing import Any

from colonnade.campaign.forms.summary import (
    IdentifiedSummary,
    Order,
    PredictionSummary,
    RestitutionSummary,
    TestSummary,
)
from colonnade.dynamics.models import MODELS
from colonnade.errors import count
from colonnade.identification.response.rank import is_within
from colonnade.units.text import LEAST_RATIO, interval, listed, quantity, ratio, shown

WITHIN, DIFFERS = "✓", "≠"
"""Verdicts on a prediction, see `verdict`."""

LEGEND = "✓ history inside the 95 % band of the model's runs; ≠ outside or another outcome"
"""What they mean; 80 columns."""

ESTIMATE = ("value", "low", "high", "level")
"""Keys of a number with its interval."""

SMALL = {"m": "mm", "rad": "mrad"}
"""Units of values below 0.1."""

LEAST_MOVED = 5e-5
"""m: below it a body counts as not moved. Markers give a body's place to some 0.01 mm."""


def pooled(found: RestitutionSummary) -> str:
    """
    Write the e of a specimen that predictions use, and where it comes from.

    Examples
    --------
    >>> pooled(RestitutionSummary(value=0.976, low=0.9756, high=0.9764, source="identified", tests=("a", "b")))
    'e 0.9760 ± 0.0004, identified from 2 free vibrations'
    >>> pooled(RestitutionSummary(value=(0.95, 0.96), source="given"))
    'e 0.95 and 0.96, given'
    """
    values = found.value if isinstance(found.value, tuple) else (found.value,)
    told = " and ".join(interval(value, found.low, found.high, found.level) for value in values)
    source = f" from {count(len(found.tests), 'free vibration')}" if found.tests else ""
    return f"e {told}, {found.source}{source}"


def order(known: Order) -> str:
    """
    Write the order of a response.

    Examples
    --------
    >>> order(1), order(3), order("irregular"), order(None)
    ('harmonic', '1/3', 'irregular', '')
    """
    if known is None or isinstance(known, str):
        return known or ""
    return "harmonic" if known == 1 else f"1/{known}"


def agree(measured: str, predicted: str) -> bool | None:
    """
    Return whether a predicted outcome is the measured (or observed) one; None where either is not known.

    Examples
    --------
    >>> agree("rocking", "rocking"), agree("not-overturned", "overturned"), agree("", "rocking")
    (True, False, None)
    """
    if not measured or not predicted:
        return None
    if measured == "not-overturned":
        return predicted != "overturned"
    return measured == predicted


def verdict(test: TestSummary, model: str) -> str:
    """
    Judge a prediction: the one rule of terminal and pages.

    Returns
    -------
    mark : str
        ``≠`` if the model predicts another outcome than the measured (or observed) one, or if the measured angle is
        outside the 95 % band of the model's runs; ``✓`` if it is inside; empty without an ensemble.
    """
    found = test.predicted.get(model, PredictionSummary())
    within = is_within(nan if found.within_spread is None else found.within_spread)
    if within is False or agree(test.outcome or test.observed_outcome or "", found.outcome or "") is False:
        return DIFFERS
    return WITHIN if within else ""


def measured(test: TestSummary, level: float | None = None) -> str:
    """
    Write what a test gave in a few words: e of a free vibration, else the outcome and the peak over α.

    `level` is that of the interval of e, None for 95 %.

    Examples
    --------
    >>> measured(TestSummary(status="done", kind="earthquake", specimen="a", outcome="rocking", peak_ratio=0.281))
    'rocking 0.281 α'
    """
    if test.status == "failed":
        return "failed"
    e = test.restitution or IdentifiedSummary()
    if e.value is not None:
        return f"e {interval(e.value, e.low, e.high, level)}"
    if not test.outcome:
        return f"{_words(test.observed_outcome)} (seen)" if test.observed_outcome else test.status
    far = farthest(test)
    moved = f", {far[0]} moved {quantity(far[1], 'mm')}" if far else ""
    return _with_peak(test.outcome, test.peak_ratio) + moved + (", no e" if test.restitution else "")


def farthest(test: TestSummary) -> tuple[str, float] | None:
    """Return the body that moved farthest for good, and how far, m; None if one fell or none is known to have moved."""
    moved = {
        name: hypot(body.residual_x, body.residual_y)
        for name, body in test.bodies.items()
        if body.residual_x is not None and body.residual_y is not None
    }
    if not moved or any(body.outcome == "overturned" for body in test.bodies.values()):
        return None
    far = max(moved.items(), key=lambda each: each[1])
    return far if far[1] >= LEAST_MOVED else None


def by_bodies(test: TestSummary) -> str:
    """
    Say what became of the bodies of an assembly: which fell, else which moved farthest; which joint opened first.

    Examples
    --------
    >>> from colonnade.campaign.forms.summary import BodySummary
    >>> low = BodySummary(outcome="rocking", residual_x=3e-3, residual_y=4e-3, opening=0.02, opening_time=1.25)
    >>> by_bodies(TestSummary(status="done", kind="earthquake", specimen="a", bodies={"1": low}))
    'Body 1 moved farthest for good: 5 mm. The joint below 1 opened first, at 1.25 s, and by up to 20 mm.'
    >>> still = BodySummary(outcome="no-rocking", residual_x=4e-6, residual_y=-3e-6)
    >>> by_bodies(TestSummary(status="done", kind="earthquake", specimen="a", bodies={"1": still}))
    'No joint opened, and no body moved for good.'
    """
    fallen = [name for name, body in test.bodies.items() if body.outcome == "overturned"]
    opened = {name: body.opening_time for name, body in test.bodies.items() if body.opening_time is not None}
    said = [f"Overturned: {listed(fallen)}."] if fallen else []
    if far := farthest(test):
        said.append(f"Body {far[0]} moved farthest for good: {quantity(far[1], 'mm')}.")
    if opened:
        first = min(opened, key=lambda name: opened[name])
        far_open = quantity(test.bodies[first].opening, "mm")
        when = quantity(opened[first], "s", 4)
        said.append(f"The joint below {first} opened first, at {when}, and by up to {far_open}.")
    known = [body.residual_x is not None and body.residual_y is not None for body in test.bodies.values()]
    if not said and all(known) and {body.outcome for body in test.bodies.values()} == {"no-rocking"}:
        return "No joint opened, and no body moved for good."
    return " ".join(said)


def predicted(test: TestSummary) -> dict[str, str]:
    """
    Write what each model predicts of a test with the verdict on it, such as ``0.275 α ✓``; the exact models first.

    The outcome is named if it is not that of a block that rocks as measured. A model that has not run is left out.
    """
    exact_first = sorted(test.predicted, key=lambda model: model in MODELS and MODELS[model].is_linearised)
    return {
        model: f"{_prediction(test, test.predicted[model])} {verdict(test, model)}".rstrip()
        for model in exact_first
        if test.predicted[model].outcome
    }


def _prediction(test: TestSummary, found: PredictionSummary) -> str:
    told = _with_peak(found.outcome or "", found.peak_ratio)
    return told.removeprefix("rocking ") if test.outcome == "rocking" else told


def _with_peak(outcome: str, peak_ratio: float | None) -> str:
    """Write an outcome, and the peak of a block that rocks."""
    if outcome != "rocking" or peak_ratio is None:
        return _words(outcome)
    told = ratio(peak_ratio) if peak_ratio < LEAST_RATIO else f"{peak_ratio:.3f}"  # to the least that counts
    return f"rocking {told} α"


def _words(outcome: str) -> str:
    return outcome.replace("-", " ")


def agreement(tests: Mapping[str, Mapping[str, Any]]) -> list[str]:
    """
    Say how far each model agrees with tests.

    Parameters
    ----------
    tests : mapping of str to mapping
        Records as summary.json has them, by test; of each `outcome`, `observed_outcome` and `predicted` are read.

    Returns
    -------
    said : list of str
        A sentence or more for each model that predicts the outcome of a test whose outcome is known.

    Examples
    --------
    >>> predicted = {"linear": {"outcome": "rocking", "nrmse": 0.02, "within_spread": 0.9}}
    >>> agreement({"a": {"outcome": "rocking", "predicted": predicted}})
    ['The linear model predicts the outcome of 1 of 1 test. Its misfit (nrmse) is 0.02 at the median and 0.02 at most, \
in a. 1 of 1 misfit is within its own spread.']
    """
    models = dict.fromkeys(model for test in tests.values() for model in test["predicted"])
    said = (
        _said(model, {name: test for name, test in tests.items() if model in test["predicted"]}) for model in models
    )
    return [text for text in said if text]


def _said(model: str, tests: Mapping[str, Mapping[str, Any]]) -> str:
    """Say how far a model agrees with the tests that it predicts, empty if no outcome can be compared."""
    predicted = {name: test["predicted"][model] for name, test in tests.items()}
    agrees = [
        agree(test["outcome"] or test.get("observed_outcome") or "", predicted[name]["outcome"] or "")
        for name, test in tests.items()
    ]
    known = [each for each in agrees if each is not None]
    if not known:
        return ""
    parts = [f"The {model} model predicts the outcome of {known.count(True)} of {count(len(known), 'test')}."]
    misfits = sorted((each["nrmse"], name) for name, each in predicted.items() if each["nrmse"] is not None)
    if misfits:
        middle, (largest, test) = median(misfit for misfit, _ in misfits), misfits[-1]
        parts.append(
            f"Its misfit (nrmse) is {ratio(middle, 2)} at the median and {ratio(largest, 2)} at most, in {test}."
        )
    ranks = (each["within_spread"] for each in predicted.values())
    judged = [inside for rank in ranks if (inside := is_within(nan if rank is None else rank)) is not None]
    verb = "is" if judged.count(True) == 1 else "are"
    within = f"{judged.count(True)} of {count(len(judged), 'misfit')} {verb} within its own spread."
    parts.append(within if judged else "Its own spread was not computed.")
    return " ".join(parts)


def finding(record: Mapping[str, Any]) -> str:
    """Write a finding of the summary as a line, marked if it follows from another."""
    follows = " (follows from the above)" if record.get("explained") else ""
    return f"{record['severity']}{follows}: {record['text']}"


def estimated(e: Mapping[str, Any]) -> str:
    """Write a coefficient of restitution with its interval, if it has one."""
    return shown(e["value"]) if e["low"] is None else interval(e["value"], e["low"], e["high"], e.get("level"))


def lines_of(record: Mapping[str, Any], prefix: str = "") -> list[tuple[str, str]]:
    """Write a nested record as lines of `a.b` and value, leaving out what is not known."""
    lines: list[tuple[str, str]] = []
    for key, value in record.items():
        name = f"{prefix}{key}"
        if isinstance(value, Mapping):
            is_estimate = {"value", "low", "high"} <= value.keys()
            lines += [(name, estimated(value))] if is_estimate and value["value"] is not None else []
            left = {each: of for each, of in value.items() if not is_estimate or each not in ESTIMATE}
            lines += lines_of(left, f"{name}.")
        elif key == "warnings":
            lines += [(name, finding(each)) for each in value]
        elif value is not None and value != []:
            lines.append((name, _with_unit(key, value)))
    return lines


def _with_unit(key: str, value: object) -> str:
    unit = _units().get(key, "")
    if isinstance(value, float) and unit in SMALL and 0.0 < abs(value) < 0.1:
        value, unit = round(1000 * value, 4), SMALL[unit]
    return f"{shown(value)} {unit}".rstrip()


@cache
def _units() -> dict[str, str]:
    """Give the units of keys of the summary; all other numbers have none."""
    from colonnade.campaign.forms.schema import json_schema
    from colonnade.campaign.specimen import OUTER_DIMENSIONS

    forms = json_schema("summary")["$defs"].values()
    said = {key: field for form in forms for key, field in form.get("properties", {}).items() if "unit" in field}
    return {key: field["unit"] for key, field in said.items()} | dict.fromkeys(OUTER_DIMENSIONS, "m")
