"""One run of the contact model: body or assembly, law and table motion in, history out."""

from __future__ import annotations

from collections.abc import Mapping
from math import ceil, hypot
from typing import Unpack

import numpy as np

from colonnade.arrays import Array, Mask
from colonnade.dynamics.assembly import Assembly
from colonnade.dynamics.block import STANDARD_GRAVITY, Block, Side
from colonnade.dynamics.contact.body import DEFAULT_STEP, ContactBody, ContactLaw, Tilts, rotation_matrices
from colonnade.dynamics.contact.history import (
    AssemblyHistory,
    BodyHistory,
    ContactHistory,
    EnergyBalance,
    Pose,
    Together,
    impacts_of,
)
from colonnade.dynamics.contact.march import march
from colonnade.dynamics.contact.stability import longest_step
from colonnade.dynamics.contact.start import Start, standing
from colonnade.dynamics.contact.state import TABLE, State
from colonnade.dynamics.contact.structure import Structure
from colonnade.dynamics.motion import Motion, at_rest
from colonnade.validation import number

MOST_STEPS = 2e9
"""Of a run: hours; more does not end while somebody waits for it."""

STEP_SHARE = 0.2
"""Of the longest stable step: the default step is at most this."""

AFTERMATH = 20.0
"""In 1/p: how long a block that is past α at the record's end is given to fall or to come back."""


def simulate(
    body: ContactBody,
    motion: Motion | None = None,
    *,
    law: ContactLaw,
    gravity: float = STANDARD_GRAVITY,
    duration: float | None = None,
    step: float | None = None,
    start: Start | None = None,
    **tilts: Unpack[Tilts],
) -> ContactHistory:
    """
    Compute how a body moves on a table that it touches at its base nodes.

    Parameters
    ----------
    body : ContactBody
    motion : Motion, optional
        Table motion along x and, where given, y and z; without it the body moves freely for `duration`.
    law : ContactLaw
    gravity : float, optional
        m/s².
    duration : float, optional
        s, only without a motion. The history is then sampled at about 1/(500 p).
    step : float, optional
        Largest step, s; each interval of the motion is divided into equal ones. Default: 5 µs, or a fifth of the
        longest stable step where that is shorter.
    start : Start, optional
        Any state at the start.
    **tilts : float, optional
        Instead of that the body on the table, as of `standing`: `theta0`, `omega0`, `out_of_plane`.

    Returns
    -------
    history : ContactHistory
        At the motion's samples.

    Raises
    ------
    ValueError
        If an argument is out of its range, or the step is longer than the longest stable one, which is then given.

    Examples
    --------
    >>> from colonnade.dynamics.contact.body import rigid_body
    >>> block = Block.prism(width=0.086, depth=0.086, height=0.456, mass=26.10)
    >>> body = rigid_body(block)
    >>> law = ContactLaw(damping_fraction=0.4).bearing(body, block.gravity)
    >>> simulate(body, law=law, theta0=0.3 * block.critical_angle, duration=0.2).outcome
    'rocking'
    """
    structure = Structure.of_body(body, law, gravity)
    starts = standing(structure, **tilts) if start is None else [start]
    together, (own,) = _run(structure, starts, motion, duration, step)
    matrices, block = rotation_matrices(own.orientation), plane_block(body, gravity)
    axis = matrices[:, :, 2]
    rate = np.cross(own.turning, axis)
    speed = (rate[:, 0] * axis[:, 2] - axis[:, 0] * rate[:, 2]) / (axis[:, 0] ** 2 + axis[:, 2] ** 2)
    # About the pole on the side of the angle: the angular momentum over the inertia.
    spin = np.einsum("nj,j,nkj,nk->n", matrices[:, 1], body.inertia, matrices, own.turning)
    orbit = np.cross(-_poles(body, matrices, own.angle), own.velocity)[:, 1]
    about = (spin + body.mass * orbit) / block.inertia
    base = np.zeros(own.angle.size) if motion is None else motion.acceleration
    sunk = body.mass * gravity / float(together.law.node_stiffness(body).sum())
    impacts = impacts_of(block, together.time, own.angle, about, base, sunk)
    # One that lies has its angle there.
    lies = np.abs(own.angle) >= 0.5 * np.pi
    lying = {"angle": np.clip(own.angle, -0.5 * np.pi, 0.5 * np.pi), "angular_velocity": np.where(lies, 0.0, speed)}
    return ContactHistory(**vars(together) | vars(own) | lying | impacts, block=block, body=body)


