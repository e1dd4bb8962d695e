"""summary.json and summary.csv, rebuilt from the results, which are the truth."""

from __future__ import annotations

import csv
import io
from collections.abc import Collection, Mapping
from pathlib import Path
from typing import Any, Literal

import colonnade
from colonnade.campaign import Campaign, Test
from colonnade.campaign.summary import RestitutionSummary, SpecimenSummary, Summary, TestSummary, Warned
from colonnade.errors import StoreError
from colonnade.findings import at_stage, in_order
from colonnade.store import files
from colonnade.store.layout import Layout
from colonnade.workflow.catalogue import Catalogue
from colonnade.workflow.freshness import source_hash
from colonnade.workflow.measured import measured, predicted, specimen_prototype
from colonnade.workflow.pooling import restitution_taken

_FOREIGN = (
    "what is stored was made from other raw files, another campaign file or another version of colonnade; run again"
)


def write_summary(
    campaign: Campaign,
    layout: Layout,
    catalogue: Catalogue,
    *,
    outdated: Collection[str] = (),
    failed: Mapping[str, str] | None = None,
) -> None:
    """
    Write both summaries, where their content changed.

    Parameters
    ----------
    campaign : Campaign
    layout : Layout
    catalogue : Catalogue
        Spares reading the results of tests that are as they were.
    outdated : collection of str, optional
        Tests whose stored results are not of this campaign file, these raw files or this program; they are pending.
    failed : mapping of str to str, optional
        Reasons of the tests that failed in this run, stored or not.

    Raises
    ------
    StoreError
        If they cannot be written.
    """
    summary = summarise(campaign, layout, catalogue, outdated=outdated, failed=failed or {})
    files.write_text(layout.summary_json, summary.text())
    files.write_text(layout.summary_csv, _table(summary))


def summarise(
    campaign: Campaign, layout: Layout, catalogue: Catalogue, *, outdated: Collection[str], failed: Mapping[str, str]
) -> Summary:
    """Gather a record a specimen and a test from what is stored; see `write_summary`."""
    elsewhere = campaign.wherever_it_lies()
    return Summary(
        campaign=campaign.campaign,
        colonnade=colonnade.__version__,
        specimens={name: _specimen(campaign, layout, name) for name in campaign.specimens},
        tests={
            name: _remembered(campaign, layout, catalogue, test, name in outdated, failed.get(name))
            for name, test in elsewhere.tests.items()
        },
    )


def _stored(path: Any) -> Any:
    """Return a result, None where it is not there; damage is a failure like any other."""
    try:
        return files.read(path) if path.exists() else None
    except StoreError as error:
        return error


def _specimen(campaign: Campaign, layout: Layout, name: str) -> SpecimenSummary:
    block = campaign.block(name)
    result = restitution_taken(campaign, layout, name)
    sides = [float(value) for value in result["side_restitution"]]
    restitution = RestitutionSummary(
        value=sides[0] if sides[0] == sides[1] else (sides[0], sides[1]),
        low=float(result["restitution_low"]),
        high=float(result["restitution_high"]),
        level=float(result["level"]),
        source=result.attrs["restitution_source"],
        method=result.attrs["method"] or None,
        reason=result.attrs["reason"] or None,
        tests=tuple(str(test) for test in result["test_id"].to_numpy()),
    )
    return SpecimenSummary(
        critical_angle=block.critical_angle,
        p=block.p,
        pole_distance=block.pole_distance,
        inertia=block.inertia,
        restitution=restitution,
        prototype=specimen_prototype(campaign, name),
    )


def _remembered(
    campaign: Campaign, layout: Layout, catalogue: Catalogue, test: Test, is_outdated: bool, failure: str | None
) -> TestSummary:
    """Record of a test: the last one where it was made from just these results, else a new one."""
    paths = _paths(campaign, layout, test)
    entry = [repr(test), repr(campaign.specimens[test.specimen]), campaign.gravity, campaign.review(test.id).excluded]
    entry.append(repr(campaign.concerning(test.id)))
    signature = catalogue.signature(paths.values(), *entry, is_outdated, failure, source_hash())
    known = catalogue.record(test.id, signature)
    if known is not None:
        return TestSummary.model_validate_json(known)
    record = _test(campaign, test, paths, is_outdated=is_outdated, failure=failure)
    catalogue.remember(test.id, signature, record.model_dump_json())
    return record


