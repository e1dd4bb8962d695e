"""`colonnade map`: stability maps of the specimens, with the campaign's measured points on them."""

from __future__ import annotations

from dataclasses import is_dataclass
from pathlib import Path
from typing import TYPE_CHECKING

import rich_click as click

from colonnade.cli.console import say, show_json, show_table
from colonnade.cli.options import campaign_argument, json_option, results_option, scheduler_option, workers_option
from colonnade.cli.progress import looking

if TYPE_CHECKING:
    from colonnade.identification.boundaries import Misfit


@click.command("map", epilog="Example: colonnade map demo --specimen prism --omega 1.1 7.8 --ramp 3")
@campaign_argument
@click.option("--specimen", multiple=True, metavar="ID", help="Only this specimen; may be given several times.")
@click.option(
    "--model",
    multiple=True,
    type=click.Choice(("linear", "nonlinear", "contact")),
    default=("linear",),
    show_default=True,
    help="May be given several times: each has a map of its own, and their limits one picture together.",
)
@click.option(
    "--omega", type=float, nargs=2, metavar="LOW HIGH", help="Frequency ratios Ω; by default they hold the sine tests."
)
@click.option(
    "--amplitude", type=float, nargs=2, metavar="LOW HIGH", help="Amplitude ratios A; by default they hold the tests."
)
@click.option(
    "--points",
    type=click.IntRange(min=2),
    nargs=2,
    metavar="N M",
    help="How many Ω and A; by default 100 and 150, of the contact model 14 and 31.",
)
@click.option("--cycles", type=float, default=20.0, show_default=True, help="Cycles at full amplitude.")
@click.option("--phase", type=float, default=0.0, show_default=True, help="Phase of the sine's beginning, degrees.")
@click.option("--ramp", type=float, default=0.0, show_default=True, help="Cycles of rise, and of fall.")
@click.option(
    "--ramp-shape",
    type=click.Choice(("linear", "cosine")),
    default="linear",
    show_default=True,
    help="Rise and fall in proportion to time, or smooth as half a cosine.",
)
@click.option("--motion", metavar="TEST", help="Instead of a sine the table motion that this sine test recorded.")
@click.option(
    "--responses", is_flag=True, help="Also the orders and amplitudes of the steady responses, with curves of them."
)
@workers_option
@scheduler_option
@results_option
@json_option
def map_command(
    campaign: Path,
    specimen: tuple[str, ...],
    model: tuple[str, ...],
    omega: tuple[float, float] | None,
    amplitude: tuple[float, float] | None,
    points: tuple[int, int] | None,
    cycles: float,
    phase: float,
    ramp: float,
    ramp_shape: str,
    motion: str | None,
    responses: bool,
    workers: int | None,
    scheduler: str | None,
    results: Path | None,
    as_json: bool,
) -> int:
    """
    Compute stability maps over frequency and amplitude, with the measured points on them.

    CAMPAIGN is a campaign.toml or its folder, by default the one you stand in. Run it first: the map takes the
    identified restitution, and shows the sine tests by their measured outcome.

    A map that is interrupted goes on where it was. One that is there already is only drawn anew.

    Writes processed/maps/<SPECIMEN>-<MODEL>.nc and its picture beside it; with --responses also
    <SPECIMEN>-<MODEL>-response.nc and its picture.
    """
    from math import radians

    from colonnade.workflow.map_plans import Wanted
    from colonnade.workflow.maps import make_maps

    wanted = Wanted(model, omega, amplitude, points, cycles, radians(phase), ramp, ramp_shape, motion, responses)
    with looking(f"Mapping by the {' and the '.join(model)} model") as progress:
        made = make_maps(
            campaign,
            wanted,
            specimens=specimen,
            workers=workers,
            scheduler=scheduler,
            results=results,
            progress=progress,
        )
    if as_json:
        show_json([{name: _plain(value) for name, value in vars(each).items()} for each in made])
        return 0
    show_table(
        (
            "specimen",
            "model",
            "e",
            "measured points",
            "lower limit − measured",
            "upper limit − measured",
            "",
            "seconds",
        ),
        [
            (
                each.specimen,
                each.model,
                each.restitution_source,
                str(each.measured),
                _misfit(each.lower),
                _misfit(each.upper),
                each.action,
                f"{each.seconds:.1f}",
            )
            for each in made
        ],
    )
    for each in made:
        say(f"map: {each.path}")
        say(f"figure: {each.figure}")
        if each.responses is not None:
            say(f"responses: {each.responses}")
            say(f"figure: {each.responses_figure}")
    for together in dict.fromkeys(each.together for each in made if each.together is not None):
        say(f"together: {together}")
    return 0


def _plain(value: object) -> object:
    """Give a value as JSON can hold it."""
    if isinstance(value, Path):
        return str(value)
    return vars(value) if is_dataclass(value) else value


def _misfit(misfit: Misfit | None) -> str:
    if misfit is None:
        return "–"
    return f"{misfit.mean:+.3f} in A (RMS {misfit.rms:.3f}, {misfit.frequencies} Ω)"
