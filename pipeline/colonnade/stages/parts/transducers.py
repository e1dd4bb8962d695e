"""Channels as identification uses them: transducers, markers, base motion on each axis, readings."""

from __future__ import annotations

from collections.abc import Collection, Mapping
from functools import lru_cache
from typing import TYPE_CHECKING, Any, TypeVar

import numpy as np
from pydantic import BaseModel, ConfigDict

from colonnade.arrays import Array, Vector
from colonnade.campaign import Campaign, Channel, Test
from colonnade.campaign.channel import ALONG
from colonnade.campaign.setup import Marker, Tracking
from colonnade.campaign.specimen import Cone, Cylinder, Prism, Specimen
from colonnade.dynamics.assembly import Assembly
from colonnade.dynamics.block import Block
from colonnade.dynamics.kinematics import Outline, pole_position
from colonnade.findings import MEASUREMENT, Finding, note, serious, warning
from colonnade.identification.fusion.sensors import Gyroscope, Readings, Transducer
from colonnade.signals.filters import second_derivative
from colonnade.store.description import variable_name
from colonnade.store.provenance import Inputs
from colonnade.units.text import format_percent, with_minus

if TYPE_CHECKING:
    import xarray as xr

FEWEST = 4
"""Markers with which the places of all are compared."""

MISPLACED = 0.01
"""m, by which a marker may be off its place at rest, relative to the others."""


MOST_SAID = 6
"""Places that one finding gives."""


class MarkerInputs(Inputs):
    """
    A marker.

    Attributes
    ----------
    body : str
    at : (float, float, float)
        From the centre of the body's base, m.
    channels : dict of str to (float, float, float)
        Directions of its three channels by their variables.
    """

    body: str
    at: Vector
    channels: dict[str, Vector]


def markers_of(
    markers: Mapping[str, Marker], tracking: Tracking, recorders: Collection[str]
) -> dict[str, MarkerInputs]:
    """Gather the markers that have a place, of recorders that recorded."""
    return {
        name: MarkerInputs(
            body=each.on,
            at=each.at,
            channels={variable_name(f"{name}_{key}"): axis for key, axis in zip("xyz", tracking.axes, strict=True)},
        )
        for name, each in markers.items()
        if each.at is not None and each.recorder in recorders
    }


def misplaced(conditioned: xr.Dataset, markers: Mapping[str, MarkerInputs], assembly: Assembly) -> list[Finding]:
    """
    Find markers that are not, at rest, where their `on` and `at` put them relative to each other.

    Where the cameras have their origin is not known: the median over all markers is taken for it.
    """
    used = {
        name: each
        for name, each in markers.items()
        if each.body in assembly.bodies
        and all(channel in conditioned and "zero" in conditioned[channel].attrs for channel in each.channels)
    }
    if len(used) < FEWEST:
        return []
    names, bodies = np.array(list(used)), np.array([each.body for each in used.values()])
    feet = np.array([np.append(assembly.bodies[body].position, assembly.levels[body]) for body in bodies.tolist()])
    declared = feet + np.array([each.at for each in used.values()])
    # What was taken off each channel at rest, along the axes of the table.
    zeros = [[float(conditioned[name].attrs["zero"]) for name in each.channels] for each in used.values()]
    seen = np.einsum("mc,mci->mi", zeros, [list(each.channels.values()) for each in used.values()])
    off = seen - declared - np.median(seen - declared, axis=0)
    wrong, said = np.linalg.norm(off, axis=1) > MISPLACED, []
    for body in dict.fromkeys(bodies[wrong].tolist()):
        mine = np.flatnonzero(wrong & (bodies == body))
        together = np.ptp(off[mine], axis=0).max() < MISPLACED
        for group in [mine] if together else np.split(mine, mine.size):
            x, y, z = (with_minus(str(round(each))) for each in (1e3 * off[group].mean(axis=0)).tolist())
            said.append(f"{', '.join(names[group])} on body {body} by {x}, {y} and {z} mm along x, y and z")
    text = (
        f"At rest {len(names[wrong])} of {len(names)} markers are off the places that `on` and `at` give: "
        f"{'; '.join(said[:MOST_SAID])}{' …' if len(said) > MOST_SAID else ''}. Check their columns, `on` and `at`, "
        "the heights of the bodies, and the axes and the unit of the tracking."
    )
    return [serious("geometry", text)] if said else []


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
    return _sorted(tuple(channels.items()))


@lru_cache
def _sorted(channels: tuple[tuple[str, Channel], ...]) -> Transducers:
    found: dict[str, dict[str, Any]] = {name: {} for name in Transducers.model_fields}
    # Inclinometers come before displacement transducers.
    for key, channel in sorted(channels, key=lambda each: each[1].quantity != "angle"):
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

    @classmethod
    def seen(cls, campaign: Campaign, test: Test) -> dict[str, Any]:
        """Gather it for the specimen of a test."""
        specimen = campaign.specimens[test.specimen]
        block, known = specimen.block(campaign.gravity), transducers(campaign.channels(test))
        return {"block": block, "outline": outline(specimen, block), "transducers": known}


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


def base_motion(conditioned: xr.Dataset, channels: Transducers, warnings: list[Finding]) -> dict[str, Array]:
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
                warnings.append(_several(f"{quantity} along {'xyz'[axis]}", names, np.array(values), mean))
    if "base_acceleration" not in base and "base_displacement" in base:
        base["base_acceleration"], finding = _derived(conditioned, channels, base["base_displacement"])
        warnings.append(finding)
    return base


def _derived(conditioned: xr.Dataset, channels: Transducers, displacement: Array) -> tuple[Array, Finding]:
    """Differentiate the table's displacement twice; a warning if an accelerometer along x was to give the motion."""
    interval = float(np.diff(conditioned["elapsed"].to_numpy()[:2])[0])
    cutoff = min(float(conditioned[name].attrs["cutoff_hz"]) for name in channels.displacements if name in conditioned)
    weight = warning if along(channels.accelerations, 0) else note
    text = (
        "The base acceleration is the second derivative of the table's displacement, because no table accelerometer is "
        f"usable. It contains nothing above {cutoff:.3g} Hz."
    )
    return second_derivative(displacement, interval, cutoff), weight("derived base motion", text)


def _several(what: str, names: list[str], values: Array, mean: Array) -> Finding:
    """Say that the base motion is the mean of several channels, and warn where they do not agree."""
    text = f"The base {what} is the mean of {' and '.join(names)}"
    off = np.sqrt(np.nanmean((values - mean) ** 2, axis=1))
    share = float(off.max()) / max(float(np.sqrt(np.nanmean(mean**2))), 1e-300)
    if share <= LARGEST_DIFFERENCE:
        return note("several table channels", f"{text}; they agree to {format_percent(share, 1)}.")
    odd = names[int(off.argmax())]
    text += (
        f", but they differ: {odd} by {format_percent(share)} of it (RMS). If one of them is wrong or is not fixed to "
        'the table, change its `on`, or set quantity = "other".'
    )
    return warning("several table channels", text, follows=MEASUREMENT)


def axes(base: Mapping[str, Array], quantity: str, time: Array) -> Array:
    """Motion of the table along x, y, z; zero along an axis that was not recorded, or is missing for a moment."""
    along = dict.fromkeys(range(3), np.zeros_like(time))
    along |= {axis: base[name] for prefix, axis in AXES.items() if (name := f"{prefix}base_{quantity}") in base}
    return np.array([along[axis] for axis in range(3)])


def readings(conditioned: xr.Dataset, known: Mapping[str, Kind]) -> Readings[Kind]:
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
