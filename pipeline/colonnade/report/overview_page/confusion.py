"""Which outcomes a model mistakes for which: measured against predicted, counted, with the tests of each cell."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple, get_args

from colonnade.dynamics.history import Outcome
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
