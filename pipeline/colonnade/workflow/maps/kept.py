"""The maps that a run keeps up to date: of specimens with sine tests at several frequencies, by the plane models."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from typing import TYPE_CHECKING, Any

from colonnade.campaign.forms.summary import Summary
from colonnade.dynamics.block import pair
from colonnade.dynamics.models.registry import MODELS
from colonnade.errors import CampaignError
from colonnade.identification.response.boundaries import MapPoint, makes_map
from colonnade.store.freshness import Recipe
from colonnade.store.records.summary import map_points
from colonnade.store.results import ResultId
from colonnade.workflow.catalogue import stored_attributes
from colonnade.workflow.maps.plans import Wanted, plan_of
from colonnade.workflow.maps.results import ASKED, MADE_BY, Options, given
from colonnade.workflow.maps.stability import whole_map
from colonnade.workflow.steps import Graph, Step

if TYPE_CHECKING:
    import xarray as xr

    from colonnade.dynamics.maps.plan import MapPlan


def map_steps(graph: Graph, summary: Summary, specimens: Sequence[str]) -> Iterator[Step]:
    """
    Give the steps of the maps that a run keeps.

    Parameters
    ----------
    graph : Graph
    summary : Summary
        Records of tests and specimens: the maps have to include their sine tests, and use their e.
    specimens : sequence of str
        Ids of those that may have a map.

    Yields
    ------
    step : Step
        Of the map that `colonnade map` makes without options. A map that was asked for with other options stays while
        it is up to date with its specimen.
    """
    for specimen in specimens:
        points = map_points(summary.tests, specimen)
        restitution = summary.specimens[specimen].restitution
        if makes_map(points) and restitution.value is not None:
            maps = _Maps(graph, specimen, points, pair(restitution.value), restitution.source)
            for model in graph.campaign.processing.predict.models:
                if not MODELS[model].in_space:
                    yield maps.step(model)


@dataclass(frozen=True)
class _Maps:
    """The maps of one specimen: what is known of it."""

    graph: Graph
    specimen: str
    points: Sequence[MapPoint]
    restitution: tuple[float, float]
    source: str

    def step(self, model: str) -> Step:
        """Return the step of the stored map if that was asked for and is up to date, else of the usual one."""
        result = ResultId(self.specimen, "map", model)
        stored = stored_attributes(self.graph.layout.path(result))
        try:
            asked = self._step(result, Wanted.of(stored[ASKED], model), model)
        except (KeyError, ValueError, TypeError, CampaignError):
            return self._step(result, Wanted((model,)), model)
        is_current = not Recipe(result.stage, asked.code, asked.inputs.model_dump_json(), asked.given).why(stored)
        return asked if is_current else self._step(result, Wanted((model,)), model)

    def _step(self, result: ResultId, wanted: Wanted, model: str) -> Step:
        campaign, layout = self.graph.campaign, self.graph.layout
        plan = plan_of(campaign, layout, self.specimen, wanted, model, self.restitution, self.points)
        code = self.graph.catalogue.code(MADE_BY, model)
        work = partial(_work, plan, self.source)
        return Step(result, layout.path(result), {}, Options(plan.options), work, code, given(plan))


def _work(plan: MapPlan, restitution_source: str, upstream: Mapping[str, Any], inputs: Any) -> xr.Dataset:
    return whole_map(plan, restitution_source)
