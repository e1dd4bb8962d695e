"""processed/summary.json and summary.csv: a record a test, made anew from the results on disk."""

from __future__ import annotations

import csv
import io
from math import pi
from typing import TYPE_CHECKING, Any

import colonnade
from colonnade.campaign import Campaign, Test
from colonnade.campaign.summary import (
    PredictionSummary,
    RestitutionSummary,
    SpecimenSummary,
    Summary,
    TestSummary,
)
from colonnade.errors import StoreError
from colonnade.store import files
from colonnade.store.layout import Layout
from colonnade.workflow.survey import Finding, Survey

if TYPE_CHECKING:
    import xarray as xr


def write_summary(campaign: Campaign, layout: Layout, survey: Survey) -> Summary:
    """
    Write both files, where they differ from what is there.

    Raises
    ------
    StoreError
        If they cannot be written.
    """
    summary = Summary(
        campaign=campaign.campaign,
        colonnade=colonnade.__version__,
        specimens={name: _specimen(campaign, name, survey.specimens[name]) for name in campaign.specimens},
        tests={name: _test(campaign, test, survey) for name, test in campaign.tests.items()},
    )
    files.write_text(layout.summary_json, summary.text())
    files.write_text(layout.summary_csv, _rows(campaign, summary))
    return summary


def _specimen(campaign: Campaign, name: str, found: Finding) -> SpecimenSummary:
    block = campaign.block(name)
    return SpecimenSummary(
        critical_angle=block.critical_angle,
        p=block.p,
        pole_distance=block.pole_distance,
        inertia=block.inertia,
        restitution=_restitution(campaign, name, found),
    )


def _restitution(campaign: Campaign, name: str, found: Finding) -> RestitutionSummary:
    given = campaign.specimens[name].restitution
    reason = found.run.reason or "not pooled yet"
    if found.holds:
        try:
            return _pooled(files.read(found.path))
        except StoreError as error:
            reason = str(error)
    return RestitutionSummary(value=given, source="identified" if given is None else "given", reason=reason)


def _pooled(pooled: xr.Dataset) -> RestitutionSummary:
    sides = [float(value) for value in pooled["side_restitution"].to_numpy()]
    source = pooled.attrs["source"]
    low = float(pooled["restitution_low"])
    return RestitutionSummary(
        value=sides[0] if sides[0] == sides[1] else (sides[0], sides[1]),
        low=low,
        high=float(pooled["restitution_high"]),
        level=float(pooled["level"]) if low == low else None,
        source=source,
        method=pooled.attrs["method"] or None,
        reason=pooled.attrs["reason"] or None,
        tests=tuple(str(test) for test in pooled["test_id"].to_numpy()) if source == "identified" else (),
    )


def _test(campaign: Campaign, test: Test, survey: Survey) -> TestSummary:
    found = survey.tests[test.id]
    written: dict[str, Any] = {
        "status": _status(found),
        "reason": _reason(found, survey.specimens[test.specimen]),
        "kind": test.kind,
        "specimen": test.specimen,
        "span": test.span,
        "observed_outcome": test.observed_outcome,
    }
    if test.frequency is not None:
        written["frequency_ratio"] = 2 * pi * test.frequency / campaign.block(test.specimen).p
    warnings: list[str] = []
    predictions: dict[str, dict[str, Any]] = {model: {} for model in campaign.processing.predict.models}
    for each in found:
        if each.run.action not in ("up-to-date", "failed") or not each.path.exists():
            continue
        try:
            result = files.read(each.path)
        except StoreError as error:
            written |= {"status": "failed", "reason": f"{each.run.stage}: {error}"}
            continue
        warnings += result.attrs.get("warnings", [])
        if not each.holds:
            continue
        if each.run.stage == "rocking":
            written |= _measured(campaign, test, result)
        elif each.run.stage == "predict" and each.run.model is not None:
            predictions[each.run.model] |= {
                "outcome": result.attrs["outcome"] or None,
                "peak_ratio": float(result["peak_ratio"]),
            }
        elif each.run.stage == "compare":
            for model, nrmse in zip(result["model"].to_numpy(), result["nrmse"].to_numpy(), strict=True):
                predictions[str(model)]["nrmse"] = float(nrmse)
    return TestSummary(
        **written,
        warnings=tuple(dict.fromkeys(warnings)),
        predicted={model: PredictionSummary(**values) for model, values in predictions.items()},
    )


def _status(found: list[Finding]) -> str:
    actions = {each.run.action for each in found}
    if actions & {"failed", "skipped"}:
        return "failed"
    return "pending" if "pending" in actions else "done"


def _reason(found: list[Finding], specimen: Finding) -> str | None:
    for each in found:
        if each.run.action == "failed":
            return f"{each.run.stage}: {each.run.reason}"
    if any(each.run.action == "skipped" for each in found):
        return f"specimen {specimen.run.subject}: {specimen.run.reason}"
    return None


def _measured(campaign: Campaign, test: Test, rocking: xr.Dataset) -> dict[str, Any]:
    values = {
        name: float(rocking[variable])
        for name, variable in (
            ("peak_ratio", "peak_ratio"),
            ("peak_time", "peak_time"),
            ("pga", "peak_ground_acceleration"),
        )
        if variable in rocking
    }
    measured: dict[str, Any] = {"outcome": rocking.attrs["outcome"] or None, **values}
    if "impact_time" in rocking:
        measured["impacts"] = rocking["impact_time"].size
    if test.kind == "sine" and "pga" in values:
        measured["amplitude_ratio"] = values["pga"] / campaign.block(test.specimen).uplift_acceleration
    return measured


def _rows(campaign: Campaign, summary: Summary) -> str:
    plain = [name for name in TestSummary.model_fields if name != "predicted"]
    models, results = campaign.processing.predict.models, list(PredictionSummary.model_fields)
    stream = io.StringIO()
    writer = csv.writer(stream, lineterminator="\n")
    writer.writerow(["test", *plain, *(f"{model}_{result}" for model in models for result in results)])
    for name, test in summary.tests.items():
        record = test.model_dump()
        record["warnings"] = "; ".join(test.warnings)
        predicted = [record["predicted"][model][result] for model in models for result in results]
        writer.writerow([name, *(record[key] for key in plain), *predicted])
    return stream.getvalue()
