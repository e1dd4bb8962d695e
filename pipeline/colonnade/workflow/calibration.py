"""The laws of contact of a campaign's specimens, as a run finds and stores them."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Any

from colonnade.campaign import Campaign
from colonnade.errors import CampaignError
from colonnade.store import files
from colonnade.store.layout import Layout
from colonnade.units.text import listed
from colonnade.workflow.executors import Where
from colonnade.workflow.graph import expect_known
from colonnade.workflow.walk import walking

NUMBERS = {
    "step": "contact_step",
    "target": "restitution",
    "restitution": "contact_restitution",
    "velocity_ratio": "contact_velocity_ratio",
    "damping_fraction": "damping_fraction",
}
"""Numbers of a law, and the variable of each in its result."""


def calibrate(
    campaign: Campaign, layout: Layout, specimens: Sequence[str] = (), workers: int | None = None
) -> list[dict[str, Any]]:
    """
    Find the contact damping with which each specimen rocks freely with its restitution, and show the law.

    Parameters
    ----------
    campaign : Campaign
        Its free vibrations have been identified.
    layout : Layout
    specimens : sequence of str, optional
        Ids; default all single blocks that are not only parts of an assembly.
    workers : int, optional
        Processes; default one a core.

    Returns
    -------
    laws : list of dict
        Of each specimen its id, the mesh, why the calibration failed or missed its target, the source of the model's e
        and `NUMBERS` (SI; None if it failed), and where the law, with all else, is stored.

    Raises
    ------
    CampaignError
        If a specimen is not in the campaign or not identified yet.
    StoreError
        If a run is in progress, or results cannot be written.
    """
    expect_known(campaign, "specimen", specimens)
    blocks = {name: campaign.specimens[name] for name in campaign.of_interest}
    chosen = list(specimens) or [name for name, each in blocks.items() if not each.is_assembly]
    several = [name for name in chosen if campaign.specimens[name].is_assembly]
    if several or not chosen:
        raise CampaignError(
            f"{listed(several or list(blocks))}: the contact of several bodies is not calibrated. They have the law of "
            "the settings under processing.predict.contact."
        )
    with walking(campaign, layout, Where(workers)) as walk:
        for name in chosen:
            if campaign.specimens[name].restitution is None and not layout.stage(name, "specimen").is_file():
                raise CampaignError(f"{name}: its restitution is not known yet. Run `colonnade identify` first.")
        walk.pool()
        walk.calibrate(chosen)
    mesh, failed = campaign.processing.predict.contact.mesh, walk.failed["specimen"]
    return [_law(name, mesh, layout.stage(name, "contact"), failed.get(name)) for name in chosen]


def _law(specimen: str, mesh: object, path: Path, failure: str | None) -> dict[str, Any]:
    found = {"specimen": specimen, "mesh": mesh, "reason": failure, "source": "", "path": None}
    if failure is not None:
        return found | dict.fromkeys(NUMBERS)
    law = files.read(path)
    said = {"reason": " ".join(map(str, law.attrs["warnings"])), "path": path}
    numbers = {name: float(law[variable]) for name, variable in NUMBERS.items()}
    return found | said | numbers | {"source": str(law.attrs["contact_restitution_source"])}