def _paths(campaign: Campaign, layout: Layout, test: Test) -> dict[str, Path]:
    stages = ("ingest", "condition", "rocking", "restitution", "compare")
    models = campaign.processing.predict.models
    return {stage: layout.stage(test.id, stage) for stage in stages} | {
        f"predict-{model}": layout.stage(test.id, "predict", model) for model in models
    }


def _test(
    campaign: Campaign, test: Test, paths: Mapping[str, Path], *, is_outdated: bool, failure: str | None
) -> TestSummary:
    models = campaign.processing.predict.models
    results = {stage: None if is_outdated else _stored(path) for stage, path in paths.items()}
    reasons = [str(each) for each in results.values() if isinstance(each, StoreError)]
    sound = {stage: each for stage, each in results.items() if each is not None and not isinstance(each, StoreError)}
    reasons += [f"{stage}: {each.attrs['reason']}" for stage, each in sound.items() if each.attrs["status"] == "failed"]
    if failure is not None and not reasons:
        reasons = [failure]
    done = {stage: each for stage, each in sound.items() if each.attrs["status"] == "done"}
    warnings = [found for stage, each in sound.items() for found in at_stage(each.attrs.get("warnings", []), stage)]
    ordered = in_order(warnings, campaign.concerning(test.id))
    has_others = is_outdated and any(path.exists() for path in paths.values())
    status: Literal["done", "failed", "pending"] = "failed" if reasons else "done" if "compare" in done else "pending"
    return TestSummary(
        status=status,
        reason=" ".join(reasons) or campaign.review(test.id).excluded or (_FOREIGN if has_others else None),
        warnings=tuple(Warned.of(found, explained=explained) for found, explained in ordered),
        kind=test.kind,
        specimen=test.specimen,
        span=test.span,
        observed_outcome=test.observed_outcome,
        **measured(campaign, test, done),
        predicted={model: predicted(done, model) for model in models if f"predict-{model}" in done},
    )


def _table(summary: Summary) -> str:
    """Return a row a test; text that a spreadsheet would take for a formula is quoted."""
    rows = []
    for name, test in summary.tests.items():
        row: dict[str, Any] = {"test": name}
        record = test.model_dump(exclude={"predicted", "restitution", "prototype"})
        row |= record | {"warnings": "; ".join(f"{each.severity}: {each.text}" for each in test.warnings)}
        for model, result in test.predicted.items():
            row |= {f"{model}_{column}": value for column, value in result.model_dump().items()}
        if test.restitution is not None:
            found = test.restitution.model_dump(include={"value", "low", "high"})
            row |= {f"restitution_{column}": value for column, value in found.items()}
            for model, history in test.restitution.whole_history.items():
                name = f"restitution_history_{model}"
                row |= {f"{name}_{column}": value for column, value in history.model_dump().items()}
        if test.prototype is not None:
            row |= {f"prototype_{column}": value for column, value in test.prototype.model_dump().items()}
        rows.append(row)
    columns = list(dict.fromkeys(column for row in rows for column in row))
    text = io.StringIO()
    writer = csv.DictWriter(text, columns or ["test"], lineterminator="\n")
    writer.writeheader()
    writer.writerows({column: _harmless(value) for column, value in row.items()} for row in rows)
    return text.getvalue()


def _harmless(value: Any) -> Any:
    """Quote what a spreadsheet would calculate; a bare carriage return would end the row."""
    if not isinstance(value, str):
        return value
    quote = "'" if value.startswith(("=", "+", "-", "@", "\t", "\r")) else ""
    return quote + value.replace("\r\n", "\n").replace("\r", "\n")
