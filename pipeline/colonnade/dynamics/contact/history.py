"""The result of the contact engine: motion in space, impacts, forces and the energy balance."""

from __future__ import annotations

from dataclasses import dataclass, fields

import numpy as np

from colonnade.arrays import Array
from colonnade.dynamics.block import Block
from colonnade.dynamics.contact.body import ContactBody, ContactLaw
from colonnade.dynamics.history import NO_ROCKING_RATIO, History
from colonnade.dynamics.models import CONTACT
from colonnade.units.text import PERCENT

LARGEST_RESIDUAL = 0.01
"""Of the energy balance, over its largest part; beyond it the run says that the balance does not close."""

CHATTER = 0.05
"""An arc between two contacts that rises less than this share of what its speed allows does not count."""

SMALLEST_ARC = 1e-4
"""Of α: neither is a smaller one."""


@dataclass(frozen=True)
class EnergyBalance:
    """
    Energies along a run, J, each of shape (n,).

    Attributes
    ----------
    kinetic, potential : ndarray
        Relative to the table, the elastic modes' included; of gravity, from the table's surface on.
    strain, contact : ndarray
        Stored in the elastic modes; in the contact's springs, normal and tangential.
    work : ndarray
        Of the table's acceleration on the body, as seen from the table, since the start.
    dissipated_contact, dissipated_friction, dissipated_bulk : ndarray
        By the contact's damping, by sliding, by the modes' damping, since the start.
    """

    kinetic: Array
    potential: Array
    strain: Array
    contact: Array
    work: Array
    dissipated_contact: Array
    dissipated_friction: Array
    dissipated_bulk: Array

    @property
    def stored(self) -> Array:
        """Kinetic, potential, strain and contact energy, J, shape (n,)."""
        return np.asarray(self.kinetic + self.potential + self.strain + self.contact)

    @property
    def dissipated(self) -> Array:
        """What contact, friction and bulk have taken since the start, J, shape (n,)."""
        return np.asarray(self.dissipated_contact + self.dissipated_friction + self.dissipated_bulk)

    @property
    def residual(self) -> Array:
        """Stored and dissipated energy beyond what was there and what the table gave, J, shape (n,); 0 where exact."""
        return np.asarray(self.stored - self.stored[0] + self.dissipated - self.work)

    @property
    def relative_residual(self) -> float:
        """Largest |residual| over the largest of all energies, potential energy counted from the start."""
        parts = [getattr(self, part.name) for part in fields(self) if part.name != "potential"]
        largest = max(float(np.abs(part).max()) for part in (*parts, self.potential - self.potential[0]))
        return float(np.abs(self.residual).max()) / largest if largest > 0.0 else 0.0

    @property
    def closes(self) -> bool:
        """Whether the balance is kept to `LARGEST_RESIDUAL`."""
        return self.relative_residual <= LARGEST_RESIDUAL


