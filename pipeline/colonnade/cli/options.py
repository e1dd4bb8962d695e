"""Arguments and options that several commands share."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any, TypeVar

import rich_click as click

Command = TypeVar("Command", bound=Callable[..., Any])

campaign_argument = click.argument("campaign", type=click.Path(path_type=Path), default=Path(), metavar="[CAMPAIGN]")
"""The argument of most commands."""

CAMPAIGN = "CAMPAIGN is a campaign.toml or its folder, by default the current folder."
"""What their help says of it."""

json_option = click.option("--json", "as_json", is_flag=True, help="Write the result as JSON.")

workers_option = click.option(
    "--workers", type=click.IntRange(min=1), metavar="N", help="Number of processes; one per core by default."
)

scheduler_option = click.option(
    "--scheduler",
    metavar="ADDRESS",
    help="Use the Dask cluster of this running scheduler, such as tcp://10.0.0.1:8786, instead of this machine.",
)

results_option = click.option(
    "--results",
    type=click.Path(file_okay=False, path_type=Path),
    metavar="DIR",
    help="Folder that holds processed/ and report/, such as one on another disk; by default that of campaign.toml.",
)

strict_option = click.option(
    "--strict", is_flag=True, help="Exit with 1 also if there is a serious finding or a warning; notes do not count."
)


def work_options(command: Command) -> Command:
    """Add what every command that runs stages understands."""
    for option in (
        json_option,
        strict_option,
        click.option(
            "--verify",
            is_flag=True,
            help="Read raw files, results and pages even if size and time are unchanged; recompute what was altered.",
        ),
        results_option,
        scheduler_option,
        workers_option,
        click.option("--only", multiple=True, metavar="ID", help="Only this test; may be given several times."),
    ):
        command = option(command)
    return command
