"""What the page of forecasts shows: each forecast with what happened, and the scored ones together."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, NamedTuple

from colonnade.arrays import Array
from colonnade.campaign.forms.forecast import ForecastFile
from colonnade.campaign.forms.foreseen import ForecastEntry, ForecastOfModel
from colonnade.campaign.forms.summary import Summary, TestSummary
from colonnade.errors import StoreError, count
from colonnade.figures.agreement import pit_histogram
from colonnade.figures.files.output import Picture
from colonnade.store import files
from colonnade.store.forecasts import read_forecasts
from colonnade.store.layout import Layout
from colonnade.store.records.forecast import FEWEST, scored_of, shown_model
from colonnade.units.text import NOTHING, number

SCORES = {
    "on_target": "as it was made",
    "on_recorded": "on the recorded motion",
    "skill_rigid_body": "skill over rigid-body e",
    "skill_base_rate": "skill over base rate",
}
"""What scores are of, in words."""


class ForecastRow(NamedTuple):
    """
    A forecast: its file, what happened in words, and of each model what it foresaw and its record if it is scored.

    What a model foresaw is in words: probabilities, bands, friction.
    """

    entry: ForecastEntry
    forecast: ForecastFile
    happened: str
    models: list[tuple[str, tuple[str, ...], ForecastOfModel | None]]


def forecasts_page(layout: Layout, summary: Summary | None) -> dict[str, Any]:
    """Gather what the page shows; empty without a forecast."""
    if summary is None or summary.forecasts is None:
        return {}
    there = {known.sha256: known.forecast for known in read_forecasts(layout).known}
    judged, entries = summary.forecasts.models, summary.forecasts.files
    return {
        "summary": summary.forecasts,
        "scores": [
            (model, [(said, each.tests, getattr(each, name)) for name, said in SCORES.items() if getattr(each, name)])
            for model, each in judged.items()
        ],
        "coverage": [(model, each.coverage) for model, each in judged.items() if each.coverage],
        "rows": [_row(entry, there[entry.sha256], summary.tests) for entry in entries if entry.sha256 in there],
        "refused": [entry for entry in entries if entry.refused is not None],
        "calibration": calibration(calibrations_of(layout, summary)),
        "fewest": FEWEST,
    }


def _row(entry: ForecastEntry, forecast: ForecastFile, tests: Mapping[str, TestSummary]) -> ForecastRow:
    test = tests.get(entry.test or "") if entry.blind is not None else None
    record = test.forecast if test is not None and entry.scored else None
    models = [
        (name, shown_model(model), None if record is None else record.models[name])
        for name, model in forecast.models.items()
    ]
    return ForecastRow(entry, forecast, NOTHING if test is None else _happened(test), models)


def _happened(test: TestSummary) -> str:
    if test.outcome is None:
        return "not yet" if test.status == "pending" else NOTHING
    return f"{test.outcome}, max |θ|/α {number(test.peak_ratio)}" if test.outcome == "rocking" else test.outcome


def calibrations_of(layout: Layout, summary: Summary | None) -> dict[str, Array]:
    """Gather by model the PIT of the amplitudes of enough scored tests."""
    if summary is None or summary.forecasts is None:
        return {}
    there, scores = {known.sha256: known.forecast for known in read_forecasts(layout).known}, {}
    forecasts = {
        entry.test: there[entry.sha256]
        for entry in summary.forecasts.files
        if entry.scored and entry.test and entry.sha256 in there
    }
    for test in forecasts:
        try:
            scores[test] = files.read(layout.stage(test, "forecast"))
        except StoreError:
            continue
    drawn = {}
    for model in dict.fromkeys(model for test in scores for model in forecasts[test].models):
        found = scored_of(model, forecasts, scores)
        if len(found.observed) >= FEWEST:
            drawn[model] = found.pit
    return drawn


def calibration(drawn: Mapping[str, Array]) -> Picture | None:
    """Draw calibrations by model; None without any."""
    if not drawn:
        return None
    described = ", ".join(f"{count(each.size, 'test')} by the {model} model" for model, each in drawn.items())
    return Picture(pit_histogram(drawn), "calibration", "PIT of forecasts", f"{described}.")
