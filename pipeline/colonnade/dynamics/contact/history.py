"""The results of the contact engine: how one body moved, or the bodies of an assembly; impacts, forces, energies."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, fields

import numpy as np
from numpy.typing import NDArray

from colonnade.arrays import Array
from colonnade.dynamics.assembly import Assembly
from colonnade.dynamics.block import Block
from colonnade.dynamics.contact.body import ContactBody, ContactLaw, rotation_matrices
from colonnade.dynamics.history import NO_ROCKING_RATIO, History, Outcome
from colonnade.dynamics.models import CONTACT
from colonnade.units.text import PERCENT, Digested
from colonnade.validation import instance, number

Whole = NDArray[np.intp]

LARGEST_RESIDUAL = 0.01
"""Of the energy balance, over its largest part; beyond it the run says that the balance does not close."""

SMALLEST_ARC = 1e-4
"""Of α: a body that leans by less is on neither side."""

BETWEEN = 3
"""Samples at most from one side to the other: a body that takes longer has come to rest."""


EDGE_ALONE = 32.0
"""Tilt beyond which the edge of a base bears the body alone, times its half width over what it sinks at rest: with it
the velocities at the impacts of a soft contact lose what the peaks between them do, within 0.0005 (a prism), 0.002 (a
cylinder)."""


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
    dissipated : ndarray
        By contact, friction and the modes' damping, since the start.
    """

    kinetic: Array
    potential: Array
    strain: Array
    contact: Array
    work: Array
    dissipated: Array

    @property
    def stored(self) -> Array:
        """Kinetic, potential, strain and contact energy, J, shape (n,)."""
        return np.asarray(self.kinetic + self.potential + self.strain + self.contact)

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


@dataclass(frozen=True, eq=False, kw_only=True)
class Together:
    """
    What is common to the bodies of a run.

    Attributes
    ----------
    law : ContactLaw
    time : ndarray, shape (n,)
        s.
    energies : EnergyBalance
        Of all bodies; it does not hold after the first of several has fallen.
    base_force : ndarray, shape (n, 3)
        N, of the table on all that stands on it: the mean since the sample before.
    step : float
        s.
    """

    law: ContactLaw
    time: Array
    energies: EnergyBalance
    base_force: Array
    step: float


@dataclass(frozen=True, eq=False, kw_only=True)
class Pose:
    """
    How a body is placed relative to what it is seen from, at each sample.

    Attributes
    ----------
    angle, out_of_plane_angle, yaw : ndarray, shape (n,)
        rad: rocking angle, positive when the top moves to +x; rotation about x; rotation about the vertical.
    slide : ndarray, shape (n, 2)
        m: displacement along x and y of the active pole, the point of the base at y = 0 that plane rocking turns about.
    uplift : ndarray, shape (n,)
        m: height of the lowest point of the base above where the base stands at rest.
    """

    angle: Array
    out_of_plane_angle: Array
    yaw: Array
    slide: Array
    uplift: Array


@dataclass(frozen=True, eq=False, kw_only=True)
class BodyHistory(Pose):
    """
    The history of one body, relative to the table; a body that has fallen stays where it fell.

    Attributes
    ----------
    below : Pose, optional
        Relative to the body that it stands on, or the first of several; None on the table.
    lean : ndarray, shape (n,)
        Angle with the vertical, over α, of the line from the base to the common centre of mass of the body and all that
        stands on it alone; α is that of this part of the assembly (`Assembly.critical_angles`).
    arm : ndarray, shape (n, 3)
        m: that line.
    position, velocity : ndarray, shape (n, 3)
        m and m/s, of the centre of mass relative to the table.
    orientation : ndarray, shape (n, 4)
        Unit quaternion (scalar first), body to table.
    turning : ndarray, shape (n, 3)
        Angular velocity in the table's axes, rad/s.
    overturning_time : float
        s, when it began to fall for good; NaN if it stands.
    """

    lean: Array
    arm: Array
    position: Array
    velocity: Array
    orientation: Array
    turning: Array
    overturning_time: float
    below: Pose | None = None

    @property
    def relative(self) -> Pose:
        """Relative to what it stands on: the table, a body, or the first of several."""
        return self.below or self

    @property
    def residual(self) -> tuple[float, float, float]:
        """Displacement along x and y, m, and yaw, rad, at the end, from where it stood at rest."""
        return float(self.slide[-1, 0]), float(self.slide[-1, 1]), float(self.yaw[-1])


