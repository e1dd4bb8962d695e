"""The e of each specimen that predictions use."""

from __future__ import annotations

from typing import TYPE_CHECKING

from colonnade.campaign import Campaign
from colonnade.errors import StoreError
from colonnade.store import files
from colonnade.store.layout import Layout

if TYPE_CHECKING:
    import xarray as xr


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
