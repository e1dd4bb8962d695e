"""The e of a campaign's specimens: pooled where a run asks for it, and given as predictions use it to all others."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

from colonnade.campaign import Campaign
from colonnade.errors import StoreError
from colonnade.store import files
from colonnade.store.layout import Layout
from colonnade.workflow.chain import advance
from colonnade.workflow.freshness import Look
from colonnade.workflow.results import StageRun
from colonnade.workflow.steps import specimen_step

if TYPE_CHECKING:
    import xarray as xr


def pool(campaign: Campaign, layout: Layout, look: Look, *, redo_from: str | None = None) -> list[StageRun]:
    """Bring the specimens up to date with the free vibrations that have been identified, as `look` tells of them."""
    identified: dict[str, dict[str, Path]] = {name: {} for name in campaign.specimens}
    for test in campaign.tests.values():
        path = layout.stage(test.id, "restitution")
        excluded = campaign.review(test.id).excluded
        if test.kind == "free-vibration" and not excluded and look(path).get("status") == "done":
            identified[test.specimen][test.id] = path
    return [
        advance(campaign, layout, name, specimen_step(campaign, layout, name, paths), redo_from=redo_from, raw={})
        for name, paths in identified.items()
    ]


def restitution_taken(campaign: Campaign, layout: Layout, specimen: str) -> xr.Dataset:
    """
    Give the e that predictions of a specimen use, by the campaign as it is now and the free vibrations that are stored.

    Returns
    -------
    pooled : xr.Dataset
        As of `stages.specimen`; nothing is written.
    """
    from colonnade.stages.specimen import SpecimenInputs, taken

    try:
        stored = files.read(layout.stage(specimen, "specimen"))
    except StoreError:
        stored = None
    if stored is not None and stored.attrs["status"] != "done":
        stored = None
    return taken(stored, SpecimenInputs.of(campaign, specimen))
