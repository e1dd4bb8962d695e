"""The group of all commands."""

from __future__ import annotations

import rich_click as click

import colonnade
from colonnade.cli.common.options import Commands
from colonnade.cli.demo import demo, init
from colonnade.cli.figure import figure
from colonnade.cli.questions import calibrate, foresee, fragility, map_command, next_command, spectrum
from colonnade.cli.run import check, identify, ingest, predict, report, run, watch
from colonnade.cli.show import schema, show

COMMANDS = (
    *(demo, init, check, run, ingest, identify, predict, report, watch, next_command),
    *(foresee, spectrum, fragility, map_command, calibrate, figure, show, schema),
)


@click.group(
    cls=Commands,
    epilog="Exit codes: 0 all good; 1 a test failed, the others are done; 2 wrong usage or campaign file; 130 "
    "interrupted.",
    context_settings={"help_option_names": ["-h", "--help"]},
)
@click.version_option(colonnade.__version__, prog_name="colonnade")
def app() -> None:
    """
    From the recordings of a shake-table test on a free-standing column to predicted over measured.

    Start with `colonnade demo`: it writes a virtual campaign and runs all of it. With recordings of your own,
    `colonnade init` drafts their campaign.toml. Most commands take a CAMPAIGN: a campaign.toml or its folder, by
    default the current folder. Results and paths go to stdout, progress to stderr.
    """


for command in COMMANDS:
    app.add_command(command)
