"""Restitution: the rocking angle of a free vibration -> impacts, peaks, e with its interval."""

from __future__ import annotations

from collections.abc import Mapping
from math import exp
from typing import Any

import numpy as np

from colonnade.arrays import Dataset, dataset
from colonnade.campaign import Campaign, Test
from colonnade.campaign.settings import RestitutionSettings
from colonnade.dynamics.block import Block
from colonnade.dynamics.uncertainty import Uncertainty
from colonnade.errors import StageError
from colonnade.findings import MEASUREMENT, Finding, warning
from colonnade.identification.restitution.identify import identify_restitution
from colonnade.identification.restitution.result import Restitution
from colonnade.store.provenance import Inputs

PEAKS = {
    "peak_time": "time",
    "peak_angle": "angle",
    "peak_angle_standard_error": "standard_error",
    "fitted_angle": "fitted_angle",
    "peak_used": "used",
}
IMPACTS = {f"impact_{name}": name for name in ("time", "velocity", "restitution", "restitution_standard_error", "used")}
ENDS = {"": "value", "_low": "low", "_high": "high", "_standard_error": "standard_error"}
HISTORY = {"fitted_elapsed": "time", "fitted_history": "angle", "history_residual": "residual"}
JOINT = {"joint_mean": "mean", "joint_covariance": "covariance"}
"""Variables of a result by the attribute of the identification that they are."""


class RestitutionInputs(Inputs):
    """
    What `restitution` reads of the campaign.

    Attributes
    ----------
    block : Block
    settings : RestitutionSettings
    known : Uncertainty
        How well α, p and the calibration of the angle are known.
    """

    block: Block
    settings: RestitutionSettings
    known: Uncertainty

    @classmethod
    def of(cls, campaign: Campaign, test: Test) -> RestitutionInputs:
        """Gather what `restitution` reads for one free vibration."""
        known = campaign.ensemble_settings(test.specimen)
        return cls(
            block=campaign.block(test.specimen),
            settings=campaign.processing.restitution,
            known=Uncertainty(critical_angle=known.critical_angle, p=known.p, angle_gain=known.angle_gain),
        )


def restitution(rocking: Dataset, inputs: RestitutionInputs) -> Dataset:
    """
    Identify e from one free vibration.

    Parameters
    ----------
    rocking : Dataset
        Result of `rocking`.
    inputs : RestitutionInputs

    Returns
    -------
    identified : Dataset
        `restitution` with its interval, the recommended one; `estimate` by each `estimator`; peaks, impacts with e of
        each, the fitted history with its residual, and what is known of e, α and p together. The attribute
        `table_moves` says "true" or "false", whether the table's recorded motion drives the history. Where e cannot be
        identified it is NaN and the attribute `reason` says why: that is a result, not a failure.

    Raises
    ------
    StageError
        If no transducer was on the specimen.
    """
    if "rocking_angle" not in rocking:
        raise StageError(
            "A free vibration without a usable displacement transducer on the specimen gives no restitution; "
            'at least one channel with on = "specimen" and quantity = "displacement" was expected.'
        )
    result = _identified(rocking, inputs)
    estimates, joint = result.estimates, result.joint
    return dataset(
        {
            **{f"restitution{end}": _number(getattr(result, field)) for end, field in ENDS.items()},
            "level": _number(result.level),
            "zero_offset": _number(result.zero_offset),
            "angle_scale": 1.0 if joint is None else exp(float(joint.mean[1]) + joint.gain),
            **_along(["peak"], PEAKS, result.peaks),
            **_along(["impact"], IMPACTS, result.impacts),
            **_along(["fitted_elapsed"], HISTORY, result.history),
            **{
                f"estimate{end}": ("estimator", [_number(getattr(each, field)) for each in estimates])
                for end, field in ENDS.items()
            },
            **_along(["joint", "joint_column"], JOINT, joint),
        },
        coords={"estimator": [each.name for each in estimates]},
        attrs={
            "method": result.method,
            "reason": result.reason,
            "recommended": result.recommended,
            "estimate_reasons": [each.reason for each in estimates],
            "departures": [found.sentence for found in result.departures],
            "table_moves": "" if result.table_moves is None else str(result.table_moves).lower(),
            "warnings": _warnings(result),
        },
    )


def _warnings(result: Restitution) -> list[Finding]:
    """Doubts about the value, or why it is missing."""
    doubts = [*result.doubts, *((found.name, found.sentence) for found in result.departures)]
    if result.reason:  # which says all of the departures
        doubts = [("no restitution", f"No restitution from this test: {result.reason}"), *result.doubts]
    return [warning(kind, text, follows=MEASUREMENT) for kind, text in doubts]


def _identified(rocking: Dataset, inputs: RestitutionInputs) -> Restitution:
    names = {"out_of_plane": "out_of_plane_angle", "slide": "slide", "base_acceleration": "base_acceleration"}
    beside: dict[str, Any] = {name: rocking[each].to_numpy() for name, each in names.items() if each in rocking}
    return identify_restitution(
        rocking["elapsed"].to_numpy(),
        rocking["rocking_angle"].to_numpy(),
        inputs.block,
        level=inputs.settings.level,
        lowest_amplitude=inputs.settings.lowest_amplitude,
        noise=float(np.nanmedian(rocking["rocking_angle_standard_error"])),
        lowpass=rocking["rocking_angle"].attrs.get("cutoff_hz"),
        uncertainty=inputs.known,
        **beside,
    )


def _number(value: float | None) -> float:
    return np.nan if value is None else float(value)


def _along(dimensions: list[str], names: Mapping[str, str], found: Any) -> dict[str, Any]:
    """Describe columns of a part of the result; flags as whole numbers, nothing of a part that is missing."""
    columns = {} if found is None else {name: getattr(found, attribute) for name, attribute in names.items()}
    return {
        name: (dimensions[: values.ndim], values.astype(np.int8) if values.dtype == bool else values)
        for name, values in columns.items()
    }
