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
        Of each specimen its id, why the calibration failed or missed its target, where the law is stored (None if it
        failed), and its numbers (SI) and the source of its e by their names there.

    Raises
    ------
    CampaignError
        If a specimen is not in the campaign or not identified yet.
    StoreError
        If a run is in progress, or results cannot be written.
    """
    expect_known(campaign, "specimen", specimens)
    chosen = list(specimens) or [name for name in campaign.of_interest if not campaign.specimens[name].is_assembly]
    several = [name for name in chosen if campaign.specimens[name].is_assembly]
    if several or not chosen:
        raise CampaignError(
            f"{listed(several or campaign.of_interest)}: the contact of several bodies is not calibrated. They have "
            "the law of the settings under processing.predict.contact."
        )
    with walking(campaign, layout, Where(workers)) as walk:
        for name in chosen:
            if campaign.specimens[name].restitution is None and not layout.stage(name, "specimen").is_file():
                raise CampaignError(f"{name}: its restitution is not known yet. Run `colonnade identify` first.")
        walk.pool()
        walk.calibrate(chosen)
    return [_law(name, layout.stage(name, "contact"), walk.failed["specimen"].get(name)) for name in chosen]


def _law(specimen: str, path: Path, failure: str | None) -> dict[str, Any]:
    if failure is not None:
        return {"specimen": specimen, "reason": failure, "path": None}
    law = files.read(path)
    numbers = {str(name): float(each) for name, each in law.data_vars.items() if not each.ndim}
    said = {"reason": " ".join(map(str, law.attrs["warnings"])), "path": path}
    return {"specimen": specimen, **said, "source": law.attrs["contact_restitution_source"], **numbers}
