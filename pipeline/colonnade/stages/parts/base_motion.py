"""The base motion that drives a prediction, as it was recorded, and the parts of it that the plane models ignore."""

from __future__ import annotations

from math import sqrt
from typing import TYPE_CHECKING

import numpy as np

from colonnade.arrays import Array
from colonnade.errors import StageError
from colonnade.findings import MEASUREMENT, Finding, serious, warning
from colonnade.units.text import format_percent

if TYPE_CHECKING:
    import xarray as xr

LARGEST_TRANSVERSE = 0.1
"""Of the peak along x: what the base may move across without a word, though a plane model leaves it out."""

VERTICAL = "vertical motion"
"""Kind of the findings about the motion along z."""

LARGEST_WEAKENING = 0.01
"""Of the base motion's root mean square: what straight lines between its samples may take without a word."""

LEAST_CONTENT = 0.01
"""Of the largest energy at a frequency of the base motion: below it lies noise."""

LEAST_VERTICAL = 1e-6
"""m/s², from lowest to highest: an accelerometer that reads less is dead."""


def base_acceleration(rocking: xr.Dataset) -> Array:
    """
    Return the acceleration of the base along x, m/s².

    Raises
    ------
    StageError
        If it was not recorded, or misses samples.
    """
    if "base_acceleration" not in rocking:
        raise StageError(
            "The table's motion along x was not recorded in this test; a prediction needs it. "
            'Add a channel with on = "table" and quantity = "acceleration" (or "displacement") to its set-up.'
        )
    base = rocking["base_acceleration"].to_numpy()
    missing = int((~np.isfinite(base)).sum())
    if missing:
        where = float(rocking["elapsed"][int(np.argmin(np.isfinite(base)))])
        raise StageError(
            f"The base acceleration is missing {missing} of {base.size} samples, the first at {where:.3f} s; all "
            "of them were expected. Give the test a `window` without them, or repair the channel."
        )
    return base


def vertical_acceleration(rocking: xr.Dataset, *, gravity: float, expected: bool) -> tuple[Array | None, list[Finding]]:
    """
    Return the acceleration of the base along z, as far as a prediction can take it.

    Parameters
    ----------
    rocking : xr.Dataset
        Result of `rocking`.
    gravity : float
        m/s².
    expected : bool
        The set-up has an accelerometer of the table along z.

    Returns
    -------
    vertical : ndarray, shape (n,), or None
        m/s², positive upwards; None if it is not known throughout, or lets go of the specimen.
    warnings : list of Finding
        Why it is None although there is a channel.
    """
    if "vertical_base_acceleration" not in rocking:
        reason = "No channel of the table's vertical acceleration is usable: predicted without it."
        return None, [warning(VERTICAL, reason, follows=MEASUREMENT)] if expected else []
    vertical = rocking["vertical_base_acceleration"].to_numpy()
    finite = np.isfinite(vertical)
    if not finite.all():
        where = float(rocking["elapsed"][int(np.argmin(finite))])
        reason = (
            f"The vertical acceleration of the base is missing {int((~finite).sum())} of {vertical.size} samples, the "
            f"first at {where:.3f} s: predicted without it."
        )
        return None, [warning(VERTICAL, reason, follows=("lost samples", "missing samples"))]
    if np.ptp(vertical) < LEAST_VERTICAL:
        reason = "The table's vertical accelerometer is dead (no noise at all): predicted without it."
        return None, [warning(VERTICAL, reason, follows=("dead channel",))]
    if not vertical.min() > -gravity:
        where = float(rocking["elapsed"][int(vertical.argmin())])
        reason = (
            f"The vertical acceleration of the base reaches {vertical.min():.4g} m/s² at {where:.3f} s, so the "
            "specimen would leave the table: predicted without it. Check its gain, direction and zero."
        )
        return None, [serious(VERTICAL, reason, follows=MEASUREMENT)]
    return vertical, []


def transverse_acceleration(rocking: xr.Dataset) -> Array | None:
    """Return the acceleration of the base along y, m/s², for a model in space; None if samples miss."""
    if "transverse_base_acceleration" not in rocking:
        return None
    transverse = rocking["transverse_base_acceleration"].to_numpy()
    return transverse if np.isfinite(transverse).all() else None


def left_out(rocking: xr.Dataset, base: Array) -> list[Finding]:
    """Say that the motion along y is left out of the plane models, if it is not small compared with that along x."""
    if "transverse_base_acceleration" not in rocking:
        return []
    peak = float(np.nanmax(np.abs(rocking["transverse_base_acceleration"].to_numpy()), initial=0.0))
    along = float(np.abs(base).max(initial=0.0))
    if peak <= LARGEST_TRANSVERSE * along:
        return []
    share = f"{format_percent(peak / along)} of that along x" if along > 0.0 else "and none along x"
    text = f"The base also moved along y, by up to {peak:.3g} m/s², {share}: the plane models ignore it."
    return [warning("motion across", text, follows=MEASUREMENT)]


def weakened(base: Array) -> list[Finding]:
    """Say by how much straight lines between the samples weaken the motion along x: sinc² of frequency over rate."""
    energy = np.abs(np.fft.rfft(base - base.mean())) ** 2
    if not energy.any():
        return []
    # Noise is spread over all frequencies, a little in each.
    energy[energy < LEAST_CONTENT * energy.max()] = 0.0
    kept = float(energy @ np.sinc(np.fft.rfftfreq(base.size)) ** 4 / energy.sum())
    loss = 1.0 - sqrt(kept)
    if loss <= LARGEST_WEAKENING:
        return []
    text = (
        f"Models take the base acceleration as straight lines between its samples, which weakens it by "
        f"{format_percent(loss)} (root mean square): much of it is faster than 1/25 of the sampling rate. Predictions "
        "are too small by about as much; a higher sampling rate avoids it."
    )
    return [warning("sampling rate", text, follows=MEASUREMENT)]
