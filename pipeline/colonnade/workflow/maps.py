"""Stability maps and steady responses of a campaign's specimens: products of a run or a command, and their figures."""

from __future__ import annotations

import time
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
from colonnade.identification.response.boundaries import MapPoint, Misfit, bracket_boundaries, limit_misfit, makes_map
from colonnade.store import files
from colonnade.store.layout import Layout
from colonnade.store.provenance import hash_of
from colonnade.store.records.stored import as_dataset, as_map
from colonnade.store.records.summary import map_points
from colonnade.store.results import ResultId, models_moving
from colonnade.workflow.executors import Arrays, Counted, Run, Where, blocks_of
from colonnade.workflow.graph import Graph
from colonnade.workflow.lock import only_run
from colonnade.workflow.map_plans import Wanted, measured_points, plan_of, restitution_of
from colonnade.workflow.pooling import expect_known
from colonnade.workflow.product import Catalogue, Product, stored_attributes
from colonnade.workflow.walk import Walk

if TYPE_CHECKING:
    import xarray as xr

    from colonnade.dynamics.maps import MapPlan
    from colonnade.dynamics.steady import SteadyResponse

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
    lower, upper : Misfit or None
        Distance of its limits from the measured boundary of overturning; None if that was not bracketed.
    action : str
        done, or up-to-date if nothing was recomputed.
    because : str
        Why they were made, see `StageRun`; empty if they were not.
    seconds : float
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
    lower: Misfit | None
    upper: Misfit | None
    action: str
    because: str
    seconds: float


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
    with only_run(layout) as run_id:
        walk = Walk(Graph(loaded, layout, Catalogue(layout)), run_id)
        usual = [name for name in loaded.of_interest if models_moving(loaded, name, wanted.models)]
        return [
            made
            for name in (specimens or usual or loaded.of_interest)
            for made in _of_specimen(walk, name, wanted, where)
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
            known = pair(restitution.value), restitution.source
            usual = _map(graph, specimen, Wanted(models=(model,)), model, points, known, None)[1]
            stored = stored_attributes(usual.paths[0])
            try:
                asked = _map(graph, specimen, Wanted.of(stored[ASKED], model), model, points, known, None)[1]
            except (KeyError, ValueError, TypeError, CampaignError):
                yield usual
            else:
                yield usual if asked.recipe().why(stored) else asked


def _of_specimen(walk: Walk, specimen: str, wanted: Wanted, where: Where) -> list[MapMade]:
    """Make the maps of one specimen, one for each model, and a common picture of several models."""
    layout, models = walk.graph.layout, list(dict.fromkeys(wanted.models))
    together = layout.together(specimen, models) if len(models) > 1 else None
    points = measured_points(layout, specimen)
    made = [_made(walk, specimen, wanted, model, points, together, where) for model in models]
    if together is not None:
        _draw([files.read(each.path) for each in made], points, together, specimen)
    return made


def _made(
    walk: Walk,
    specimen: str,
    wanted: Wanted,
    model: str,
    points: Sequence[MapPoint],
    together: Path | None,
    where: Where,
) -> MapMade:
    started, layout = time.perf_counter(), walk.graph.layout
    known = restitution_of(walk.graph.campaign, layout, specimen)
    plan, product = _map(walk.graph, specimen, wanted, model, points, known, where)
    stored, because = _brought(walk, product)
    _draw([stored], points, layout.figure(product.result), specimen)
    responses = responses_figure = None
    if wanted.responses:
        product = _responses(walk.graph, specimen, plan, known[1], where)
        responses, responses_figure = product.paths[0], layout.figure(product.result)
        steady, why = _brought(walk, product)
        because = why or because
        _draw_responses(as_response(steady), plan, points, responses_figure, specimen)
    boundaries, chart = bracket_boundaries(points), as_map(stored)
    lower, upper = (limit_misfit(boundaries, chart.frequency_ratio, limit) for limit in (chart.lower, chart.upper))
    return MapMade(
        specimen=specimen,
        model=model,
        restitution_source=known[1],
        path=layout.stage(specimen, "map", model),
        figure=layout.figure(ResultId(specimen, "map", model)),
        together=together,
        responses=responses,
        responses_figure=responses_figure,
        measured=len(points),
        lower=lower,
        upper=upper,
        action="done" if because else "up-to-date",
        because=because,
        seconds=time.perf_counter() - started,
    )


def _brought(walk: Walk, product: Product) -> tuple[xr.Dataset, str]:
    """Bring one map or the responses up to date here; give it, and why it was made."""
    walk.follow([[product]])
    made = walk.stages[-1]
    if made.action == "failed":
        raise StoreError(made.reason)
    return files.read(product.paths[0]), made.because


def _map(
    graph: Graph,
    specimen: str,
    wanted: Wanted,
    model: str,
    points: Sequence[MapPoint],
    restitution: tuple[Any, str],
    where: Where | None,
) -> tuple[MapPlan, Product]:
    """Plan a map, made in blocks or, without `where`, in one."""
    plan = plan_of(graph.campaign, graph.layout, specimen, wanted, model, restitution[0], points)
    asked = {} if wanted.text() == Wanted().text() else {ASKED: wanted.text()}
    attributes = {"restitution_source": restitution[1], **asked}
    make = partial(_chart, plan, attributes)
    return plan, _product(graph, ResultId(specimen, "map", model), plan, plan.options, _columns, make, where)


def _responses(graph: Graph, specimen: str, plan: MapPlan, source: str, where: Where) -> Product:
    """Plan steady responses: of the plan, its block, axes, model, restitution and sine, with `SETTLING` cycles."""
    settings, make = _settings(plan), partial(_steady, plan, {"restitution_source": source})
    return _product(graph, ResultId(specimen, "responses", plan.model), plan, settings, _steady_columns, make, where)


def _product(
    graph: Graph,
    result: ResultId,
    plan: MapPlan,
    settings: Mapping[str, Any],
    columns: Callable[[MapPlan, range], Arrays],
    make: Callable[[list[Arrays]], xr.Dataset],
    where: Where | None,
) -> Product:
    work = partial(_in_blocks, plan, columns, make)
    return graph.product(result, Options(dict(settings)), given(plan), work, *MADE_BY, where=where)


def _in_blocks(
    plan: MapPlan,
    columns: Callable[[MapPlan, range], Arrays],
    make: Callable[[list[Arrays]], xr.Dataset],
    *,
    inputs: Options,
    run: Run | None = None,
) -> xr.Dataset:
    """Make a result over Ω and A of blocks of Ω, or at once."""
    size = plan.frequency_ratio.size
    return make([columns(plan, range(size))] if run is None else run(partial(columns, plan), blocks_of(size)))


def given(plan: MapPlan) -> dict[str, str | None]:
    """Hash what a map is made from besides its options: block, axes and motion."""
    motion = None if plan.motion is None else [plan.motion.dt, plan.motion.acceleration.tolist()]
    axes = [plan.frequency_ratio.tolist(), plan.amplitude_ratio.tolist()]
    return {"block": hash_of(repr(plan.block)), "axes": hash_of(axes), "motion": hash_of(motion)}


def _columns(plan: MapPlan, indices: range) -> Arrays:
    """Work of a block: some columns of a map, as arrays over Ω."""
    from colonnade.dynamics.maps import map_part

    chart = map_part(plan, indices)
    return {name: each for name, each in vars(chart).items() if name not in ("amplitude_ratio", "options")}


def _chart(plan: MapPlan, attributes: Mapping[str, str], blocks: Sequence[Arrays]) -> xr.Dataset:
    from colonnade.dynamics.maps import StabilityMap

    whole = StabilityMap(amplitude_ratio=plan.amplitude_ratio, options=plan.options, **_joined(blocks))
    return as_dataset(whole).assign_attrs(attributes)


def _joined(blocks: Sequence[Arrays]) -> Arrays:
    return {name: np.concatenate([block[name] for block in blocks]) for name in blocks[0]}


def _draw(stored: Sequence[xr.Dataset], points: Sequence[MapPoint], path: Path, specimen: str) -> None:
    from colonnade.figures.maps import response_orders

    files.write_text(path, response_orders.computed(specimen, [as_map(each) for each in stored], points).svg)


def as_response(stored: xr.Dataset) -> SteadyResponse:
    """Return stored responses as the library gives them."""
    from colonnade.dynamics.steady import SteadyResponse

    names = ("frequency_ratio", "amplitude_ratio", "steady_order", "steady_period", "steady_peak_ratio")
    omega, amplitude, order, period, peak = (stored[name].to_numpy() for name in names)
    return SteadyResponse(omega, amplitude, order.astype(np.int8), period, peak)


def _settings(plan: MapPlan) -> dict[str, Any]:
    """All that the responses depend on apart from block and axes, by the names of a map's options."""
    kept = ("model", "phase", "ramp", "rest_angle", "critical_angle", "p")
    own = {name: each for name, each in plan.options.items() if name in kept or name.startswith("restitution_")}
    return own | {"settling": SETTLING}


def _steady_columns(plan: MapPlan, indices: range) -> Arrays:
    """Work of a block: the responses at some Ω, as arrays."""
    from colonnade.dynamics.steady import steady_response

    response = steady_response(
        plan.block,
        settling=SETTLING,
        phase=plan.phase,
        ramp=plan.ramp,
        model=plan.model,
        frequency_ratio=plan.frequency_ratio[indices.start : indices.stop],
        amplitude_ratio=plan.amplitude_ratio,
        restitution=plan.restitution,
    )
    return {
        "steady_order": response.order.astype(np.int32),
        "steady_period": response.period,
        "steady_peak_ratio": response.amplitude,
    }


def _steady(plan: MapPlan, attributes: Mapping[str, str], blocks: Sequence[Arrays]) -> xr.Dataset:
    import xarray as xr

    coordinates = {"frequency_ratio": plan.frequency_ratio, "amplitude_ratio": plan.amplitude_ratio}
    variables = {name: (tuple(coordinates), each) for name, each in _joined(blocks).items()}
    return xr.Dataset(variables, coordinates, _settings(plan) | dict(attributes))


def _draw_responses(
    response: SteadyResponse, plan: MapPlan, points: Sequence[MapPoint], path: Path, specimen: str
) -> None:
    from colonnade.figures.maps import response_orders

    files.write_text(path, response_orders.responses(specimen, response, points, _settings(plan)).svg)
