"""How a body starts: on the table, tilted, turned and rocking, or anywhere."""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from math import hypot, tan

import numpy as np
import scipy

from colonnade.arrays import Array
from colonnade.dynamics.contact.body import ContactBody, rotation_matrices
from colonnade.dynamics.contact.state import TABLE
from colonnade.dynamics.contact.structure import Joint, Structure


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
    structure: Structure, *, theta0: float = 0.0, omega0: float = 0.0, out_of_plane: float = 0.0
) -> list[Start]:
    """
    Put bodies on the table and on each other, so deep that each contact bears what is above it, and let them rock.

    `theta0` and `out_of_plane` in rad, of bodies on the table; `omega0`, rad/s, is about the pole at ±x on the side of
    θ₀ (of ω₀ where θ₀ is 0), which is where the upright body has it. One that stands on a single other turns with it,
    one on several stays level and goes along with the uppermost points of their tops.
    """
    starts: list[Start] = []
    for body, rest, joints in zip(structure.bodies, structure.rest, structure.joints, strict=True):
        if joints[0].sides[0].target == TABLE:
            starts.append(_on_table(body, rest, joints[0], theta0, omega0, out_of_plane))
        else:
            found = [_carried(starts[joint.sides[0].target], joint, len(joints) == 1) for joint in joints]
            position = np.mean([one.position for one in found], axis=0)
            velocity = np.mean([one.velocity for one in found], axis=0)
            starts.append(replace(found[0], position=position, velocity=velocity))
    return starts


def _on_table(body: ContactBody, rest: Array, joint: Joint, theta0: float, omega0: float, out_of_plane: float) -> Start:
    axis = np.array([tan(theta0), -tan(out_of_plane), 1.0])
    axis /= np.linalg.norm(axis)
    orientation = np.array([1.0 + axis[2], -axis[1], axis[0], 0.0]) / np.sqrt(2.0 * (1.0 + axis[2]))
    matrix = rotation_matrices(orientation)
    pole = np.array([np.sign(theta0 or omega0) * body.half_width, 0.0, -body.height])
    arm, angular = matrix @ pole, np.array([0.0, omega0, 0.0])
    position = rest - arm + pole
    stiffness = joint.sides[0].law.node_stiffness(body)
    position[2] = _bearing_height(body, matrix[2], stiffness, joint.load)
    return Start(position, np.cross(angular, -arm), orientation, angular)


def _carried(below: Start, joint: Joint, turns: bool) -> Start:
    """Give the start of a body by that of one that it stands on, which it turns with or whose uppermost point bears."""
    side, matrix = joint.sides[0], rotation_matrices(below.orientation)
    bearing = sum(float(each.law.node_stiffness(each.at) @ each.on_face) for each in joint.sides)
    rest = side.apart - [0.0, 0.0, joint.load / bearing]
    held = rest if turns else np.array([-np.sign(matrix[0, 2]) * side.face[0], 0.0, side.face[4]])
    arm = matrix @ held
    start = Start(below.position + arm - held + rest, below.velocity + np.cross(below.angular_velocity, arm))
    if turns:
        return replace(start, orientation=below.orientation, angular_velocity=below.angular_velocity)
    return start


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
