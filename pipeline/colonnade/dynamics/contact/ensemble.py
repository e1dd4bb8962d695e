"""Ensembles of the contact model over friction, contact damping and the position at release."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import ClassVar

import numpy as np

from colonnade.arrays import Array
from colonnade.dynamics.assembly import Assembly
from colonnade.dynamics.contact.bodies import AssemblyHistory
from colonnade.dynamics.contact.body import ContactBody, ContactLaw
from colonnade.dynamics.contact.history import ContactHistory
from colonnade.dynamics.contact.simulate import simulate, simulate_assembly
from colonnade.dynamics.ensemble import Plan

Range = tuple[float, float]


@dataclass(frozen=True, kw_only=True)
class ContactPlan(Plan):
    """
    Of the contact model.

    Attributes
    ----------
    body : ContactBody
    law : ContactLaw
        Whose friction and damping fraction each member replaces by its own; of the central run as it is.
    friction, damping_fraction, out_of_plane : pair of float
        Lowest and highest value, all in between equally likely; the rotation about x at the start in rad.
    step : float, optional
        s; see `simulate`.
    """

    body: ContactBody
    law: ContactLaw
    friction: Range
    damping_fraction: Range
    out_of_plane: Range = (0.0, 0.0)
    step: float | None = None
    names: ClassVar[tuple[str, ...]] = ("friction", "damping_fraction", "out_of_plane")

    def central(self) -> ContactHistory:
        """Run the model with its law and the middle rotation out of the plane."""
        return self._simulate(self.law, sum(self.out_of_plane) / 2)

    def follow(self, random: np.random.Generator) -> tuple[Array, ContactHistory]:
        """Draw what one member takes, in the order of `names`, and run the model with it."""
        inputs = random.uniform(*np.array([getattr(self, name) for name in self.names]).T)
        friction, fraction, out_of_plane = inputs.tolist()
        law = replace(self.law, friction=friction, damping_fraction=fraction)
        return inputs, self._simulate(law, out_of_plane)

    def _simulate(self, law: ContactLaw, out_of_plane: float) -> ContactHistory:
        return simulate(
            self.body,
            self.motion,
            law=law,
            gravity=self.block.gravity,
            step=self.step,
            theta0=self.theta0,
            omega0=self.omega0,
            out_of_plane=out_of_plane,
        )


@dataclass(frozen=True, kw_only=True)
class AssemblyPlan(Plan):
    """
    Of the contact model, for several bodies.

    Attributes
    ----------
    assembly : Assembly
    law : ContactLaw
        As of `ContactPlan`.
    friction, damping_fraction, penetration : pair of float
        Lowest and highest value, all in between equally likely; the penetration in m.
    misplacement : float
        m: each body stands off its place by up to this along x and along y, all equally likely.
    """

    assembly: Assembly
    law: ContactLaw
    friction: Range
    damping_fraction: Range
    penetration: Range
    misplacement: float = 0.0
    names: ClassVar[tuple[str, ...]] = ("friction", "damping_fraction", "penetration")

    def central(self) -> AssemblyHistory:
        """Run the model with its law, each body in its place."""
        return self._simulate(self.law, self.assembly)

    def follow(self, random: np.random.Generator) -> tuple[Array, AssemblyHistory]:
        """Draw what one member takes, in the order of `names`, and the places of its bodies; run the model with it."""
        inputs = random.uniform(*np.array([getattr(self, name) for name in self.names]).T)
        friction, fraction, penetration = inputs.tolist()
        placed = {}
        for name, body in self.assembly.bodies.items():
            x, y = (np.array(body.position) + self.misplacement * random.uniform(-1.0, 1.0, 2)).tolist()
            placed[name] = replace(body, position=(x, y))
        law = replace(self.law, friction=friction, damping_fraction=fraction, penetration=penetration)
        return inputs, self._simulate(law, Assembly(placed))

    def ends(self, history: AssemblyHistory) -> dict[str, Array]:
        """How far each body `moved` for good (m), and whether it `fell`."""
        moved = [np.hypot(x, y) for x, y, _ in history.residuals.values()]
        fell = [float(np.isfinite(body.overturning_time)) for body in history.bodies.values()]
        return {"moved": np.array(moved), "fell": np.array(fell)}

    def _simulate(self, law: ContactLaw, assembly: Assembly) -> AssemblyHistory:
        return simulate_assembly(assembly, self.motion, law=law, theta0=self.theta0, omega0=self.omega0)
