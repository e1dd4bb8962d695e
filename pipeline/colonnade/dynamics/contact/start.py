"""How a body starts: on the table, tilted, turned and rocking, or anywhere."""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from math import hypot, tan

import numpy as np
import scipy

from colonnade.arrays import Array
from colonnade.dynamics.assembly import Assembly, Placed
from colonnade.dynamics.contact.body import ContactBody, ContactLaw
from colonnade.dynamics.contact.structure import Structure, on_face


@dataclass(frozen=True)
class Start:
    """
    Where a body is and how it moves at the start, relative to the table.

    Attributes
    ----------
    position, velocity : ndarray, shape (3,)
        Of the centre of mass, m and m/s.
    orientation : ndarray, shape (4,)
        Quaternion (scalar first), body to table; any length but 0.
    angular_velocity : ndarray, shape (3,)
        rad/s, in the table's axes.
    """

    position: Array
    velocity: Array = field(default_factory=lambda: np.zeros(3))
    orientation: Array = field(default_factory=lambda: np.array([1.0, 0.0, 0.0, 0.0]))
    angular_velocity: Array = field(default_factory=lambda: np.zeros(3))

    @property
    def row(self) -> Array:
        """Position, velocity, unit quaternion, and angular velocity in the body's axes, shape (13,)."""
        orientation = self.orientation / np.linalg.norm(self.orientation)
        turning = rotation_matrices(orientation).T @ self.angular_velocity
        return np.concatenate((self.position, self.velocity, orientation, turning))


def standing(
    body: ContactBody,
    law: ContactLaw,
    gravity: float,
    *,
    theta0: float = 0.0,
    omega0: float = 0.0,
    out_of_plane: float = 0.0,
    weight: float | None = None,
) -> Start:
    """
    Put a body on the table, so deep that its contact bears its weight (or the `weight` given, N), and give it a rocking
    velocity.

    `theta0` and `out_of_plane` in rad; `omega0`, rad/s, is about the pole at ±x on the side of θ₀ (of ω₀ where θ₀ is
    0), which is where the upright body has it.
    """
    axis = np.array([tan(theta0), -tan(out_of_plane), 1.0])
    axis /= np.linalg.norm(axis)
    orientation = np.array([1.0 + axis[2], -axis[1], axis[0], 0.0]) / np.sqrt(2.0 * (1.0 + axis[2]))
    matrix = rotation_matrices(orientation)
    pole = np.array([np.sign(theta0 or omega0) * body.half_width, 0.0, -body.height])
    arm, angular = matrix @ pole, np.array([0.0, omega0, 0.0])
    position = pole - arm
    position[2] = _bearing_height(
        body, matrix[2], law.node_stiffness(body), body.mass * gravity if weight is None else weight
    )
    return Start(position, np.cross(angular, -arm), orientation, angular)


def standing_assembly(
    assembly: Assembly, structure: Structure, *, theta0: float = 0.0, omega0: float = 0.0
) -> dict[str, Start]:
    """
    Put the bodies of an assembly on the table and on each other, so deep that each contact bears what is above it.

    Bodies on the table begin as `standing`; one that stands on a single other turns with it, one on several stays
    level and goes along with the uppermost points of their tops.
    """
    starts: dict[str, Start] = {}
    joints = iter(structure.joints)
    for (name, placed), body in zip(assembly.bodies.items(), structure.bodies, strict=True):
        if not placed.on:
            joint = next(joints)
            law, gravity = joint.sides[0].law, assembly.gravity
            on_table = standing(body, law, gravity, theta0=theta0, omega0=omega0, weight=joint.load)
            starts[name] = replace(on_table, position=on_table.position + np.append(placed.position, 0.0))
            continue
        found = []
        for below in placed.on:
            joint = next(joints)
            bearing = sum(float(side.law.node_stiffness(side.at) @ on_face(side)) for side in joint.sides)
            rest = np.array(joint.sides[0].apart) - [0.0, 0.0, joint.load / bearing]
            found.append(_carried(starts[below], rest, assembly.bodies[below], len(placed.on) == 1))
        starts[name] = Start(
            np.mean([one.position for one in found], axis=0),
            np.mean([one.velocity for one in found], axis=0),
            found[0].orientation,
            found[0].angular_velocity,
        )
    return starts


def _carried(below: Start, rest: Array, placed: Placed, turns: bool) -> Start:
    """Give the start of a body that at rest is `rest` from the centre of mass of the one that it stands on."""
    matrix, solid = rotation_matrices(below.orientation), placed.block.solid
    if turns:
        arm = matrix @ rest
        velocity = below.velocity + np.cross(below.angular_velocity, arm)
        return Start(below.position + arm, velocity, below.orientation, below.angular_velocity)
    assert solid is not None  # the assembly has seen to it
    tilted = -np.sign(matrix[0, 2]) if abs(matrix[0, 2]) > 0.0 else 0.0
    corner = np.array([tilted * solid.top[0], 0.0, solid.height - placed.centre_height])
    arm = matrix @ corner
    velocity = below.velocity + np.cross(below.angular_velocity, arm)
    return Start(below.position + arm - corner + rest, velocity)


def _bearing_height(body: ContactBody, upward: Array, stiffness: Array, weight: float) -> float:
    """Find the height of the centre of mass at which rings, and points (rings without rise), bear the weight."""
    rise = body.ring_radii * hypot(upward[0], upward[1])
    lowest = np.where(body.ring_radii > 0.0, body.nodes[:, 2] * upward[2], body.nodes @ upward) - rise
    above = lowest - lowest.min()

    def excess(sunk: float) -> float:
        # The mean depth all around, (d − r σ) φ/π + r σ sin(φ)/π, of an arc of ± φ that is d deep at its lowest point.
        depth = sunk - above
        share = np.divide(depth, 2.0 * rise, out=(depth > 0.0).astype(float), where=rise > 0.0)
        half = 2.0 * np.arcsin(np.sqrt(np.clip(share, 0.0, 1.0)))
        return float(stiffness @ ((depth - rise) * half + rise * np.sin(half)) / np.pi) - weight

    # Twice as deep as an upright body, of which the bound would else be the root itself, missed by rounding.
    deepest = 2.0 * (weight / float(stiffness.sum()) + float(rise.max())) + float(above.max())
    return float(-lowest.min() - scipy.optimize.brentq(excess, 0.0, deepest, xtol=1e-20, rtol=1e-15))


def rotation_matrices(orientation: Array) -> Array:
    """Return the rotation matrices, shape (…, 3, 3), of unit quaternions, shape (…, 4)."""
    w, x, y, z = np.moveaxis(orientation, -1, 0)
    rows = [
        [1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
        [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
        [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)],
    ]
    return np.moveaxis(np.array(rows), (0, 1), (-2, -1))
