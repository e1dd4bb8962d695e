"""A test of a campaign through the stages one by one, each with the inputs that the campaign gives it."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import xarray as xr

from colonnade.campaign import Campaign, Test, load
from colonnade.readers.recording import Recording
from colonnade.stages.compare import CompareInputs, compare
from colonnade.stages.condition import ConditionInputs, condition
from colonnade.stages.ingest import IngestInputs, ingest
from colonnade.stages.ingesting.quality import ChannelInputs
from colonnade.stages.predict import PredictInputs, predict
from colonnade.stages.restitution import RestitutionInputs, restitution
from colonnade.stages.rocking import RockingInputs, rocking
from colonnade.stages.specimen import SpecimenInputs, specimen

Recordings = Mapping[str, Recording]


def _of(campaign: Campaign, test: str | Test) -> Test:
    return campaign.tests[test] if isinstance(test, str) else test


def changed(campaign: Campaign, *changes: tuple[str, str]) -> Campaign:
    """The campaign after changes of its file, each of its first place only."""
    text = campaign.path.read_text(encoding="utf-8")
    for old, new in changes:
        assert old in text
        text = text.replace(old, new, 1)
    campaign.path.write_text(text, encoding="utf-8")
    return load(campaign.path)


def plain_channel(quantity: str, **changes: Any) -> ChannelInputs:
    """A channel of the main recorder on the specimen, along x, without unit, gain and range if none are given."""
    unset = dict.fromkeys(("time", "unit", "gain", "full_scale", "range_recorded"))
    fixed = {"column": "a", "recorder": "main", "factor": 1.0, "offset": 0.0, "on": "specimen", "direction": (1, 0, 0)}
    return ChannelInputs(quantity=quantity, **unset | fixed | changes)


def ingested(campaign: Campaign, test: str | Test, recordings: Recordings, **changes: Any) -> xr.Dataset:
    """Each of these takes changes of the last stage's inputs."""
    return ingest(recordings, IngestInputs.of(campaign, _of(campaign, test)).model_copy(update=changes))


def conditioned(campaign: Campaign, test: str | Test, recordings: Recordings, **changes: Any) -> xr.Dataset:
    read = ConditionInputs.of(campaign, _of(campaign, test)).model_copy(update=changes)
    return condition(ingested(campaign, test, recordings), read)


def measured(campaign: Campaign, test: str | Test, recordings: Recordings) -> tuple[xr.Dataset, xr.Dataset]:
    """The channels on one clock, and the rocking angle from them."""
    ready = conditioned(campaign, test, recordings)
    return ready, rocking(ready, RockingInputs.of(campaign, _of(campaign, test)))


def identified(campaign: Campaign, angle: xr.Dataset, test: str = "free-01", **changes: Any) -> xr.Dataset:
    return restitution(angle, RestitutionInputs.of(campaign, campaign.tests[test]).model_copy(update=changes))


def pooled(campaign: Campaign, found: Mapping[str, xr.Dataset], **changes: Any) -> xr.Dataset:
    return specimen(found, SpecimenInputs.of(campaign, "prism").model_copy(update=changes))


def predicted(
    campaign: Campaign,
    test: str | Test,
    angle: xr.Dataset,
    of_specimen: xr.Dataset,
    model: str = "linear",
    free: xr.Dataset | None = None,
    **changes: Any,
) -> xr.Dataset:
    """`free` is the e that was identified from the same test, if it is a free vibration."""
    read = PredictInputs.of(campaign, _of(campaign, test), model).model_copy(update=changes)
    return predict(angle, of_specimen, read, None, free)


def compared(
    campaign: Campaign,
    test: str | Test,
    angle: xr.Dataset,
    predictions: Mapping[str, xr.Dataset],
    ensembles: Mapping[str, xr.Dataset] | None = None,
    **changes: Any,
) -> xr.Dataset:
    read = CompareInputs.of(campaign, _of(campaign, test)).model_copy(update=changes)
    return compare(angle, predictions, read, ensembles or {})
