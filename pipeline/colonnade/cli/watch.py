"""`colonnade watch`: a line on each test seconds after its file is finished."""

from __future__ import annotations

import json
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any

import rich_click as click

from colonnade.cli.common.console import complain, say
from colonnade.cli.common.options import campaign_argument, result_options, workers_option
from colonnade.interruption import answered, noted

if TYPE_CHECKING:
    from colonnade.store.records.advice import Advice
    from colonnade.workflow.watching.measure import Line


@click.command(epilog='Example: colonnade watch --from /media/recorder --notify "notify-send colonnade"')
@campaign_argument
@click.option(
    "--from",
    "share",
    type=click.Path(exists=True, file_okay=False, path_type=Path),
    metavar="DIR",
    help="Copy finished files from this folder, such as a recorder's share. No file is ever overwritten.",
)
@click.option(
    "--notify",
    metavar="COMMAND",
    help="After each test run this command, without a shell, with the line as JSON on its stdin.",
)
@click.option("--once", is_flag=True, help="Handle what is there, then end with the exit code of `run`.")
@workers_option
@result_options
def watch(campaign: Path, notify: str | None, once: bool, as_json: bool, **options: Any) -> int:
    """
    Watch the raw folder: a line on each test as soon as its file is finished.

    {CAMPAIGN} The line says what happened, what the models predict, and what is wrong. Ensembles, the contact
    model, earlier tests and the report follow at lower priority. An open page of the report keeps itself up to date.

    Tests come from [[tests]], the test log, or the `pattern` in [watch]. Ctrl-C ends the watch with
    exit code 0; nothing is lost.
    """
    from colonnade.workflow.watching.measure import command_of
    from colonnade.workflow.watching.watch import watch as watch_campaign

    try:
        command = command_of(notify) if notify is not None else ()
        show = partial(_show, as_json=as_json)
        return watch_campaign(campaign, command=command, once=once, show=show, say=complain, **options)
    except (KeyboardInterrupt, Exception) as error:  # the import of a compiled module makes an ImportError of it
        if once or not (noted() or isinstance(error, KeyboardInterrupt)):
            raise
        answered()
    complain("The watch has ended. All results are kept.")
    return 0


def _show(line: Line | Advice, *, as_json: bool) -> None:
    say(json.dumps(line.as_json(), ensure_ascii=False, allow_nan=False) if as_json else line.text())
