"""`colonnade calibrate`: the contact damping that gives each specimen its restitution."""

from __future__ import annotations

from pathlib import Path

import rich_click as click

from colonnade.cli.common.console import say, show_json, show_table
from colonnade.cli.common.options import (
    CAMPAIGN,
    campaign_argument,
    json_option,
    results_option,
    specimen_option,
    workers_option,
)

HEADS = (
    *("specimen", "mesh", "step", "CDF ξ", "ξ_eff", "stiffness"),
    *("e", "source", "e wanted", "velocity ratio"),
)


@click.command(
    epilog="Example: colonnade calibrate demo --specimen prism",
    help=f"""
    Find the contact damping with which the contact model gives each specimen's restitution.

    {CAMPAIGN} Identify its free vibrations first.

    e is identified from the rocking angle of a free vibration of the model, as from a record. The mean velocity ratio
    of its impacts is shown with it: a contact that bounces also loses energy between impacts, so the two differ. If e
    cannot be identified, as after too few impacts, the mean velocity ratio is used: "source" shows which of the two.

    Mesh and step are those of the settings (processing.predict.contact). Writes processed/contact/<SPECIMEN>.nc, as a
    run does.
    """,
)
@campaign_argument
@specimen_option
@workers_option
@results_option
@json_option
def calibrate(
    campaign: Path,
    specimen: tuple[str, ...],
    workers: int | None,
    results: Path | None,
    as_json: bool,
) -> int:
    """Calibrate, show the laws, and return the exit code."""
    from colonnade.workflow.calibration import calibrate as calibrated

    made = calibrated(campaign, specimens=specimen, workers=workers, results=results)
    if as_json:
        show_json(made)
        return int(any(each["restitution"] is None for each in made))
    rows = [
        (
            each["specimen"],
            each["mesh"],
            _number(None if each["step"] is None else 1e6 * each["step"], ".3g", " µs"),
            _number(each["damping_fraction"], ".3g"),
            _number(each["effective_damping"], ".3g"),
            _number(each["stiffness"], ".3g", " N/m³"),
            _number(each["restitution"], ".4f"),
            each["source"] or "–",
            _number(each["target"], ".4f"),
            _number(each["velocity_ratio"], ".4f"),
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


def _number(value: float | None, form: str, unit: str = "") -> str:
    return "–" if value is None else f"{value:{form}}{unit}"
