"""Restitution: the rocking angle of a free vibration -> impacts, peaks, e with its interval."""

from __future__ import annotations

from collections.abc import Mapping
from math import exp
from typing import TYPE_CHECKING, Any

import numpy as np

from colonnade.campaign import Campaign, Test
from colonnade.campaign.settings import RestitutionSettings
from colonnade.dynamics.block import Block
from colonnade.dynamics.uncertainty import Uncertainty
from colonnade.errors import StageError
from colonnade.findings import MEASUREMENT, Finding, warning
from colonnade.identification.restitution.identify import identify_restitution
from colonnade.identification.restitution.noise import ORDER
from colonnade.identification.restitution.result import Restitution
from colonnade.store.provenance import Inputs

if TYPE_CHECKING:
    import xarray as xr

PEAKS = {
    "peak_time": "time",
    "peak_angle": "angle",
    "peak_angle_standard_error": "standard_error",
    "fitted_angle": "fitted_angle",
    "peak_used": "used",
}
IMPACTS = {
    "impact_time": "time",
    "impact_time_standard_error": "time_standard_error",
    "impact_velocity": "velocity",
    "impact_restitution": "restitution",
    "impact_restitution_standard_error": "restitution_standard_error",
    "impact_used": "used",
}
ENDS = {"": "value", "_low": "low", "_high": "high", "_standard_error": "standard_error"}
HISTORY = {"fitted_elapsed": "time", "fitted_history": "angle", "history_residual": "residual"}
"""Variables of a result by the attribute of the identification that they are."""


class RestitutionInputs(Inputs):
    """
    What `restitution` reads of the campaign.

    Attributes
    ----------
    block : Block
    settings : RestitutionSettings
    critical_angle, p, angle_gain : float
        How well α, p and the calibration of the angle are known: relative standard deviations.
    filter_order : int
        Of the low-pass.
    """

    block: Block
    settings: RestitutionSettings
    critical_angle: float
    p: float
    angle_gain: float
    filter_order: int = ORDER

    @classmethod
    def of(cls, campaign: Campaign, test: Test) -> RestitutionInputs:
        """Gather what `restitution` reads for one free vibration."""
        known = campaign.ensemble_settings(test.specimen)
        return cls(
            block=campaign.block(test.specimen),
            settings=campaign.processing.restitution,
            critical_angle=known.critical_angle,
            p=known.p,
            angle_gain=known.angle_gain,
            filter_order=campaign.processing.filter_order,
        )


def restitution(rocking: xr.Dataset, inputs: RestitutionInputs) -> xr.Dataset:
    """
    Identify e from one free vibration.

    Parameters
    ----------
    rocking : xr.Dataset
        Result of `rocking`.
    inputs : RestitutionInputs

    Returns
    -------
    identified : xr.Dataset
        `restitution` with its interval, the recommended one; `estimate` by each `estimator`, `restitution_history` from
        the whole history by each model; peaks, impacts with e of each, the fitted history with its residual, and
        the joint region of e and the critical angle. The attribute `table_moves` says "true" or "false", whether the
        table's recorded motion drives the history. Where e cannot be identified it is NaN and the attribute `reason`
        (of the histories, `history_reason`) says why: that is a result, not a failure.

    Raises
    ------
    StageError
        If no transducer was on the specimen.
    """
    import xarray as xr

    expect_angle(rocking)
    result = _identified(rocking, inputs)
    of_history, estimates = result.estimates[0], result.estimates
    residual = np.nan if result.history is None else float(np.sqrt(np.nanmean(result.history.residual**2)))
    return xr.Dataset(
        {
            "restitution": _number(result.value),
            "restitution_low": _number(result.low),
            "restitution_high": _number(result.high),
            "restitution_standard_error": _number(result.standard_error),
            "level": _number(result.level),
            "zero_offset": _number(result.zero_offset),
            "angle_scale": 1.0 if result.joint is None else exp(float(result.joint.mean[1]) + result.joint.gain),
            "restitution_slope": _number(result.constancy.slope),
            "restitution_slope_standard_error": _number(result.constancy.slope_standard_error),
            "restitution_history_residual": ("model", [residual]),
            **_along("peak", PEAKS, result.peaks),
            **_along("impact", IMPACTS, result.impacts),
            **_along("fitted_elapsed", HISTORY, result.history),
            **_joint(result),
            **{
                f"{name}{end}": (dimension, [_number(getattr(each, field)) for each in found])
                for name, dimension, found in (
                    ("estimate", "estimator", estimates),
                    ("restitution_history", "model", [of_history]),
                )
                for end, field in ENDS.items()
            },
        },
        coords={"model": ["nonlinear"], "estimator": [each.name for each in estimates]},
        attrs={
            "method": result.method,
            "reason": result.reason,
            "recommended": result.recommended,
            "estimate_assumptions": [each.assumptions for each in estimates],
            "estimate_reasons": [each.reason for each in estimates],
            "history_model": "" if result.history is None else "nonlinear",
            "departures": [found.sentence for found in result.departures],
            "history_reason": of_history.reason,
            "table_moves": "" if result.table_moves is None else str(result.table_moves).lower(),
            "warnings": _warnings(result),
        },
    )


