"""A map or the steady responses of a specimen: made in blocks if they are out of date, and stored."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any

from pydantic import RootModel

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

ASKED = "asked_for"
"""Attribute of a map that was asked for with options of its own: these."""


class Options(RootModel[dict[str, Any]]):
    """What a map or steady responses depend on besides what is `given`, by name."""


def bring_up_to_date(
    campaign: Campaign,
    layout: Layout,
    result: ResultId,
    plan: MapPlan,
    settings: Mapping[str, Any],
    attributes: Mapping[str, str],
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
    attributes : mapping
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
    recipe = Recipe(result.stage, code, Options(dict(settings)).model_dump_json(), given(plan))
    because = recipe.why(stored_attributes(path))
    if because:
        blocks = layout.blocks(result)
        made = make(blocks, recipe.key)
        described = global_attributes(Origin.of(campaign), result) | recipe.attributes
        files.write(made, path, attributes=described | dict(attributes))
        forget(blocks)
    return files.read(path), because


def given(plan: MapPlan) -> dict[str, str | None]:
    """Hash what a map is made from besides its options: block, axes and motion."""
    motion = None if plan.motion is None else [plan.motion.dt, plan.motion.acceleration.tolist()]
    axes = [plan.frequency_ratio.tolist(), plan.amplitude_ratio.tolist()]
    return {"block": hash_of(repr(plan.block)), "axes": hash_of(axes), "motion": hash_of(motion)}
