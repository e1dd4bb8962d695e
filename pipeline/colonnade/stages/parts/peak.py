"""The measured peak that predictions are compared with, over the time that is predicted; and the release."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from colonnade.arrays import Array
from colonnade.dynamics.history import amplitude

if TYPE_CHECKING:
    import xarray as xr

    from colonnade.dynamics.block import Block


SETTLED = 0.1
"""Over p: time before the release over which the held angle is averaged."""


class MeasuredPeak(NamedTuple):
    """
    Largest measured |θ|/α.

    Attributes
    ----------
    ratio, time : float
        Over the time that is predicted, and when, s; NaN if it is not known, the ratio also of what overturned.
    release : float
        |θ|/α from which a free vibration was released; NaN of other tests.
    """

    ratio: float = np.nan
    time: float = np.nan
    release: float = np.nan


def find_peak(
    rocking: xr.Dataset, predicted: Mapping[str, xr.Dataset], block: Block, *, free_vibration: bool
) -> MeasuredPeak:
    """
    Find the measured peak.

    Parameters
    ----------
    rocking : xr.Dataset
        Result of `rocking`, its angle about the true zero.
    predicted : mapping of str to xr.Dataset
        Results of `predict` by model.
    block : Block
    free_vibration : bool
    """
    if "rocking_angle" not in rocking:
        return MeasuredPeak()
    if not free_vibration:
        return MeasuredPeak(float(rocking["peak_ratio"]), float(rocking["peak_time"]))
    time, angle = rocking["elapsed"].to_numpy(), np.nan_to_num(rocking["rocking_angle"].to_numpy())
    ratio = amplitude(angle, block)
    is_predicted = np.any([np.isfinite(each["rocking_angle"].to_numpy()) for each in predicted.values()], axis=0)
    first = int(np.argmax(is_predicted))
    largest = first + int(np.argmax(ratio[first:]))
    held = angle[:first] * np.sign(angle[first]) < 0.0
    return MeasuredPeak(
        np.nan if rocking.attrs["outcome"] == "overturned" else float(ratio[largest]),
        float(time[largest]),
        _release(time[:first][held], ratio[:first][held], block.p, least=0.5 * ratio[largest]),
    )


def _release(time: Array, ratio: Array, p: float, *, least: float) -> float:
    """
    |θ|/α at which a specimen was released, given the samples before its first impact.

    That is at rest, so that the impact comes a quarter period later, acosh(1/(1 − |θ|/α))/p (Housner 1963, eq. 3);
    what is held longer has been at that angle before, what moves already arrives earlier.
    """
    if time.size == 0:
        return np.nan
    later = time[-1] - time
    arriving = np.arccosh(1.0 / (1.0 - np.minimum(ratio, 1.0 - 1e-9))) / p
    waits = np.flatnonzero((later >= arriving) & (ratio > least))
    if not waits.size:
        return float(ratio.max())
    let_go = time[waits[-1]]
    return float(np.median(ratio[(time >= let_go - SETTLED / p) & (time <= let_go)]))
