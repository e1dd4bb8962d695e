"""summary.csv: the record of each test as a row of numbers and plain text for a spreadsheet."""

from __future__ import annotations

import csv
import io
from typing import Any

from pydantic import BaseModel

from colonnade.campaign.forms.foreseen import ForecastScores
from colonnade.campaign.forms.summary import Summary, TestSummary


def as_csv(summary: Summary) -> str:
    """Return a row a test, with a column for each value that a test has."""
    rows = [_row(name, test) for name, test in summary.tests.items()]
    columns = list(dict.fromkeys(column for row in rows for column in row))
    text = io.StringIO()
    writer = csv.DictWriter(text, columns or ["test"], lineterminator="\n")
    writer.writeheader()
    writer.writerows({column: harmless(value) for column, value in row.items()} for row in rows)
    return text.getvalue()


def _row(name: str, test: TestSummary) -> dict[str, Any]:
    warnings = "; ".join(f"{each.severity}: {each.text}" for each in test.warnings)
    row = (
        {"test": name}
        | test.model_dump(exclude={"predicted", "restitution", "prototype", "forecast"})
        | {"warnings": warnings}
    )
    for model, prediction in test.predicted.items():
        row |= _columns(model, prediction)
    if test.restitution is not None:
        row |= _columns("restitution", test.restitution, without={"reason", "whole_history"})
        for model, history in test.restitution.whole_history.items():
            row |= _columns(f"restitution_history_{model}", history)
    if test.prototype is not None:
        row |= _columns("prototype", test.prototype)
    if test.forecast is not None:
        row |= _columns("forecast", test.forecast, without={"models"})
        for model, foreseen in test.forecast.models.items():
            row |= _columns(f"forecast_{model}", foreseen, without={"on_target", "on_recorded", "rigid_body"})
            for basis in ("on_target", "on_recorded"):
                row |= _columns(f"forecast_{model}_{basis}", getattr(foreseen, basis) or ForecastScores())
    return row


def _columns(prefix: str, record: BaseModel, without: set[str] | None = None) -> dict[str, Any]:
    return {f"{prefix}_{name}": value for name, value in record.model_dump(exclude=without).items()}


def harmless(value: Any) -> Any:
    """Quote what a spreadsheet would calculate; a bare carriage return would end the row."""
    if not isinstance(value, str):
        return value
    quote = "'" if value.startswith(("=", "+", "-", "@", "\t", "\r")) else ""
    return quote + value.replace("\r\n", "\n").replace("\r", "\n")