@dataclass(frozen=True, kw_only=True)
class ContactHistory(History):
    """
    A rocking history in space; after lying down (|tilt| = π/2) its last state is held.

    Attributes
    ----------
    body, law : ContactBody, ContactLaw
        What was computed.
    step : float
        s.
    position, velocity : ndarray, shape (n, 3)
        Of the centre of mass relative to the table, m and m/s.
    orientation : ndarray, shape (n, 4)
        Unit quaternion (scalar first), body to table.
    turning : ndarray, shape (n, 3)
        Angular velocity in the table's axes, rad/s.
    out_of_plane, yaw : ndarray, shape (n,)
        rad: rotation about x, of the body's axis; about that axis.
    slide : ndarray, shape (n, 2)
        m: displacement along x and y of the active pole, the point of the base at y = 0 that plane rocking turns about.
    uplift : ndarray, shape (n,)
        m: height of the lowest point of the base; slightly negative in contact.
    base_force : ndarray, shape (n, 3)
        N, of the table on the body, along x, y, z: the mean since the sample before.
    energies : EnergyBalance
    airborne : float
        s, the time in which nothing touched.
    """

    body: ContactBody
    law: ContactLaw
    step: float
    position: Array
    velocity: Array
    orientation: Array
    turning: Array
    out_of_plane: Array
    yaw: Array
    slide: Array
    uplift: Array
    base_force: Array
    energies: EnergyBalance
    airborne: float
    model: str = CONTACT.name

    @property
    def tilt(self) -> Array:
        """Angle of the body's axis with the vertical, rad, shape (n,)."""
        return tilt(self.orientation)

    @property
    def impact_restitution(self) -> Array:
        """
        Velocity after over before each impact, shape (m,).

        Negative where the block went back to the same side, NaN where it came without velocity.
        """
        unknown = np.full(self.impact_velocities.shape, np.nan)
        moving = self.impact_velocities != 0.0
        return np.asarray(np.divide(self.rebound_velocities, self.impact_velocities, out=unknown, where=moving))

    @property
    def warnings(self) -> tuple[str, ...]:
        """What the reader of this history has to know, one sentence each."""
        alpha, weight = self.block.critical_angle, self.block.mass * self.block.gravity
        # What cannot lift the block to where rocking counts is not missed.
        lift = np.cos((1.0 - NO_ROCKING_RATIO) * alpha) - np.cos(alpha)
        least = weight * self.block.pole_distance * lift
        if self.energies.closes or np.abs(self.energies.residual).max() <= least:
            return ()
        return (
            f"The energy balance does not close: {100 * self.energies.relative_residual:.2g}{PERCENT} of the largest "
            f"energy is missing, {100 * LARGEST_RESIDUAL:g}{PERCENT} is allowed. "
            f"Try a step shorter than {self.step:.3g} s.",
        )


def tilt(orientation: Array) -> Array:
    """Return the angle of the body's z axis with the vertical, rad, shape (n,), of quaternions (n, 4)."""
    across = 2.0 * np.hypot(orientation[:, 1], orientation[:, 2]) * np.hypot(orientation[:, 0], orientation[:, 3])
    upright = 1.0 - 2.0 * (orientation[:, 1] ** 2 + orientation[:, 2] ** 2)
    return np.asarray(np.arctan2(across, upright))


def impacts_of(table: Array, block: Block) -> tuple[Array, Array, Array]:
    """
    Turn contacts on both sides into impacts between two arcs.

    Parameters
    ----------
    table : ndarray, shape (m, IMPACT)
        As the engine gives them.
    block : Block
        Symmetric.

    Returns
    -------
    times, velocities, rebounds : ndarray, shape (k,)
        s, when the impact begins; rad/s, just before and after it. A rebound that did not end within the run, or that
        leaves the block at rest, is 0.

    Notes
    -----
    An impact lasts. Speeds at its two ends are carried to θ = 0 by the energy of rocking about the pole at the base's
    acceleration of that instant, so that they are those of an impact without duration. Contacts that follow each other
    without an arc between them are one impact.
    """
    alpha = block.critical_angle
    kept: list[Array] = []
    for row in table:
        if kept:
            before = kept[-1]
            speed = _at_zero(block, before[6], before[7], before[3], before[8])
            reachable = alpha * (1.0 - np.sqrt(max(0.0, 1.0 - (speed / (block.p * alpha)) ** 2)))
            if row[9] < max(CHATTER * reachable, SMALLEST_ARC * alpha):
                before[5:9] = row[5:9]
                continue
        kept.append(row.copy())
    times = np.array([row[0] for row in kept])
    velocities = np.array([_at_zero(block, row[1], row[2], row[3], row[4]) for row in kept])
    rebounds = np.array(
        [_at_zero(block, row[6], row[7], row[3], row[8]) if np.isfinite(row[5]) else 0.0 for row in kept]
    )
    return times, velocities, rebounds


def _at_zero(block: Block, angle: float, speed: float, base: float, pole: float) -> float:
    """Carry the speed of rocking about a pole (±1) from an angle to 0."""
    alpha, lean = block.critical_angle, block.critical_angle - pole * angle
    rise = np.cos(lean) - np.cos(alpha) + pole * base / block.gravity * (np.sin(alpha) - np.sin(lean))
    return float(np.copysign(np.sqrt(max(0.0, speed**2 + 2.0 * block.p**2 * rise)), speed))
