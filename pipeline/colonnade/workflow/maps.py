"""Stability maps and steady responses of a campaign's specimens: what is asked, the products, and their figures."""

from __future__ import annotations

import json
from collections.abc import Iterator, Sequence
from contextlib import suppress
from dataclasses import dataclass
from functools import partial
from math import radians
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, NamedTuple

import numpy as np
from pydantic import Field, RootModel

from colonnade.campaign import Campaign
from colonnade.campaign.assembly import APART, Whole
from colonnade.campaign.forms.summary import Summary
from colonnade.campaign.syntax.fields import MOST_CYCLES, Limits, MapPoints, MapRatio, Number, OneOf
from colonnade.campaign.syntax.table import Table
from colonnade.dynamics.block import Sided, pair
from colonnade.dynamics.models import MODELS, NONLINEAR, PLANE_MODELS
from colonnade.errors import CampaignError, StoreError
from colonnade.identification.response.boundaries import MapPoint, makes_map
from colonnade.stages.predict import sides
from colonnade.store import files
from colonnade.store.layout import Layout
from colonnade.store.provenance import hash_of
from colonnade.store.records.stored import as_dataset, as_map, as_response
from colonnade.store.records.summary import map_points, read_summary
from colonnade.store.results import ResultId, models_moving
from colonnade.workflow.executors import HERE, Arrays, Run, Where, blocks_of
from colonnade.workflow.graph import Graph, expect_known, restitution_taken
from colonnade.workflow.product import Product, read_done, stored_attributes
from colonnade.workflow.walk import Walk, walking

if TYPE_CHECKING:
    import xarray as xr

    from colonnade.dynamics.contact.body import InSpace
    from colonnade.dynamics.maps import MapPlan

MADE_BY = ("colonnade.dynamics.maps", "colonnade.workflow.maps")
"""Modules whose code makes maps and steady responses; what they import counts too."""

ASKED = "asked_for"
"""Attribute of a map: the options that it was asked for with."""

SETTLING = 400
"""Cycles at full amplitude before a response is looked at."""

OF_MAPS = ("cycles", "width", "edge", "scan_step", "no_rocking_ratio")
"""Options of a map on which steady responses do not depend."""

USUAL_FREQUENCIES = (1.0, 8.0)
"""Ω of a map of a specimen without sine tests."""

LOWEST_AMPLITUDE, USUAL_AMPLITUDE = 0.5, 8.0
"""Smallest A of a map, and the least value of its largest A: the upper limit is far above the tests."""

LARGEST_AMPLITUDE_IN_SPACE = 3.5
"""The same largest A of a map by the contact model."""

_Cycles = Annotated[Number, Field(ge=0.0, le=MOST_CYCLES)]


class Wanted(Table):
    """What a map is asked to show."""

    models: tuple[Annotated[str, OneOf(tuple(MODELS))], ...] = (NONLINEAR.name,)
    """Model of rocking; each has a map of its own, and one picture shows the limits of all."""
    omega: Limits[MapRatio] | None = None
    """Frequency ratios Ω; by default around the sine tests."""
    amplitude: Limits[MapRatio] | None = None
    """Amplitude ratios A; by default around the sine tests."""
    points: tuple[MapPoints, MapPoints] | None = None
    """Numbers of Ω and of A; by default 24 and 150, for the contact model 14 and 31."""
    cycles: _Cycles = 20.0
    """Cycles at full amplitude."""
    phase: Annotated[Number, Field(ge=-360.0, le=360.0)] = 0.0
    """Phase of the sine at its start, in degrees."""
    ramp: _Cycles = 0.0
    """Cycles of the linear rise, and of the fall."""
    responses: bool = False
    """Also compute the orders and amplitudes of the steady responses, with curves."""


class Measured(NamedTuple):
    """What was measured of a specimen: its sine tests, which a map has to include, its e, and where that comes from."""

    specimen: str
    points: Sequence[MapPoint]
    restitution: Sided
    source: str


class Options(RootModel[dict[str, Any]]):
    """What a map or steady responses depend on besides what is `given`, by name."""


@dataclass(frozen=True)
class MapMade:
    """
    A map of a specimen, or its steady responses.

    Attributes
    ----------
    specimen, model : str
    kind : str
        map or responses.
    path, figure : Path
        The picture of a map shows all models that are asked for.
    restitution_source : str
        given, identified or rigid-body.
    measured : int
        Sine tests drawn on it.
    because : str
        Why it was made, see `StageRun`; empty if it was up to date.
    """

    specimen: str
    model: str
    kind: str
    path: Path
    figure: Path
    restitution_source: str
    measured: int
    because: str


