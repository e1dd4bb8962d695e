"""Where a prediction begins, and the recorded base motion that drives it from there on."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

from colonnade.arrays import Array, Dataset
from colonnade.dynamics.block import Block
from colonnade.dynamics.motion import Motion
from colonnade.errors import StageError
from colonnade.findings import MEASUREMENT, Finding, warning
from colonnade.identification.response.base_motion import LEAST_MOTION, table_moves
from colonnade.identification.restitution.arcs import arcs_between, find_impacts
from colonnade.store.provenance import Inputs

LARGEST_LEFT_OUT = 0.1
"""Of the peak along x: what a prediction may leave out of the motion along y and z without a word."""


def base_acceleration(rocking: Dataset) -> Array:
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
    missing = np.flatnonzero(~np.isfinite(base))
    if missing.size:
        raise StageError(
            f"The base acceleration is missing {missing.size} of {base.size} samples, the first at "
            f"{float(rocking['elapsed'][missing[0]]):.3f} s; all of them were expected. Give the test a `window` "
            "without them, or repair the channel."
        )
    return base


def other_axes(
    rocking: Dataset, base: Array, *, gravity: float, is_in_space: bool
) -> tuple[Array | None, Array | None, list[Finding]]:
    """
    Return what a prediction takes of the base's acceleration along y and z, m/s², and say what it leaves out.

    Only a model in space takes that along y; one that misses samples, or along z lets go of the specimen, is left out.
    """
    taken: dict[str, Array] = {}
    warnings: list[Finding] = []
    for axis, name in (("y", "transverse_base_acceleration"), ("z", "vertical_base_acceleration")):
        values = rocking[name].to_numpy() if name in rocking else np.zeros(1)
        peak, along = float(np.nanmax(np.abs(values), initial=0.0)), float(np.abs(base).max())
        if name in rocking and np.isfinite(values).all() and (is_in_space if axis == "y" else values.min() > -gravity):
            taken[axis] = values
        elif peak > LARGEST_LEFT_OUT * along:
            text = (
                f"The base also moved along {axis}, by up to {peak:.3g} m/s² ({along:.3g} m/s² along x). That is left "
                "out: models in the plane take none along y, and no model one that misses samples or would lift the "
                "specimen off the table (check gain, direction and zero)."
            )
            follows = (*MEASUREMENT, "lost samples", "missing samples")
            warnings.append(warning("motion left out", text, follows=follows))
    return taken.get("y"), taken.get("z"), warnings


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
    is_in_space : bool
        Whether the model also moves across the plane.
    """

    block: Block
    free_vibration: bool
    tilt: float = 0.0
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
    rocking: Dataset, inputs: BeginningInputs, identified: Dataset | None = None, block: Block | None = None
) -> Beginning:
    """
    Find where a prediction begins and what it is driven by.

    Parameters
    ----------
    rocking : Dataset
        Result of `rocking`.
    inputs : BeginningInputs
    identified : Dataset, optional
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
        base, in_space = base_acceleration(rocking), inputs.is_in_space
        transverse, vertical, warnings = other_axes(rocking, base, gravity=block.gravity, is_in_space=in_space)
    else:
        base, vertical, transverse, warnings = np.zeros_like(time), None, None, []
    # On a tilted table a part of gravity acts along x, as a base acceleration the other way would.
    felt = base[first:] - block.gravity * np.sin(inputs.tilt)
    vertical, transverse = (None if each is None else each[first:] for each in (vertical, transverse))
    motion = Motion(felt, float(time[1] - time[0]), vertical, transverse)
    theta0, omega0 = _fallen(peak, since, float(felt[0]), block)
    return Beginning(first, theta0, omega0, base, motion, driven_by, **zero, warnings=warnings)


def _drives_free_vibration(rocking: Dataset, block: Block, identified: Dataset | None) -> str:
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


def _start(rocking: Dataset, block: Block, zero_offset: float, angle_gain: float) -> tuple[int, float, float]:
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
