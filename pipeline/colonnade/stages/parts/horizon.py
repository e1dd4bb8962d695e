"""Whether the measured angle is within each model's own spread, and up to when the model predicts it."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
import xarray as xr

from colonnade.dynamics.block import Block
from colonnade.dynamics.history import amplitude
from colonnade.identification.response.rank import rank


def horizons_and_ranks(
    rocking: xr.Dataset, ensembles: Mapping[str, xr.Dataset], models: list[str], block: Block
) -> dict[str, Any]:
    """
    Compare the measured angle with the runs of each model.

    Parameters
    ----------
    rocking : xr.Dataset
        Result of `rocking`.
    ensembles : mapping of str to xr.Dataset
        Results of `ensemble` by model.
    models : list of str
        The order of the dimension `model`.
    block : Block

    Returns
    -------
    variables : dict
        On `model`: `horizon`, s; `within_spread`, the share of runs that are closer to their median than the measured
        angle (`identification.response.rank`); `peak_rank`, the share of runs whose peak is below the measured one,
        with half of the equal ones; `overturning_probability`. NaN without a measured angle. Empty without ensembles.
    """
    if not ensembles:
        return {}
    rows = [_row(rocking, ensembles[model], block) if model in ensembles else (np.nan,) * 4 for model in models]
    names = ("horizon", "within_spread", "peak_rank", "overturning_probability")
    return {name: ("model", np.array(column)) for name, column in zip(names, zip(*rows, strict=True), strict=True)}


def _row(rocking: xr.Dataset, ensemble: xr.Dataset, block: Block) -> tuple[float, float, float, float]:
    probability, horizon = float(ensemble["overturning_probability"]), float(ensemble["horizon"])
    if "rocking_angle" not in rocking:
        return horizon, np.nan, np.nan, probability
    first = int(np.searchsorted(rocking["elapsed"].to_numpy(), float(ensemble["elapsed"][0])))
    measured = rocking["rocking_angle"].to_numpy()[first:]
    # Peaks within the noise are all the same.
    least = float(rocking["noise_threshold"]) / block.critical_angle
    peak = float(np.nanmax(amplitude(measured, block), initial=least))
    if rocking.attrs["outcome"] == "overturned":
        peak = np.inf
    peaks = np.where(np.isfinite(ensemble["member_overturning_time"]), np.inf, ensemble["member_peak_ratio"])
    peaks = np.maximum(peaks, least)
    return horizon, _within(ensemble), rank(peak, peaks), probability


def _within(ensemble: xr.Dataset) -> float:
    if "measured_distance" not in ensemble:
        return np.nan
    return rank(float(ensemble["measured_distance"]), ensemble["member_distance"].to_numpy())