def make_maps(
    campaign: Campaign, layout: Layout, wanted: Wanted, specimens: Sequence[str] = (), where: Where = HERE
) -> list[MapMade]:
    """
    Make the stability maps of a campaign's specimens, with its measured points on them.

    Parameters
    ----------
    campaign : Campaign
    layout : Layout
    wanted : Wanted
    specimens : sequence of str, optional
        Ids; default those that the models move, but not those that are only parts of an assembly.
    where : Where, optional

    Returns
    -------
    made : list of MapMade

    Raises
    ------
    CampaignError
        If a specimen or a wanted value is not usable.
    StoreError
        If a run is in progress, or results cannot be written.
    """
    expect_known(campaign, "specimen", specimens)
    with walking(campaign, layout, where) as walk:
        usual = [name for name in campaign.of_interest if models_moving(campaign, name, wanted.models)]
        named = specimens or usual or campaign.of_interest
        return [made for specimen in named for made in _of_specimen(walk, specimen, wanted)]


def kept_maps(graph: Graph, summary: Summary, specimens: Sequence[str]) -> Iterator[Product]:
    """
    Give the maps that a run keeps up to date: of specimens with sine tests at several frequencies, by the plane models.

    Parameters
    ----------
    graph : Graph
    summary : Summary
        Records of tests and specimens: the maps have to include their sine tests.
    specimens : sequence of str
        Ids of those that may have a map.

    Yields
    ------
    map : Product
        That which `colonnade map` makes without options. One that was asked for with other options stays while it is
        up to date with its specimen.
    """
    for specimen in specimens:
        points, pooled = map_points(summary.tests, specimen), summary.specimens[specimen].restitution
        if pooled.value is None or not makes_map(points):
            continue
        measured = Measured(specimen, points, pair(pooled.value), pooled.source)
        in_plane = [model for model in graph.campaign.processing.predict.models if model in PLANE_MODELS]
        for model in models_moving(graph.campaign, specimen, in_plane):
            asked = usual = _product(graph, Wanted(), model, measured)
            with suppress(KeyError, ValueError, TypeError, CampaignError):
                wanted = Wanted.model_validate_json(stored_attributes(usual.paths[0])[ASKED])
                asked = _product(graph, wanted, model, measured)
            yield usual if asked.why(stored_attributes) else asked


def _measured(graph: Graph, summary: Summary | None, specimen: str) -> Measured:
    pooled = restitution_taken(graph.campaign, graph.layout, specimen)
    points = [] if summary is None else map_points(summary.tests, specimen)
    return Measured(specimen, points, sides(pooled), str(pooled.attrs["restitution_source"]))


def _of_specimen(walk: Walk, specimen: str, wanted: Wanted) -> Iterator[MapMade]:
    """Make the maps and responses of one specimen, by each model, and one picture of its maps."""
    from colonnade.figures.maps.response_orders import computed, responses

    graph, layout, models = walk.graph, walk.graph.layout, list(dict.fromkeys(wanted.models))
    measured = _measured(graph, read_summary(layout), specimen)
    made = partial(MapMade, specimen, restitution_source=measured.source, measured=len(measured.points))
    together, charts = layout.figure(ResultId(specimen, "map", "+".join(models))), []
    for model in models:
        for kind in ("map", "responses") if wanted.responses else ("map",):
            product, figure = _product(graph, wanted, model, measured, kind, walk.where), together
            walk.follow([[product]])
            if walk.stages[-1].action == "failed":
                raise StoreError(walk.stages[-1].reason)
            stored = files.read(product.paths[0])
            if kind == "map":
                charts.append(as_map(stored))
            else:
                figure = layout.figure(product.result)
                drawn = responses(specimen, as_response(stored), measured.points, json.loads(stored.attrs["settings"]))
                files.write_text(figure, drawn.svg)
            yield made(model, kind, product.paths[0], figure, because=walk.stages[-1].because)
    files.write_text(together, computed(specimen, charts, measured.points).svg)


