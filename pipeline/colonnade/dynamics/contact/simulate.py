"""One run of the contact model: body or assembly, law and table motion in, history out."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from math import ceil, hypot

import numpy as np

from colonnade.arrays import Array, Mask
from colonnade.dynamics.assembly import Assembly
from colonnade.dynamics.block import STANDARD_GRAVITY, Block
from colonnade.dynamics.contact.body import DEFAULT_STEP, ContactBody, ContactLaw
from colonnade.dynamics.contact.history import (
    AssemblyHistory,
    BodyHistory,
    ContactHistory,
    EnergyBalance,
    Pose,
    impacts_of,
)
from colonnade.dynamics.contact.march import march
from colonnade.dynamics.contact.stability import longest_step
from colonnade.dynamics.contact.start import Start, rotation_matrices, standing, standing_assembly
from colonnade.dynamics.contact.state import IMPACT, TABLE, State
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
    theta0: float = 0.0,
    omega0: float = 0.0,
    out_of_plane: float = 0.0,
    start: Start | None = None,
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
    theta0, omega0, out_of_plane : float, optional
        The body at the start, on the table: angle (rad) and angular velocity (rad/s) about y, rotation about x.
    start : Start, optional
        Instead of these, any other state.

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
    >>> law = ContactLaw.stiff(body, block.gravity, damping_fraction=0.4)
    >>> simulate(body, law=law, theta0=0.3 * block.critical_angle, duration=0.2).outcome
    'rocking'
    """
    block = plane_block(body, gravity)
    motion = at_rest(block, duration) if motion is None else motion
    structure = Structure.of_body(body, law, gravity)
    law = structure.interfaces[0].law
    if start is None:
        start = standing(body, law, gravity, theta0=theta0, omega0=omega0, out_of_plane=out_of_plane)
    run = _run(structure, [start], motion, step)
    own, matrices = run.samples[:, 0], run.matrices[:, 0]
    axis, turning = matrices[:, :, 2], np.einsum("nij,nj->ni", matrices, own[:, 10:13])
    rate = np.cross(turning, axis)
    speed = (rate[:, 0] * axis[:, 2] - axis[:, 0] * rate[:, 2]) / (axis[:, 0] ** 2 + axis[:, 2] ** 2)
    pose = _pose(body, matrices, own[:, :3] - [0.0, 0.0, body.height])
    if run.reached < len(own):
        # One that lies has its angle there.
        last = run.reached - 1
        pose["angle"][last:], speed[last:] = np.copysign(0.5 * np.pi, axis[last, 0]), 0.0
    return ContactHistory(
        block,
        motion.time,
        pose["angle"],
        speed,
        *impacts_of(run.impacts, block),
        float(run.overturning_times[0]),
        body=body,
        law=law,
        step=run.step,
        position=own[:, :3],
        velocity=own[:, 3:6],
        orientation=own[:, 6:10],
        turning=turning,
        out_of_plane=pose["out_of_plane_angle"],
        yaw=pose["yaw"],
        slide=pose["slide"],
        uplift=pose["uplift"],
        base_force=run.base_force,
        energies=run.energies,
        airborne=float(run.joints[-1, 0, 6]),
    )


