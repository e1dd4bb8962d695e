"""`colonnade map`: stability maps of the specimens, with the campaign's measured points on them."""

from __future__ import annotations

from pathlib import Path

import rich_click as click

from colonnade.cli.console import say, show_json, show_table
from colonnade.cli.options import campaign_argument, json_option, scheduler_option, workers_option
from colonnade.cli.progress import looking


@click.command("map", epilog="Example: colonnade map demo --specimen prism --omega 1.1 7.8 --ramp 3")
@campaign_argument
@click.option("--specimen", multiple=True, metavar="ID", help="Only this specimen; may be given several times.")
@click.option("--model", type=click.Choice(("linear", "nonlinear")), default="linear", show_default=True)
@click.option(
    "--omega", type=float, nargs=2, metavar="LOW HIGH", help="Frequency ratios Ω; by default they hold the sine tests."
)
@click.option(
    "--amplitude", type=float, nargs=2, metavar="LOW HIGH", help="Amplitude ratios A; by default they hold the tests."
)
@click.option(
    "--points", type=click.IntRange(min=2), nargs=2, metavar="N M", help="How many Ω and A; by default 100 and 150."
)
@click.option("--cycles", type=float, default=20.0, show_default=True, help="Cycles at full amplitude.")
@click.option("--phase", type=float, default=0.0, show_default=True, help="Phase of the sine's beginning, degrees.")
@click.option("--ramp", type=float, default=0.0, show_default=True, help="Cycles of linear rise, and of fall.")
@click.option("--motion", metavar="TEST", help="Instead of a sine the table motion that this sine test recorded.")
@workers_option
@scheduler_option
@json_option
def map_command(
    campaign: Path,
    specimen: tuple[str, ...],
    model: str,
    omega: tuple[float, float] | None,
    amplitude: tuple[float, float] | None,
    points: tuple[int, int] | None,
    cycles: float,
    phase: float,
    ramp: float,
    motion: str | None,
    workers: int | None,
    scheduler: str | None,
    as_json: bool,
) -> int:
    """
    Compute stability maps over frequency and amplitude, with the measured points on them.

    CAMPAIGN is a campaign.toml or its folder, by default the one you stand in. Run it first: the map takes the
    identified restitution, and shows the sine tests by their measured outcome.

    A map that is interrupted goes on where it was. One that is there already is only drawn anew.

    Writes processed/maps/<SPECIMEN>-<MODEL>.nc and its picture beside it.
    """
    from math import radians

    from colonnade.workflow.map_plans import USUAL_POINTS, Wanted
    from colonnade.workflow.maps import make_maps

    wanted = Wanted(model, omega, amplitude, points or USUAL_POINTS, cycles, radians(phase), ramp, motion)
    with looking(f"Mapping by the {model} model") as progress:
        made = make_maps(campaign, wanted, specimens=specimen, workers=workers, scheduler=scheduler, progress=progress)
    if as_json:
        show_json([vars(each) | {"path": str(each.path), "figure": str(each.figure)} for each in made])
        return 0
    show_table(
        ("specimen", "model", "e", "measured points", "", "seconds"),
        [
            (
                each.specimen,
                each.model,
                each.restitution_source,
                str(each.measured),
                each.action,
                f"{each.seconds:.1f}",
            )
            for each in made
        ],
    )
    for each in made:
        say(f"map: {each.path}")
        say(f"figure: {each.figure}")
    return 0
