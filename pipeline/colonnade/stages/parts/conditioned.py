"""Conditioned channels in the form that identification uses: the base motion along each axis, and readings by kind."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, TypeVar

import numpy as np

from colonnade.arrays import Array
from colonnade.campaign.channel import ALONG
from colonnade.findings import MEASUREMENT, Finding, note, warning
from colonnade.identification.fusion.sensors import Accelerometer, Readings
from colonnade.signals.filters import second_derivative
from colonnade.stages.parts.transducers import Transducers
from colonnade.units.text import format_percent

if TYPE_CHECKING:
    import xarray as xr

Kind = TypeVar("Kind")

AXES = {"": 0, "transverse_": 1, "vertical_": 2}
"""Axes of the base motion by the beginning of its variables' names."""

LARGEST_DIFFERENCE = 0.1
"""Of the base motion (RMS), by which several table channels may differ from their mean without a warning."""

DERIVED = "derived base motion"
"""Kind of the finding that the base acceleration is the second derivative of a displacement."""

LEAST_NOISE = 1e-9
"""m, rad, …: smallest noise assumed for a reading, so that it has a finite weight."""


def base_motion(conditioned: xr.Dataset, channels: Transducers, warnings: list[Finding]) -> dict[str, Array]:
    """
    Average the table's channels along each axis; without an accelerometer along x, differentiate its displacement.

    Returns
    -------
    base : dict of str to ndarray, shape (n,)
        As far as they were recorded: `base_acceleration` and `base_displacement`, and these with `transverse_` and
        `vertical_` before; m/s² and m.
    """
    base: dict[str, Array] = {}
    for quantity, table in (("acceleration", channels.accelerations), ("displacement", channels.displacements)):
        for prefix, axis in AXES.items():
            along = {name: direction[axis] for name, direction in table.items() if abs(direction[axis]) >= ALONG}
            values = [conditioned[name].to_numpy() / part for name, part in along.items() if name in conditioned]
            if values:
                base[f"{prefix}base_{quantity}"] = mean = np.mean(values, axis=0)
            if len(values) > 1:
                names = [str(conditioned[name].attrs.get("channel", name)) for name in along if name in conditioned]
                warnings.append(_several(f"{quantity} along {'xyz'[axis]}", names, np.array(values), mean))
    if "base_acceleration" not in base and "base_displacement" in base:
        base["base_acceleration"], finding = _derived(conditioned, channels, base["base_displacement"])
        warnings.append(finding)
    return base


def _derived(conditioned: xr.Dataset, channels: Transducers, displacement: Array) -> tuple[Array, Finding]:
    """Differentiate the table's displacement twice; a warning if an accelerometer along x was to give the motion."""
    interval = float(np.diff(conditioned["elapsed"].to_numpy()[:2])[0])
    cutoff = min(float(conditioned[name].attrs["cutoff_hz"]) for name in channels.displacements if name in conditioned)
    is_meant = not any(abs(direction[0]) >= ALONG for direction in channels.accelerations.values())
    weight = note if is_meant else warning
    finding = weight(
        DERIVED,
        "The base acceleration is the second derivative of the table's displacement, because no table accelerometer "
        f"is usable. It contains nothing above {cutoff:.3g} Hz.",
    )
    return second_derivative(displacement, interval, cutoff), finding


def _several(what: str, names: list[str], values: Array, mean: Array) -> Finding:
    """Say that the base motion is the mean of several channels, and warn where they do not agree."""
    text = f"The base {what} is the mean of {' and '.join(names)}"
    off = np.sqrt(np.nanmean((values - mean) ** 2, axis=1))
    share = float(off.max()) / max(float(np.sqrt(np.nanmean(mean**2))), 1e-300)
    if share <= LARGEST_DIFFERENCE:
        return note("several table channels", f"{text}; they agree to {format_percent(share, 1)}.")
    odd = names[int(off.argmax())]
    return warning(
        "several table channels",
        f"{text}, but they differ: {odd} by {format_percent(share)} of it (RMS). If one of them is wrong or "
        'is not fixed to the table, change its `on`, or set quantity = "other".',
        follows=MEASUREMENT,
    )


def axes(base: Mapping[str, Array], quantity: str, time: Array) -> Array:
    """Motion of the table along x, y, z; zero along an axis that was not recorded, or is missing for a moment."""
    along = dict.fromkeys(range(3), np.zeros_like(time))
    along |= {axis: base[name] for prefix, axis in AXES.items() if (name := f"{prefix}base_{quantity}") in base}
    return np.array([along[axis] for axis in range(3)])


def group(conditioned: xr.Dataset, known: Mapping[str, Kind], gravity: float) -> Readings[Kind]:
    """Transducers of one kind, as far as they are usable, and what they read: changes from rest."""
    names = [name for name in known if name in conditioned]
    values, noise, cutoff = [], [], []
    for name in names:
        given = conditioned[name].attrs
        transducer = known[name]
        # Gravity, unless what was read at rest was taken off whole.
        resting = transducer.direction[2] * gravity if isinstance(transducer, Accelerometer) else 0.0
        values.append(conditioned[name].to_numpy() - given.get("rest_value", 0.0 if "zero" in given else resting))
        noise.append(max(float(given.get("noise", 0.0)), LEAST_NOISE))
        cutoff.append(float(given.get("cutoff_hz", np.inf)))
    shape = (len(values), conditioned.sizes["elapsed"])
    return Readings([known[name] for name in names], np.array(values).reshape(shape), np.array(noise), np.array(cutoff))
