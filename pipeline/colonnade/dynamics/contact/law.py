"""The law of contact: penalty stiffness, critical damping fraction and Coulomb friction with elastic slip."""

from __future__ import annotations

from dataclasses import dataclass, replace
from math import sqrt

import numpy as np

from colonnade.arrays import Array
from colonnade.dynamics.contact.body import ContactBody, Nodes
from colonnade.validation import number

STATIC_PENETRATION = 1e-7
"""Of the default law: how deep the standing body sinks, in heights of its centre of mass. On a softer contact a block
leans on its springs by enough to rock below A = 1."""

DEFAULT_STEP = 5e-6
"""s, of runs with the default law; shorter where the contact is too stiff for it."""


@dataclass(frozen=True)
class ContactLaw:
    """
    Force of the table on one base node: a point, or a whole ring with each of its points.

    Attributes
    ----------
    stiffness : float or None, optional
        Normal penalty stiffness k per area of the base, N/m³. Default: at each interface by the weight above it, which
        sinks by `penetration`, so that bodies of all sizes are served alike.
    damping_fraction : float
        ξ, the critical damping fraction: 2 ξ sqrt(m k) v acts while the node is in contact, m the node's mass.
    friction : float
        Coulomb's coefficient µ; `math.inf` for no sliding.
    tangential_ratio : float
        Stiffness against elastic slip, over k.
    tangential_damping : float
        Damping of the elastic slip, over the normal one. A node that slides is not damped.
    penetration : float, optional
        Depth under what stands on an interface, over the height of its centre of mass.

    Notes
    -----
    The normal force is max(0, k δ + 2 ξ sqrt(m k) dδ/dt) for a depth δ > 0: the table never pulls. The tangential force
    follows the elastic slip s, −k_t s − c_t ds/dt, and where k_t |s| would exceed µ N the node slides and s stays at
    µ N / k_t.

    A ring of radius r has its stiffness k and its mass m spread evenly around: by length k' = k / 2πr, m' = m / 2πr and
    the damping 2 ξ sqrt(m' k'), each the limit of more and more nodes; k is the stiffness times the area of the
    annulus that the ring stands for.
    """

    stiffness: float | None = None
    damping_fraction: float = 0.4
    friction: float = 0.6
    tangential_ratio: float = 1.0
    tangential_damping: float = 1.0
    penetration: float = STATIC_PENETRATION

    def __post_init__(self) -> None:
        for name in ("tangential_ratio", "penetration") + (() if self.stiffness is None else ("stiffness",)):
            number(name, getattr(self, name), "a positive number", above=0.0)
        for name in ("damping_fraction", "friction", "tangential_damping"):
            number(name, getattr(self, name), "a number from 0 on", low=0.0, finite=name != "friction")

    @classmethod
    def stiff(
        cls,
        body: ContactBody,
        gravity: float,
        *,
        damping_fraction: float = 0.4,
        friction: float = 0.6,
        penetration: float = STATIC_PENETRATION,
    ) -> ContactLaw:
        """
        Choose the stiffness by how deep a standing body sinks.

        Parameters
        ----------
        body : ContactBody
        gravity : float
            m/s².
        damping_fraction, friction, penetration : float, optional
        """
        law = cls(damping_fraction=damping_fraction, friction=friction, penetration=penetration)
        return law.under(body.mass * gravity / float(body.node_area.sum()), body.height)

    def under(self, pressure: float, height: float) -> ContactLaw:
        """Return the law with its stiffness under a pressure (Pa) by what has its centre of mass at a height (m)."""
        return self if self.stiffness is not None else replace(self, stiffness=pressure / (self.penetration * height))

    def node_stiffness(self, body: Nodes) -> Array:
        """Normal stiffness of each base node, N/m, shape (n,)."""
        if self.stiffness is None:
            raise ValueError("The law has no stiffness yet; `under` gives it one, or `ContactLaw.stiff` of a body")
        return self.stiffness * body.node_area

    def node_damping(self, body: Nodes) -> Array:
        """Normal damping 2 ξ sqrt(m k) of each base node, N s/m, shape (n,)."""
        return np.asarray(2.0 * self.damping_fraction * np.sqrt(body.node_mass * self.node_stiffness(body)))

    def node_weights(self, body: ContactBody, gravity: float) -> Array:
        """What each base node bears of the standing body's weight, N, shape (n,)."""
        stiffness = self.node_stiffness(body)
        return np.asarray(body.mass * gravity * stiffness / stiffness.sum())

    def effective_damping(self, body: ContactBody) -> float:
        """
        Damping fraction ξ_eff of the whole body that bounces on all its nodes, Σc / (2 sqrt(M Σk)).

        What compares meshes: for nodes that carry the base layer of a mesh of first-order elements of length L,
        ξ_eff = ξ sqrt(L / 2 H), H the height of the body.
        """
        stiffness = float(self.node_stiffness(body).sum())
        return float(self.node_damping(body).sum()) / (2.0 * sqrt(body.mass * stiffness))
