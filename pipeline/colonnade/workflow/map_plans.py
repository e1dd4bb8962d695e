"""What a stability map of a specimen has to show, and the plan that follows from it and from earlier results."""

from __future__ import annotations

import json
from collections.abc import Sequence
from math import radians
from typing import TYPE_CHECKING, Annotated, NamedTuple

import numpy as np
from pydantic import Field

from colonnade.campaign import Campaign
from colonnade.campaign.assembly import APART, Whole
from colonnade.campaign.syntax.fields import MOST_CYCLES, Limits, MapPoints, MapRatio, Number, OneOf
from colonnade.campaign.syntax.table import Table
from colonnade.dynamics.block import Sided
from colonnade.dynamics.models import MODELS, NONLINEAR
from colonnade.errors import CampaignError
from colonnade.identification.response.boundaries import MapPoint
from colonnade.store import files
from colonnade.store.layout import Layout
from colonnade.store.results import models_moving
from colonnade.workflow.pooling import restitution_taken

if TYPE_CHECKING:
    from colonnade.dynamics.contact.body import InSpace
    from colonnade.dynamics.maps import MapPlan

USUAL_FREQUENCIES = (1.0, 8.0)
"""Ω of a map of a specimen without sine tests."""
LOWEST_AMPLITUDE, USUAL_AMPLITUDE = 0.5, 8.0
"""Smallest A of a map, and the least value of its largest A: the upper limit is far above the tests."""
LARGEST_AMPLITUDE_IN_SPACE = 3.5
"""The same largest A if the contact model is among the models."""


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

    def text(self) -> str:
        """Write what a map of one model is asked for with, as it is stored with the map; of others, those in space."""
        in_space = tuple(name for name in self.models if MODELS[name].in_space)
        return self.model_copy(update={"models": in_space}).model_dump_json(exclude={"responses"})

    @classmethod
    def of(cls, text: str, model: str) -> Wanted:
        """Read what a stored map of a model was asked for with; raises ValueError or TypeError if that is altered."""
        asked = json.loads(text)
        return cls(**asked | {"models": tuple(dict.fromkeys((model, *asked["models"])))})


class Measured(NamedTuple):
    """What was measured of a specimen: its sine tests, which a map has to include, its e, and where that comes from."""

    points: Sequence[MapPoint]
    restitution: Sided
    source: str


def plan_of(
    campaign: Campaign, layout: Layout, specimen: str, wanted: Wanted, model: str, measured: Measured
) -> MapPlan:
    """
    Plan a specimen's map.

    Raises
    ------
    CampaignError
        If no map can be made so, or the model does not move the specimen.
    """
    from colonnade.dynamics.maps import EDGE, MapPlan
    from colonnade.dynamics.search import STEPS_A_WIDTH, WIDTH

    if model not in models_moving(campaign, specimen, (model,)):
        raise CampaignError(
            f"{specimen}: {APART}, which the {model} model moves. Give --model contact, or another --specimen."
        )
    omegas = wanted.omega or _around([point.frequency_ratio for point in measured.points], USUAL_FREQUENCIES)
    largest = max((1.2 * point.amplitude_ratio for point in measured.points), default=0.0)
    space = _space(campaign, layout, specimen) if MODELS[model].in_space else None
    in_space = [MODELS[name] for name in wanted.models if MODELS[name].in_space]
    usual = LARGEST_AMPLITUDE_IN_SPACE if in_space else USUAL_AMPLITUDE
    amplitudes = wanted.amplitude or (LOWEST_AMPLITUDE, max(usual, float(np.ceil(largest * 2) / 2)))
    grid = wanted.points or MODELS[model].map_points
    width, edge = WIDTH, EDGE
    if in_space:
        # A contact map runs its own points only: an interval narrower than four of them makes no limit, nor does it
        # on the maps of other models in the same picture.
        points_in_space = wanted.points or in_space[0].map_points
        spacing = (amplitudes[1] - amplitudes[0]) / (points_in_space[1] - 1)
        width, edge = STEPS_A_WIDTH * spacing, EDGE if space is None else spacing / 8
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
            width=width,
            edge=edge,
            space=space,
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
    path = layout.stage(specimen, "contact")
    law = files.read(path) if path.is_file() else None
    if law is None or law.attrs["status"] != "done":
        raise CampaignError(f"{specimen}: its law of contact is not known yet. Run `colonnade calibrate` first.")
    own = contact.law_of(law)
    return InSpace(contact.body_of(contact.ContactInputs.of(campaign, specimen), own), own, settings.step)


def _around(values: Sequence[float], usual: tuple[float, float]) -> tuple[float, float]:
    """Return a range, in steps of a tenth, that includes the values with some margin; without values, the usual one."""
    if not values:
        return usual
    return float(np.floor(9 * min(values)) / 10), float(np.ceil(11 * max(values)) / 10)


def restitution_of(campaign: Campaign, layout: Layout, specimen: str) -> tuple[Sided, str]:
    """Return e as predictions use it, and where it comes from."""
    pooled = restitution_taken(campaign, layout, specimen)
    negative, positive = (float(e) for e in pooled["side_restitution"])
    return (negative, positive), str(pooled.attrs["restitution_source"])
