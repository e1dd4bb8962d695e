"""What `run` and the commands that stop on its way have in common: run the workflow, say what it did and why."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from itertools import groupby
from pathlib import Path
from typing import TYPE_CHECKING, Any

from colonnade.cli.console import say, show_json, show_table
from colonnade.cli.findings import all_records, probable_cause, show_by_kind
from colonnade.cli.progress import following

if TYPE_CHECKING:
    from colonnade.workflow import RunResult, StageRun

STAGES = ("ingest", "condition", "rocking", "restitution", "predict", "ensemble", "compare", "report")


def work(campaign: Path, *, as_json: bool = False, strict: bool = False, **choices: Any) -> int:
    """
    Run a campaign, with the choices of `colonnade.workflow.run`, and show what was done; return the exit code.

    With `strict` it is 1 also where a finding is more than a note.
    """
    result = run_with_progress(campaign, **choices)
    if as_json:
        show_json(_record(result))
    else:
        show_result(result)
    return int(result.failed or (strict and result.has_warnings))


def run_with_progress(campaign: Path, **choices: Any) -> RunResult:
    """Run a campaign with a bar on stderr."""
    from colonnade.workflow import run

    with following() as progress:
        return run(campaign, progress=progress, **choices)


def show_result(result: RunResult) -> None:
    """List what was redone and why, what was found, what failed, and where the results are."""
    redone = [stage for stage in result.stages if stage.action == "done"]
    show_table(("redone", "stages", "why", "seconds"), list(_grouped(redone)))
    show_by_kind(result.findings)
    failed = failed_rows(result)
    show_table(("failed", "stage", "reason"), failed)
    for notice in result.notices:
        say(notice)
    kept = sum(stage.action == "up-to-date" for stage in result.stages)
    say(f"{len(redone)} redone, {kept} up to date, {len(failed)} failed")
    say(f"summary: {result.summary}")
    if result.report is not None:
        if result.findings:
            say(f"all findings: {result.report.parent / 'problems.html'}")
        say(f"report: {result.report}")


def failed_rows(result: RunResult) -> list[tuple[str, str, str]]:
    """Test or specimen, stage and reason of all that failed, now or in an earlier run; its probable cause first."""
    findings = result.findings
    return [
        (stage.subject, stage.stage, f"{probable_cause(findings.get(stage.told_of, []), where='above')}{stage.reason}")
        for stage in result.stages
        if stage.action == "failed"
    ]


def _grouped(stages: Iterable[StageRun]) -> Iterator[tuple[str, str, str, str]]:
    """One row for the stages of a test that were redone for the same reason."""
    ordered = sorted(stages, key=lambda stage: stage.subject)
    for (subject, because), group in groupby(ordered, key=lambda stage: (stage.subject, stage.because)):
        members = list(group)
        seconds = sum(member.seconds for member in members)
        yield subject, ", ".join(member.stage for member in members), because, f"{seconds:.1f}"


def _record(result: RunResult) -> dict[str, Any]:
    return {
        "failed": result.failed,
        "summary": str(result.summary),
        "report": None if result.report is None else str(result.report),
        "warnings": all_records(result.findings),
        "notices": list(result.notices),
        "stages": [
            {name: value for name, value in vars(stage).items() if name != "findings"} for stage in result.stages
        ],
    }
