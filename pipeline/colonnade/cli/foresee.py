"""`colonnade foresee`: what a specimen will do on a base motion at several levels, kept before the test."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

import rich_click as click

from colonnade.cli.common.console import say, show_json, show_paragraph, show_table
from colonnade.cli.common.options import CAMPAIGN, campaign_argument, json_option, one_specimen_option, results_option
from colonnade.cli.common.progress import work_progress

if TYPE_CHECKING:
    from colonnade.workflow.foresee import Foreseen


@click.command(
    epilog='Example: colonnade foresee demo --specimen prism --motion "El Centro 1940 NS" --level "0.3 g" --level 1.5x',
    help=f"""
    Forecast what a specimen does on a base motion.

    {CAMPAIGN} Run it first: a forecast takes the e that is identified so far.

    Writes a file for each level into forecasts/, which is never changed. After the test `run` scores the last one with
    --test that was made before the raw file of that test was there.
    """,
)
@campaign_argument
@click.option(
    "--motion",
    required=True,
    metavar="NAME|FILE",
    help="A test that recorded it, a motion that tests name, one of [motions], or a file.",
)
@click.option(
    "--level",
    required=True,
    multiple=True,
    metavar="LEVEL",
    help='Peak acceleration of the table, "0.3 g", or a factor on a recorded motion, 1.5x. Without --test it may be '
    "repeated.",
)
@one_specimen_option
@click.option("--test", metavar="ID", help="The test that the forecast is for, such as one with planned = true.")
@click.option(
    "--time-scale", type=float, metavar="FACTOR", help="On the motion's own time; by default that of the test, else 1."
)
@results_option
@json_option
def foresee(
    campaign: Path,
    motion: str,
    level: tuple[str, ...],
    specimen: str | None,
    test: str | None,
    time_scale: float | None,
    results: Path | None,
    as_json: bool,
) -> int:
    """Make forecasts, show them, and return the exit code."""
    from colonnade.workflow.foresee import foresee as make

    with work_progress("Foreseeing") as progress:
        made = make(
            campaign,
            motion=motion,
            levels=level,
            specimen=specimen,
            test=test,
            time_scale=time_scale,
            results=results,
            progress=progress,
        )
    if as_json:
        show_json([{"file": each.path, **each.forecast.model_dump(mode="json", by_alias=True)} for each in made])
        return 0
    for each in made:
        _show(each)
        say(f"forecast: {each.path}")
    return 0


def _show(made: Foreseen) -> None:
    """Write what the table must do, and under it what each model foresees, side by side."""
    from colonnade.store.records.forecast import FORESEEN, shown_model, shown_table

    forecast = made.forecast
    acceleration, velocity, displacement = shown_table(forecast.table)
    show_paragraph(f"{forecast.level}: the table reaches {acceleration}; velocity {velocity}; stroke {displacement}")
    columns = [shown_model(model) for model in forecast.models.values()]
    show_table(("", *forecast.models), list(zip(FORESEEN, *columns, strict=True)))
