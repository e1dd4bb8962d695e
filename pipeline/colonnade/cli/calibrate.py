"""`colonnade calibrate`: the contact damping that gives each specimen its restitution."""

from __future__ import annotations

from pathlib import Path

import rich_click as click

from colonnade.cli.common.console import say, show_json, show_table
from colonnade.cli.common.options import (
    CAMPAIGN,
    LateChoice,
    campaign_argument,
    json_option,
    meshes,
    results_option,
    specimen_option,
    workers_option,
)

HEADS = (
    *("specimen", "mesh", "step", "CDF ξ", "ξ_eff", "stiffness"),
    *("e", "source", "e wanted", "velocity ratio", "seconds"),
)


@click.command(
    epilog="Example: colonnade calibrate demo --specimen prism --mesh rigid --mesh coarse",
    help=f"""
    Find the contact damping with which the contact model gives each specimen's restitution.

    {CAMPAIGN} Identify its free vibrations first.

    e is identified from the rocking angle of a free vibration of the model, as from a record. The mean velocity ratio
    of its impacts is shown with it: a contact that bounces also loses energy between impacts, so the two differ. If e
    cannot be identified, as after too few impacts, the mean velocity ratio is used: "source" shows which of the two.

    Writes processed/contact/<SPECIMEN>.nc for the mesh and step of the settings (processing.predict.contact); others
    are only shown.
    """,
)
@campaign_argument
@specimen_option
@click.option(
    "--mesh",
    multiple=True,
    type=LateChoice(meshes),
    help="Replaces the one in the settings. Repeat the option for several.",
)
@click.option(
    "--step",
    multiple=True,
    metavar="TIME",
    help='Replaces the one in the settings, such as "10 us". Repeat the option for several.',
)
@workers_option
@results_option
@json_option
def calibrate(
    campaign: Path,
    specimen: tuple[str, ...],
    mesh: tuple[str, ...],
    step: tuple[str, ...],
    workers: int | None,
    results: Path | None,
    as_json: bool,
) -> int:
    """Calibrate, show the laws, and return the exit code."""
    from colonnade.workflow.calibration import calibrate as calibrated

    steps = [_seconds(text) for text in step]
    made = calibrated(campaign, specimens=specimen, meshes=mesh, steps=steps, workers=workers, results=results)
    if as_json:
        show_json(made)
        return int(any(each.restitution is None for each in made))
    rows = [
        (
            each.specimen,
            each.mesh,
            f"{each.step * 1e6:.3g} µs",
            _number(each.damping_fraction, ".3g"),
            _number(each.effective_damping, ".3g"),
            _number(each.stiffness, ".3g", " N/m³"),
            _number(each.restitution, ".4f"),
            each.source or "–",
            _number(each.target, ".4f"),
            _number(each.velocity_ratio, ".4f"),
            f"{each.seconds:.1f}",
        )
        for each in made
    ]
    show_table(HEADS, rows)
    for each in made:
        if each.reason:
            say(f"{each.specimen}, {each.mesh}: {each.reason}")
        if each.path is not None:
            say(f"law: {each.path}")
    return int(any(each.restitution is None for each in made))


def _seconds(step: str) -> float:
    """Read a step by the rules of the setting."""
    from pydantic import ValidationError

    from colonnade.campaign.settings import ContactSettings
    from colonnade.errors import CampaignError

    try:
        return ContactSettings.model_validate({"step": step}).step
    except ValidationError as error:
        raise CampaignError(f"--step: {error.errors()[0]['msg']}") from None


def _number(value: float | None, form: str, unit: str = "") -> str:
    return "–" if value is None else f"{value:{form}}{unit}"