def simulate_assembly(
    assembly: Assembly,
    motion: Motion | None = None,
    *,
    law: ContactLaw | None = None,
    duration: float | None = None,
    step: float | None = None,
    theta0: float = 0.0,
    omega0: float = 0.0,
    starts: Mapping[str, Start] | None = None,
    structure: Structure | None = None,
) -> AssemblyHistory:
    """
    Compute how the bodies of an assembly move on a table and on each other.

    Parameters
    ----------
    assembly : Assembly
    motion, duration, step
        As of `simulate`.
    law : ContactLaw, optional
        Of all interfaces. Without a stiffness, each has its own by the weight above it.
    theta0, omega0 : float, optional
        rad and rad/s, of the bodies on the table; what stands on one of them alone turns with it, what stands on
        several stays level.
    starts : mapping of str to Start, optional
        Of single bodies by name, instead.
    structure : Structure, optional
        With other nodes than the default; its law counts.

    Returns
    -------
    history : AssemblyHistory
        At the motion's samples.

    Raises
    ------
    ValueError
        If an argument is out of its range, or the step is longer than the longest stable one, which is then given.
    """
    law = ContactLaw() if law is None else law
    structure = Structure.of_assembly(assembly, law) if structure is None else structure
    block = next(iter(assembly.bodies.values())).block
    motion = at_rest(block, duration) if motion is None else motion
    begin = standing_assembly(assembly, structure, theta0=theta0, omega0=omega0) | dict(starts or {})
    run = _run(structure, list(begin.values()), motion, step)
    bodies: dict[str, BodyHistory] = {}
    for row, ((name, placed), body) in enumerate(zip(assembly.bodies.items(), structure.bodies, strict=True)):
        place, matrices = run.samples[:, row, :3], run.matrices[:, row]
        own = [joint for joint, each in enumerate(structure.joints) if each.sides[0].carrier == row]
        supports = {}
        for below, joint in zip(placed.on, own, strict=False):
            side = structure.joints[joint].sides[0]
            turned = np.swapaxes(run.matrices[:, side.target], 1, 2)
            apart = np.einsum("nij,nj->ni", turned, place - run.samples[:, side.target, :3]) - side.apart
            supports[below] = Pose(**_pose(body, turned @ matrices, apart))
        plane = plane_block(body, assembly.gravity)
        times, before, after = np.hstack([impacts_of(run.impacts[run.impacts[:, -1] == one], plane) for one in own])
        order = np.argsort(times, kind="stable")
        bodies[name] = BodyHistory(
            **_pose(body, matrices, place - [*placed.position, assembly.levels[name] + body.height]),
            supports=supports,
            lean=run.leans[:, row],
            position=place,
            orientation=run.samples[:, row, 6:10],
            impact_times=times[order],
            impact_velocities=before[order],
            rebound_velocities=after[order],
            dissipated_contact=run.joints[:, own, 1].sum(axis=1),
            dissipated_friction=run.joints[:, own, 2].sum(axis=1),
            overturning_time=float(run.overturning_times[row]),
        )
    return AssemblyHistory(
        assembly=assembly,
        law=law,
        time=motion.time,
        angle=np.copysign(run.leans[:, 0] * structure.critical_angles[0], run.arms[:, 0, 0]),
        bodies=bodies,
        energies=run.energies,
        base_force=run.base_force,
        step=run.step,
    )


def plane_block(body: ContactBody, gravity: float) -> Block:
    """Give the block whose plane rocking about y is that of a body, for its α, R, I₀ and p."""
    distance = hypot(body.half_width, body.height)
    return Block.measured(
        mass=body.mass,
        pole_distance=distance,
        critical_angle=float(np.arctan2(body.half_width, body.height)),
        inertia=float(body.inertia[1]) + body.mass * distance**2,
        gravity=gravity,
    )


@dataclass(frozen=True, eq=False)
class _Run:
    """
    What the engine gives at each sample; where all have fallen before the end, the last sample is held.

    samples, joints, sums as of `march`; rotation matrices of the bodies; arms, from each body's base to the centre of
    all that turns with it, and their leans over α; overturning_times (s); reached, the number of samples that were run.
    """

    structure: Structure
    samples: Array
    joints: Array
    sums: Array
    impacts: Array
    matrices: Array
    arms: Array
    leans: Array
    overturning_times: Array
    reached: int
    step: float

    @property
    def base_force(self) -> Array:
        """Force of the table on all that stands on it, N, shape (n, 3)."""
        on_table = [joint.sides[0].target == TABLE for joint in self.structure.joints]
        return np.asarray(self.joints[:, on_table, 3:6].sum(axis=1))

    @property
    def energies(self) -> EnergyBalance:
        """Of bodies, of their modes and of the joints between them."""
        masses, inertias = (
            np.array([getattr(one, name) for one in self.structure.bodies]) for name in ("mass", "inertia")
        )
        speeds = (self.samples[:, :, 3:6] ** 2).sum(axis=2) @ masses
        turning = (self.samples[:, :, 10:13] ** 2 * inertias).sum(axis=2).sum(axis=1)
        contact, lost_to_contact, lost_to_friction = self.joints[:, :, :3].sum(axis=1).T
        return EnergyBalance(
            kinetic=0.5 * (speeds + turning) + self.sums[:, 2],
            potential=self.structure.gravity * self.samples[:, :, 2] @ masses,
            strain=self.sums[:, 3],
            contact=contact,
            work=self.sums[:, 0],
            dissipated_contact=lost_to_contact,
            dissipated_friction=lost_to_friction,
            dissipated_bulk=self.sums[:, 1],
        )


