"""`colonnade check`: the campaign and its raw files, looked at as `run` would, and nothing written."""

from __future__ import annotations

from collections import Counter
from pathlib import Path
from typing import TYPE_CHECKING

import rich_click as click

from colonnade.cli.console import say, show_json
from colonnade.cli.findings import probable_cause, records_of, show_by_kind
from colonnade.cli.options import campaign_argument, json_option, strict_option
from colonnade.cli.progress import counting

if TYPE_CHECKING:
    from colonnade.campaign import Campaign
    from colonnade.workflow.check import Checked


@click.command(epilog="Example: colonnade check demo")
@campaign_argument
@strict_option
@json_option
def check(campaign: Path, strict: bool, as_json: bool) -> int:
    """
    Validate a campaign and its raw files; write nothing.

    CAMPAIGN is a campaign.toml or its folder, by default the one you stand in. Every raw file is read as `run` would
    read it, and each test is taken as far as its prediction would begin: missing files and columns, units, gains,
    signs, swapped columns, clocks and dead channels are reported for all tests at once. The exit code is 1 if a test
    would fail.
    """
    from colonnade.campaign import load
    from colonnade.findings import Severity
    from colonnade.workflow.check import check as check_campaign
    from colonnade.workflow.copies import digests_of_equal_sizes, with_copies

    loaded = load(campaign)
    loaded = with_copies(loaded, digests_of_equal_sizes(loaded))
    with counting("Reading raw files", len(loaded.tests)) as advance:
        checked = check_campaign(loaded, advance)
    if as_json:
        tests = {
            name: {"problems": each.problems, "warnings": records_of(each.findings, each.concerning)}
            for name, each in checked.items()
        }
        show_json({"campaign": str(loaded.path), "warnings": records_of(loaded.warnings), "tests": tests})
    else:
        _tell(loaded, checked)
    findings = [*loaded.warnings, *(found for each in checked.values() for found in each.findings)]
    is_refused = strict and any(found.severity is not Severity.NOTE for found in findings)
    return int(is_refused or any(each.problems for each in checked.values()))


def _tell(campaign: Campaign, checked: dict[str, Checked]) -> None:
    from colonnade.findings import in_order

    say(f"{campaign.path}: {_count(len(campaign.tests), 'test')}, {_count(len(campaign.specimens), 'specimen')}")
    told = {"campaign file": in_order(campaign.warnings)}
    told |= {name: in_order(each.findings, each.concerning) for name, each in checked.items()}
    for name, each in checked.items():
        say(f"{name}: {each.status}")
        for problem in each.problems:
            say(f"  problem: {probable_cause(told[name], where='below')}{_indented(problem)}")
    show_by_kind(told)
    statuses = Counter(each.status for each in checked.values())
    if statuses["would fail"] or statuses["doubtful"]:
        words = {"would fail": "would fail", "doubtful": "would give wrong results"}
        say(" ".join(f"{_count(statuses[each], 'test')} {what}." for each, what in words.items() if statuses[each]))
    elif any(found.severity != "note" for findings in told.values() for found, _ in findings):
        say("No test would fail; look at what was found. Nothing was written.")
    else:
        say("All good; nothing was written.")


def _count(number: int, what: str) -> str:
    return f"{number} {what}" if number == 1 else f"{number} {what}s"


def _indented(text: str) -> str:
    return text.replace("\n", "\n    ")