@dataclass(frozen=True, eq=False, repr=False, kw_only=True)
class ContactHistory(History, BodyHistory, Together):
    """A rocking history in space of one `body`; after lying down (|tilt| = π/2) its last state is held."""

    body: ContactBody
    model: str = CONTACT.name

    @property
    def impact_restitution(self) -> Array:
        """
        Velocity after over before each impact, shape (m,).

        Negative where the block went back to the same side, NaN where it came without velocity.
        """
        arriving = np.where(self.impact_velocities == 0.0, np.nan, self.impact_velocities)
        return np.asarray(self.rebound_velocities / arriving)

    @property
    def warnings(self) -> tuple[str, ...]:
        """What the reader of this history has to know, one sentence each."""
        missing = self.energies.relative_residual
        if missing <= LARGEST_RESIDUAL:
            return ()
        return (
            f"The energy balance does not close: {100 * missing:.2g}{PERCENT} of the largest "
            f"energy is missing, {100 * LARGEST_RESIDUAL:g}{PERCENT} is allowed. "
            f"Try a step shorter than {self.step:.3g} s.",
        )


def passages(time: Array, angle: Array, critical_angle: float) -> tuple[Whole, Whole, Array]:
    """Find where a body rocks over to its other side: the last sample before, the first after, and when, s."""
    clear = np.flatnonzero(np.abs(angle) > SMALLEST_ARC * critical_angle)
    before, after = clear[:-1], clear[1:]
    passes = (angle[before] * angle[after] < 0.0) & (after - before <= BETWEEN)
    before, after = before[passes], after[passes]
    share = angle[before] / (angle[before] - angle[after])
    return before, after, time[before] + share * (time[after] - time[before])


def impacts_of(block: Block, time: Array, angle: Array, speed: Array, base: Array, sunk: float) -> dict[str, Array]:
    """
    Find the impacts of a symmetric block: times (s), velocities before and rebounds after (rad/s).

    `speed` is the angular momentum about the pole on the side of the angle, over the inertia about it, which the
    contact's own vibration does not change. An impact lasts for half a period of a body that bounces on all its nodes,
    which sinks by `sunk` (m) where it stands, and for as long as more than its edge touches: speeds of samples on
    either side are carried to θ = 0 by the energy of rocking about the pole at the base's acceleration (m/s²), so that
    they are those of an impact without duration.
    """
    before, after, times = passages(time, angle, block.critical_angle)
    rate = np.abs(angle[after] - angle[before]) / (time[after] - time[before])
    touching = EDGE_ALONE * sunk / block.governing.half_width
    lasts = np.maximum(np.pi * np.sqrt(sunk / block.gravity), touching / rate)
    # Not as far as the top of a short arc.
    free = np.diff(times, prepend=time[0], append=time[-1]) / 3.0
    before = np.clip(np.searchsorted(time, times - np.minimum(lasts, free[:-1])) - 1, 0, before)
    after = np.clip(np.searchsorted(time, times + np.minimum(lasts, free[1:])), after, time.size - 1)
    alpha, at_impact = block.critical_angle, np.interp(times, time, base)
    found = []
    for sample in (before, after):
        side, lean = np.sign(angle[sample]), alpha - np.abs(angle[sample])
        accelerated = side * 0.5 * (base[sample] + at_impact) / block.gravity
        rise = np.cos(lean) - np.cos(alpha) + accelerated * (np.sin(alpha) - np.sin(lean))
        square = speed[sample] ** 2 + 2.0 * block.p**2 * rise
        found.append(np.copysign(np.sqrt(np.maximum(0.0, square)), speed[sample]))
    return {"impact_times": times, "impact_velocities": found[0], "rebound_velocities": found[1]}


PARTED = 0.2
"""Of α: histories that differ by more have parted."""


