"""What a stability map of a specimen is asked for, and the plan that follows from it and from what is known."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from math import isfinite, nan
from typing import TYPE_CHECKING, cast, get_args

import numpy as np

from colonnade.campaign import Campaign
from colonnade.campaign.summary import Summary
from colonnade.dynamics.block import Sided
from colonnade.dynamics.history import Outcome
from colonnade.errors import CampaignError, StoreError, nearest
from colonnade.identification.boundaries import MapPoint
from colonnade.store import files
from colonnade.store.layout import Layout

if TYPE_CHECKING:
    from colonnade.dynamics.maps.plan import MapPlan
    from colonnade.dynamics.motion import Motion

USUAL_FREQUENCIES = (1.0, 8.0)
"""Ω of a map of a specimen that was not tested by sines."""
LOWEST_AMPLITUDE, USUAL_AMPLITUDE = 0.5, 8.0
"""A from which a map starts, and up to which it goes at least: the upper limit lies high above the tests."""
USUAL_POINTS = (100, 150)
"""Ω and A of a map."""


@dataclass(frozen=True)
class Wanted:
    """
    What a map is asked to show.

    Attributes
    ----------
    model : str
    frequency_ratio, amplitude_ratio : pair of float or None
        First and last Ω and A; by default they hold the specimen's sine tests.
    points : pair of int
        How many of each.
    cycles, phase, ramp : float
        Of the sine, see `dynamics.maps.chart.stability_map`.
    motion : str or None
        Id of a sine test whose recorded table motion is taken instead, stretched to Ω and scaled to A.
    """

    model: str = "linear"
    frequency_ratio: tuple[float, float] | None = None
    amplitude_ratio: tuple[float, float] | None = None
    points: tuple[int, int] = USUAL_POINTS
    cycles: float = 20.0
    phase: float = 0.0
    ramp: float = 0.0
    motion: str | None = None


def measured_points(layout: Layout, specimen: str) -> list[MapPoint]:
    """Sine tests of a specimen whose Ω, A and outcome the last run knows; none where there was no run."""
    try:
        summary = Summary.model_validate_json(layout.summary_json.read_text(encoding="utf-8"))
    except (OSError, ValueError):
        return []
    points = []
    for name, test in summary.tests.items():
        outcome = test.outcome or test.observed_outcome
        ratios = (_known(test.frequency_ratio), _known(test.amplitude_ratio))
        if test.specimen == specimen and all(map(isfinite, ratios)) and outcome in get_args(Outcome):
            points.append(MapPoint(name, *ratios, cast(Outcome, outcome), test.order))
    return points


def plan_of(
    campaign: Campaign,
    layout: Layout,
    specimen: str,
    wanted: Wanted,
    restitution: Sided,
    points: Sequence[MapPoint],
) -> MapPlan:
    """
    Plan a specimen's map.

    Parameters
    ----------
    campaign : Campaign
    layout : Layout
    specimen : str
    wanted : Wanted
    restitution : float or pair of float
    points : sequence of MapPoint
        Sine tests that the map holds, where nothing else is wanted.

    Raises
    ------
    CampaignError
        If what is wanted is out of its range.
    """
    from colonnade.dynamics.maps.plan import plan_map

    motion, frequency = (None, None) if wanted.motion is None else _recorded(campaign, layout, wanted.motion)
    omegas = wanted.frequency_ratio or _around([point.frequency_ratio for point in points], USUAL_FREQUENCIES)
    largest = max((1.2 * point.amplitude_ratio for point in points), default=0.0)
    amplitudes = wanted.amplitude_ratio or (LOWEST_AMPLITUDE, max(USUAL_AMPLITUDE, float(np.ceil(largest * 2) / 2)))
    try:
        return plan_map(
            campaign.block(specimen),
            frequency_ratio=np.linspace(*omegas, wanted.points[0]),
            amplitude_ratio=np.linspace(*amplitudes, wanted.points[1]),
            restitution=restitution,
            cycles=wanted.cycles,
            phase=wanted.phase,
            ramp=wanted.ramp,
            model=wanted.model,
            motion=motion,
            motion_frequency=frequency,
        )
    except ValueError as error:
        raise CampaignError(f"This map cannot be made: {error}.") from error


def _around(values: Sequence[float], usual: tuple[float, float]) -> tuple[float, float]:
    """Return a range, in steps of a tenth, that holds the values with room beside; else the usual one."""
    if not values:
        return usual
    return float(np.floor(9 * min(values)) / 10), float(np.ceil(11 * max(values)) / 10)


def restitution_of(campaign: Campaign, layout: Layout, specimen: str) -> tuple[Sided, str]:
    """Return e as predictions take it, and where it comes from."""
    given = campaign.specimens[specimen].restitution
    if given is not None:
        return given, "given"
    try:
        pooled = files.read(layout.specimen(specimen))
    except StoreError:
        return campaign.block(specimen).restitution, "rigid-body"
    if pooled.attrs["status"] != "done":
        return campaign.block(specimen).restitution, "rigid-body"
    negative, positive = (float(e) for e in pooled["side_restitution"])
    return (negative, positive), str(pooled.attrs["restitution_source"])


def _recorded(campaign: Campaign, layout: Layout, test: str) -> tuple[Motion, float]:
    """Return the recorded table motion of a sine test, and its frequency (Hz)."""
    from colonnade.dynamics.motion import Motion

    if test not in campaign.tests:
        raise CampaignError(f'{campaign.path.name} has no test "{test}".{nearest(test, campaign.tests)}')
    rocking, compared = (layout.stage(test, stage) for stage in ("rocking", "compare"))
    base, sine = files.read(rocking), files.read(compared)
    frequency = float(sine["forcing_frequency"]) if "forcing_frequency" in sine else nan
    if "base_acceleration" not in base or not isfinite(frequency):
        raise CampaignError(
            f"{test}: its table motion cannot be stretched over a map. A sine test whose table acceleration is "
            "recorded and steady was expected, as `colonnade show tests` lists them with their Ω."
        )
    time = base["elapsed"].to_numpy()
    return Motion(base["base_acceleration"].to_numpy(), float(time[1] - time[0])), frequency


def _known(value: float | None) -> float:
    return nan if value is None else value
