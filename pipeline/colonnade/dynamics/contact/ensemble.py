"""Ensembles of the contact model over its law, the tilt at release, and where bodies stand."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace

import numpy as np

from colonnade.arrays import Array
from colonnade.dynamics.assembly import Assembly
from colonnade.dynamics.contact.body import InSpace
from colonnade.dynamics.contact.history import AssemblyHistory, ContactHistory
from colonnade.dynamics.ensemble import Plan


@dataclass(frozen=True, kw_only=True)
class ContactPlan(Plan):
    """
    Of the contact model.

    Attributes
    ----------
    space : InSpace
        Of the central run, with all bodies in their places and in the middle of the range of `out_of_plane`.
    ranges : mapping of str to pair of float
        Of the inputs, attributes of the law or `out_of_plane`, the rotation about x at the start of a single body
        (rad): lowest and highest value, all in between equally likely.
    misplacement : float
        m: each body of an assembly stands off its place by up to this along x and along y, all equally likely.
    """

    space: InSpace
    ranges: Mapping[str, tuple[float, float]]
    misplacement: float = 0.0

    @property
    def names(self) -> tuple[str, ...]:
        """Of the inputs."""
        return tuple(self.ranges)

    def central(self) -> ContactHistory | AssemblyHistory:
        """Run the model with nothing varied."""
        return self._run(self.space, sum(self.ranges.get("out_of_plane", (0.0, 0.0))) / 2)

    def follow(self, random: np.random.Generator) -> tuple[Array, ContactHistory | AssemblyHistory]:
        """Draw what one member takes, in the order of `names`, and the places of its bodies; run the model with it."""
        inputs = random.uniform(*np.array(list(self.ranges.values())).T)
        drawn, body = dict(zip(self.ranges, inputs.tolist(), strict=True)), self.space.body
        out_of_plane = drawn.pop("out_of_plane", 0.0)
        if isinstance(body, Assembly):
            placed = {}
            for name, each in body.bodies.items():
                x, y = (np.array(each.position) + self.misplacement * random.uniform(-1.0, 1.0, 2)).tolist()
                placed[name] = replace(each, position=(x, y))
            body = Assembly(placed)
        return inputs, self._run(replace(self.space, body=body, law=replace(self.space.law, **drawn)), out_of_plane)

    def ends(self, history: ContactHistory | AssemblyHistory) -> dict[str, Array]:
        """How far each body of an assembly `moved` for good (m), and whether it `fell`."""
        if isinstance(history, ContactHistory):
            return {}
        moved = [np.hypot(x, y) for x, y, _ in history.residuals.values()]
        fell = [float(np.isfinite(body.overturning_time)) for body in history.bodies.values()]
        return {"moved": np.array(moved), "fell": np.array(fell)}

    def _run(self, space: InSpace, out_of_plane: float) -> ContactHistory | AssemblyHistory:
        return space.run(
            self.motion, self.block.gravity, theta0=self.theta0, omega0=self.omega0, out_of_plane=out_of_plane
        )
