"""Steady responses of a specimen to sines over Ω and A: planned like a stability map, made in blocks, stored, drawn."""

from __future__ import annotations

from collections.abc import Sequence
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from colonnade.campaign import Campaign
from colonnade.identification.response.boundaries import MapPoint
from colonnade.store import files
from colonnade.store.layout import Layout
from colonnade.store.results import ResultId
from colonnade.workflow.execution.blocks import Spread, blocks_of
from colonnade.workflow.maps.results import bring_up_to_date

if TYPE_CHECKING:
    import xarray as xr

    from colonnade.dynamics.maps.plan import MapPlan
    from colonnade.dynamics.maps.steady import SteadyResponse

SETTLING = 400
"""Cycles at full amplitude before a response is looked at."""


def make_responses(
    campaign: Campaign,
    layout: Layout,
    specimen: str,
    plan: MapPlan,
    points: Sequence[MapPoint],
    restitution_source: str,
    spread: Spread,
) -> str:
    """
    Make the steady responses of a specimen if they are out of date, and draw them.

    Parameters
    ----------
    campaign : Campaign
    layout : Layout
    specimen : str
    plan : MapPlan
        Its block, axes, model, restitution and sine are used, with `SETTLING` cycles.
    points : sequence of MapPoint
        Measured sine tests that are drawn on them.
    restitution_source : str
    spread : Spread

    Returns
    -------
    because : str
        Why they were made; empty if they were up to date.

    Raises
    ------
    StoreError
        If they cannot be written.
    """
    result = ResultId(specimen, "responses", plan.model)
    make, attributes = partial(_responses, plan, spread), {"restitution_source": restitution_source}
    stored, because = bring_up_to_date(campaign, layout, result, plan, _settings(plan), attributes, make)
    _draw(as_response(stored), plan, points, layout, specimen)
    return because


def as_response(stored: xr.Dataset) -> SteadyResponse:
    """Return stored responses as the library gives them."""
    from colonnade.dynamics.maps.steady import SteadyResponse

    return SteadyResponse(
        stored["frequency_ratio"].to_numpy(),
        stored["amplitude_ratio"].to_numpy(),
        stored["steady_order"].to_numpy().astype(np.int8),
        stored["steady_period"].to_numpy(),
        stored["steady_peak_ratio"].to_numpy(),
    )


def _settings(plan: MapPlan) -> dict[str, Any]:
    """All that the responses depend on apart from block and axes, by the names of a map's options."""
    kept = ("model", "phase", "ramp", "rest_angle", "critical_angle", "p")
    options = plan.options
    return {name: options[name] for name in options if name in kept or name.startswith("restitution_")} | {
        "settling": SETTLING
    }


def _columns(plan: MapPlan, indices: range) -> dict[str, NDArray[Any]]:
    """Work of a block: the responses at some Ω, as arrays."""
    from colonnade.dynamics.maps.steady import steady_response

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
    return {"order": response.order, "period": response.period, "amplitude": response.amplitude}


def _responses(plan: MapPlan, spread: Spread, folder: Path, key: str) -> xr.Dataset:
    import xarray as xr

    parts = spread(partial(_columns, plan), blocks_of(plan.frequency_ratio.size), folder, key)
    cells = ("frequency_ratio", "amplitude_ratio")
    order, period, amplitude = (np.concatenate([part[name] for part in parts]) for name in parts[0])
    return xr.Dataset(
        {
            "steady_order": (cells, order.astype(np.int32)),
            "steady_period": (cells, period),
            "steady_peak_ratio": (cells, amplitude),
        },
        coords={"frequency_ratio": plan.frequency_ratio, "amplitude_ratio": plan.amplitude_ratio},
        attrs=_settings(plan),
    )


def _draw(response: SteadyResponse, plan: MapPlan, points: Sequence[MapPoint], layout: Layout, specimen: str) -> None:
    from colonnade.figures.stored import maps

    picture = maps.responses(specimen, response, points, _settings(plan))
    files.write_text(layout.figure(ResultId(specimen, "responses", plan.model)), picture.svg)
