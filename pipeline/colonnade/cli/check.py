"""`colonnade check`: checks the campaign and its raw files as `run` would, and writes nothing."""

from __future__ import annotations

from collections import Counter
from pathlib import Path
from typing import TYPE_CHECKING, Any

import rich_click as click

from colonnade.cli.common.console import saved, say_marked, show_json, work_progress
from colonnade.cli.common.findings import STYLES, failures, records_of, show_by_kind
from colonnade.cli.common.options import campaign_argument, file_option, json_option, strict_option
from colonnade.errors import count
from colonnade.findings import Severity

if TYPE_CHECKING:
    from colonnade.campaign import Campaign
    from colonnade.workflow import RunResult, StageRun

WRONG = "would give wrong results"


@click.command(epilog="Example: colonnade check demo")
@campaign_argument
@file_option("--drawing", "Draw specimens and transducers to this file: .svg, .pdf or .png.")
@strict_option
@json_option
def check(campaign: Path, drawing: Path | None, strict: bool, as_json: bool) -> int:
    """
    Check a campaign and its raw files; write nothing.

    {CAMPAIGN} Every raw file is read as `run` would read it, and each test is taken to the point where its prediction
    would begin. The ground motions and the hazard of assessments are read, too. Missing files and columns, units,
    gains, signs, swapped columns, clocks and dead channels are reported for all tests at once. The exit code is 1 if a
    test or an assessment would fail.

    With --drawing, specimens and transducers are drawn to scale as the campaign file places them: that is the one file
    that is written.
    """
    from colonnade.campaign import load
    from colonnade.workflow.check import check as check_campaign

    loaded = load(campaign)
    if drawing is not None:
        from colonnade.figures.drawing.described import of_campaign

        saved(lambda: of_campaign(loaded), drawing)
    with work_progress("Reading raw files") as progress:
        checked = check_campaign(loaded, progress)
    if as_json:
        show_json(_record(loaded, checked) | ({} if drawing is None else {"drawing": drawing}))
    else:
        _show(checked, drawing)
    return int(checked.failed or (strict and checked.has_warnings))


def _record(campaign: Campaign, checked: RunResult) -> dict[str, Any]:
    findings = checked.findings
    found: dict[str, Any] = {"campaign": campaign.path, "warnings": records_of(findings.get("campaign file", ()))}
    found |= {"tests": {}, "assessments": {}}
    for stage in checked.stages:
        nothing = {"problems": [], "warnings": records_of(findings.get(stage.heading, ()))}
        own = found[f"{stage.of}s"].setdefault(stage.subject, nothing)
        own["problems"] += [stage.reason] if stage.action == "failed" else []
    return found


def _show(checked: RunResult, drawing: Path | None) -> None:
    say_marked(*_verdict(checked), f" Nothing was written{'.' if drawing is None else f' but {drawing}.'}")
    for name, _, reason in failures(checked, where="below"):
        say_marked("would fail", STYLES[Severity.SERIOUS], f": {name}: {reason}".replace("\n", "\n  "))
    show_by_kind(checked.findings)


def _verdict(checked: RunResult) -> tuple[str, str]:
    """Say in a line how many tests are good, and give its colour."""
    failing = dict.fromkeys((stage.of, stage.subject) for stage in checked.stages if stage.action == "failed")
    whole = [stage for stage in checked.stages if stage.action == "done" and stage.of == "test"]
    statuses = Counter("would fail" if (each.of, each.subject) in failing else _good(checked, each) for each in whole)
    tests = count(len(whole), "test")
    parts = [f"{statuses[each]} {each}" for each in ("would fail", WRONG, "good") if statuses[each]]
    if unanswered := sum(of == "assessment" for of, _ in failing):
        parts.append(f"{count(unanswered, 'assessment')} would fail")
    if failing or statuses[WRONG]:
        return f"{tests}: {', '.join(parts)}.", STYLES[Severity.SERIOUS]
    if checked.has_warnings:
        return f"No test would fail, but see the findings: {', '.join(parts)}.", STYLES[Severity.WARNING]
    return f"All good: {tests}.", "bold green"


def _good(checked: RunResult, stage: StageRun) -> str:
    """Say whether the results of a test would be wrong, by what was found of it and of its specimen and set-up."""
    found = (*stage.findings, *checked.concerning[stage.subject])
    return WRONG if any(each.severity is Severity.SERIOUS for each in found) else "good"
