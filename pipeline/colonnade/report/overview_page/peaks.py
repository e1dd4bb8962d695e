"""Agreement of peaks: what each model predicts of every test that rocked, over what was measured."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from math import inf, log
from typing import NamedTuple

from colonnade.errors import count
from colonnade.figures.agreement import PeakPoint, predicted_over_measured
from colonnade.figures.files.output import Picture
from colonnade.report.rows import TestRow

NAMED = 10
"""Tests whose predicted peaks are furthest from the measured ones, named under the figure and numbered in it."""


class Worst(NamedTuple):
    """One of the tests whose predicted peak is furthest from the measured one; `factor` is predicted over measured."""

    row: TestRow
    model: str
    factor: float


def worst(tests: Sequence[TestRow], models: Sequence[str]) -> list[Worst]:
    """
    Find the `NAMED` predictions furthest from the measured peak, as a ratio either way.

    A model that predicts overturning of a test that rocked has no peak: its outcome is missed.
    """
    found = []
    for row in tests:
        measured = row.record.peak_ratio
        for model in models if row.record.outcome == "rocking" and measured else ():
            predicted = row.predicted(model).peak_ratio
            if predicted is not None and measured:
                found.append(Worst(row, model, predicted / measured))
    found.sort(key=lambda each: (-_distance(each.factor), each.row.id))
    return found[:NAMED]


def _distance(factor: float) -> float:
    return abs(log(factor)) if factor > 0 else inf


def points(tests: Sequence[TestRow], models: Sequence[str], named: Sequence[Worst]) -> dict[str, list[PeakPoint]]:
    """Give the points of the figure, by model: every prediction of a test that rocked, overturning without a peak."""
    numbers = {(each.row.id, each.model): place for place, each in enumerate(named, 1)}
    found = {
        model: [
            _point(row, model, numbers.get((row.id, model)))
            for row in tests
            if row.record.outcome == "rocking" and row.record.peak_ratio and row.predicted(model).outcome
        ]
        for model in models
    }
    return {model: own for model, own in found.items() if own}


def _point(row: TestRow, model: str, place: int | None) -> PeakPoint:
    predicted = row.predicted(model)
    ends = predicted.peak_low, predicted.peak_high
    return PeakPoint(row.record.peak_ratio or 0.0, predicted.peak_ratio, *ends, test=row.id, number=place)


def picture(found: Mapping[str, Sequence[PeakPoint]]) -> Picture | None:
    """Draw the figure; None without a point."""
    if not found:
        return None
    described = ", ".join(f"{count(len(own), 'test')} by the {model} model" for model, own in found.items())
    title = "Predicted over measured largest rocking angle"
    return Picture(predicted_over_measured(found), "peaks", title, f"{described}.")
