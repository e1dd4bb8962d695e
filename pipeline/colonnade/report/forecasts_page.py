"""What the page of forecasts shows: each forecast with what happened, and the scored ones together."""

from __future__ import annotations

from collections.abc import Mapping
from typing import NamedTuple

import numpy as np

from colonnade.campaign.forms.forecast import ForecastFile
from colonnade.campaign.forms.foreseen import ForecastEntry, ForecastOfModel, ForecastsSummary
from colonnade.campaign.forms.summary import Summary, TestSummary
from colonnade.errors import StoreError, count
from colonnade.figures.files.output import Picture
from colonnade.figures.forecasts import Calibration, reliability_and_pit
from colonnade.identification.calibration import reliability
from colonnade.store import files
from colonnade.store.forecasts import Known, read_forecasts
from colonnade.store.layout import Layout
from colonnade.store.records.forecast import FEWEST, scored_of, shown_model, shown_table
from colonnade.units.text import NOTHING, number


class ModelRow(NamedTuple):
    """What a model foresaw, in words (probabilities, bands, friction), and its record if it is scored."""

    model: str
    foreseen: tuple[str, ...]
    scores: ForecastOfModel | None


class ForecastRow(NamedTuple):
    """A forecast: its file, what the table has to do, each model, and what happened in words."""

    entry: ForecastEntry
    forecast: ForecastFile
    made: str
    table: tuple[str, str, str]
    models: list[ModelRow]
    happened: str


class ForecastsPage(NamedTuple):
    """All that the page shows."""

    summary: ForecastsSummary
    rows: list[ForecastRow]
    refused: list[ForecastEntry]
    calibration: Picture | None
    fewest: int


def forecasts_page(layout: Layout, summary: Summary | None) -> ForecastsPage | None:
    """
    Gather what the page shows.

    Parameters
    ----------
    layout : Layout
    summary : Summary or None
        Of the last run.

    Returns
    -------
    page : ForecastsPage or None
        None without a forecast.
    """
    if summary is None or summary.forecasts is None:
        return None
    there = {known.sha256: known for known in read_forecasts(layout).known}
    entries = summary.forecasts.files
    rows = [_row(entry, there[entry.sha256], summary.tests) for entry in entries if entry.sha256 in there]
    return ForecastsPage(
        summary.forecasts,
        rows,
        [entry for entry in entries if entry.refused is not None],
        calibration(calibrations_of(layout, summary)),
        FEWEST,
    )


def _row(entry: ForecastEntry, known: Known, tests: Mapping[str, TestSummary]) -> ForecastRow:
    forecast = known.forecast
    test = tests.get(entry.test or "") if entry.blind is not None else None
    record = test.forecast if test is not None and entry.scored else None
    return ForecastRow(
        entry,
        forecast,
        f"{forecast.made:%Y-%m-%d %H:%M:%S} UTC",
        shown_table(forecast.table),
        [
            ModelRow(name, shown_model(model), None if record is None else record.models[name])
            for name, model in forecast.models.items()
        ],
        NOTHING if test is None else _happened(test),
    )


def _happened(test: TestSummary) -> str:
    if test.outcome is None:
        return "not yet" if test.status == "pending" else NOTHING
    return f"{test.outcome}, max |θ|/α {number(test.peak_ratio)}" if test.outcome == "rocking" else test.outcome


def calibrations_of(layout: Layout, summary: Summary | None) -> dict[str, Calibration]:
    """Gather by model how probabilities and amplitudes of enough scored tests agree with what was measured."""
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
            diagram = reliability(found.forecasts, found.observed, np.zeros(len(found.observed)))
            drawn[model] = Calibration(diagram, found.pit)
    return drawn


def calibration(drawn: Mapping[str, Calibration]) -> Picture | None:
    """Draw calibrations by model; None without any."""
    if not drawn:
        return None
    described = ", ".join(f"{count(each.pit.size, 'test')} by the {model} model" for model, each in drawn.items())
    return Picture(reliability_and_pit(drawn), "calibration", "Reliability and PIT of forecasts", f"{described}.")
