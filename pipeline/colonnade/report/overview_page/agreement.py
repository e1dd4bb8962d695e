"""How well models agree with a campaign: outcomes counted, and peaks over measured ones."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from math import inf, log
from typing import NamedTuple, get_args

from colonnade.dynamics.history import Outcome
from colonnade.errors import count
from colonnade.figures.agreement import PeakPoint, predicted_over_measured
from colonnade.figures.files.output import Picture
from colonnade.report.rows import TestRow

MEASURED = (*get_args(Outcome), "not-overturned")
"""Outcomes that a test can have; the last is only observed, where nothing was measured."""


class Cell(NamedTuple):
    """Tests of one measured and one predicted outcome, and whether these agree."""

    measured: str
    predicted: str
    tests: tuple[str, ...]
    agrees: bool


class Confusion(NamedTuple):
    """Outcomes of one model: by measured outcome a row of cells, one for each predicted outcome."""

    model: str
    predicted: tuple[str, ...]
    rows: tuple[tuple[Cell, ...], ...]

    @property
    def wrong(self) -> list[Cell]:
        """Cells with tests whose outcome the model misses, those with most tests first."""
        cells = [cell for row in self.rows for cell in row if cell.tests and not cell.agrees]
        return sorted(cells, key=lambda cell: -len(cell.tests))


def confusions(tests: Sequence[TestRow], models: Sequence[str]) -> list[Confusion]:
    """Count the outcomes of each model that predicts a test whose outcome is known."""
    found = (_of_model(tests, model) for model in models)
    return [confusion for confusion in found if confusion.rows]


def _of_model(tests: Sequence[TestRow], model: str) -> Confusion:
    known = [row for row in tests if row.agrees(model) is not None]
    outcomes = get_args(Outcome)
    rows = []
    for measured in MEASURED:
        own = [row for row in known if row.outcome == measured]
        if own:
            rows.append(tuple(_cell(own, measured, predicted, model) for predicted in outcomes))
    return Confusion(model, outcomes, tuple(rows))


def _cell(own: Sequence[TestRow], measured: str, predicted: str, model: str) -> Cell:
    tests = [row for row in own if row.predicted(model).outcome == predicted]
    agrees = predicted != "overturned" if measured == "not-overturned" else predicted == measured
    return Cell(measured, predicted, tuple(row.id for row in tests), agrees)


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


def peak_points(tests: Sequence[TestRow], models: Sequence[str], named: Sequence[Worst]) -> dict[str, list[PeakPoint]]:
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


def peaks_picture(found: Mapping[str, Sequence[PeakPoint]]) -> Picture | None:
    """Draw the figure; None without a point."""
    if not found:
        return None
    described = ", ".join(f"{count(len(own), 'test')} by the {model} model" for model, own in found.items())
    title = "Predicted over measured largest rocking angle"
    return Picture(predicted_over_measured(found), "peaks", title, f"{described}.")
