"""`colonnade init`: a draft of campaign.toml, guessed from the raw files."""

from __future__ import annotations

import shlex
from pathlib import Path
from typing import TYPE_CHECKING

import rich_click as click

from colonnade.cli.common.console import say, show_json, show_table
from colonnade.cli.common.options import json_option
from colonnade.cli.common.progress import work_progress
from colonnade.errors import count

if TYPE_CHECKING:
    from colonnade.campaign.draft.write import CampaignDraft

DRAWING = "drawing.svg"
"""Name of the drawing next to the draft."""

MOST_SHOWN = 12
"""Questions that are listed; the file has all of them."""


@click.command(epilog="Example: colonnade init measurements")
@click.argument("folder", type=click.Path(path_type=Path), default=Path(), metavar="[DIR]")
@json_option
def init(folder: Path, as_json: bool) -> int:
    """
    Draft a campaign.toml from the raw files.

    DIR is the folder with the raw files, or one that holds folders of them; by default the current folder. Columns,
    units, recorders and kinds of test are guessed, each guess with its reason after it. What no file shows is left
    as "?" for you to fill in. An existing campaign.toml is never overwritten. A drawing next to it shows the
    transducers with the directions that were guessed.
    """
    from colonnade.campaign.draft.write import draft
    from colonnade.figures.drawing.described import of_draft
    from colonnade.figures.files.saving import expect_place, save
    from colonnade.store.files import write_text

    with work_progress("Reading raw files") as advance:
        drafted = draft(folder, progress=advance)
    drawing = None if drafted.asks_first else drafted.path.with_name(DRAWING)
    if drawing:
        expect_place(drawing)
    write_text(drafted.path, drafted.text)
    if drawing:
        save(of_draft(drafted.text), drawing)
    if as_json:
        show_json(
            {
                "campaign": drafted.path,
                "drawing": drawing,
                "tests": drafted.tests,
                "setups": drafted.setups,
                "open": drafted.open,
                "doubts": drafted.doubts,
                "refused": dict(drafted.refused),
            }
        )
    else:
        _tell(drafted, drawing)
    return 0


def _tell(drafted: CampaignDraft, drawing: Path | None) -> None:
    say(f"campaign: {drafted.path}")
    if drawing:
        say(f"drawing: {drawing}")
    say(f"{count(drafted.tests, 'test')}, {count(drafted.setups, 'set-up')}")
    for name, reason in drafted.refused:
        say(f"  not used: {name}: {reason}")
    if drafted.asks_first:
        say(
            f"First question: which of these {drafted.setups} kinds of files are recordings of tests? Remove the # "
            "from their groups."
        )
    show_table(
        ("line", "to fill in", "", "what is asked"),
        [(str(each.line), each.key, each.value, each.asked) for each in drafted.open[:MOST_SHOWN]],
    )
    if len(drafted.open) > MOST_SHOWN:
        say(f"… and {len(drafted.open) - MOST_SHOWN} more")
    if drafted.open:
        say(f'To fill in: {count(len(drafted.open), "value")} marked "?".')
    say(f'To look at: {count(len(drafted.doubts), "guess", "guesses")} marked "# ?".')
    say(f"Then: colonnade check {shlex.quote(str(drafted.path.parent))}")
