"""`colonnade next`: which test tells most."""

from __future__ import annotations

from pathlib import Path

import rich_click as click

from colonnade.cli.common.console import say, show_json, show_table
from colonnade.cli.common.options import CAMPAIGN, campaign_argument, json_option, results_option, specimen_option


@click.command(
    "next",
    epilog="Example: colonnade next demo --specimen prism",
    help=f"""
    Say which test tells most: of each specimen the next sine test, free vibration and Span.

    {CAMPAIGN} It uses the results of the last run. Each advice has its reason, its risk of overturning and what the
    table must do; "enough" means that no test of this kind is needed. The settings are in [next], the limits of the
    table in [table]. Nothing is written.
    """,
)
@campaign_argument
@specimen_option
@results_option
@json_option
def next_command(campaign: Path, specimen: tuple[str, ...], results: Path | None, as_json: bool) -> int:
    """Show the advice; return the exit code."""
    from colonnade.store.records.advice import HEADS
    from colonnade.workflow.advising.next import advise

    found = advise(campaign, specimens=specimen, results=results)
    if as_json:
        show_json({"advice": [vars(each) for each in found.advice], "awaited": found.awaited})
        return 0
    show_table(HEADS, [each.row() for each in found.advice])
    for test, file in found.awaited.items():
        say(f"{test}: expected: {file}")
    if not found.advice:
        say("Nothing to advise: no free vibration, sine test or earthquake has been run.")
    return 0