def expect_angle(rocking: xr.Dataset) -> None:
    """Refuse a free vibration whose rocking angle was not measured."""
    if "rocking_angle" not in rocking:
        raise StageError(
            "A free vibration without a usable displacement transducer on the specimen gives no restitution; "
            'at least one channel with on = "specimen" and quantity = "displacement" was expected.'
        )


def _warnings(result: Restitution) -> list[Finding]:
    """Doubts about the value, or why it is missing."""
    doubts = [
        ("no restitution", f"No restitution from this test: {result.reason}" if result.reason else ""),
        *((kind, text) for kind, text in result.doubts),
        # One that refuses the value is the reason already.
        *((found.name, found.sentence) for found in result.departures if found.sentence not in result.reason),
    ]
    return [warning(kind, text, follows=MEASUREMENT) for kind, text in doubts if text]


def _identified(rocking: xr.Dataset, inputs: RestitutionInputs) -> Restitution:
    names = {"out_of_plane": "out_of_plane_angle", "slide": "slide", "uplift": "uplift"}
    names["base_acceleration"] = "base_acceleration"
    beside: dict[str, Any] = {name: rocking[each].to_numpy() for name, each in names.items() if each in rocking}
    return identify_restitution(
        rocking["elapsed"].to_numpy(),
        rocking["rocking_angle"].to_numpy(),
        inputs.block,
        level=inputs.settings.level,
        lowest_amplitude=inputs.settings.lowest_amplitude,
        noise=float(np.nanmedian(rocking["rocking_angle_standard_error"])),
        # A filter of another order is not the one that the fit knows: it finds the nearest one itself.
        lowpass=rocking["rocking_angle"].attrs.get("cutoff_hz") if inputs.filter_order == ORDER else None,
        uncertainty=Uncertainty(critical_angle=inputs.critical_angle, p=inputs.p, angle_gain=inputs.angle_gain),
        **beside,
    )


def _number(value: float | None) -> float:
    return np.nan if value is None else float(value)


def _along(dimension: str, names: Mapping[str, str], found: Any) -> dict[str, Any]:
    """Describe columns of a part of the result; flags as whole numbers, nothing of a part that is missing."""
    columns = {} if found is None else {name: getattr(found, attribute) for name, attribute in names.items()}
    return {
        name: (dimension, values.astype(np.int8) if values.dtype == bool else values)
        for name, values in columns.items()
    }


def _joint(result: Restitution) -> dict[str, Any]:
    """What is known of e, α and p together: logarithms, and the region of e and α."""
    joint = result.joint
    if joint is None:
        return {}
    variables: dict[str, Any] = {
        "joint_mean": ("joint", joint.mean),
        "joint_covariance": (("joint", "joint_column"), joint.covariance),
    }
    centre, errors = np.exp(joint.mean[:2]), np.sqrt(np.diag(joint.covariance)[:2])
    if (errors > 0).all():
        region = {
            "restitution": centre[0],
            "critical_angle": centre[1],
            "restitution_error": centre[0] * errors[0],
            "critical_angle_error": centre[1] * errors[1],
            "correlation": joint.covariance[0, 1] / (errors[0] * errors[1]),
        }
        variables |= {f"region_{name}": ((), float(value)) for name, value in region.items()}
    return variables