def simulate_assembly(
    assembly: Assembly,
    motion: Motion | None = None,
    *,
    law: ContactLaw,
    duration: float | None = None,
    step: float | None = None,
    starts: Mapping[str, Start] | None = None,
    structure: Structure | None = None,
    **tilts: Unpack[Tilts],
) -> AssemblyHistory:
    """
    Compute how the bodies of an assembly move on a table and on each other.

    Parameters
    ----------
    assembly : Assembly
    motion, duration, step
        As of `simulate`.
    law : ContactLaw
        Of all interfaces. Without a stiffness, each has its own by the weight above it.
    starts : mapping of str to Start, optional
        Of single bodies by name, instead of `tilts`.
    structure : Structure, optional
        With other nodes than the default; its law counts.
    **tilts : float, optional
        As of `simulate`, of all bodies on the table.

    Returns
    -------
    history : AssemblyHistory
        At the motion's samples.

    Raises
    ------
    ValueError
        If an argument is out of its range, or the step is longer than the longest stable one, which is then given.
    """
    structure = Structure.of_assembly(assembly, law) if structure is None else structure
    begin = dict(zip(structure.names, standing(structure, **tilts), strict=True)) | dict(starts or {})
    together, bodies = _run(structure, list(begin.values()), motion, duration, step)
    return AssemblyHistory(**vars(together), assembly=assembly, bodies=dict(zip(structure.names, bodies, strict=True)))


def plane_block(body: ContactBody, gravity: float) -> Block:
    """Give the block whose plane rocking about y is that of a body, for its α, R, I₀ and p."""
    angle, distance = float(np.arctan2(body.half_width, body.height)), hypot(body.half_width, body.height)
    side = Side(angle, distance, float(body.inertia[1]) + body.mass * distance**2)
    return Block(body.mass, gravity, side, side)


def _run(
    structure: Structure, starts: list[Start], motion: Motion | None, duration: float | None, step: float | None
) -> tuple[Together, list[BodyHistory]]:
    """Run bodies from their starts; those that are past α at the end until they fall or come back."""
    first = plane_block(structure.bodies[0], structure.gravity)
    motion = at_rest(first, duration) if motion is None else motion
    parts, nothing = _parts(structure, motion, step), np.zeros(motion.acceleration.size)
    along = motion.acceleration, motion.transverse, motion.vertical
    table = np.column_stack([nothing if values is None else values for values in along])
    rows = np.array([start.row for start in starts])
    samples, sums, stands = _march(structure, rows, table, motion.dt, parts)
    matrices, arms = rotation_matrices(samples[:, :, 6:10]), np.zeros((*samples.shape[:2], 3))
    for row, (body, names) in enumerate(zip(structure.bodies, structure.together, strict=True)):
        masses = np.array([structure.bodies[other].mass for other in names])
        base = samples[:, row, :3] - body.height * matrices[:, row, :, 2]
        arms[:, row] = np.einsum("nbi,b->ni", samples[:, names, :3], masses / masses.sum()) - base
    leans = np.arctan2(np.hypot(arms[:, :, 0], arms[:, :, 1]), arms[:, :, 2]) / structure.critical_angles
    if (stands & (leans[-1] > 1.0)).any():
        still = np.zeros((ceil(AFTERMATH / (first.p * motion.dt)) + 1, 3))
        *_, stands = _march(structure, samples[-1], still, motion.dt, parts)
    upright = np.where(leans <= 1.0, np.arange(len(leans))[:, None], -1).max(axis=0)
    times = np.where(stands, np.nan, motion.time[np.minimum(upright + 1, len(leans) - 1)])
    bodies = []
    for row, body in enumerate(structure.bodies):
        place, below = samples[:, row, :3], None
        side = structure.joints[row][0].sides[0]
        if side.target != TABLE:
            turned = np.swapaxes(matrices[:, side.target], 1, 2)
            apart = np.einsum("nij,nj->ni", turned, place - samples[:, side.target, :3]) - side.apart
            below = Pose(**_pose(body, turned @ matrices[:, row], apart))
        own = BodyHistory(
            **_pose(body, matrices[:, row], place - structure.rest[row]),
            below=below,
            lean=leans[:, row],
            arm=arms[:, row],
            position=place,
            velocity=samples[:, row, 3:6],
            orientation=samples[:, row, 6:10],
            turning=np.einsum("nij,nj->ni", matrices[:, row], samples[:, row, 10:13]),
            overturning_time=float(times[row]),
        )
        bodies.append(own)
    law, energies = structure.interfaces[0].law, EnergyBalance(*sums[:, :6].T)
    common = Together(law=law, time=motion.time, energies=energies, base_force=sums[:, 6:], step=motion.dt / parts)
    return common, bodies


