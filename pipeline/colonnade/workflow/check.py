"""Check: what a run would refuse or warn of, found by running its first stages in memory; nothing is written."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from functools import cache
from itertools import groupby
from pathlib import Path

from colonnade.campaign import Campaign, Test
from colonnade.campaign.assessment import Assessment
from colonnade.dynamics.models import CONTACT
from colonnade.errors import ReadError, StageError, count
from colonnade.findings import Finding, at_stage, note, warning
from colonnade.readers.recording import Recording
from colonnade.store.layout import Layout
from colonnade.store.results import models_of
from colonnade.workflow.chain import WORKER_LOST, RunResult, StageRun
from colonnade.workflow.executors import Counted, spread
from colonnade.workflow.graph import Graph
from colonnade.workflow.pages import unshown_photos
from colonnade.workflow.pooling import contradictions
from colonnade.workflow.product import Catalogue
from colonnade.workflow.raw_files import copies

MANY = 16
"""Files from which starting other processes is sooner done than reading them one after the other."""


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
    layout = Layout.of(campaign.path, None)
    graph = Graph(campaign, layout, Catalogue(layout))
    same = copies(campaign, {name: graph.raw(test) for name, test in campaign.tests.items()})
    campaign = campaign.warned([*same, *unshown_photos(campaign), *_overnight(campaign)])
    found: dict[str, list[StageRun]] = {}
    for name in campaign.tests:
        if excluded := campaign.review(name).excluded:
            found[name] = _found(name, [], [note("excluded", f"{excluded} (review.toml).")])
        elif awaited := campaign.left_out(name):
            found[name] = _found(name, [], [note("planned", f"{awaited}. This planned test has not been run yet.")])
    waiting = [test for name, test in campaign.tests.items() if name not in found]
    # Tests that share a file follow each other in most campaigns: it is read once.
    together = [list(tests) for _, tests in groupby(waiting, lambda test: test.files)]
    parts = [campaign.but(tests={test.id: test for test in tests}) for tests in together]
    progress(len(found), len(campaign.tests))
    for _, read in spread(_read_and_checked, parts, workers=None if len(parts) >= MANY else 1, lost=_lost):
        found |= read
        progress(len(found), len(campaign.tests))
    stages = [stage for name in campaign.tests for stage in found[name]]
    campaign = campaign.warned(contradictions(campaign, {name: found[name][-1].findings for name in campaign.tests}))
    concerning = {name: campaign.concerning(name) for name in campaign.tests}
    stages += [stage for each in campaign.assessments.items() for stage in _records_checked(campaign, *each)]
    return RunResult(tuple(stages), layout.summary_json, None, campaign.warnings, concerning)


def _found(subject: str, problems: Sequence[str], findings: Iterable[Finding], stage: str = "ingest") -> list[StageRun]:
    """Say why something would fail, and give all that was found last."""
    failed = [StageRun(subject, stage, "failed", reason=problem) for problem in problems]
    return [*failed, StageRun(subject, stage, "done", findings=tuple(findings))]


def _overnight(campaign: Campaign) -> list[Finding]:
    """Say how often several bodies are moved, which takes hours."""
    tests = [test for test in campaign.tests.values() if campaign.specimens[test.specimen].is_assembly]
    runs = sum(campaign.members(test, CONTACT.name) for test in tests)
    if not runs:
        return []
    first = "For a first look without them, write `members = 0` under [processing.predict.ensemble.contact]."
    return [_on_contact(f"the bodies of {count(len(tests), 'test')}", runs, first)]


def _on_contact(what: str, runs: int, remedy: str = "Fewer `levels` and `draws` take less.") -> Finding:
    """Say how often bodies are moved by the contact model, and that it takes hours."""
    said = (
        f"The contact model moves {what} {count(runs, 'time')}, over what is not known. Four drums over 20 s take "
        f"about two minutes of one core each time; the runs are spread over all cores. {remedy}"
    )
    return note("runs on contact", said)


def _read_and_checked(part: Campaign) -> dict[str, list[StageRun]]:
    """Check tests that share their files."""
    from colonnade.readers.registry import read

    @cache
    def reading(path: Path, setup: str, recorder: str) -> Recording:
        file = part.setups[setup].recorders[recorder].file
        return read(path, file.format, file.options, within=part.folder)

    return {name: _checked(part, test, reading) for name, test in part.tests.items()}


def _lost(part: Campaign) -> dict[str, list[StageRun]]:
    return {name: _found(name, [WORKER_LOST], []) for name in part.tests}


def _checked(campaign: Campaign, test: Test, reading: Callable[[Path, str, str], Recording]) -> list[StageRun]:
    problems, findings, recordings = list[str](), list[Finding](), dict[str, Recording]()
    for recorder, path in test.files.items():
        try:
            recordings[recorder] = reading(path, test.setup, recorder)
        except ReadError as error:
            problems.append(str(error))
    problems += _missing_columns(campaign, test, recordings)
    if not problems:
        try:
            _measure(campaign, test, recordings, findings)
        except (ReadError, StageError) as error:
            problems.append(str(error))
    return _found(test.id, problems, findings)


def _records_checked(campaign: Campaign, name: str, asked: Assessment) -> list[StageRun]:
    """Read the ground motions and the hazard of an assessment; no history is run."""
    from colonnade.assessment.outcomes import FEWEST
    from colonnade.readers.hazard import read_hazard
    from colonnade.readers.record_set import read_record_set

    problems, findings = list[str](), list[Finding]()
    try:
        records = read_record_set(asked.records)
    except ReadError as error:
        problems.append(str(error))
    else:
        if len(records.records) < FEWEST:
            problems.append(
                f"{count(len(records.records), 'ground motion')} can be used; at least {FEWEST} were expected."
            )
        for left_out, reason in records.left_out.items():
            findings.append(warning("ground motion", f"{left_out} is left out: {reason.splitlines()[0]}"))
        findings += [note("ground motion", each) for each in records.notes]
        if not campaign.specimens[asked.specimen].is_in_plane:
            motions = sum(2 - (each.motion.transverse is None) for each in records.records)
            runs = motions * len(asked.levels or ()) * (1 + asked.draws)
            findings.append(_on_contact(asked.specimen, runs))
    if asked.hazard is not None:
        try:
            read_hazard(asked.hazard, asked.measure)
        except ReadError as error:
            problems.append(str(error))
    return _found(name, problems, at_stage(findings, "assessment"), "assessment")


def _missing_columns(campaign: Campaign, test: Test, recordings: dict[str, Recording]) -> list[str]:
    """Find every column of a test that its files do not have; `ingest` stops at the first."""
    problems = []
    for name, channel in campaign.channels(test).items():
        for column in (channel.column, channel.time):
            if channel.recorder in recordings and column is not None:
                try:
                    recordings[channel.recorder].channel(column)
                except ReadError as error:
                    problems.append(f"channel {name}: {error}")
    return problems


def _measure(campaign: Campaign, test: Test, recordings: dict[str, Recording], findings: list[Finding]) -> None:
    """
    Run the stages up to the start of a prediction; the warnings of each stage are added to the findings.

    Raises
    ------
    ReadError, StageError
        As the stages do.
    """
    from colonnade.stages import compare, condition, ingest, predict, rocking
    from colonnade.stages.parts.beginning import begin

    recorded = ingest.ingest(recordings, ingest.IngestInputs.of(campaign, test))
    findings += at_stage(recorded.attrs["warnings"], "ingest")
    conditioned = condition.condition(recorded, condition.ConditionInputs.of(campaign, test))
    findings += at_stage(conditioned.attrs["warnings"], "condition")
    measured = rocking.rocking(conditioned, rocking.RockingInputs.of(campaign, test))
    findings += at_stage(measured.attrs["warnings"], "rocking")
    if test.kind == "sine":
        forcing = compare.forcing_of(measured)
        findings += at_stage(compare.contradictions(forcing, test.frequency, test.amplitude), "compare")
    for model in models_of(campaign, test)[:1]:  # the base motion and the start are the same for all
        beginning = begin(measured, predict.PredictInputs.of(campaign, test, model))
        findings += at_stage(beginning.warnings, "predict")
