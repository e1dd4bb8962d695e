"""What of a test's results goes into its record of the summary."""

from __future__ import annotations

from collections.abc import Mapping
from math import isfinite, nan
from typing import Any

import numpy as np

from colonnade.campaign import Campaign, Test
from colonnade.campaign.summary import (
    HistorySummary,
    IdentifiedSummary,
    Order,
    PredictionSummary,
    SpecimenPrototype,
    TestPrototype,
)
from colonnade.dynamics.similitude import at_prototype
from colonnade.stages.peak import known_peak

Results = Mapping[str, Any]

_SPREAD = ("horizon", "within_spread", "peak_rank", "overturning_probability")
"""What a comparison with a model's ensemble says."""


def measured(campaign: Campaign, test: Test, done: Results) -> dict[str, Any]:
    """
    Gather what was measured.

    Parameters
    ----------
    campaign : Campaign
    test : Test
    done : mapping of str to xr.Dataset
        The results that there are, by stage.

    Returns
    -------
    fields : dict
        Of `TestSummary`.
    """
    rocking = done.get("rocking")
    if rocking is None:
        return {}
    time = rocking["elapsed"].to_numpy()
    fields: dict[str, Any] = {
        "outcome": rocking.attrs["outcome"] or None,
        "pga": float(rocking["peak_ground_acceleration"]),
        "duration": float(time[-1] - time[0]),
    }
    if "rocking_angle" in rocking:
        peak = known_peak(rocking, done.get("compare"), free_vibration=test.kind == "free-vibration")
        fields |= {"peak_ratio": peak.ratio, "peak_time": peak.time, "release_ratio": peak.release}
        fields["impacts"] = int(rocking.sizes.get("impact", 0))
    if "slide" in rocking:
        overturning = float(rocking["overturning_time"])
        slide = np.abs(rocking["slide"].to_numpy()[time <= overturning if isfinite(overturning) else slice(None)])
        fields["peak_slide"] = float(np.nanmax(slide)) if np.isfinite(slide).any() else nan
    if test.kind == "sine":
        fields |= _sine(test, done.get("compare"))
    if "restitution" in done:
        fields["restitution"] = _identified(done["restitution"])
    scale = campaign.specimens[test.specimen].scale
    if scale is not None:
        fields["prototype"] = _prototype(fields, scale)
    return fields


def predicted(done: Results, model: str) -> PredictionSummary:
    """Gather what one model says of a test."""
    result, nrmse, order, spread = done[f"predict-{model}"], nan, None, {}
    if "compare" in done and model in (models := list(done["compare"]["model"].to_numpy())):
        compared, place = done["compare"], models.index(model)
        nrmse = float(compared["nrmse"].to_numpy()[place])
        if "predicted_response_order" in compared:
            order = _order(str(compared["predicted_response_order"].to_numpy()[place]))
        spread = {name: float(compared[name].to_numpy()[place]) for name in _SPREAD if name in compared}
    return PredictionSummary(
        outcome=result.attrs["outcome"], peak_ratio=float(result["peak_ratio"]), nrmse=nrmse, order=order, **spread
    )


def specimen_prototype(campaign: Campaign, name: str) -> SpecimenPrototype | None:
    """Return a specimen at prototype scale, None where its scale is not given."""
    specimen, block = campaign.specimens[name], campaign.block(name)
    if specimen.scale is None:
        return None
    return SpecimenPrototype(
        scale=specimen.scale,
        p=at_prototype("frequency", block.p, specimen.scale),
        pole_distance=at_prototype("length", block.pole_distance, specimen.scale),
        mass=at_prototype("mass", block.mass, specimen.scale),
        inertia=at_prototype("inertia", block.inertia, specimen.scale),
        sizes={key: at_prototype("length", size, specimen.scale) for key, size in specimen.sizes().items()},
    )


def _sine(test: Test, compared: Any) -> dict[str, Any]:
    if compared is None:
        return {}
    found = {
        name: float(compared[variable]) if variable in compared else nan
        for name, variable in (
            ("frequency", "forcing_frequency"),
            ("frequency_ratio", "frequency_ratio"),
            ("amplitude_ratio", "amplitude_ratio"),
            ("impacts_per_cycle", "impacts_per_cycle"),
        )
    }
    if not isfinite(found["frequency"]) and test.frequency is not None:
        found["frequency"] = test.frequency
    return {
        **found,
        "order": _order(compared.attrs.get("response_order", "")),
        "order_reason": compared.attrs.get("response_order_reason") or None,
    }


def _order(text: str) -> Order:
    if not text:
        return None
    return "irregular" if text == "irregular" else int(text)


def _identified(result: Any) -> IdentifiedSummary:
    histories = {
        str(model): HistorySummary(
            **{
                name: float(result[f"restitution_history{suffix}"].to_numpy()[place])
                for name, suffix in (("value", ""), ("low", "_low"), ("high", "_high"), ("residual", "_residual"))
            }
        )
        for place, model in enumerate(result["model"].to_numpy())
    }
    return IdentifiedSummary(
        value=float(result["restitution"]),
        low=float(result["restitution_low"]),
        high=float(result["restitution_high"]),
        reason=result.attrs["reason"] or None,
        whole_history=histories,
    )


def _prototype(fields: Mapping[str, Any], scale: float) -> TestPrototype:
    quantities = {"duration": "time", "frequency": "frequency", "peak_time": "time", "peak_slide": "length"}
    return TestPrototype(
        **{name: at_prototype(quantity, fields.get(name, nan), scale) for name, quantity in quantities.items()}
    )
