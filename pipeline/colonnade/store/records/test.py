"""The record of one test: what was measured, what each model predicts, and what its stages found."""

from __future__ import annotations

from collections.abc import Mapping
from math import isnan, nan
from typing import TYPE_CHECKING, Any, cast

import numpy as np

from colonnade.campaign import Campaign, Test
from colonnade.campaign.assembly import APART
from colonnade.campaign.forms.summary import (
    BodyPrediction,
    BodySummary,
    HistorySummary,
    IdentifiedSummary,
    Order,
    Outcome,
    PredictionSummary,
    RestitutionSummary,
    SpecimenPrototype,
    SpecimenSummary,
    TestPrototype,
    TestSummary,
    Warned,
)
from colonnade.dynamics.block import Block
from colonnade.dynamics.size import at_prototype
from colonnade.findings import in_order
from colonnade.identification.response.rank import BAND
from colonnade.store.records.stored import Stored

AT_PROTOTYPE = {"duration": "time", "frequency": "frequency", "peak_time": "time", "peak_slide": "length"}
BLOCK_AT_PROTOTYPE = {"p": "frequency", "pole_distance": "length", "mass": "mass", "inertia": "inertia"}
"""What is given at prototype scale too, of a test and of a block, and the kind of quantity by which it scales."""


def record_of_test(campaign: Campaign, test: Test, stored: Stored) -> TestSummary:
    """
    Take the record of a test from its stored results.

    Parameters
    ----------
    campaign : Campaign
    test : Test
    stored : Stored
        As `read_test` gives it.

    Returns
    -------
    record : TestSummary
        What is not known is None.
    """
    measured = _measured(test, stored)
    reason = " ".join(f"{stage}: {text}" if stage else text for stage, text in stored.failures)
    scale = campaign.specimens[test.specimen].scale
    return TestSummary(
        status=stored.status,
        reason=reason or campaign.left_out(test.id) or stored.outdated or None,
        warnings=tuple(
            Warned.of(found, explained=explained)
            for found, explained in in_order(stored.findings, campaign.concerning(test.id))
        ),
        **as_given(test),
        restitution=_identified(stored) if stored.has("restitution") else None,
        prototype=TestPrototype(**at_scale(AT_PROTOTYPE, measured, scale)) if scale and stored.has("rocking") else None,
        predicted={model: _predicted(stored, model) for model in stored.models("predict")},
        bodies=bodies_of(stored),
        **_of_comparison(stored) | measured,
    )


def bodies_of(stored: Stored) -> dict[str, BodySummary]:
    """Return the record of each body of an assembly by its id; empty for a single body."""
    names = [str(name) for name in stored.array("rocking", "body")]
    return {
        name: BodySummary(
            **_numbers(BodySummary, stored, place, "rocking"),
            separation=str(stored.array("rocking", "body_separation")[place]),
            predicted={
                model: BodyPrediction(
                    **_numbers(BodyPrediction, stored, place, "predict", model), **_spread(stored, place, model)
                )
                for model in stored.models("predict")
                if stored.has("predict", "body_outcome", model)
            },
        )
        for place, name in enumerate(names)
    }


def _spread(stored: Stored, place: int, model: str) -> dict[str, Any]:
    """What the runs of a model say of a body at a place."""
    if not stored.has("ensemble", "body_moved_band", model):
        return {}
    band = stored.array("ensemble", "body_moved_band", model)[:, place]
    falls = stored.array("ensemble", "body_overturning_probability", model)[place]
    return {"moved_low": band[0], "moved_high": band[-1], "overturning_probability": falls}


def _numbers(
    form: type[BodyPrediction], stored: Stored, place: int, stage: str, model: str | None = None
) -> dict[str, Any]:
    """What a result says of a body at a place, by the names of its record."""
    found = {key: stored.array(stage, f"body_{key}", model) for key in form.model_fields if key != "separation"}
    return {key: None if values[place] == "" else values[place] for key, values in found.items() if values.size}


def _of_comparison(stored: Stored) -> dict[str, float]:
    """Give the numbers of a test that the comparison stores by the name that they have in the record."""
    names = [name for name in TestSummary.model_fields if stored.has("rocking") and stored.has("compare", name)]
    return {name: value for name in names if not isnan(value := stored.value("compare", name))}


def as_given(test: Test) -> dict[str, Any]:
    """Return what the record of a test repeats of the campaign file."""
    given = {key: getattr(test, key) for key in ("kind", "specimen", "span", "operator", "observed_outcome")}
    return given | {"date": test.date and test.date.isoformat()}


def largest_motion(stored: Stored, name: str) -> float:
    """Return the largest magnitude of a motion while the specimen stands, NaN if it was not measured."""
    values, time = np.abs(stored.array("rocking", name)), stored.array("rocking", "elapsed")
    fall = stored.value("rocking", "overturning_time")
    standing = values[time <= (np.inf if isnan(fall) else fall)] if values.size else values
    return float(np.nanmax(standing)) if np.isfinite(standing).any() else nan


def predicted_peak_time(stored: Stored, model: str) -> float:
    """Return when a model predicts its largest angle, s; if it overturns, when it does."""
    fall = stored.value("predict", "overturning_time", model)
    return stored.value("predict", "peak_time", model) if isnan(fall) else fall


def driven_by(stored: Stored) -> str:
    """Return the base motion that drives the predictions, empty if there is no prediction."""
    return next(filter(None, (stored.text("predict", "driven_by", model) for model in stored.models("predict"))), "")


