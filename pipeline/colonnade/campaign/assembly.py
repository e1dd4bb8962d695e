"""Assemblies: bodies on each other, each made from a specimen, and the one block as which they rock together."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Annotated

from pydantic import BeforeValidator, Field

from colonnade.campaign.channel import Channel
from colonnade.campaign.specimen import Specimen
from colonnade.campaign.syntax import fields
from colonnade.campaign.syntax.names import Identifier
from colonnade.campaign.syntax.table import Table
from colonnade.dynamics.assembly import Assembly, Placed, as_one, is_frame, standing_on
from colonnade.dynamics.block import Block

RESERVED = ("specimen", "table", "ground")
"""What a body or an assembly cannot be called."""


class Body(Table):
    """One body of an assembly."""

    specimen: Identifier
    """Id of the specimen that it is made as."""
    on: Annotated[tuple[Identifier, ...], BeforeValidator(fields.listed)] = ()
    """The body or bodies that it stands on, such as ["left", "right"]; the table if it is not given."""
    position: tuple[fields.Coordinate, fields.Coordinate] = (0.0, 0.0)
    """Of the middle of its base, along x and y of the table, such as ["-500 mm", "0 mm"]."""


class AssemblyTable(Table):
    """Bodies on each other, by `stack` or by `bodies`."""

    stack: tuple[Identifier, ...] = ()
    """Specimens from the bottom to the top; the bodies are "1", "2" and so on."""
    bodies: dict[Identifier, Body] = Field(default={})
    """Its bodies, by id."""

    @property
    def placed(self) -> dict[str, Body]:
        """Its bodies, by id."""
        stacked = {
            str(number): Body.model_construct(specimen=name, on=(str(number - 1),) if number > 1 else ())
            for number, name in enumerate(self.stack, 1)
        }
        return stacked | self.bodies


APART = "its bodies do not rock as one block"
"""Why an assembly that is no frame has no e."""


class Whole(Specimen):
    """
    An assembly as a specimen: the block as which its bodies rock together.

    Bodies of a frame rock as `Block.frame` says; of others the first on the table, with all that stands on it alone,
    as one rigid block.
    """

    is_assembly = True

    shape: str = "assembly"
    """Its shape."""
    placed: dict[str, Body]
    """Its bodies."""
    made: dict[str, Specimen]
    """The specimen of each."""

    @classmethod
    def of(cls, table: AssemblyTable, specimens: Mapping[str, Specimen]) -> Whole:
        """Make it; a ValidationError or ValueError says why there is no such assembly."""
        placed = table.placed
        made = {name: specimens[body.specimen] for name, body in placed.items()}
        scales = {each.scale for each in made.values()}
        mass = sum(each.mass for each in made.values())
        scale = scales.pop() if len(scales) == 1 else None
        whole = cls.model_construct(mass=mass, placed=placed, made=made, scale=scale)
        whole.block(9.81)
        return whole

    def assembly(self, gravity: float) -> Assembly:
        """Return its bodies where they stand."""
        return Assembly(
            {name: Placed(self.made[name].block(gravity), body.on, body.position) for name, body in self.placed.items()}
        )

    def block(self, gravity: float) -> Block:
        """Return the block as which its bodies rock together."""
        return as_one(self.assembly(gravity))

    @property
    def is_in_plane(self) -> bool:
        """Whether its bodies rock as one block: those of a frame."""
        return is_frame(self.assembly(9.81))

    def sizes(self) -> dict[str, float]:
        """Width of the base of what rocks together, and the height of all, m."""
        assembly = self.assembly(9.81)
        first = next(iter(assembly.bodies.values())).block
        return {"width": 2 * first.governing.half_width, "height": assembly.height}

    def as_seen(self, channels: Mapping[str, Channel]) -> dict[str, Channel]:
        """
        Return channels as those of the one block: on it, where they are above its base.

        Those on bodies that move otherwise, and those between bodies, have no place on it.
        """
        assembly = self.assembly(9.81)
        first, is_one_frame, seen = next(iter(assembly.bodies)), is_frame(assembly), dict(channels)
        together = standing_on(assembly, first)
        if is_one_frame:
            together = tuple(name for name, body in assembly.bodies.items() if not body.on)
        for name, channel in channels.items():
            on, place = channel.on or "", None
            if on not in assembly.bodies:
                continue
            if channel.at is not None and on in together and channel.relative_to not in assembly.bodies:
                reference = assembly.bodies[on if is_one_frame else first].position
                along, across = (
                    own - other for own, other in zip(assembly.bodies[on].position, reference, strict=True)
                )
                place = channel.at[0] + along, channel.at[1] + across, channel.at[2] + assembly.levels[on]
            seen[name] = channel.model_copy(update={"on": "specimen", "at": place})
        return seen
