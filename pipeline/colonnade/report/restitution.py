"""What is stored of a free vibration's restitution, in words: every estimator, the departures, what was assumed."""

from __future__ import annotations

from dataclasses import dataclass
from math import isfinite, nan

from colonnade.figures import EstimateRow
from colonnade.report import wording
from colonnade.report.results import Results
from colonnade.units import format_uncertain

STAGE = "restitution"

ESTIMATORS = {
    "peaks": "peaks",
    "half-periods": "half-periods",
    "impact-by-impact": "impact by impact",
    "history-linear": "whole history, linear",
    "history-nonlinear": "whole history, nonlinear",
    "history-scatter": "whole history, e of each impact",
}
"""Estimators by the name they are stored with, in words."""


@dataclass(frozen=True)
class EstimateText:
    """One estimator's e with its interval, or why it gives none; what it assumes; whether it is the recommended one."""

    name: str
    value: str
    assumptions: str
    reason: str
    recommended: bool


def value_of(results: Results, stage: str) -> str:
    """Write a coefficient of restitution with the half-width of its interval."""
    names = ("restitution_low", "restitution_high", "level")
    low, high, level = (nan if bound is None else bound for bound in (results.value(stage, name) for name in names))
    return wording.interval(results.value(stage, "restitution"), low, high, level)


def estimates_of(results: Results) -> tuple[EstimateText, ...]:
    """Write what each estimator gives, in the order in which they are stored."""
    values, low, high = (results.of(STAGE, f"estimate{end}", "estimator") for end in ("", "_low", "_high"))
    assumptions, reasons = (results.texts(STAGE, f"estimate_{name}") for name in ("assumptions", "reasons"))
    recommended = results.text(STAGE, "recommended")
    return tuple(
        EstimateText(
            ESTIMATORS.get(name, name),
            _compact(value, low[name], high[name]),
            assumptions[index] if index < len(assumptions) else "",
            reasons[index] if index < len(reasons) else "",
            name == recommended,
        )
        for index, (name, value) in enumerate(values.items())
    )


def _compact(value: float, low: float, high: float) -> str:
    """Write e and half of its interval, without the level: many of them stand in one table."""
    return format_uncertain(value, (high - low) / 2) if isfinite(high - low) else wording.number(value, 5)


def estimate_rows(results: Results) -> list[EstimateRow]:
    """Return the estimates for a figure."""
    values, low, high = (results.of(STAGE, f"estimate{end}", "estimator") for end in ("", "_low", "_high"))
    recommended = results.text(STAGE, "recommended")
    return [
        EstimateRow(ESTIMATORS.get(name, name), value, low[name], high[name], name == recommended)
        for name, value in values.items()
    ]


def departures_of(results: Results) -> tuple[str, ...]:
    """Return the departures from the plane model, a sentence each."""
    return tuple(results.texts(STAGE, "departures"))


def facts_of(results: Results) -> tuple[tuple[str, str], ...]:
    """Give e of a free vibration, by which estimator and what that assumes, or why it was refused."""
    estimates = estimates_of(results)
    chosen = next((each for each in estimates if each.recommended), None)
    slope, error = (results.value(STAGE, f"restitution_slope{end}") for end in ("", "_standard_error"))
    trend = "" if slope is None or error is None or not error > 0 else f"{slope:+.2g} ± {error:.1g} a rad/s"
    facts = (
        ("e", value_of(results, STAGE)),
        ("refused", results.text(STAGE, "reason")),
        ("recommended estimator", chosen.name if chosen else ""),
        ("which assumes", chosen.assumptions if chosen else ""),
        ("method", results.text(STAGE, "method")),
        ("e with the speed of impact", trend),
        ("rest angle taken off", wording.quantity(results.value(STAGE, "zero_offset"), "mrad", 2)),
    )
    return tuple((label, text) for label, text in facts if text not in ("", wording.NOTHING))
