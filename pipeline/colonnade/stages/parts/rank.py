"""The rank of the measured angle among the runs of a model, and the time up to which it is meaningful."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

import numpy as np

from colonnade.arrays import Array
from colonnade.dynamics.block import Block
from colonnade.dynamics.ensemble import Ensemble
from colonnade.dynamics.history import amplitude, capped
from colonnade.identification.response.rank import Measurement, as_measured, distances, rank
from colonnade.stages.parts.beginning import Beginning

if TYPE_CHECKING:
    import xarray as xr

SEED = 22
"""Of the measurement errors of the runs; they are the same in every run of the stage."""


def describe_bands(
    rocking: xr.Dataset,
    beginning: Beginning,
    found: Ensemble,
    starts: Array,
    errors: Measurement,
    block: Block,
    width: float,
) -> xr.Dataset:
    """
    Put the bands of an ensemble into a dataset, and compare the measured angle with the runs.

    Parameters
    ----------
    rocking : xr.Dataset
        Result of `rocking`.
    beginning : Beginning
        Of the prediction.
    found : Ensemble
    starts : ndarray, shape (members,)
        By how much each run began above the measured start, rad.
    errors : Measurement
        Of the measured angle, see `measurement_errors`.
    block : Block
    width : float
        rad, of the band at which a prediction is no longer meaningful.

    Returns
    -------
    bands : xr.Dataset
        With the `horizon`, s; if an angle was measured, on `judged_member` the `judged_peak_ratio` that would have been
        recorded of each run, missing where it overturns, and if there are runs enough, `measured_distance` and
        `member_distance` of the runs.
    """
    import xarray as xr

    # Samples of the record to each of the bands.
    first, stride = beginning.first, round(float(found.time[1] - found.time[0]) / beginning.motion.dt)
    time = rocking["elapsed"].to_numpy()[first::stride]
    start = float(time[0])
    low, high = found.overturning_interval()
    sensitivity = found.sensitivity()
    horizon = found.horizon(width) + start
    bands = xr.Dataset(
        {
            "rocking_angle": ("elapsed", found.central),
            "rocking_angle_band": (("quantile", "elapsed"), found.bands),
            "overturning_probability": found.overturning_probability,
            "overturning_probability_low": low,
            "overturning_probability_high": high,
            "member_peak_ratio": ("member", found.peak_ratio),
            "member_overturning_time": ("member", found.overturning_time + start),
            "peak_sensitivity": ("input", np.array(list(sensitivity.values()))),
            "horizon": horizon,
        },
        coords={"elapsed": time, "quantile": found.levels, "input": np.array(list(sensitivity), dtype=object)},
    )
    if "rocking_angle" not in rocking:
        return bands
    angle = rocking["rocking_angle"].to_numpy()[first::stride] - beginning.zero_offset
    measured = capped(time, angle / beginning.angle_gain, float(rocking["overturning_time"]), block)
    thinned = errors.thinned(first, stride)
    recorded = as_measured(found.histories, starts[: len(found.histories)], thinned, np.random.default_rng(SEED))
    falls = np.isfinite(found.overturning_time[: len(recorded)])
    peaks = amplitude(recorded, block).max(axis=1)
    bands = bands.assign(judged_peak_ratio=("judged_member", np.where(falls, np.nan, peaks)))
    seen = time <= horizon
    compared = distances(measured[seen], recorded[:, seen])
    if compared is None:
        return bands
    return bands.assign(measured_distance=compared[0], member_distance=("judged_member", compared[1]))


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
        angle (`identification.response.rank`); `peak_rank`, the share of runs whose peak would have been recorded below
        the measured one, with half of the equal ones; `overturning_probability`. NaN without a measured angle. Empty
        without ensembles.
    """
    if not ensembles:
        return {}
    rows = [_row(rocking, ensembles[model], block) if model in ensembles else (np.nan,) * 4 for model in models]
    names = ("horizon", "within_spread", "peak_rank", "overturning_probability")
    return {name: ("model", column) for name, column in zip(names, np.transpose(rows), strict=True)}


def _row(rocking: xr.Dataset, ensemble: xr.Dataset, block: Block) -> tuple[float, float, float, float]:
    probability, horizon = float(ensemble["overturning_probability"]), float(ensemble["horizon"])
    if "rocking_angle" not in rocking:
        return horizon, np.nan, np.nan, probability
    measured = rocking["rocking_angle"].sel(elapsed=ensemble["elapsed"]).to_numpy()
    # Peaks within the noise are all the same.
    least = float(rocking["noise_threshold"]) / block.critical_angle
    peak = float(np.nanmax(amplitude(measured, block), initial=least))
    if rocking.attrs["outcome"] == "overturned":
        peak = np.inf
    peaks = np.nan_to_num(ensemble["judged_peak_ratio"].to_numpy(), nan=np.inf)
    within = np.nan
    if "measured_distance" in ensemble:
        within = rank(float(ensemble["measured_distance"]), ensemble["member_distance"].to_numpy())
    return horizon, within, rank(peak, np.maximum(peaks, least)), probability
