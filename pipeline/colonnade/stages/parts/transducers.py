"""The channels of a set-up as transducers for the identification: on the specimen, and on the table."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from pydantic import BaseModel, ConfigDict

from colonnade.arrays import Vector
from colonnade.campaign import Channel
from colonnade.campaign.specimen import Cone, Cylinder, Prism, Specimen
from colonnade.dynamics.block import Block
from colonnade.dynamics.kinematics import Outline, pole_position
from colonnade.identification.fusion.sensors import Accelerometer, Gyroscope, Transducer
from colonnade.store.description import variable_name


class Transducers(BaseModel):
    """
    Channels of one set-up, by the names of their variables.

    Attributes
    ----------
    positions : dict of str to Transducer
        Displacement transducers and inclinometers on the specimen.
    gyroscopes : dict of str to Gyroscope
    accelerometers : dict of str to Accelerometer
        On the specimen, where their place is given.
    accelerations, displacements : dict of str to (x, y, z)
        Table channels and their directions.
    """

    model_config = ConfigDict(frozen=True)

    positions: dict[str, Transducer]
    gyroscopes: dict[str, Gyroscope]
    accelerometers: dict[str, Accelerometer]
    accelerations: dict[str, Vector]
    displacements: dict[str, Vector]

    @property
    def on_specimen(self) -> tuple[str, ...]:
        """Names of all transducers on the specimen."""
        return (*self.positions, *self.gyroscopes, *self.accelerometers)


def transducers(channels: Mapping[str, Channel]) -> Transducers:
    """Sort a set-up's channels by what they measure."""
    named = {variable_name(name): channel for name, channel in channels.items()}
    return Transducers(
        positions=dict(_positions(named)),
        gyroscopes={
            name: Gyroscope(direction) for name, direction in _directions(named, "specimen", "angular_velocity")
        },
        accelerometers={
            name: Accelerometer(direction, at)
            for name, direction in _directions(named, "specimen", "acceleration")
            if (at := named[name].at) is not None
        },
        accelerations=dict(_directions(named, "table", "acceleration")),
        displacements=dict(_directions(named, "table", "displacement")),
    )


def _directions(named: Mapping[str, Channel], on: str, quantity: str) -> Iterator[tuple[str, Vector]]:
    for name, channel in named.items():
        if channel.on == on and channel.quantity == quantity and channel.direction is not None:
            yield name, channel.direction


def _positions(named: Mapping[str, Channel]) -> Iterator[tuple[str, Transducer]]:
    for name, direction in _directions(named, "specimen", "angle"):
        yield name, Transducer("angle", direction)
    for name, direction in _directions(named, "specimen", "displacement"):
        channel = named[name]
        if channel.at is not None:
            yield (
                name,
                Transducer(
                    channel.sensing,
                    direction,
                    channel.at,
                    normal=channel.normal,
                    anchor=channel.anchor,
                    on_ground=channel.relative_to == "ground",
                ),
            )


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
