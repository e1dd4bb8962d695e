"""summary.json and summary.csv: records of tests, specimens and assessments, made again if they changed; forecasts."""

from __future__ import annotations

import json
from collections.abc import Collection, Mapping
from dataclasses import dataclass
from functools import partial
from typing import TYPE_CHECKING, Any

import colonnade
from colonnade.campaign import Campaign, Test
from colonnade.campaign.assessment import Assessment
from colonnade.campaign.forms.assessed import AssessmentSummary
from colonnade.campaign.forms.forecast import ModelForecast
from colonnade.campaign.forms.foreseen import (
    ForecastEntry,
    ForecastOfModel,
    ForecastScores,
    ForecastsSummary,
    TestForecast,
)
from colonnade.campaign.forms.summary import SpecimenSummary, Summary, TestSummary
from colonnade.findings import Finding, warning
from colonnade.store import files
from colonnade.store.forecasts import Forecasts, Known, Refused
from colonnade.store.layout import Layout
from colonnade.store.records.stored import read_test
from colonnade.store.records.summary import as_csv
from colonnade.store.records.test import record_of_specimen, record_of_test
from colonnade.store.results import results_of
from colonnade.workflow.graph import Graph, RawFiles, restitution_taken
from colonnade.workflow.product import Contents, Product, brought_up_to_date, read_done, stored_attributes

if TYPE_CHECKING:
    import xarray as xr

MADE_BY = ("colonnade.store", "colonnade.identification", "colonnade.stages.specimen")
"""Packages whose code makes the records; what they import counts too."""

Foreseen = tuple[Mapping[str, TestForecast], ForecastsSummary | None]
"""What the summary says of forecasts: by test, and of all together."""


def write_summary(
    graph: Graph,
    *,
    outdated: Collection[str] = (),
    failed: Mapping[str, str] | None = None,
    unassessed: Collection[str] = (),
    foreseen: Foreseen = ({}, None),
    workers: int | None = 1,
) -> Summary:
    """
    Write both summaries if their content changed.

    Parameters
    ----------
    graph : Graph
    outdated : collection of str, optional
        Tests whose stored results are out of date; they are reported as pending.
    failed : mapping of str to str, optional
        Why tests failed in this run, whether stored or not.
    unassessed : collection of str, optional
        Assessments whose stored results are out of date; they are left out.
    foreseen : Foreseen, optional
        What was forecast.
    workers : int, optional
        Processes in which results are read; None for one a core.

    Returns
    -------
    summary : Summary

    Raises
    ------
    StoreError
        If a file cannot be written.
    """
    campaign, layout, failures = graph.campaign, graph.layout, failed or {}
    tests = (_of_test(graph, test, name in outdated, failures.get(name)) for name, test in campaign.tests.items())
    made = brought_up_to_date((_of_specimen(graph, name) for name in campaign.specimens), graph.catalogue)
    made |= brought_up_to_date(tests, graph.catalogue, workers=workers)
    summary = Summary(
        campaign=campaign.campaign,
        colonnade=colonnade.__version__,
        specimens={
            name: SpecimenSummary.model_validate_json(made[f"specimen-record {name}"].text)
            for name in campaign.specimens
        },
        tests={
            name: TestSummary.model_validate_json(made[f"record {name}"].text).model_copy(
                update={"forecast": foreseen[0].get(name)}
            )
            for name in campaign.tests
        },
        forecasts=foreseen[1],
        assessments={
            name: record
            for name, asked in campaign.assessments.items()
            if name not in unassessed and (record := record_of_assessment(layout, name, asked)) is not None
        },
    )
    files.write_text(layout.summary_json, summary.text())
    files.write_text(layout.summary_csv, as_csv(summary))
    return summary


def _of_specimen(graph: Graph, name: str) -> Product:
    from colonnade.stages.specimen import SpecimenInputs

    campaign, layout = graph.campaign, graph.layout
    inputs = SpecimenInputs.of(campaign, name).model_dump_json()
    entry = json.dumps([inputs, repr(campaign.specimens[name]), campaign.gravity])
    upstream = {"specimen": graph.catalogue.content(layout.stage(name, "specimen"))}
    make = partial(_specimen, campaign, layout, name)
    return Product(f"specimen-record {name}", entry, upstream, graph.catalogue.code(MADE_BY), make)


def _specimen(campaign: Campaign, layout: Layout, name: str) -> Contents:
    return [], record_of_specimen(campaign, name, restitution_taken(campaign, layout, name)).model_dump_json()


def _of_test(graph: Graph, test: Test, is_outdated: bool, failure: str | None) -> Product:
    """Give the record of a test, made by a campaign that holds this test alone."""
    campaign, layout = graph.campaign.but(tests={test.id: test}), graph.layout
    entry = [campaign.told(test), repr(campaign.specimens[test.specimen]), campaign.gravity, campaign.left_out(test.id)]
    entry += [repr(campaign.concerning(test.id)), is_outdated, failure]
    upstream = {str(each): graph.catalogue.content(layout.path(each)) for each in results_of(campaign, test)}
    make = partial(_test, campaign, layout, test, is_outdated, failure)
    return Product(f"record {test.id}", json.dumps(entry), upstream, graph.catalogue.code(MADE_BY), make)


