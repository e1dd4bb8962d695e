"""Whether the misfit of measured and predicted lies within the model's own spread."""

from __future__ import annotations

from collections.abc import Mapping
from statistics import NormalDist
from typing import Any

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from colonnade.dynamics.block import Block
from colonnade.dynamics.history import amplitude

Array = NDArray[np.float64]

LEAST_WITHIN = 0.9
"""Share of the measured angle that a band of 90 % holds if the model is right."""

UNLIKELY = 0.05
"""Share of an ensemble at either end in which the measured peak is not expected."""


def is_within(within: float, rank: float) -> bool | None:
    """
    Judge whether a misfit lies within the model's own spread.

    Parameters
    ----------
    within, rank : float
        `within_spread` and `peak_rank` as of `spread`.

    Returns
    -------
    verdict : bool or None
        None if either is not known.
    """
    if np.isnan(within) or np.isnan(rank):
        return None
    return bool(within >= LEAST_WITHIN and UNLIKELY <= rank <= 1 - UNLIKELY)


def spread(rocking: xr.Dataset, ensembles: Mapping[str, xr.Dataset], models: list[str], block: Block) -> dict[str, Any]:
    """
    Hold the measured angle against the bands of each model.

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
        On `model`: `within_spread`, the share of samples on which the measured angle lies in the widest band, until
        either first passes α and as long as either rocks; `peak_rank`, the share of members whose peak is below the
        measured one, equal ones by half; `overturning_probability`. NaN where there is nothing to hold. Empty without
        ensembles.

    Notes
    -----
    The band is widened by the measured angle's own standard error as far as it reaches itself in standard deviations.
    """
    if not ensembles:
        return {}
    rows = [_row(rocking, ensembles[model], block) if model in ensembles else (np.nan,) * 3 for model in models]
    names = ("within_spread", "peak_rank", "overturning_probability")
    return {name: ("model", np.array(column)) for name, column in zip(names, zip(*rows, strict=True), strict=True)}


def _row(rocking: xr.Dataset, ensemble: xr.Dataset, block: Block) -> tuple[float, float, float]:
    probability = float(ensemble["overturning_probability"])
    if "rocking_angle" not in rocking:
        return np.nan, np.nan, probability
    first = int(np.searchsorted(rocking["elapsed"].to_numpy(), float(ensemble["elapsed"][0])))
    measured = rocking["rocking_angle"].to_numpy()[first:]
    # What is not told from noise is all alike.
    least = float(rocking["noise_threshold"]) / block.critical_angle
    peak = float(np.nanmax(amplitude(measured, block), initial=least))
    if rocking.attrs["outcome"] == "overturned":
        peak = np.inf
    peaks = np.where(np.isfinite(ensemble["member_overturning_time"]), np.inf, ensemble["member_peak_ratio"])
    peaks = np.maximum(peaks, least)
    rank = float(np.mean(peaks < peak) + 0.5 * np.mean(peaks == peak))
    stride = -(-measured.size // ensemble.sizes["elapsed"])
    return _within(measured[::stride], rocking, ensemble, block), rank, probability


def _within(measured: Array, rocking: xr.Dataset, ensemble: xr.Dataset, block: Block) -> float:
    low, high = (ensemble["rocking_angle_band"].to_numpy()[place] for place in (0, -1))
    central, threshold = ensemble["rocking_angle"].to_numpy(), float(rocking["noise_threshold"])
    reach = NormalDist().inv_cdf(float(ensemble["quantile"][-1])) * float(rocking["rocking_angle_standard_error"])
    beyond = np.fmax(amplitude(measured, block), amplitude(central, block)) > 1
    until = int(np.argmax(beyond)) if beyond.any() else measured.size
    largest = np.maximum(np.abs(low), np.abs(high))
    held = np.isfinite(measured) & (np.fmax(np.abs(measured), largest) > threshold) & (np.arange(measured.size) < until)
    if not held.any():
        return np.nan
    inside = (measured >= low - reach) & (measured <= high + reach)
    return float(inside[held].mean())