@dataclass(frozen=True, eq=False, repr=False, kw_only=True)
class AssemblyHistory(Together, Digested):
    """
    How the bodies of an assembly rocked, slid and fell.

    Attributes
    ----------
    assembly : Assembly
    bodies : mapping of str to BodyHistory
        From the bottom to the top.
    law : ContactLaw
    time : ndarray, shape (n,)
        s.
    energies : EnergyBalance
        Of all bodies; it does not hold after the first has fallen.
    base_force : ndarray, shape (n, 3)
        N, of the table on all that stands on it: the mean since the sample before.
    step : float
        s.

    Examples
    --------
    >>> import colonnade
    >>> drum = colonnade.Block.prism(width=0.3, depth=0.3, height=0.3, mass=65.0)
    >>> column = colonnade.Assembly.stack(low=drum, high=drum)
    >>> history = colonnade.rock(column, model="contact", theta0=0.05, duration=0.1)
    >>> history.outcome, history.overturned_bodies
    ('rocking', ())
    >>> round(float(history.bodies["high"].angle[0]), 4), abs(round(float(history.bodies["high"].relative.angle[0]), 4))
    (0.05, 0.0)
    >>> round(float(history.angle[0]), 4)
    0.05
    >>> history.overturning_time, history.peak_ratio < 0.2, list(history.residuals)
    (nan, True, ['low', 'high'])
    >>> history.outlines()["low"].shape == (history.time.size, 4, 2), round(history.horizon(history), 3)
    (True, 0.1)
    >>> history.impact_times.size
    0
    """

    _ESSENCE = "outcome, overturned_bodies, peak_ratio, overturning_time s"

    assembly: Assembly
    bodies: Mapping[str, BodyHistory]

    @property
    def angle(self) -> Array:
        """
        Lean of the lowest body with all that stands on it alone, rad, positive to +x, shape (n,).

        The angle with the vertical of the line from its base to their common centre of mass.
        """
        name, body = next(iter(self.bodies.items()))
        return np.copysign(body.lean * self.assembly.critical_angles[name], body.arm[:, 0])

    @property
    def impact_times(self) -> Array:
        """When the lowest body rocks over to its other side, s, shape (m,)."""
        name, body = next(iter(self.bodies.items()))
        return passages(self.time, body.angle, self.assembly.critical_angles[name])[2]

    @property
    def overturned_bodies(self) -> tuple[str, ...]:
        """Names of the bodies that fell, the first one first."""
        fallen = {name: body.overturning_time for name, body in self.bodies.items()}
        return tuple(sorted((name for name in fallen if np.isfinite(fallen[name])), key=lambda name: fallen[name]))

    @property
    def overturning_time(self) -> float:
        """When the first body began to fall, s; NaN if all stand."""
        return min((self.bodies[name].overturning_time for name in self.overturned_bodies), default=float("nan"))

    @property
    def peak_ratio(self) -> float | None:
        """Largest lean of any body; None if one overturned."""
        return None if self.overturned_bodies else max(float(body.lean.max()) for body in self.bodies.values())

    @property
    def outcome(self) -> Outcome:
        """no-rocking, rocking or overturned, as for one body."""
        peak = self.peak_ratio
        return "overturned" if peak is None else "rocking" if peak > NO_ROCKING_RATIO else "no-rocking"

    @property
    def residuals(self) -> dict[str, tuple[float, float, float]]:
        """Displacement of each body along x and y, m, and its yaw, rad, at the end."""
        return {name: body.residual for name, body in self.bodies.items()}

    def outlines(self) -> dict[str, Array]:
        """
        Return where the corners of each body are, seen along y.

        Returns
        -------
        outlines : dict of str to ndarray, shape (n, 4, 2)
            x and z relative to the table, m.
        """
        found = {}
        for name, body in self.bodies.items():
            placed = self.assembly.bodies[name]
            base, below, solid = placed.block.governing.half_width, placed.centre_height, placed.block.solid
            top, height = (base, 2.0 * below) if solid is None else (solid.top[0], solid.height)
            corners = np.array([(-base, -below), (base, -below), (top, height - below), (-top, height - below)])
            matrices = rotation_matrices(body.orientation)[:, ::2, ::2]
            found[name] = np.einsum("nij,kj->nki", matrices, corners) + body.position[:, None, ::2]
        return found

    def horizon(self, other: AssemblyHistory, *, share: float = PARTED) -> float:
        """
        Return up to when this history and one of inputs that differ by little are the same.

        Parameters
        ----------
        other : AssemblyHistory
            At the same samples: with a shorter step, another friction, a motion times 1.001.
        share : float, optional
            Of α: leans of a body that differ by more have parted.

        Returns
        -------
        horizon : float
            s; the end of the history if they never part.
        """
        share = number("share", share, "a positive number", above=0.0)
        if instance("other", other, AssemblyHistory).time.size != self.time.size:
            raise ValueError("other has other samples; a history on the same motion was expected")
        apart = np.zeros(self.time.size, dtype=bool)
        for name, body in self.bodies.items():
            apart |= np.abs(body.lean - other.bodies[name].lean) > share
        return float(self.time[np.argmax(apart)] if apart.any() else self.time[-1])
