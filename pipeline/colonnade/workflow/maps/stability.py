"""Stability maps of a campaign's specimens: planned from earlier results, made in blocks, stored, drawn."""

from __future__ import annotations

import time
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from colonnade.campaign import Campaign, load
from colonnade.errors import CampaignError, nearest
from colonnade.identification.response.boundaries import MapPoint, Misfit, bracket_boundaries, limit_misfit
from colonnade.store import files
from colonnade.store.layout import Layout
from colonnade.store.records.stability_map import as_dataset, as_map
from colonnade.store.results import ResultId
from colonnade.workflow.execution.blocks import Counted, Spread, blocks_of, in_blocks
from colonnade.workflow.execution.lock import only_run
from colonnade.workflow.maps.plans import Wanted, measured_points, plan_of, restitution_of
from colonnade.workflow.maps.responses import make_responses
from colonnade.workflow.maps.results import ASKED, bring_up_to_date

if TYPE_CHECKING:
    import xarray as xr

    from colonnade.dynamics.maps.plan import MapPlan


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
    progress: Counted | None = None,
) -> list[MapMade]:
    """
    Make the stability maps of a campaign's specimens, with its measured points on them.

    Parameters
    ----------
    campaign : Path or str
        A campaign.toml or its folder.
    wanted : Wanted
    specimens : sequence of str, optional
        Ids; default all.
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
    for name in specimens:
        if name not in loaded.specimens:
            raise CampaignError(f'{loaded.path.name} has no specimen "{name}".{nearest(name, loaded.specimens)}')
    layout = Layout.of(loaded.path, results)
    with only_run(layout):
        spread = partial(in_blocks, workers=workers, scheduler=scheduler, progress=progress)
        return [
            made
            for name in (specimens or loaded.specimens)
            for made in _of_specimen(loaded, layout, name, wanted, spread)
        ]


def _of_specimen(campaign: Campaign, layout: Layout, specimen: str, wanted: Wanted, spread: Spread) -> list[MapMade]:
    """Make the maps of one specimen, one for each model, and a common picture of several models."""
    models = list(dict.fromkeys(wanted.models))
    together = layout.together(specimen, models) if len(models) > 1 else None
    points = measured_points(layout, specimen)
    made = [_make(campaign, layout, specimen, wanted, model, points, together, spread) for model in models]
    if together is not None:
        _draw([files.read(each.path) for each in made], points, together, specimen)
    return made


def _make(
    campaign: Campaign,
    layout: Layout,
    specimen: str,
    wanted: Wanted,
    model: str,
    points: Sequence[MapPoint],
    together: Path | None,
    spread: Spread,
) -> MapMade:
    started = time.perf_counter()
    restitution, source = restitution_of(campaign, layout, specimen)
    plan = plan_of(campaign, layout, specimen, wanted, model, restitution, points)
    result = ResultId(specimen, "map", model)
    make = partial(_chart, plan, source, spread)
    asked = {} if wanted.text() == Wanted().text() else {ASKED: wanted.text()}
    stored, because = bring_up_to_date(campaign, layout, result, plan, plan.options, asked, make)
    _draw([stored], points, layout.figure(result), specimen)
    responses = responses_figure = None
    if wanted.responses:
        steady = ResultId(specimen, "responses", model)
        responses, responses_figure = layout.path(steady), layout.figure(steady)
        because = make_responses(campaign, layout, specimen, plan, points, source, spread) or because
    boundaries, chart = bracket_boundaries(points), as_map(stored)
    lower, upper = (limit_misfit(boundaries, chart.frequency_ratio, limit) for limit in (chart.lower, chart.upper))
    return MapMade(
        specimen=specimen,
        model=model,
        restitution_source=source,
        path=layout.path(result),
        figure=layout.figure(result),
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


def whole_map(plan: MapPlan, restitution_source: str) -> xr.Dataset:
    """Make a map in this process alone."""
    return _assembled(plan, restitution_source, [_columns(plan, range(plan.frequency_ratio.size))])


def _chart(plan: MapPlan, restitution_source: str, spread: Spread, folder: Path, key: str) -> xr.Dataset:
    blocks = spread(partial(_columns, plan), blocks_of(plan.frequency_ratio.size), folder, key)
    return _assembled(plan, restitution_source, blocks)


def _assembled(plan: MapPlan, restitution_source: str, blocks: Iterable[Mapping[str, NDArray[Any]]]) -> xr.Dataset:
    from colonnade.dynamics.maps.chart import assemble
    from colonnade.dynamics.maps.column import MapColumn

    columns = []
    for arrays in blocks:
        ends = np.cumsum(arrays["intervals_of_column"])
        intervals = np.split(arrays["intervals"], ends[:-1])
        columns += [
            MapColumn(outcome, fraction, onset, lower, upper, own)
            for outcome, fraction, (onset, lower, upper), own in zip(
                arrays["outcome"], arrays["fraction"], arrays["limits"].tolist(), intervals, strict=True
            )
        ]
    return as_dataset(assemble(plan, columns)).assign_attrs(restitution_source=restitution_source)


def _columns(plan: MapPlan, indices: range) -> dict[str, NDArray[Any]]:
    """Work of a block: some columns of a map, as arrays."""
    from colonnade.dynamics.maps.column import map_column

    columns = [map_column(plan, index) for index in indices]
    return {
        "outcome": np.stack([column.outcome for column in columns]),
        "fraction": np.stack([column.overturning_fraction for column in columns]),
        "limits": np.array([(column.no_rocking, column.lower, column.upper) for column in columns]),
        "intervals": np.concatenate([column.intervals for column in columns]),
        "intervals_of_column": np.array([len(column.intervals) for column in columns]),
    }


def _draw(stored: Sequence[xr.Dataset], points: Sequence[MapPoint], path: Path, specimen: str) -> None:
    from colonnade.figures.stored import maps

    files.write_text(path, maps.computed(specimen, [as_map(each) for each in stored], points).svg)
