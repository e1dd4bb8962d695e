"""The summary of the last run, read back, and values gathered from the records of its tests."""

from __future__ import annotations

import csv
import io
from collections.abc import Mapping
from typing import Any, cast, get_args

from pydantic import BaseModel

from colonnade.campaign import Campaign
from colonnade.campaign.forms.foreseen import ForecastScores
from colonnade.campaign.forms.summary import Summary, TestSummary
from colonnade.dynamics.history import Outcome
from colonnade.errors import StoreError
from colonnade.identification.response.boundaries import MapPoint
from colonnade.store.layout import Layout
from colonnade.store.records.test import as_given, of_block


def read_summary(layout: Layout) -> Summary | None:
    """
    Read the summary of the last run.

    Returns
    -------
    summary : Summary or None
        None if there was no run.

    Raises
    ------
    StoreError
        If the file was altered or damaged.
    """
    try:
        return Summary.model_validate_json(layout.summary_json.read_text(encoding="utf-8"))
    except FileNotFoundError:
        return None
    except (OSError, ValueError, RecursionError):
        raise StoreError(
            f"{layout.summary_json}: it was altered or damaged. Run `colonnade run` to make it again."
        ) from None


def records_of_tests(campaign: Campaign, summary: Summary | None) -> dict[str, TestSummary]:
    """Return the record of each test of a campaign; one that was never run is pending."""
    known = {} if summary is None else summary.tests
    return {
        name: known.get(name) or TestSummary(status="pending", **as_given(test))
        for name, test in campaign.tests.items()
    }


def records_of_specimens(campaign: Campaign, summary: Summary | None) -> dict[str, dict[str, Any]]:
    """Return each specimen as in the summary, with shape, mass and rigid-body e; before a run its e is not known."""
    records = {}
    for name, specimen in campaign.specimens.items():
        block = campaign.block(name)
        records[name] = {
            "shape": specimen.shape,
            "mass": specimen.mass,
            "rigid_restitution": block.restitution if specimen.is_in_plane else None,
            **of_block(block),
            "restitution": dict.fromkeys(("value", "low", "high", "level", "source")) | {"reason": "not run yet"},
        }
        if summary is not None and name in summary.specimens:
            records[name] |= summary.specimens[name].model_dump(mode="json")
    return records


def map_points(tests: Mapping[str, TestSummary], specimen: str) -> list[MapPoint]:
    """Return the sine tests of a specimen whose Ω, A and outcome, measured or observed, are known."""
    points = []
    for name, test in tests.items():
        outcome, ratios = test.outcome or test.observed_outcome, (test.frequency_ratio, test.amplitude_ratio)
        if test.specimen == specimen and None not in ratios and outcome in get_args(Outcome):
            points.append(MapPoint(name, *cast(tuple[float, float], ratios), cast(Outcome, outcome), test.order))
    return points


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
