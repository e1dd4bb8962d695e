"""Pictures of maps: measured sine tests, computed stability and steady responses over frequency and amplitude."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

from colonnade.dynamics.maps import StabilityMap
from colonnade.dynamics.steady import SteadyResponse
from colonnade.figures.files.output import Picture
from colonnade.figures.maps.measured_map import measured_map
from colonnade.figures.maps.response_orders import response_orders
from colonnade.figures.maps.stability_map import stability_map
from colonnade.identification.response.boundaries import MapPoint


def tested(identity: str, points: Sequence[MapPoint]) -> Picture:
    """Draw the sine tests of a specimen by outcome over Ω and A."""
    outcomes = [point.outcome for point in points]
    described = ", ".join(f"{outcomes.count(outcome)} {outcome}" for outcome in dict.fromkeys(outcomes))
    return Picture(
        measured_map(points, linked=True),
        identity,
        "Sine tests by outcome over frequency ratio Ω and amplitude ratio A",
        f"{len(points)} tests: {described}.",
    )


def computed(
    specimen: str, charts: Sequence[StabilityMap], points: Sequence[MapPoint], *, linked: bool = False
) -> Picture:
    """Draw the stability maps of a specimen, one for each model, with its sine tests, as links if `linked`."""
    models = [str(chart.options["model"]) for chart in charts]
    return Picture(
        stability_map(charts, points, linked=linked),
        f"map-{specimen}-{'-'.join(models)}",
        f"Stability map of {specimen}, {' and '.join(models)} model",
        f"Outcomes over frequency ratio Ω and amplitude ratio A, with {len(points)} measured points.",
    )


def responses(
    specimen: str, response: SteadyResponse, points: Sequence[MapPoint], options: Mapping[str, Any]
) -> Picture:
    """Draw the steady responses of a specimen by their order, with its measured sine tests."""
    model = str(options["model"])
    return Picture(
        response_orders(response, points, options),
        f"response-{specimen}-{model}",
        f"Steady responses of {specimen}, {model} model",
        f"Orders over frequency ratio Ω and amplitude ratio A, with {len(points)} measured points.",
    )
