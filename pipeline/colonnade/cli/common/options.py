"""Arguments and options that several commands share."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING, Any, TypeVar

import rich_click as click

from colonnade.cli.common.keys import options_of

if TYPE_CHECKING:
    from pydantic.fields import FieldInfo

Command = TypeVar("Command", bound=Callable[..., Any])


campaign_argument = click.argument("campaign", type=click.Path(path_type=Path), default=Path(), metavar="[CAMPAIGN]")
"""The argument of most commands."""

CAMPAIGN = "CAMPAIGN is a campaign.toml or its folder, by default the current folder."
"""What their help says of it."""

campaign_and_id_argument = click.argument("arguments", nargs=-1, metavar="[CAMPAIGN] [ID]")
"""The arguments of commands that show one test or specimen; `campaign_and_id` reads them."""


def campaign_and_id(arguments: tuple[str, ...]) -> tuple[Path, str | None]:
    """Take a single argument as CAMPAIGN if such a file or folder exists, else as ID."""
    if len(arguments) > 2:
        raise click.UsageError(f"{len(arguments)} arguments were found. Give at most a CAMPAIGN and an ID.")
    if len(arguments) == 2:
        return Path(arguments[0]), arguments[1]
    if arguments and not Path(arguments[0]).exists():
        return Path(), arguments[0]
    return Path(*arguments), None


specimen_option = click.option(
    "--specimen", multiple=True, metavar="ID", help="Only this specimen. Repeat the option for several."
)

one_specimen_option = click.option(
    "--specimen", metavar="ID", help="The specimen; needed if there are several and nothing else names it."
)


def column_keys(*more: str) -> list[click.Option]:
    """Make the options that say which column: its sizes, and keys of [prototype.<specimen>]: e, α, p and `more`."""
    from colonnade.campaign.assessment import Prototype
    from colonnade.campaign.specimen import SIZED
    from colonnade.workflow.real_column import Size

    sizes: dict[str, FieldInfo] = {}
    for model in SIZED.values():
        sizes |= model.model_fields
    sizes = {key: sizes[key] for key in ("width", "diameter", "base_diameter", "top_diameter", "height")}
    prototype = {key: Prototype.model_fields[key] for key in ("critical_angle", "p", "restitution", *more)}
    return options_of(Size.model_fields | sizes | prototype)


json_option = click.option("--json", "as_json", is_flag=True, help="Write the result as JSON.")

workers_option = click.option(
    "--workers", type=click.IntRange(min=1), metavar="N", help="Number of processes; one per core by default."
)

scheduler_option = click.option(
    "--scheduler",
    metavar="ADDRESS",
    help="Compute on the Dask cluster of this scheduler, such as tcp://10.0.0.1:8786, not on this machine.",
)

results_option = click.option(
    "--results",
    type=click.Path(file_okay=False, path_type=Path),
    metavar="DIR",
    help="Folder for processed/ and report/, such as one on another disk; by default that of campaign.toml.",
)

strict_option = click.option(
    "--strict", is_flag=True, help="Exit with 1 also for a serious finding or a warning, but not for a note."
)


def work_options(command: Command) -> Command:
    """Add the options of all commands that run stages."""
    for option in (
        json_option,
        click.option("--verbose", is_flag=True, help="Also list each redone stage, why it was redone, and its time."),
        strict_option,
        click.option(
            "--verify",
            is_flag=True,
            help="Read raw files, results and pages even if size and time are unchanged; recompute what was altered.",
        ),
        click.option(
            "--await",
            "awaiting",
            is_flag=True,
            help="Take a test without its raw file for planned: pending, not failed.",
        ),
        results_option,
        scheduler_option,
        workers_option,
        click.option("--only", multiple=True, metavar="ID", help="Only this test. Repeat the option for several."),
    ):
        command = option(command)
    return command
