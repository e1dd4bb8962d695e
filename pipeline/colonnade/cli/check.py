"""`colonnade check`: checks the campaign and its raw files as `run` would, and writes nothing."""

from __future__ import annotations

from collections import Counter
from pathlib import Path
from typing import TYPE_CHECKING

import rich_click as click

from colonnade.cli.common.console import say_marked, show_json, work_progress
from colonnade.cli.common.findings import STYLES, alike, probable_cause, records_of, show_by_kind
from colonnade.cli.common.options import campaign_argument, file_option, json_option, strict_option
from colonnade.errors import count
from colonnade.findings import Severity, in_order

if TYPE_CHECKING:
    from colonnade.workflow.check import CampaignCheck


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
        from colonnade.figures.files.saving import expect_place, save

        expect_place(drawing)
        save(of_campaign(loaded), drawing)
    with work_progress("Reading raw files") as progress:
        checked = check_campaign(loaded, progress)
    if as_json:
        show_json(_record(checked) | ({} if drawing is None else {"drawing": drawing}))
    else:
        _show(checked, drawing)
    return int(checked.fails or (strict and checked.has_warnings))


def _record(checked: CampaignCheck) -> dict[str, object]:
    found: dict[str, object] = {
        "campaign": checked.campaign.path,
        "warnings": records_of(in_order(checked.campaign.warnings)),
    }
    for kind, subjects in (("tests", checked.tests), ("assessments", checked.assessments)):
        found[kind] = {
            name: {"problems": each.problems, "warnings": records_of(in_order(each.findings, each.concerning))}
            for name, each in subjects.items()
        }
    return found


def _show(checked: CampaignCheck, drawing: Path | None) -> None:
    findings = checked.findings
    say_marked(*_verdict(checked), f" Nothing was written{'.' if drawing is None else f' but {drawing}.'}")
    failing = [*checked.tests.items(), *((f"assessment {name}", each) for name, each in checked.assessments.items())]
    problems = [
        (name, probable_cause(findings[name], where="below") + problem.replace("\n", "\n  "))
        for name, each in failing
        for problem in each.problems
    ]
    for name, said in alike(problems):
        say_marked("would fail", STYLES[Severity.SERIOUS], f": {name}: {said}")
    show_by_kind(findings)


def _verdict(checked: CampaignCheck) -> tuple[str, str]:
    """Say in a line how many tests are good, and give its colour."""
    tests = count(len(checked.tests), "test")
    statuses = Counter(each.status for each in checked.tests.values())
    words = {"would fail": "would fail", "doubtful": "would give wrong results", "good": "good"}
    parts = [f"{statuses[each]} {said}" for each, said in words.items() if statuses[each]]
    if unanswered := sum(bool(each.problems) for each in checked.assessments.values()):
        parts.append(f"{count(unanswered, 'assessment')} would fail")
    if checked.fails or statuses["doubtful"]:
        return f"{tests}: {', '.join(parts)}.", STYLES[Severity.SERIOUS]
    if checked.has_warnings:
        return f"No test would fail, but see the findings: {', '.join(parts)}.", STYLES[Severity.WARNING]
    return f"All good: {tests}.", "bold green"
