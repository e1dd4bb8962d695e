"""Compare: measured and predicted -> how well they agree."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING

import numpy as np

from colonnade.campaign import Campaign, Test
from colonnade.dynamics.block import Block
from colonnade.dynamics.history import amplitude
from colonnade.findings import MEASUREMENT, Finding, serious
from colonnade.signals.metrics import nrmse
from colonnade.stages.parts.inputs import Inputs
from colonnade.stages.parts.rank import horizons_and_ranks
from colonnade.stages.parts.sine import Sine, find_peak, sine

if TYPE_CHECKING:
    import xarray as xr


class CompareInputs(Inputs):
    """What `compare` reads of the campaign: block, kind, outcome as seen; of a sine its frequency (Hz), amplitude."""

    block: Block
    observed_outcome: str | None
    free_vibration: bool = False
    is_sine: bool = False
    frequency: float | None = None
    amplitude: float | None = None

    @classmethod
    def of(cls, campaign: Campaign, test: Test) -> CompareInputs:
        """Gather what `compare` reads for one test."""
        return cls(
            block=campaign.specimens[test.specimen].block(campaign.gravity),
            observed_outcome=test.observed_outcome,
            free_vibration=test.kind == "free-vibration",
            is_sine=test.kind == "sine",
            frequency=test.frequency,
            amplitude=test.amplitude,
        )


def compare(
    rocking: xr.Dataset,
    predicted: Mapping[str, xr.Dataset],
    inputs: CompareInputs,
    ensembles: Mapping[str, xr.Dataset] | None = None,
) -> xr.Dataset:
    """
    Compare measured and predicted in numbers.

    Parameters
    ----------
    rocking : xr.Dataset
        Result of `rocking`.
    predicted : mapping of str to xr.Dataset
        Results of `predict` by model, on the same clock.
    inputs : CompareInputs
    ensembles : mapping of str to xr.Dataset, optional
        Results of `ensemble` by model.

    Returns
    -------
    compared : xr.Dataset
        On the dimension `model`: `nrmse`, RMS(predicted − measured)/α until either first passes α, `compared_until`
        (s), `predicted_peak_ratio`, `peak_ratio_error` and `predicted_outcome`. NaN if nothing was measured. The
        measured angle counts over the time that is predicted, about its true zero and with its true gain
        (`zero_offset`, `angle_gain`): its `measured_peak_ratio` and `measured_peak_time` (s); of a free vibration the
        largest before that is the `release_ratio`. Of a sine test also what `sine` adds; with ensembles what
        `horizons_and_ranks` adds.
    """
    import xarray as xr

    models = sorted(predicted)
    zero = {"zero_offset": 0.0, "angle_gain": 1.0}
    zero = {name: float(predicted[models[0]][name]) for name in zero} if models else zero
    if "rocking_angle" in rocking:
        true = (rocking["rocking_angle"] - zero["zero_offset"]) / zero["angle_gain"]
        rocking = rocking.assign(rocking_angle=true)
    peak = find_peak(rocking, predicted, inputs.block, free_vibration=inputs.free_vibration)
    rows = [_row(rocking, predicted[model], inputs.block) for model in models]
    ratios = np.array([float(predicted[model]["peak_ratio"]) for model in models])
    warnings: list[Finding] = []
    measured, observed = rocking.attrs["outcome"], inputs.observed_outcome
    if measured and observed and not _agree(measured, observed):
        text = f"The transducers show {measured}, the test log says {observed}: check the record."
        warnings.append(serious("outcome", text, follows=MEASUREMENT))
    steady = sine(rocking, predicted, inputs.block, inputs.frequency, inputs.amplitude) if inputs.is_sine else Sine()
    return xr.Dataset(
        {
            "nrmse": ("model", np.array([row[0] for row in rows])),
            "compared_until": ("model", np.array([row[1] for row in rows])),
            "predicted_peak_ratio": ("model", ratios),
            "peak_ratio_error": ("model", ratios - peak.ratio),
            "predicted_outcome": (
                "model",
                np.array([predicted[model].attrs["outcome"] for model in models], dtype=object),
            ),
            "measured_peak_ratio": ((), peak.ratio),
            "measured_peak_time": ((), peak.time),
            "release_ratio": ((), peak.release),
            **{name: ((), value) for name, value in zero.items()},
        }
        | steady.variables
        | horizons_and_ranks(rocking, ensembles or {}, models, inputs.block),
        coords={"model": ("model", np.array(models, dtype=object))},
        attrs={
            "outcome_measured": measured or observed or "",
            **steady.attributes,
            "warnings": [*warnings, *steady.warnings],
        },
    )


def _row(rocking: xr.Dataset, predicted: xr.Dataset, block: Block) -> tuple[float, float]:
    """Return the nrmse and the end of the time that it covers."""
    if "rocking_angle" not in rocking:
        return np.nan, np.nan
    time = rocking["elapsed"].to_numpy()
    measured, model = rocking["rocking_angle"].to_numpy(), predicted["rocking_angle"].to_numpy()
    beyond = np.fmax(amplitude(measured, block), amplitude(model, block)) > 1
    until = int(np.argmax(beyond)) if beyond.any() else time.size
    both = np.isfinite(measured[:until]) & np.isfinite(model[:until])
    if not both.any():
        return np.nan, np.nan
    return nrmse(measured[:until][both], model[:until][both], block.critical_angle), float(time[until - 1])


def _agree(measured: str, observed: str) -> bool:
    return measured == observed or (observed == "not-overturned" and measured != "overturned")