def _run(structure: Structure, starts: list[Start], motion: Motion, step: float | None) -> _Run:
    """Run bodies from their starts; those that are past α at the end until they fall or come back."""
    parts, nothing = _parts(structure, motion, step), np.zeros(motion.acceleration.size)
    along = motion.acceleration, motion.transverse, motion.vertical
    table = np.column_stack([nothing if values is None else values for values in along])
    rows = np.array([start.row for start in starts])
    samples, joints, sums, impacts, reached, stands = _march(structure, rows, table, motion.dt, parts)
    for values in (samples, joints, sums):
        values[reached:] = values[reached - 1]
    matrices, arms = rotation_matrices(samples[:, :, 6:10]), np.zeros((*samples.shape[:2], 3))
    for row, (body, together) in enumerate(zip(structure.bodies, structure.together, strict=True)):
        masses = np.array([structure.bodies[other].mass for other in together])
        base = samples[:, row, :3] - body.height * matrices[:, row, :, 2]
        arms[:, row] = np.einsum("nbi,b->ni", samples[:, together, :3], masses / masses.sum()) - base
    leans = np.arctan2(np.hypot(arms[:, :, 0], arms[:, :, 1]), arms[:, :, 2]) / structure.critical_angles
    if (stands & (leans[-1] > 1.0)).any():
        p = plane_block(structure.bodies[0], structure.gravity).p
        still = np.zeros((ceil(AFTERMATH / (p * motion.dt)) + 1, 3))
        *_, stands = _march(structure, samples[-1], still, motion.dt, parts)
    times = np.full(len(stands), np.nan)
    for fallen in np.flatnonzero(~stands):
        upright = np.flatnonzero(leans[:, fallen] <= 1.0)
        times[fallen] = motion.time[min(upright.max(initial=-1) + 1, len(samples) - 1)]
    step = motion.dt / parts
    return _Run(structure, samples, joints, sums, impacts, matrices, arms, leans, times, reached, step)


def _parts(structure: Structure, motion: Motion, step: float | None) -> int:
    """Give the number of steps in an interval of a motion."""
    longest = longest_step(structure)
    if step is None:
        step = min(DEFAULT_STEP, STEP_SHARE * longest)
    step = number("step", step, "a positive step", above=0.0, unit="s")
    steps = motion.dt / step * motion.acceleration.size
    if steps > MOST_STEPS:
        raise ValueError(
            f"step is {step:.4g} s, of which {motion.acceleration.size} intervals of {motion.dt:.4g} s (dt) hold "
            f"{steps:.3g}; at most {MOST_STEPS:.0e} were expected"
        )
    parts = max(1, ceil(motion.dt / step * (1.0 - 1e-12)))
    if motion.dt / parts > longest:
        raise ValueError(
            f"step is {motion.dt / parts:.4g} s; at most {longest:.4g} s was expected: beyond it the contact of this "
            "body and law is unstable. Use a shorter step or a smaller stiffness."
        )
    return parts


def _march(
    structure: Structure, rows: Array, table: Array, interval: float, parts: int
) -> tuple[Array, Array, Array, Array, int, Mask]:
    """Call the engine from the bodies' rows, as of `Start`; give samples, joints, sums, impacts, reached, stands."""
    system, joints = structure.system(interval / parts), len(structure.joints)
    state = State.begin(system, rows)
    samples, sums = np.zeros((len(table), *rows.shape)), np.zeros((len(table), 4))
    contact, found = np.zeros((len(table), joints, 7)), np.zeros((2 * joints * parts, IMPACT))
    reached, stands = 0, state.stands > 0
    while reached < len(table) and stands.any():
        reached = march(system, state, table, interval, parts, samples, contact, sums, found, reached)
        found, stands = np.concatenate((found, np.zeros_like(found))), state.stands > 0
    return samples, contact, sums, found[: state.hits[0]], reached, stands


def _pose(body: ContactBody, matrices: Array, moved: Array) -> dict[str, Array]:
    """Give the pose of a body, turned by matrices and with its centre of mass `moved` from where it is at rest."""
    axis, upward = matrices[:, :, 2], matrices[:, 2]
    angle = np.arctan2(axis[:, 0], axis[:, 2])
    pole = np.zeros((len(angle), 3))
    pole[:, 0], pole[:, 2] = np.where(angle < 0.0, -1.0, 1.0) * body.half_width, -body.height
    slide = moved + np.einsum("nij,nj->ni", matrices, pole) - pole
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
