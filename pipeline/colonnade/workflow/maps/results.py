"""A map or the steady responses of a specimen: made in blocks if they are out of date, and stored."""

from __future__ import annotations

import json
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any

from colonnade.campaign import Campaign
from colonnade.store import files
from colonnade.store.freshness import Recipe
from colonnade.store.layout import Layout
from colonnade.store.provenance import Origin, global_attributes, hash_of
from colonnade.store.results import ResultId
from colonnade.workflow.catalogue import Catalogue, stored_attributes
from colonnade.workflow.execution.blocks import forget

if TYPE_CHECKING:
    import xarray as xr

    from colonnade.dynamics.maps.plan import MapPlan

MADE_BY = ("colonnade.dynamics.maps", "colonnade.workflow.maps")
"""Packages whose code makes maps and steady responses; what they import counts too."""


def bring_up_to_date(
    campaign: Campaign,
    layout: Layout,
    result: ResultId,
    plan: MapPlan,
    settings: Mapping[str, Any],
    restitution_source: str,
    make: Callable[[Path, str], xr.Dataset],
) -> tuple[xr.Dataset, str]:
    """
    Make a result over Ω and A if it is out of date.

    Parameters
    ----------
    campaign : Campaign
    layout : Layout
    result : ResultId
    plan : MapPlan
        If its block, axes or motion change, the result is out of date.
    settings : mapping
        All else that the result depends on.
    restitution_source : str
        Stored with it.
    make : callable
        Takes the folder of its blocks and its key; returns the result.

    Returns
    -------
    stored : xr.Dataset
    because : str
        Why it was made, see `Recipe.why`; empty if it was up to date.

    Raises
    ------
    StoreError
        If it cannot be written.
    """
    path = layout.path(result)
    code = Catalogue(layout).code(MADE_BY, result.model)
    recipe = Recipe(result.stage, code, json.dumps(settings), _upstream(plan))
    because = recipe.why(stored_attributes(path))
    if because:
        blocks = layout.blocks(result)
        made = make(blocks, recipe.key)
        attributes = global_attributes(Origin.of(campaign), result) | recipe.attributes
        files.write(made, path, attributes=attributes | {"restitution_source": restitution_source})
        forget(blocks)
    return files.read(path), because


def _upstream(plan: MapPlan) -> dict[str, str | None]:
    motion = None if plan.motion is None else [plan.motion.dt, plan.motion.acceleration.tolist()]
    axes = [plan.frequency_ratio.tolist(), plan.amplitude_ratio.tolist()]
    return {"block": hash_of(repr(plan.block)), "axes": hash_of(axes), "motion": hash_of(motion)}