def _parts(structure: Structure, motion: Motion, step: float | None) -> int:
    """Give the number of steps in an interval of a motion."""
    longest = longest_step(structure)
    if step is None:
        step = min(DEFAULT_STEP, STEP_SHARE * longest)
    step = number("step", step, "a positive step in s", above=0.0)
    steps = motion.dt / step * motion.acceleration.size
    if steps > MOST_STEPS:
        raise ValueError(
            f"step is {step:.4g} s, of which {motion.acceleration.size} intervals of {motion.dt:.4g} s (dt) hold "
            f"{steps:.3g}; at most {MOST_STEPS:.0e} were expected"
        )
    parts = max(1, ceil(motion.dt / step * (1.0 - 1e-12)))
    if motion.dt / parts > longest:
        raise ValueError(
            f"step is {step:.4g} s; at most {longest:.4g} s was expected: beyond it the contact of this "
            "body and law is unstable. Use a shorter step or a softer contact."
        )
    return parts


def _march(structure: Structure, rows: Array, table: Array, interval: float, parts: int) -> tuple[Array, Array, Mask]:
    """Call the engine from the bodies' rows, as of `Start`; give samples, sums, stands."""
    system = structure.system(interval / parts)
    state, samples, sums = State.begin(system, rows), np.zeros((len(table), len(rows), 13)), np.zeros((len(table), 9))
    reached = march(system, state, table, interval, parts, samples, sums)
    # Where all have fallen before the end, the last sample is held.
    for values in (samples, sums):
        values[reached:] = values[reached - 1]
    return samples, sums, state.stands[:TABLE] > 0


def _poles(body: ContactBody, matrices: Array, angle: Array) -> Array:
    """Give the pole on the side of an angle from the centre of mass, in the axes that a body is turned from, (n, 3)."""
    side = np.where(angle < 0.0, -body.half_width, body.half_width)
    return side[:, None] * matrices[:, :, 0] - body.height * matrices[:, :, 2]


def _pose(body: ContactBody, matrices: Array, moved: Array) -> dict[str, Array]:
    """Give the pose of a body, turned by matrices and with its centre of mass `moved` from where it is at rest."""
    axis, upward = matrices[:, :, 2], matrices[:, 2]
    angle = np.arctan2(axis[:, 0], axis[:, 2])
    upright = np.broadcast_to(np.eye(3), matrices.shape)
    slide = moved + _poles(body, matrices, angle) - _poles(body, upright, angle)
    # Of a ring, whose point at +x is its node, the lowest point is where it goes down most.
    rings = np.outer(upward[:, 2], body.nodes[:, 2]) - np.outer(np.hypot(*upward.T[:2]), body.ring_radii)
    lowest = np.where(body.ring_radii > 0.0, rings, upward @ body.nodes.T).min(axis=1)
    return {
        "angle": angle,
        "out_of_plane_angle": np.arctan2(-axis[:, 1], axis[:, 2]),
        "yaw": np.unwrap(np.arctan2(matrices[:, 1, 0] - matrices[:, 0, 1], matrices[:, 0, 0] + matrices[:, 1, 1])),
        "slide": slide[:, :2],
        "uplift": moved[:, 2] + body.height + lowest,
    }
