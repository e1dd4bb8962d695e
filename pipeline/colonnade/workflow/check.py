"""Check: what a run would refuse or warn of, found by making its first results in memory; nothing is written."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from colonnade.campaign import Campaign, Test
from colonnade.campaign.assessment import Assessment
from colonnade.errors import ReadError, StageError
from colonnade.findings import Finding, at_stage, note, warning
from colonnade.store.layout import Layout
from colonnade.store.results import RUN_STAGES, models_of
from colonnade.workflow.assessing import planned
from colonnade.workflow.chain import WORKER_LOST, RunResult, StageRun
from colonnade.workflow.executors import Counted, Where, spread
from colonnade.workflow.graph import Graph, copies, restitution_taken
from colonnade.workflow.product import Catalogue, Product

if TYPE_CHECKING:
    import xarray as xr

MANY = 16
"""Tests from which starting other processes is sooner done than reading them one after the other."""


_Unchecked = tuple[Campaign, Test, Sequence[Product]]
"""The campaign with one test alone, this test, and its results up to the measured angle."""


def check(campaign: Campaign, progress: Counted = lambda done, total: None) -> RunResult:
    """
    Read every raw file of a campaign, and run each test as far as the start of its prediction.

    Parameters
    ----------
    campaign : Campaign
    progress : callable, optional
        Called with the number of tests that are done, and of all.

    Returns
    -------
    checked : RunResult
        As of a run up to there: each problem is a stage that failed. Nothing is written.
    """
    layout, total = Layout.of(campaign.path, None), len(campaign.tests)
    graph = Graph(campaign, layout, Catalogue(layout))
    same = copies(campaign, {name: graph.raw(test) for name, test in campaign.tests.items()})
    campaign = campaign.warned(same)
    found, waiting = dict[str, StageRun](), []
    for name, test in campaign.tests.items():
        if reason := campaign.left_out(name):
            kind = "excluded" if campaign.review(name).excluded else "planned"
            found[name] = _found(name, [note(kind, f"{reason}. This test is not run.")])
        else:
            products = [each for each in graph.of_test(test) if each.result.order <= RUN_STAGES.index("rocking")]
            waiting.append((campaign.but(tests={name: test}), test, products))
    progress(len(found), total)
    here = Where(workers=None if len(waiting) >= MANY else 1)
    for _, checked in spread(_checked, waiting, here, lost=_lost):
        found[checked.subject] = checked
        progress(len(found), total)
    runs = [found[name] for name in campaign.tests]
    runs += [_records_checked(campaign, layout, *asked) for asked in campaign.assessments.items()]
    concerning = {name: campaign.concerning(name) for name in campaign.tests}
    return RunResult(tuple(runs), layout.summary_json, None, campaign.warnings, concerning)


def _found(subject: str, findings: Iterable[Finding], problem: str = "", stage: str = "ingest") -> StageRun:
    """Give all that was found, and say why something would fail."""
    return StageRun(subject, stage, "failed" if problem else "done", reason=problem, findings=tuple(findings))


def _lost(unchecked: _Unchecked) -> StageRun:
    return _found(unchecked[1].id, [], WORKER_LOST)


def _checked(unchecked: _Unchecked) -> StageRun:
    campaign, test, products = unchecked
    made, findings = dict[Path, "xr.Dataset"](), list[Finding]()
    try:
        for product in products:
            read = {name: made[path] for name, path in product.upstream.items() if isinstance(path, Path)}
            result = made[product.paths[0]] = product.make(read)
            findings += at_stage(result.attrs["warnings"], product.result.stage)
        findings.extend(_begun(campaign, test, result))
    except (ReadError, StageError) as error:
        return _found(test.id, findings, str(error))
    return _found(test.id, findings)


def _begun(campaign: Campaign, test: Test, measured: xr.Dataset) -> Iterator[Finding]:
    """Find what the stages after the measured angle would say or refuse before they compute anything."""
    from colonnade.stages import compare, predict
    from colonnade.stages.parts.beginning import begin

    if test.kind == "sine":
        forcing = compare.forcing_of(measured)
        yield from at_stage(compare.contradictions(forcing, test.frequency, test.amplitude), "compare")
    for model in models_of(campaign, test)[:1]:  # the base motion and the start are the same for all
        yield from at_stage(begin(measured, predict.PredictInputs.of(campaign, test, model)).warnings, "predict")


def _records_checked(campaign: Campaign, layout: Layout, name: str, asked: Assessment) -> StageRun:
    """Read the ground motions and the hazard of an assessment, and plan it; no history is run."""
    from colonnade.stages.assessment_plan import AssessmentInputs

    try:
        pooled = restitution_taken(campaign, layout, asked.specimen)
        records, _ = planned(asked, AssessmentInputs.of(campaign, asked), pooled)
    except (ReadError, StageError) as error:
        return _found(name, [], str(error), "assessment")
    said = (f"{each} is left out: {reason.splitlines()[0]}" for each, reason in records.left_out.items())
    findings = [warning("ground motion", each) for each in said]
    findings += [note("ground motion", each) for each in records.notes]
    return _found(name, at_stage(findings, "assessment"), stage="assessment")
