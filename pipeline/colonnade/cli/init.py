"""`colonnade init`: a campaign.toml to start from, guessed from the raw files."""

from __future__ import annotations

import shlex
from pathlib import Path
from typing import TYPE_CHECKING

import rich_click as click

from colonnade.cli.console import say, show_json, show_table
from colonnade.cli.options import json_option
from colonnade.cli.progress import looking

if TYPE_CHECKING:
    from colonnade.campaign.draft import CampaignDraft

MOST_SHOWN = 12
"""Questions that are listed; all of them stand in the file."""


@click.command(epilog="Example: colonnade init measurements")
@click.argument("folder", type=click.Path(path_type=Path), default=Path(), metavar="[DIR]")
@json_option
def init(folder: Path, as_json: bool) -> int:
    """
    Write a campaign.toml to start from, guessed from the raw files where it can be.

    DIR is the folder with the raw files, or one that holds folders of them; by default the one you stand in. Columns,
    units, recorders and kinds of test are guessed, each guess with its reason behind it. What no file can tell is left
    as "?" for you to fill in. A campaign.toml that is there is never written over.
    """
    from colonnade.campaign.draft import draft
    from colonnade.store.files import write_text

    with looking("Reading raw files") as advance:
        drafted = draft(folder, progress=advance)
    write_text(drafted.path, drafted.text)
    if as_json:
        show_json(
            {
                "campaign": str(drafted.path),
                "tests": drafted.tests,
                "setups": drafted.setups,
                "open": [vars(question) for question in drafted.open],
                "doubts": [vars(question) for question in drafted.doubts],
                "refused": dict(drafted.refused),
            }
        )
    else:
        _tell(drafted)
    return 0


def _tell(drafted: CampaignDraft) -> None:
    say(f"campaign: {drafted.path}")
    say(f"{_count(drafted.tests, 'test')}, {_count(drafted.setups, 'set-up')}")
    for name, reason in drafted.refused:
        say(f"  not in it: {name}: {reason}")
    if drafted.asks_first:
        say(
            f"The first question: which of these {drafted.setups} kinds of files are recordings of tests? "
            "Delete the groups that are not."
        )
    show_table(
        ("line", "to fill in", "", "what is asked"),
        [(str(each.line), each.key, each.value, each.asked) for each in drafted.open[:MOST_SHOWN]],
    )
    if len(drafted.open) > MOST_SHOWN:
        say(f"… and {len(drafted.open) - MOST_SHOWN} more")
    if drafted.open:
        say(f'To fill in: {_count(len(drafted.open), "value")} marked "?".')
    say(f'To look at: {_count(len(drafted.doubts), "guess", "guesses")} marked "# ?".')
    say(f"Then: colonnade check {shlex.quote(str(drafted.path.parent))}")


def _count(number: int, one: str, several: str = "") -> str:
    return f"{number} {one}" if number == 1 else f"{number} {several or one + 's'}"
