"""`colonnade next`: which test tells most."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

import rich_click as click

from colonnade.cli.common.console import say, show_json, show_paragraph
from colonnade.cli.common.options import CAMPAIGN, campaign_argument, json_option, results_option, specimen_option
from colonnade.cli.common.progress import work_progress

if TYPE_CHECKING:
    from colonnade.store.records.advice import Advice


@click.command(
    "next",
    epilog="Example: colonnade next demo --specimen prism",
    help=f"""
    Say which test tells most: the next one, and the others of all specimens by what they tell.

    {CAMPAIGN} It uses the results of the last run. Each advice has its reason, its risk of overturning and what the
    table must do; "enough" means that no test of this kind is needed. A Span is advised at most a fifth above the
    largest that was tested. The settings are in [next], the limits of the table in [table]. Nothing is written.
    """,
)
@campaign_argument
@specimen_option
@results_option
@json_option
def next_command(campaign: Path, specimen: tuple[str, ...], results: Path | None, as_json: bool) -> int:
    """Show the advice; return the exit code."""
    with work_progress("Looking for the test that tells most") as progress:
        from colonnade.workflow.advising.next import advise

        found = advise(campaign, specimens=specimen, results=results, progress=progress)
    if as_json:
        show_json({"advice": [vars(each) for each in found.advice], "awaited": found.awaited})
        return 0
    _show(found.advice)
    for test, file in found.awaited.items():
        show_paragraph(f"{test}: expected: {file}")
    return 0


def _show(advice: Sequence[Advice]) -> None:
    """Write the test to do next with its reason, then the others."""
    if not advice:
        say("Nothing to advise: no free vibration, sine test or earthquake has been run.")
        return
    needed = [each for each in advice if not each.is_enough and not each.beyond]
    others = [each for each in advice if each not in needed[:1]]
    if needed:
        show_paragraph(f"Do this next: {needed[0].what()}")
        show_paragraph(f"Because {needed[0].reason}.")
    else:
        say("No test that the table can do is needed.")
    if others:
        say("\nThen, by what they tell:" if needed else "")
    for each in others:
        reasons = [each.reason] if each.is_enough else each.beyond
        show_paragraph("; ".join((each.what(), *reasons)), bullet="- ")