def plan_of(campaign: Campaign, layout: Layout, wanted: Wanted, model: str, measured: Measured) -> MapPlan:
    """
    Plan a specimen's map.

    Raises
    ------
    CampaignError
        If no map can be made so, or the model does not move the specimen.
    """
    from colonnade.dynamics.maps import MapPlan
    from colonnade.dynamics.search import STEPS_A_WIDTH

    specimen = measured.specimen
    if model not in models_moving(campaign, specimen, (model,)):
        raise CampaignError(
            f"{specimen}: {APART}, which the {model} model moves. Give --model contact, or another --specimen."
        )
    omegas = wanted.omega or _around([point.frequency_ratio for point in measured.points], USUAL_FREQUENCIES)
    largest = max((1.2 * point.amplitude_ratio for point in measured.points), default=0.0)
    space = _space(campaign, layout, specimen) if MODELS[model].in_space else None
    usual = USUAL_AMPLITUDE if space is None else LARGEST_AMPLITUDE_IN_SPACE
    amplitudes = wanted.amplitude or (LOWEST_AMPLITUDE, max(usual, float(np.ceil(largest * 2) / 2)))
    grid = wanted.points or MODELS[model].map_points
    scan: dict[str, float] = {}
    if space is not None:
        # Only the points of the map itself are run: an interval narrower than four of them makes no limit.
        spacing = (amplitudes[1] - amplitudes[0]) / (grid[1] - 1)
        scan = {"width": STEPS_A_WIDTH * spacing, "edge": spacing / 8}
    try:
        return MapPlan(
            campaign.block(specimen),
            frequency_ratio=np.linspace(*omegas, grid[0]),
            amplitude_ratio=np.linspace(*amplitudes, grid[1]),
            restitution=measured.restitution,
            cycles=wanted.cycles,
            phase=radians(wanted.phase),
            ramp=wanted.ramp,
            model=model,
            space=space,
            **scan,
        )
    except ValueError as error:
        raise CampaignError(f"This map cannot be made: {str(error).rstrip('.')}.") from error


def _space(campaign: Campaign, layout: Layout, specimen: str) -> InSpace:
    """Body and law of contact of a specimen, as `predict` or `calibrate` has left it."""
    from colonnade.dynamics.contact.body import InSpace
    from colonnade.stages import contact

    whole, settings = campaign.specimens[specimen], campaign.processing.predict.contact
    if isinstance(whole, Whole):
        return InSpace(whole.assembly(campaign.gravity), contact.assembly_law(settings))
    law = read_done(layout.stage(specimen, "contact"))
    if law is None:
        raise CampaignError(f"{specimen}: its law of contact is not known yet. Run `colonnade calibrate` first.")
    own = contact.law_of(law)
    return InSpace(contact.body_of(contact.ContactInputs.of(campaign, specimen), own), own, settings.step)


def _around(values: Sequence[float], usual: tuple[float, float]) -> tuple[float, float]:
    """Return a range, in steps of a tenth, that includes the values with some margin; without values, the usual one."""
    if not values:
        return usual
    return float(np.floor(9 * min(values)) / 10), float(np.ceil(11 * max(values)) / 10)


def _product(
    graph: Graph, wanted: Wanted, model: str, measured: Measured, kind: str = "map", where: Where | None = None
) -> Product:
    """Plan a map or the steady responses on its axes, made in blocks or, without `where`, in one."""
    plan = plan_of(graph.campaign, graph.layout, wanted, model, measured)
    attributes, options = {"restitution_source": measured.source}, Options(plan.options)
    if kind == "map":
        attributes[ASKED] = wanted.model_dump_json(exclude={"models", "responses"})
    else:
        kept = {name: each for name, each in plan.options.items() if name not in OF_MAPS}
        options = Options(kept | {"settling": SETTLING})
    axes = [plan.frequency_ratio.tolist(), plan.amplitude_ratio.tolist()]
    given = {"block": hash_of(repr(plan.block)), "axes": hash_of(axes)}
    work = partial(_in_blocks, kind, plan, attributes)
    return graph.product(ResultId(measured.specimen, kind, model), options, given, work, *MADE_BY, where=where)


def _in_blocks(
    kind: str, plan: MapPlan, attributes: dict[str, str], *, inputs: Options, run: Run | None = None
) -> xr.Dataset:
    """Make a result over Ω and A of blocks of Ω, or at once."""
    columns, size = partial(_columns, kind, plan), plan.frequency_ratio.size
    blocks = [columns(range(size))] if run is None else run(columns, blocks_of(size))
    joined = {name: np.concatenate([block[name] for block in blocks]) for name in blocks[0]}
    return as_dataset(joined | {"amplitude_ratio": plan.amplitude_ratio}, inputs.root | attributes)


def _columns(kind: str, plan: MapPlan, indices: range) -> Arrays:
    """Work of a block: a map or responses at some Ω, as arrays over Ω."""
    from colonnade.dynamics.maps import map_part, steady_response

    found = map_part(plan, indices) if kind == "map" else steady_response(plan, indices, SETTLING)
    return {name: each for name, each in vars(found).items() if name not in ("amplitude_ratio", "options")}
