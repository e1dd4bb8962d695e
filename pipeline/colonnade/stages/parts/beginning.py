"""Where a prediction begins, and the recorded base motion that drives it from there on."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING

import numpy as np

from colonnade.arrays import Array
from colonnade.dynamics.block import Block
from colonnade.dynamics.motion import Motion
from colonnade.errors import StageError
from colonnade.findings import MEASUREMENT, Finding, serious, warning
from colonnade.identification.response.base_motion import LEAST_MOTION, table_moves
from colonnade.identification.restitution.arcs import arcs_between, find_impacts
from colonnade.store.provenance import Inputs
from colonnade.units.text import format_percent

if TYPE_CHECKING:
    import xarray as xr

LARGEST_TRANSVERSE = 0.1
"""Of the peak along x: what the base may move across without a word, though a plane model leaves it out."""

VERTICAL = "vertical motion"
"""Kind of the findings about the motion along z."""

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
    if missing := _missing(base, rocking):
        raise StageError(
            f"The base acceleration is missing {missing}; all of them were expected. Give the test a `window` without "
            "them, or repair the channel."
        )
    return base


def _missing(values: Array, rocking: xr.Dataset) -> str:
    """Say how many samples miss, and the first; empty if none does."""
    finite = np.isfinite(values)
    if finite.all():
        return ""
    where = float(rocking["elapsed"][int(np.argmin(finite))])
    return f"{int((~finite).sum())} of {values.size} samples, the first at {where:.3f} s"


def vertical_acceleration(rocking: xr.Dataset, *, gravity: float, expected: bool) -> tuple[Array | None, list[Finding]]:
    """
    Return the acceleration of the base along z, m/s² upwards, as far as a prediction can take it, and why it is None.

    It is None if it is not known throughout, or lets go of the specimen; without a channel there is nothing to say
    unless the set-up has one, so that it was `expected`.
    """
    weight = warning
    if "vertical_base_acceleration" not in rocking:
        reason = "No channel of the table's vertical acceleration is usable" if expected else ""
    else:
        vertical = rocking["vertical_base_acceleration"].to_numpy()
        if missing := _missing(vertical, rocking):
            reason = f"The vertical acceleration of the base is missing {missing}"
        elif np.ptp(vertical) < LEAST_VERTICAL:
            reason = "The table's vertical accelerometer is dead (no noise at all)"
        elif vertical.min() <= -gravity:
            weight, where = serious, float(rocking["elapsed"][int(vertical.argmin())])
            reason = (
                f"The vertical acceleration of the base reaches {vertical.min():.4g} m/s² at {where:.3f} s, so the "
                "specimen would leave the table (check its gain, direction and zero)"
            )
        else:
            return vertical, []
    follows = (*MEASUREMENT, "lost samples", "missing samples")
    return None, [weight(VERTICAL, f"{reason}: predicted without it.", follows=follows)] if reason else []


def transverse_acceleration(rocking: xr.Dataset) -> Array | None:
    """Return the acceleration of the base along y, m/s², for a model in space; None if samples miss."""
    across = rocking.get("transverse_base_acceleration")
    return None if across is None or not np.isfinite(across).all() else across.to_numpy()


def left_out(rocking: xr.Dataset, base: Array) -> list[Finding]:
    """Say that the motion along y is left out of the plane models, if it is not small compared with that along x."""
    across = rocking.get("transverse_base_acceleration", np.zeros(1))
    peak, along = float(np.nanmax(np.abs(across), initial=0.0)), float(np.abs(base).max(initial=0.0))
    if peak <= LARGEST_TRANSVERSE * along:
        return []
    share = f"{format_percent(peak / along)} of that along x" if along > 0.0 else "and none along x"
    text = f"The base also moved along y, by up to {peak:.3g} m/s², {share}: the plane models ignore it."
    return [warning("motion across", text, follows=MEASUREMENT)]


RECORDED = "the recorded motion of the base"
NOT_RECORDED = "a base at rest: its motion was not recorded"
AT_REST = (
    f"a base at rest: what was recorded changes the specimen's velocity by less than {LEAST_MOTION:g} p α, or its "
    "accelerometer shows more noise than motion"
)


class BeginningInputs(Inputs):
    """
    What the beginning of a prediction reads of the campaign.

    Attributes
    ----------
    block : Block
    free_vibration : bool
    tilt : float
        The table's rotation about +y, rad: with it gravity pulls towards +x.
    has_vertical : bool
        The set-up has an accelerometer of the table along z.
    is_in_space : bool
        Whether the model also moves across the plane.
    """

    block: Block
    free_vibration: bool
    tilt: float = 0.0
    has_vertical: bool = False
    is_in_space: bool = False


@dataclass(frozen=True)
class Beginning:
    """
    Where a prediction begins.

    Attributes
    ----------
    first : int
        Sample of the record.
    theta0, omega0 : float
        Angle there, about the true zero, and angular velocity, rad and rad/s.
    base : ndarray, shape (n,)
        Base acceleration of the whole record along x, m/s².
    motion : Motion
        From `first` on, with the table's tilt in it, and along z where that is known throughout.
    driven_by : str
        `RECORDED`, `NOT_RECORDED` or `AT_REST`.
    zero_offset, angle_gain : float
        rad, what the measured angle shows at the true zero; measured over true angle.
    warnings : list of Finding
    """

    first: int
    theta0: float
    omega0: float
    base: Array
    motion: Motion
    driven_by: str = RECORDED
    zero_offset: float = 0.0
    angle_gain: float = 1.0
    warnings: list[Finding] = field(default_factory=list)

    def padded(self, values: Array) -> Array:
        """Values over time from `first` on, shape (n - first,), on the whole clock; NaN before."""
        return np.concatenate((np.full(self.first, np.nan), values))


def begin(
    rocking: xr.Dataset, inputs: BeginningInputs, identified: xr.Dataset | None = None, block: Block | None = None
) -> Beginning:
    """
    Find where a prediction begins and what it is driven by.

    Parameters
    ----------
    rocking : xr.Dataset
        Result of `rocking`.
    inputs : BeginningInputs
    identified : xr.Dataset, optional
        Result of `restitution`, of a free vibration: zero and scale of its angle.
    block : Block, optional
        That predictions move, with the α of all free vibrations; default: that of the inputs.

    Raises
    ------
    StageError
        If there is no base motion, or a free vibration shows no arc to start from.

    Notes
    -----
    A free vibration is driven by what was recorded on the table if its restitution is; where that was not decided, if
    that moves it (`table_moves`). Otherwise by nothing, since the noise of an accelerometer moves no table.
    """
    time = rocking["elapsed"].to_numpy()
    first, peak, since, driven_by = 0, 0.0, 0.0, RECORDED
    zero = {"zero_offset": 0.0, "angle_gain": 1.0}
    block = block or inputs.block
    if inputs.free_vibration:
        if identified is not None and np.isfinite(identified["restitution"]):
            gain = float(identified["angle_scale"]) * inputs.block.critical_angle / block.critical_angle
            zero = {"zero_offset": float(identified["zero_offset"]), "angle_gain": gain}
        first, peak, since = _start(rocking, block, **zero)
        driven_by = _drives_free_vibration(rocking, block, identified)
    if driven_by == RECORDED:
        base = base_acceleration(rocking)
        vertical, warnings = vertical_acceleration(rocking, gravity=block.gravity, expected=inputs.has_vertical)
        transverse = transverse_acceleration(rocking) if inputs.is_in_space else None
        if transverse is None:
            warnings += left_out(rocking, base)
    else:
        base, vertical, transverse, warnings = np.zeros_like(time), None, None, []
    # On a tilted table a part of gravity acts along x, as a base acceleration the other way would.
    felt = base[first:] - block.gravity * np.sin(inputs.tilt)
    vertical, transverse = (None if each is None else each[first:] for each in (vertical, transverse))
    motion = Motion(felt, float(time[1] - time[0]), vertical, transverse)
    theta0, omega0 = _fallen(peak, since, float(felt[0]), block)
    return Beginning(first, theta0, omega0, base, motion, driven_by, **zero, warnings=warnings)


def _drives_free_vibration(rocking: xr.Dataset, block: Block, identified: xr.Dataset | None) -> str:
    if "base_acceleration" not in rocking:
        return NOT_RECORDED
    if decided := "" if identified is None else identified.attrs.get("table_moves", ""):
        return RECORDED if decided == "true" else AT_REST
    time = rocking["elapsed"].to_numpy()
    moves = table_moves(rocking["base_acceleration"].to_numpy(), float(time[1] - time[0]), block)
    return RECORDED if moves else AT_REST


def _fallen(peak: float, since: float, base: float, block: Block) -> tuple[float, float]:
    """Angle (rad) and angular velocity (rad/s) a part of a sampling interval (s) after a peak (rad)."""
    if since == 0.0:
        return peak, 0.0
    side = block.negative if peak < 0 else block.positive
    lean = np.copysign(side.critical_angle, peak) - peak
    acceleration = -(block.side_p(side) ** 2) * (np.sin(lean) + base / block.gravity * np.cos(lean))
    return float(peak + acceleration * since**2 / 2), float(acceleration * since)


def _start(rocking: xr.Dataset, block: Block, zero_offset: float, angle_gain: float) -> tuple[int, float, float]:
    """Find the first peak between two impacts: next sample, angle (rad), time to the sample (s)."""
    if "rocking_angle" not in rocking:
        raise StageError("A free vibration without a measured angle has no release to start a prediction from.")
    time, angle = rocking["elapsed"].to_numpy(), (rocking["rocking_angle"].to_numpy() - zero_offset) / angle_gain
    impacts = find_impacts(time, angle, lowest=float(rocking["noise_threshold"]))
    arcs = arcs_between(impacts, time, angle, block.p)
    whole = np.flatnonzero(np.isfinite(arcs.peak_angle))
    if whole.size == 0:
        raise StageError(
            "This free vibration has no arc between two impacts above the noise; a prediction needs a peak to start "
            "from. Was the specimen released within the record?"
        )
    when, peak = float(arcs.peak_time[whole[0]]), float(arcs.peak_angle[whole[0]])
    if not abs(peak) < np.pi / 2:
        raise StageError(
            f"The first peak of this free vibration is {peak:.3g} rad; less than a right angle was expected. Check "
            "unit, gain and range of the transducers on the specimen; a code such as -9999 has to be an empty cell."
        )
    first = min(int(np.searchsorted(time, when)), time.size - 2)
    return first, peak, float(time[first] - when)
