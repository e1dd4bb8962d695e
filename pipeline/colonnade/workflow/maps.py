"""Stability maps and steady responses of a campaign's specimens: products of a run or a command, and their figures."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from pydantic import RootModel

from colonnade.campaign import load
from colonnade.campaign.forms.summary import Summary
from colonnade.dynamics.block import pair
from colonnade.dynamics.models import MODELS
from colonnade.errors import CampaignError, StoreError
from colonnade.identification.response.boundaries import MapPoint, makes_map
from colonnade.store import files
from colonnade.store.layout import Layout
from colonnade.store.provenance import hash_of
from colonnade.store.records.stored import as_dataset, as_map
from colonnade.store.records.summary import map_points, read_summary
from colonnade.store.results import ResultId, models_moving
from colonnade.workflow.executors import Arrays, Counted, Run, Where, blocks_of
from colonnade.workflow.graph import Graph
from colonnade.workflow.map_plans import Measured, Wanted, plan_of, restitution_of
from colonnade.workflow.pooling import expect_known
from colonnade.workflow.product import Product, stored_attributes
from colonnade.workflow.walk import Walk, walking

if TYPE_CHECKING:
    import xarray as xr

    from colonnade.dynamics.maps import MapPlan, SteadyResponse

MADE_BY = ("colonnade.dynamics.maps", "colonnade.workflow.maps")
"""Modules whose code makes maps and steady responses; what they import counts too."""

ASKED = "asked_for"
"""Attribute of a map that was asked for with options of its own: these."""

SETTLING = 400
"""Cycles at full amplitude before a response is looked at."""


class Options(RootModel[dict[str, Any]]):
    """What a map or steady responses depend on besides what is `given`, by name."""


@dataclass(frozen=True)
class MapMade:
    """
    A specimen's map.

    Attributes
    ----------
    specimen, model : str
    restitution_source : str
        given, identified or rigid-body.
    path, figure : Path
    together : Path or None
        Picture with the limits of all models, if there are several.
    responses, responses_figure : Path or None
        Steady responses, if requested.
    measured : int
        Sine tests drawn on it.
    action : str
        done, or up-to-date if nothing was recomputed.
    because : str
        Why they were made, see `StageRun`; empty if they were not.
    """

    specimen: str
    model: str
    restitution_source: str
    path: Path
    figure: Path
    together: Path | None
    responses: Path | None
    responses_figure: Path | None
    measured: int
    action: str
    because: str


def make_maps(
    campaign: Path | str,
    wanted: Wanted,
    *,
    specimens: Sequence[str] = (),
    workers: int | None = None,
    scheduler: str | None = None,
    results: Path | str | None = None,
    progress: Counted = lambda done, total: None,
) -> list[MapMade]:
    """
    Make the stability maps of a campaign's specimens, with its measured points on them.

    Parameters
    ----------
    campaign : Path or str
        A campaign.toml or its folder.
    wanted : Wanted
    specimens : sequence of str, optional
        Ids; default those that the models move, but not those that are only parts of an assembly.
    workers, scheduler : optional
        As of `spread`.
    results : Path or str, optional
        Folder that holds `processed` and `report`; default that of the campaign file.
    progress : callable, optional
        Called with the number of blocks done, and their total.

    Returns
    -------
    made : list of MapMade

    Raises
    ------
    CampaignError
        If the campaign file, a specimen or a wanted value is not usable.
    StoreError
        If a run is in progress, or results cannot be written.
    """
    loaded = load(Path(campaign))
    expect_known(loaded, "specimen", specimens)
    layout, where = Layout.of(loaded.path, results), Where(workers, scheduler, progress)
    with walking(loaded, layout, where) as walk:
        usual = [name for name in loaded.of_interest if models_moving(loaded, name, wanted.models)]
        return [
            made for name in (specimens or usual or loaded.of_interest) for made in _of_specimen(walk, name, wanted)
        ]


def kept_maps(graph: Graph, summary: Summary, specimens: Sequence[str]) -> Iterator[Product]:
    """
    Give the maps that a run keeps up to date: of specimens with sine tests at several frequencies, by the plane models.

    Parameters
    ----------
    graph : Graph
    summary : Summary
        Records of tests and specimens: the maps have to include their sine tests, and use their e.
    specimens : sequence of str
        Ids of those that may have a map.

    Yields
    ------
    map : Product
        That which `colonnade map` makes without options. One that was asked for with other options stays while it is
        up to date with its specimen.
    """
    for specimen in specimens:
        points, restitution = map_points(summary.tests, specimen), summary.specimens[specimen].restitution
        if not makes_map(points) or restitution.value is None:
            continue
        for model in models_moving(graph.campaign, specimen, graph.campaign.processing.predict.models):
            if MODELS[model].in_space:
                continue
            measured = Measured(points, pair(restitution.value), restitution.source)
            _, usual = _map(graph, specimen, Wanted(models=(model,)), model, measured)
            stored = stored_attributes(usual.paths[0])
            try:
                _, asked = _map(graph, specimen, Wanted.of(stored[ASKED], model), model, measured)
            except (KeyError, ValueError, TypeError, CampaignError):
                yield usual
            else:
                yield usual if asked.why(stored_attributes) else asked


def _of_specimen(walk: Walk, specimen: str, wanted: Wanted) -> list[MapMade]:
    """Make the maps of one specimen, one for each model, and a common picture of several models."""
    layout, models = walk.graph.layout, list(dict.fromkeys(wanted.models))
    summary = read_summary(layout)
    points = [] if summary is None else map_points(summary.tests, specimen)
    measured = Measured(points, *restitution_of(walk.graph.campaign, layout, specimen))
    together = layout.together(specimen, models) if len(models) > 1 else None
    made = [_made(walk, specimen, wanted, model, measured, together) for model in models]
    if together is not None:
        _draw([files.read(each.path) for each in made], points, together, specimen)
    return made


def _made(walk: Walk, specimen: str, wanted: Wanted, model: str, measured: Measured, together: Path | None) -> MapMade:
    from colonnade.figures.maps import response_orders

    layout = walk.graph.layout
    plan, product = _map(walk.graph, specimen, wanted, model, measured, walk.where)
    stored, because = _brought(walk, product)
    figure = layout.figure(product.result)
    _draw([stored], measured.points, figure, specimen)
    responses = responses_figure = None
    if wanted.responses:
        asked = _responses(walk.graph, specimen, plan, measured.source, walk.where)
        responses, responses_figure = asked.paths[0], layout.figure(asked.result)
        steady, why = _brought(walk, asked)
        because = why or because
        drawn = response_orders.responses(specimen, as_response(steady), measured.points, _settings(plan))
        files.write_text(responses_figure, drawn.svg)
    return MapMade(
        specimen=specimen,
        model=model,
        restitution_source=measured.source,
        path=product.paths[0],
        figure=figure,
        together=together,
        responses=responses,
        responses_figure=responses_figure,
        measured=len(measured.points),
        action="done" if because else "up-to-date",
        because=because,
    )


def _brought(walk: Walk, product: Product) -> tuple[xr.Dataset, str]:
    """Bring one map or the responses up to date here; give it, and why it was made."""
    walk.follow([[product]])
    made = walk.stages[-1]
    if made.action == "failed":
        raise StoreError(made.reason)
    return files.read(product.paths[0]), made.because


def _map(
    graph: Graph, specimen: str, wanted: Wanted, model: str, measured: Measured, where: Where | None = None
) -> tuple[MapPlan, Product]:
    """Plan a map, made in blocks or, without `where`, in one."""
    plan = plan_of(graph.campaign, graph.layout, specimen, wanted, model, measured)
    asked = {} if wanted.text() == Wanted().text() else {ASKED: wanted.text()}
    work = partial(_in_blocks, _columns, _chart, plan, {"restitution_source": measured.source, **asked})
    options = Options(plan.options)
    return plan, graph.product(ResultId(specimen, "map", model), options, given(plan), work, *MADE_BY, where=where)


def _responses(graph: Graph, specimen: str, plan: MapPlan, source: str, where: Where) -> Product:
    """Plan steady responses: of the plan, its block, axes, model, restitution and sine, with `SETTLING` cycles."""
    work = partial(_in_blocks, _steady_columns, _steady, plan, {"restitution_source": source})
    result, options = ResultId(specimen, "responses", plan.model), Options(_settings(plan))
    return graph.product(result, options, given(plan), work, *MADE_BY, where=where)


def _in_blocks(
    columns: Callable[[MapPlan, range], Arrays],
    make: Callable[[MapPlan, Arrays], xr.Dataset],
    plan: MapPlan,
    attributes: Mapping[str, str],
    *,
    inputs: Options,
    run: Run | None = None,
) -> xr.Dataset:
    """Make a result over Ω and A of blocks of Ω, or at once."""
    size = plan.frequency_ratio.size
    blocks = [columns(plan, range(size))] if run is None else run(partial(columns, plan), blocks_of(size))
    joined = {name: np.concatenate([block[name] for block in blocks]) for name in blocks[0]}
    return make(plan, joined).assign_attrs(attributes)


def given(plan: MapPlan) -> dict[str, str | None]:
    """Hash what a map is made from besides its options: block and axes."""
    axes = [plan.frequency_ratio.tolist(), plan.amplitude_ratio.tolist()]
    return {"block": hash_of(repr(plan.block)), "axes": hash_of(axes)}


def _columns(plan: MapPlan, indices: range) -> Arrays:
    """Work of a block: some columns of a map, as arrays over Ω."""
    from colonnade.dynamics.maps import map_part

    chart = map_part(plan, indices)
    return {name: each for name, each in vars(chart).items() if name not in ("amplitude_ratio", "options")}


def _chart(plan: MapPlan, joined: Arrays) -> xr.Dataset:
    from colonnade.dynamics.maps import StabilityMap

    return as_dataset(StabilityMap(amplitude_ratio=plan.amplitude_ratio, options=plan.options, **joined))


def _draw(stored: Sequence[xr.Dataset], points: Sequence[MapPoint], path: Path, specimen: str) -> None:
    from colonnade.figures.maps import response_orders

    files.write_text(path, response_orders.computed(specimen, [as_map(each) for each in stored], points).svg)


STEADY = {"order": "steady_order", "amplitude": "steady_peak_ratio"}
"""What steady responses are, and the variable of each in their result."""


def as_response(stored: xr.Dataset) -> SteadyResponse:
    """Return stored responses as the library gives them."""
    from colonnade.dynamics.maps import SteadyResponse

    axes = (stored[name].to_numpy() for name in ("frequency_ratio", "amplitude_ratio"))
    return SteadyResponse(*axes, **{own: stored[name].to_numpy() for own, name in STEADY.items()})


def _settings(plan: MapPlan) -> dict[str, Any]:
    """All that the responses depend on apart from block and axes, by the names of a map's options."""
    kept = ("model", "phase", "ramp", "rest_angle", "critical_angle", "p")
    own = {name: each for name, each in plan.options.items() if name in kept or name.startswith("restitution_")}
    return own | {"settling": SETTLING}


def _steady_columns(plan: MapPlan, indices: range) -> Arrays:
    """Work of a block: the responses at some Ω, as arrays."""
    from colonnade.dynamics.maps import steady_response

    response = steady_response(plan, indices, SETTLING)
    return {name: getattr(response, own) for own, name in STEADY.items()}


def _steady(plan: MapPlan, joined: Arrays) -> xr.Dataset:
    import xarray as xr

    coordinates = {"frequency_ratio": plan.frequency_ratio, "amplitude_ratio": plan.amplitude_ratio}
    variables = {name: (tuple(coordinates), each) for name, each in joined.items()}
    return xr.Dataset(variables, coordinates, _settings(plan))
