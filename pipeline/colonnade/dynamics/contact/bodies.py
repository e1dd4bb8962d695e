"""The result of the contact engine for an assembly: how each body moved, and what became of all."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from colonnade.arrays import Array
from colonnade.dynamics.assembly import Assembly
from colonnade.dynamics.contact.body import ContactLaw
from colonnade.dynamics.contact.history import EnergyBalance
from colonnade.dynamics.contact.start import rotation_matrices
from colonnade.dynamics.history import NO_ROCKING_RATIO, Outcome
from colonnade.units.text import Digested, written
from colonnade.validation import instance, number

PARTED = 0.2
"""Of α: histories that differ by more have parted."""


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
    The history of one body of an assembly, relative to the table; a body that has fallen stays where it fell.

    Attributes
    ----------
    supports : mapping of str to Pose
        Relative to each body that it stands on, by name; empty on the table.
    lean : ndarray, shape (n,)
        Angle with the vertical, over α, of the line from the base to the common centre of mass of the body and all that
        stands on it alone; α is that of this part of the assembly (`Assembly.critical_angles`).
    position, orientation : ndarray, shape (n, 3) and (n, 4)
        m, of the centre of mass relative to the table; unit quaternion (scalar first), body to table.
    impact_times, impact_velocities, rebound_velocities : ndarray, shape (m,)
        s; rad/s about the pole relative to what it stands on, just before and after.
    dissipated_contact, dissipated_friction : ndarray, shape (n,)
        J, taken where it stands since the start.
    overturning_time : float
        s, when it began to fall for good; NaN if it stands.
    """

    supports: Mapping[str, Pose]
    lean: Array
    position: Array
    orientation: Array
    impact_times: Array
    impact_velocities: Array
    rebound_velocities: Array
    dissipated_contact: Array
    dissipated_friction: Array
    overturning_time: float

    @property
    def relative(self) -> Pose:
        """Relative to what it stands on: the table, a body, or the first of several."""
        return next(iter(self.supports.values()), self)

    @property
    def residual(self) -> tuple[float, float, float]:
        """Displacement along x and y, m, and yaw, rad, at the end, from where it stood at rest."""
        return float(self.slide[-1, 0]), float(self.slide[-1, 1]), float(self.yaw[-1])


@dataclass(frozen=True, eq=False, repr=False, kw_only=True)
class AssemblyHistory(Digested):
    """
    How the bodies of an assembly rocked, slid and fell.

    Attributes
    ----------
    assembly : Assembly
    law : ContactLaw
    time : ndarray, shape (n,)
        s.
    angle : ndarray, shape (n,)
        rad, positive to +x: lean of the lowest body with all that stands on it alone, the angle with the vertical of
        the line from its base to their common centre of mass.
    bodies : mapping of str to BodyHistory
        From the bottom to the top.
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
    >>> history.digest()["outcome"], history.overturning_time, history.peak_ratio < 0.2, list(history.residuals)
    ('rocking', nan, True, ['low', 'high'])
    >>> history.outlines()["low"].shape == (history.time.size, 4, 2), round(history.horizon(history), 3)
    (True, 0.1)
    """

    assembly: Assembly
    law: ContactLaw
    time: Array
    angle: Array
    bodies: Mapping[str, BodyHistory]
    energies: EnergyBalance
    base_force: Array
    step: float

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

    def digest(self) -> dict[str, str]:
        """
        Return outcome, what overturned or the largest lean, and the largest residual displacement.

        Returns
        -------
        digest : dict of str to str
            Names and values with their units, as a notebook shows them.
        """
        fallen = ", ".join(self.overturned_bodies)
        name, text = ("overturned", fallen) if fallen else ("max lean/α", written(self.peak_ratio))
        moved = max(float(np.hypot(x, y)) for x, y, _ in self.residuals.values())
        return {
            "outcome": self.outcome,
            name: text,
            "largest residual displacement": written(moved, "m"),
            "duration": written(float(self.time[-1] - self.time[0]), "s"),
            "model": "contact",
        }
