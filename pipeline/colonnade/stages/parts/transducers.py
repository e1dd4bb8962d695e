"""Channels as identification uses them: transducers, markers, base motion on each axis, readings."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, TypeVar

import numpy as np
from pydantic import BaseModel, ConfigDict

from colonnade.arrays import Array, Dataset, Vector
from colonnade.campaign import Channel
from colonnade.campaign.specimen import Cone, Cylinder, Prism, Specimen
from colonnade.dynamics.block import Block
from colonnade.dynamics.kinematics import Outline, pole_position
from colonnade.findings import MEASUREMENT, Finding, note, warning
from colonnade.identification.fusion.sensors import Gyroscope, Readings, Transducer
from colonnade.signals.filters import second_derivative
from colonnade.store.description import variable_name
from colonnade.store.provenance import Inputs
from colonnade.units.text import format_percent

ALONG = 0.9
"""Least part of a direction along an axis with which a channel of the table records the motion along it."""


class Transducers(BaseModel):
    """
    Channels of one set-up, by the names of their variables.

    Attributes
    ----------
    positions : dict of str to Transducer
        Displacement transducers and inclinometers on the specimen.
    gyroscopes : dict of str to Gyroscope
    accelerations, displacements : dict of str to (x, y, z)
        Table channels and their directions.
    """

    model_config = ConfigDict(frozen=True)

    positions: dict[str, Transducer]
    gyroscopes: dict[str, Gyroscope]
    accelerations: dict[str, Vector]
    displacements: dict[str, Vector]

    @property
    def on_specimen(self) -> tuple[str, ...]:
        """Names of all transducers on the specimen."""
        return (*self.positions, *self.gyroscopes)


def transducers(channels: Mapping[str, Channel]) -> Transducers:
    """Sort a set-up's channels by what they measure."""
    found: dict[str, dict[str, Any]] = {name: {} for name in Transducers.model_fields}
    # Inclinometers come before displacement transducers.
    for key, channel in sorted(channels.items(), key=lambda each: each[1].quantity != "angle"):
        name, direction = variable_name(key), channel.direction
        match channel.on, channel.quantity:
            case _ if direction is None:
                continue
            case "specimen", "angle":
                found["positions"][name] = Transducer("angle", direction)
            case "specimen", "displacement" if channel.at is not None:
                found["positions"][name] = Transducer(
                    channel.sensing,
                    direction,
                    channel.at,
                    normal=channel.normal,
                    anchor=channel.anchor,
                    on_ground=channel.relative_to == "ground",
                )
            case "specimen", "angular_velocity":
                found["gyroscopes"][name] = Gyroscope(direction)
            case "table", "acceleration" | "displacement":
                found[f"{channel.quantity}s"][name] = direction
    return Transducers(**found)


class SeenInputs(Inputs):
    """
    A body, and what sees it and the table.

    Attributes
    ----------
    block : Block
    outline : Outline
        Its base, and the side that transducers look at.
    transducers : Transducers
    """

    block: Block
    outline: Outline
    transducers: Transducers


def along(table: Mapping[str, Vector], axis: int) -> dict[str, float]:
    """Give the channels of the table that record its motion along an axis, with that part of their direction."""
    return {name: direction[axis] for name, direction in table.items() if abs(direction[axis]) >= ALONG}


def outline(specimen: Specimen, block: Block) -> Outline:
    """Outline of a specimen; one of unknown shape is as wide as its poles are apart, without depth."""
    match specimen:
        case Prism():
            return Outline(specimen.width / 2, specimen.depth / 2)
        case Cylinder():
            return Outline(specimen.diameter / 2, specimen.diameter / 2, is_round=True)
        case Cone():
            base, top = specimen.base_diameter / 2, specimen.top_diameter / 2
            return Outline(base, base, is_round=True, taper=(top - base) / specimen.height)
    return Outline(pole_position(block), 0.0)