def _measured(test: Test, stored: Stored) -> dict[str, Any]:
    if not stored.has("rocking"):
        return {}
    time = stored.array("rocking", "elapsed")
    return {
        "outcome": stored.text("rocking", "outcome") or None,
        "pga": stored.value("rocking", "peak_ground_acceleration"),
        "duration": float(time[-1] - time[0]),
        "peak_slide": largest_motion(stored, "slide"),
        **(_peak(test, stored) if stored.has("rocking", "rocking_angle") else {}),
        **(_sine(test, stored) if test.kind == "sine" and stored.has("compare") else {}),
    }


def _peak(test: Test, stored: Stored) -> dict[str, Any]:
    """Give the peak that predictions are compared with; of a free vibration it is known once that is done."""
    impacts = stored.datasets["rocking", None].sizes.get("impact", 0)
    stage, before = ("compare", "measured_") if test.kind == "free-vibration" else ("rocking", "")
    fall = stored.value("rocking", "overturning_time")
    return {
        "peak_ratio": stored.value(stage, f"{before}peak_ratio"),
        "peak_time": stored.value(stage, f"{before}peak_time") if isnan(fall) else fall,
        "release_ratio": stored.value("compare", "release_ratio") if before else nan,
        "impacts": int(impacts),
    }


def _sine(test: Test, stored: Stored) -> dict[str, Any]:
    recorded = stored.value("compare", "forcing_frequency")
    return {
        "frequency": test.frequency if isnan(recorded) and test.frequency is not None else recorded,
        "order": _order(stored.text("compare", "response_order")),
        "order_reason": stored.text("compare", "response_order_reason") or None,
    }


def _predicted(stored: Stored, model: str) -> PredictionSummary:
    low, high = _peak_band(stored, model)
    compared = [name for name in PredictionSummary.model_fields if stored.has("compare", name)]
    return PredictionSummary(
        outcome=cast(Outcome, stored.text("predict", "outcome", model)),
        peak_ratio=stored.value("predict", "peak_ratio", model),
        peak_low=low,
        peak_high=high,
        order=_order(stored.by("model", "compare", "predicted_response_order").get(model, "")),
        **{name: stored.compared(name, model) for name in compared},
    )


def _peak_band(stored: Stored, model: str) -> tuple[float, float]:
    """Return the band that holds the peaks of 95 % of a model's runs; NaN where it ends with runs that overturn."""
    peaks = stored.array("ensemble", "member_peak_ratio", model)
    if not peaks.size:
        return nan, nan
    low, _, high = np.quantile(np.where(np.isfinite(peaks), peaks, np.inf), BAND, method="inverted_cdf")
    return float(low) if np.isfinite(low) else nan, float(high) if np.isfinite(high) else nan


def _order(text: str) -> Order:
    return int(text) if text.isdigit() else "irregular" if text else None


def _identified(stored: Stored) -> IdentifiedSummary:
    ends = {"value": "", "low": "_low", "high": "_high"}
    history = {name: stored.by("estimator", "restitution", f"estimate{end}") for name, end in ends.items()}
    residual = stored.array("restitution", "history_residual")
    rms = float(np.sqrt(np.nanmean(residual**2))) if residual.size else nan
    return IdentifiedSummary(
        **{name: stored.value("restitution", f"restitution{end}") for name, end in ends.items()},
        reason=stored.text("restitution", "reason") or None,
        whole_history={
            "nonlinear": HistorySummary(**{name: each["history"] for name, each in history.items()}, residual=rms)
        },
    )


def at_scale(kinds: Mapping[str, str], values: Mapping[str, float], scale: float) -> dict[str, float]:
    """Return values of these kinds of quantity at prototype scale; NaN for one that is not known."""
    return {name: at_prototype(kind, values.get(name, nan), scale) for name, kind in kinds.items()}


if TYPE_CHECKING:
    import xarray as xr


def record_of_specimen(campaign: Campaign, name: str, pooled: xr.Dataset) -> SpecimenSummary:
    """
    Take the record of a specimen.

    Parameters
    ----------
    campaign : Campaign
    name : str
    pooled : xr.Dataset
        Its restitution, as the stage `specimen` gives it.
    """
    block, is_one = campaign.block(name), campaign.specimens[name].is_in_plane
    negative, positive = (float(value) for value in pooled["side_restitution"])
    return SpecimenSummary(
        **of_block(block),
        restitution=RestitutionSummary(
            value=None if not is_one else negative if negative == positive else (negative, positive),
            low=float(pooled["restitution_low"]),
            high=float(pooled["restitution_high"]),
            level=float(pooled["level"]),
            source=pooled.attrs["restitution_source"],
            method=(pooled.attrs["method"] or None) if is_one else None,
            reason=(pooled.attrs["reason"] or None) if is_one else f"{APART[0].upper()}{APART[1:]}.",
            tests=tuple(map(str, pooled["test_id"].to_numpy())),
        ),
        prototype=specimen_prototype(campaign, name),
    )


def of_block(block: Block) -> dict[str, float]:
    """Return what the record of a specimen repeats of its block."""
    return {key: getattr(block, key) for key in ("critical_angle", "p", "pole_distance", "inertia")}


def specimen_prototype(campaign: Campaign, name: str) -> SpecimenPrototype | None:
    """Return a specimen at prototype scale, None if its scale is not given."""
    specimen, block = campaign.specimens[name], campaign.block(name)
    if (scale := specimen.scale) is None:
        return None
    return SpecimenPrototype(
        scale=scale,
        sizes=at_scale(dict.fromkeys(specimen.sizes(), "length"), specimen.sizes(), scale),
        **at_scale(BLOCK_AT_PROTOTYPE, of_block(block) | {"mass": block.mass}, scale),
    )
