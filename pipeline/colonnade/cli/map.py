"""`colonnade map` and `calibrate`: stability maps with the measured points, and the laws of contact."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

import rich_click as click

from colonnade.cli.common.console import say, show_json, show_rows, show_table, work_progress
from colonnade.cli.common.options import (
    Asking,
    campaign_argument,
    options_of,
    result_options,
    scheduler_option,
    specimen_option,
    workers_option,
)
from colonnade.errors import count
from colonnade.units.text import NOTHING, number, quantity, written

if TYPE_CHECKING:
    from colonnade.identification.response.boundaries import Misfit
    from colonnade.workflow.maps import MapMade


def _keys() -> list[click.Option]:
    from colonnade.workflow.map_plans import Wanted

    return options_of(Wanted.model_fields, alone=True)


@click.command(
    "map",
    cls=Asking,
    keys=_keys,
    epilog="Example: colonnade map demo --specimen prism --omega 1.1 7.8 --ramp 3",
)
@campaign_argument
@specimen_option
@workers_option
@scheduler_option
@result_options
def map_command(
    campaign: Path, specimen: tuple[str, ...], given: dict[str, Any], results: Path | None, as_json: bool, **where: Any
) -> int:
    """
    Compute stability maps over frequency and amplitude, with the measured points on them.

    {CAMPAIGN} Run it first: the map uses the identified restitution, and shows the sine tests by their measured
    outcome.

    An interrupted map is continued. An existing map is only redrawn.

    Writes processed/maps/<SPECIMEN>-<MODEL>.nc and a picture of it; with --responses also
    <SPECIMEN>-<MODEL>-response.nc and its picture.
    """
    from colonnade.workflow.map_plans import Wanted
    from colonnade.workflow.maps import make_maps
    from colonnade.workflow.real_column import picked

    asked = picked(Wanted, given)
    with work_progress(f"Mapping by the {' and the '.join(asked.models)} model") as progress:
        made = make_maps(campaign, asked, specimens=specimen, results=results, progress=progress, **where)
    if as_json:
        show_json(made)
        return 0
    for each in made:
        _show_limits(each)
        say(f"map: {each.path}")
        say(f"figure: {each.figure}")
        if each.responses is not None:
            say(f"responses: {each.responses}")
            say(f"figure: {each.responses_figure}")
    for together in dict.fromkeys(each.together for each in made if each.together is not None):
        say(f"together: {together}")
    return 0


def _show_limits(made: MapMade) -> None:
    from colonnade.store.provenance import NEVER_RUN

    measured = count(made.measured, "measured point")
    why = f"computed again, {made.because}" if made.because else "up to date"
    why = "computed" if made.because == NEVER_RUN else why
    say(f"{made.specimen}, {made.model} model: {measured}, e {made.restitution_source}; {why}")
    limits = (("lower", made.lower), ("upper", made.upper))
    show_rows([(f"{name} limit − measured", _misfit(misfit)) for name, misfit in limits if misfit is not None])


def _misfit(misfit: Misfit) -> str:
    return f"{misfit.mean:+.3f} in A (RMS {misfit.rms:.3f}, {misfit.frequencies} Ω)"


HEADS = (
    *("specimen", "mesh", "step", "CDF ξ", "ξ_eff", "stiffness"),
    *("e", "source", "e wanted", "velocity ratio"),
)


@click.command(epilog="Example: colonnade calibrate demo --specimen prism")
@campaign_argument
@specimen_option
@workers_option
@result_options
def calibrate(
    campaign: Path, specimen: tuple[str, ...], workers: int | None, results: Path | None, as_json: bool
) -> int:
    """
    Find the contact damping with which the contact model gives each specimen's restitution.

    {CAMPAIGN} Identify its free vibrations first.

    e is identified from the rocking angle of a free vibration of the model, as from a record. The mean velocity ratio
    of its impacts is shown with it: a contact that bounces also loses energy between impacts, so the two differ. If e
    cannot be identified, as after too few impacts, the mean velocity ratio is used: "source" shows which of the two.

    Mesh and step are those of the settings (processing.predict.contact). Writes processed/contact/<SPECIMEN>.nc, as a
    run does.
    """
    from colonnade.workflow.calibration import calibrate as calibrated

    made = calibrated(campaign, specimens=specimen, workers=workers, results=results)
    if as_json:
        show_json(made)
        return int(any(each["restitution"] is None for each in made))
    rows = [
        (
            each["specimen"],
            str(each["mesh"]),
            quantity(each["step"], "µs"),
            number(each["damping_fraction"]),
            number(each["effective_damping"]),
            written(each["stiffness"] and 1e-9 * each["stiffness"], "N/mm³", 3),
            _e(each["restitution"]),
            each["source"] or NOTHING,
            _e(each["target"]),
            _e(each["velocity_ratio"]),
        )
        for each in made
    ]
    show_table(HEADS, rows)
    for each in made:
        if each["reason"]:
            say("{specimen}: {reason}".format_map(each))
        if each["path"] is not None:
            say("law: {path}".format_map(each))
    return int(any(each["restitution"] is None for each in made))


def _e(value: float | None) -> str:
    return NOTHING if value is None else f"{value:.4f}"