Kind = TypeVar("Kind")

AXES = {"": 0, "transverse_": 1, "vertical_": 2}
"""Axes of the base motion by the beginning of its variables' names."""

LARGEST_DIFFERENCE = 0.1
"""Of the base motion (RMS), by which several table channels may differ from their mean without a warning."""

LEAST_NOISE = 1e-9
"""m, rad, …: smallest noise assumed for a reading, so that it has a finite weight."""


def base_motion(conditioned: Dataset, channels: Transducers, warnings: list[Finding]) -> dict[str, Array]:
    """
    Average the table's channels along each axis; without an accelerometer along x, differentiate its displacement.

    By name, as far as they were recorded: `base_acceleration` and `base_displacement`, m/s² and m, and these with
    `transverse_` and `vertical_` before.
    """
    base: dict[str, Array] = {}
    for quantity, table in (("acceleration", channels.accelerations), ("displacement", channels.displacements)):
        for prefix, axis in AXES.items():
            used = {name: part for name, part in along(table, axis).items() if name in conditioned}
            values = [conditioned[name].to_numpy() / part for name, part in used.items()]
            if values:
                base[f"{prefix}base_{quantity}"] = mean = np.mean(values, axis=0)
            if len(values) > 1:
                names = [str(conditioned[name].attrs.get("channel", name)) for name in used]
                warnings += _several(f"{quantity} along {'xyz'[axis]}", names, np.array(values), mean)
    if "base_acceleration" not in base and "base_displacement" in base:
        interval = float(np.diff(conditioned["elapsed"].to_numpy()[:2])[0])
        cutoff = min(conditioned[name].attrs["cutoff_hz"] for name in channels.displacements if name in conditioned)
        base["base_acceleration"] = second_derivative(base["base_displacement"], interval, cutoff)
        text = (
            "The base acceleration is the second derivative of the table's displacement, because no table "
            f"accelerometer is usable. It contains nothing above {cutoff:.3g} Hz."
        )
        warnings.append(note("derived base motion", text))
    return base


def _several(what: str, names: list[str], values: Array, mean: Array) -> list[Finding]:
    """Warn where the channels that the base motion is the mean of do not agree."""
    off = np.sqrt(np.nanmean((values - mean) ** 2, axis=1))
    share = float(off.max()) / max(float(np.sqrt(np.nanmean(mean**2))), 1e-300)
    if share <= LARGEST_DIFFERENCE:
        return []
    text = (
        f"The base {what} is the mean of {' and '.join(names)}, but they differ: {names[int(off.argmax())]} by "
        f"{format_percent(share)} of it (RMS). If one of them is wrong or is not fixed to the table, change its `on`, "
        'or set quantity = "other".'
    )
    return [warning("several table channels", text, follows=MEASUREMENT)]


def axes(base: Mapping[str, Array], quantity: str, time: Array) -> Array:
    """Motion of the table along x, y, z; zero along an axis that was not recorded, or is missing for a moment."""
    along = dict.fromkeys(range(3), np.zeros_like(time))
    along |= {axis: base[name] for prefix, axis in AXES.items() if (name := f"{prefix}base_{quantity}") in base}
    return np.array([along[axis] for axis in range(3)])


def readings(conditioned: Dataset, known: Mapping[str, Kind]) -> Readings[Kind]:
    """Transducers on a specimen, as far as they are usable, and what they read: changes from rest."""
    names = [name for name in known if name in conditioned]
    values, noise, cutoff = [], [], []
    for name in names:
        given = conditioned[name].attrs
        values.append(conditioned[name].to_numpy())
        noise.append(max(float(given.get("noise", 0.0)), LEAST_NOISE))
        cutoff.append(float(given.get("cutoff_hz", np.inf)))
    shape = (len(values), conditioned.sizes["elapsed"])
    return Readings([known[name] for name in names], np.array(values).reshape(shape), np.array(noise), np.array(cutoff))
