"""The record of one specimen: its properties, the restitution that predictions use, and both at prototype scale."""

from __future__ import annotations

from typing import TYPE_CHECKING

from colonnade.campaign import Campaign
from colonnade.campaign.forms.summary import RestitutionSummary, SpecimenPrototype, SpecimenSummary
from colonnade.dynamics.similitude import at_prototype

if TYPE_CHECKING:
    import xarray as xr


def record_of_specimen(campaign: Campaign, name: str, pooled: xr.Dataset) -> SpecimenSummary:
    """
    Take the record of a specimen.

    Parameters
    ----------
    campaign : Campaign
    name : str
    pooled : xr.Dataset
        Its restitution, as the stage `specimen` gives it.
    """
    block = campaign.block(name)
    negative, positive = (float(value) for value in pooled["side_restitution"])
    return SpecimenSummary(
        critical_angle=block.critical_angle,
        p=block.p,
        pole_distance=block.pole_distance,
        inertia=block.inertia,
        restitution=RestitutionSummary(
            value=negative if negative == positive else (negative, positive),
            low=float(pooled["restitution_low"]),
            high=float(pooled["restitution_high"]),
            level=float(pooled["level"]),
            source=pooled.attrs["restitution_source"],
            method=pooled.attrs["method"] or None,
            reason=pooled.attrs["reason"] or None,
            tests=tuple(map(str, pooled["test_id"].to_numpy())),
        ),
        prototype=specimen_prototype(campaign, name),
    )


def specimen_prototype(campaign: Campaign, name: str) -> SpecimenPrototype | None:
    """Return a specimen at prototype scale, None if its scale is not given."""
    specimen, block = campaign.specimens[name], campaign.block(name)
    scale = specimen.scale
    if scale is None:
        return None
    return SpecimenPrototype(
        scale=scale,
        p=at_prototype("frequency", block.p, scale),
        pole_distance=at_prototype("length", block.pole_distance, scale),
        mass=at_prototype("mass", block.mass, scale),
        inertia=at_prototype("inertia", block.inertia, scale),
        sizes={key: at_prototype("length", size, scale) for key, size in specimen.sizes().items()},
    )