def _test(campaign: Campaign, layout: Layout, test: Test, is_outdated: bool, failure: str | None) -> Contents:
    stored = read_test(campaign, layout, test, is_outdated=is_outdated, failure=failure)
    return [], record_of_test(campaign, test, stored).model_dump_json()


def record_of_assessment(layout: Layout, name: str, asked: Assessment, failure: str = "") -> AssessmentSummary | None:
    """Return the record of an assessment that was made or failed, now (`failure`) or in an earlier run."""
    stored = stored_attributes(layout.stage(name, "assessment"))
    if failure or stored.get("status") == "failed":
        reason = failure or str(stored["reason"])
        return AssessmentSummary(status="failed", reason=reason, specimen=asked.specimen, measure=asked.measure)
    return AssessmentSummary.model_validate_json(stored["answer"]) if stored else None


NOT_BLIND = "not blind: the raw file of the test was there when it was made"
NOT_MEASURED = "the test has no result yet"


@dataclass(frozen=True)
class Chosen:
    """
    The forecasts of a campaign by what they are for.

    Attributes
    ----------
    blind : dict of str to bool
        By file, of those that are for a test: whether it is blind.
    counts : dict of str to Known
        By test the one that counts: the last one that is blind, else the last one.
    """

    blind: dict[str, bool]
    counts: dict[str, Known]

    @property
    def scored(self) -> dict[str, Known]:
        """Those of `counts` that are blind."""
        return {test: known for test, known in self.counts.items() if self.blind[known.name]}


def choose(campaign: Campaign, forecasts: Forecasts, raw: Mapping[str, RawFiles]) -> Chosen:
    """
    Find the forecast of each test that counts.

    Parameters
    ----------
    campaign : Campaign
    forecasts : Forecasts
        A forecast is for the test that it names, if that is still one of its specimen.
    raw : mapping of str to mapping of str to RawFile
        Raw files by test.
    """
    blind, counts = {}, dict[str, Known]()
    for known in forecasts.known:
        test = campaign.tests.get(known.forecast.test or "")
        if test is None or test.specimen != known.forecast.specimen:
            continue
        blind[known.name] = is_blind(known, raw[test.id])
        earlier = counts.get(test.id)
        if earlier is None or blind[known.name] or not blind[earlier.name]:
            counts[test.id] = known
    return Chosen(blind, counts)


def is_blind(known: Known, raw: RawFiles) -> bool:
    """Whether none of a test's raw files was there when a forecast was made, by name or by content."""
    there = known.forecast.raw_files
    content = {file.sha256 for file in raw.values() if file.sha256 is not None}
    return not (raw.keys() & there.keys() or content & set(there.values()))


def finding_of(refused: Refused) -> Finding:
    """Make a finding of a file that cannot be taken as a forecast."""
    return warning("forecast", f"forecasts/{refused.name}: {refused.reason} It is left out.")


def foreseen_of(layout: Layout, forecasts: Forecasts, chosen: Chosen) -> Foreseen:
    """Gather what the summary says of forecasts, of which those that count have been scored."""
    records, scored = {}, dict[str, "xr.Dataset"]()
    for test, known in chosen.counts.items():
        blind = chosen.blind[known.name]
        scores = read_done(layout.stage(test, "forecast")) if blind else None
        if scores is None or scores.attrs["file"] != known.name:  # those of another forecast
            reason = NOT_MEASURED if blind else NOT_BLIND
        else:
            reason = str(scores.attrs["reason"])
            if "observed_amplitude" in scores:
                scored[test] = scores
        records[test] = TestForecast(
            file=known.name,
            made=f"{known.forecast.made:%Y-%m-%dT%H:%M:%SZ}",
            level=known.forecast.level,
            blind=blind,
            reason=reason or None,
            models={name: _of_model(name, model, scored.get(test)) for name, model in known.forecast.models.items()},
        )
    if not (forecasts.known or forecasts.refused):
        return records, None
    from colonnade.store.records.forecast import judge

    names = {chosen.counts[test].name for test in scored}
    entries = [
        ForecastEntry(
            file=known.name,
            sha256=known.sha256,
            test=known.forecast.test,
            blind=chosen.blind.get(known.name),
            scored=known.name in names,
        )
        for known in forecasts.known
    ]
    entries += [ForecastEntry(file=each.name, refused=each.reason) for each in forecasts.refused]
    return records, ForecastsSummary(
        count=len(forecasts.known),
        blind=sum(chosen.blind.values()),
        models=judge({test: chosen.counts[test].forecast for test in scored}, scored),
        files=tuple(entries),
    )


def _of_model(name: str, model: ModelForecast, scores: xr.Dataset | None) -> ForecastOfModel:
    widest = max(model.bands, key=lambda band: band.probability)
    found: dict[str, Any] = {share: getattr(model, share) for share in ("no_rocking", "rocking", "overturned")}
    if scores is not None:
        own = scores.sel(model=name)
        found["pit"] = float(own["forecast_pit"].sel(basis="on_target"))
        for basis in map(str, own["basis"].to_numpy()):
            at = own.sel(basis=basis)
            values = ForecastScores(**{key: float(at[f"forecast_{key}"]) for key in ForecastScores.model_fields})
            found[basis] = None if values.crps is None else values
    return ForecastOfModel(low=widest.low, high=widest.high, **found)
