"""One run of the contact model: body or assembly, law and table motion in, history out."""

from __future__ import annotations

from collections.abc import Mapping
from math import ceil, hypot
from typing import NamedTuple

import numpy as np

from colonnade.arrays import Array, Mask
from colonnade.dynamics.assembly import Assembly, standing_on
from colonnade.dynamics.block import STANDARD_GRAVITY, Block
from colonnade.dynamics.contact.bodies import AssemblyHistory, BodyHistory, Pose
from colonnade.dynamics.contact.body import DEFAULT_STEP, ContactBody, ContactLaw
from colonnade.dynamics.contact.history import ContactHistory, EnergyBalance, impacts_of, tilt
from colonnade.dynamics.contact.march import march
from colonnade.dynamics.contact.stability import longest_step
from colonnade.dynamics.contact.start import Start, rotation_matrices, standing, standing_assembly
from colonnade.dynamics.contact.state import IMPACT, Near, State, Whole
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
    yaw: float = 0.0,
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
    theta0, omega0, out_of_plane, yaw : float, optional
        The body at the start, on the table: angle (rad) and angular velocity (rad/s) about y, rotation about x and z.
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
    interval, parts = _division(structure, motion, step)
    _check(motion, theta0, omega0, out_of_plane)
    if start is None:
        start = standing(body, law, gravity, theta0=theta0, omega0=omega0, out_of_plane=out_of_plane, yaw=yaw)
    run = _run(structure, [start], _table(motion), interval, parts)
    over = tilt(run.samples[:, 0, 6:10]) > block.critical_angle
    lies = len(run.samples) < motion.acceleration.size
    fell = lies or (over[-1] and not run.afterwards(structure, block.p).stands[0])
    return _history(law, block, motion, structure, run, _passed(motion.time, over) if fell else float("nan"))


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
    interval, parts = _division(structure, motion, step)
    _check(motion, theta0, omega0, 0.0)
    begin = standing_assembly(assembly, structure, theta0=theta0, omega0=omega0) | dict(starts or {})
    lowest = np.array([assembly.levels[name] if placed.on else -np.inf for name, placed in assembly.bodies.items()])
    run = _run(structure, [begin[name] for name in assembly.bodies], _table(motion), interval, parts, lowest)
    leans = _leans(assembly, run)
    stands = run.stands > 0
    if stands.any() and (leans[-1, stands] > 1.0).any():
        stands = run.afterwards(structure, block.p, lowest).stands > 0
    return _assembly_history(assembly, law, structure, motion, run, leans, ~stands)


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


def _division(structure: Structure, motion: Motion, step: float | None) -> tuple[float, int]:
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
    return motion.dt, parts


def _check(motion: Motion, theta0: float, omega0: float, out_of_plane: float) -> None:
    for name, value in (("theta0", theta0), ("out_of_plane", out_of_plane)):
        if not abs(value) < 0.5 * np.pi:
            raise ValueError(f"{name} is {value} rad; an angle between −π/2 and π/2 was expected")
    if not np.isfinite(omega0):
        raise ValueError(f"omega0 is {omega0} rad/s; a finite number was expected")


def _table(motion: Motion) -> Array:
    """Give the table's acceleration along x, y and z, shape (n, 3)."""
    table = np.zeros((motion.acceleration.size, 3))
    for axis, values in enumerate((motion.acceleration, motion.transverse, motion.vertical)):
        if values is not None:
            table[:, axis] = values
    return table


class _Run(NamedTuple):
    """What the engine gives: samples as far as it came, with their interval and steps; which bodies still stand."""

    samples: Array
    joints: Array
    sums: Array
    impacts: Array
    stands: Whole
    interval: float
    parts: int

    def afterwards(self, structure: Structure, p: float, lowest: Array | None = None) -> _Run:
        """Go on from the last sample with the table at rest."""
        last = self.samples[-1]
        matrices = rotation_matrices(last[:, 6:10])
        starts = [
            Start(one[:3], one[3:6], one[6:10], matrix @ one[10:13]) for one, matrix in zip(last, matrices, strict=True)
        ]
        table = np.zeros((ceil(AFTERMATH / (p * self.interval)) + 1, 3))
        return _run(structure, starts, table, self.interval, self.parts, lowest)


def _run(
    structure: Structure, starts: list[Start], table: Array, interval: float, parts: int, lowest: Array | None = None
) -> _Run:
    """Call the engine from the bodies' starts; `lowest`: heights below which they have fallen, m."""
    bodies, joints = len(structure.bodies), len(structure.joints)
    system = structure.system(interval / parts, np.full(bodies, -np.inf) if lowest is None else lowest)
    rigid = []
    for body, start in zip(structure.bodies, starts, strict=True):
        orientation = start.orientation / np.linalg.norm(start.orientation)
        spin = body.inertia * (rotation_matrices(orientation[None])[0].T @ start.angular_velocity)
        rigid.append(np.concatenate((start.position, start.velocity, orientation, spin)))
    state, near = State.begin(system, np.array(rigid)), Near.room(system)
    samples, sums, contact = (
        np.zeros((len(table), bodies, 13)),
        np.zeros((len(table), 4)),
        np.zeros((len(table), joints, 8)),
    )
    found, count, stands = np.zeros((2 * joints * parts, IMPACT)), 0, True
    while count < len(table) and stands:
        count = march(system, state, near, table, interval, parts, samples, contact, sums, found, count)
        found, stands = np.concatenate((found, np.zeros_like(found))), bool(state.stands.any())
    impacts = found[: state.hits[0]]
    return _Run(samples[:count], contact[:count], sums[:count], impacts, state.stands, interval, parts)


def _history(
    law: ContactLaw, block: Block, motion: Motion, structure: Structure, run: _Run, overturning_time: float
) -> ContactHistory:
    """Name the columns of a single body; one that lies has its angle there."""
    samples, joints, sums = _held(motion, run.samples, run.joints, run.sums)
    body, own, first = structure.bodies[0], samples[:, 0], len(run.samples) - 1
    matrices = rotation_matrices(own[:, 6:10])
    axis, turning = matrices[:, :, 2], np.einsum("nij,nj->ni", matrices, own[:, 10:13])
    rate = np.cross(turning, axis)
    speed = (rate[:, 0] * axis[:, 2] - axis[:, 0] * rate[:, 2]) / (axis[:, 0] ** 2 + axis[:, 2] ** 2)
    pose = _pose(block, body, matrices, own[:, :3] - [0.0, 0.0, body.height])
    if first + 1 < len(own):
        pose["angle"][first:], speed[first:] = np.copysign(0.5 * np.pi, axis[first, 0]), 0.0
    times, speeds, rebounds = impacts_of(run.impacts, block)
    return ContactHistory(
        block,
        motion.time,
        pose["angle"],
        speed,
        times,
        speeds,
        rebounds,
        overturning_time,
        body=body,
        law=law,
        step=run.interval / run.parts,
        position=own[:, :3],
        velocity=own[:, 3:6],
        orientation=own[:, 6:10],
        turning=turning,
        out_of_plane=pose["out_of_plane_angle"],
        yaw=pose["yaw"],
        slide=pose["slide"],
        uplift=joints[:, 0, 0],
        base_force=joints[:, 0, 4:7],
        energies=_energies(block.gravity, structure, samples, joints, sums),
        airborne=float(joints[-1, 0, 7]),
    )


def _held(motion: Motion, *values: Array) -> tuple[Array, ...]:
    """Hold the last of some values to the end of a motion."""
    missing = motion.acceleration.size - len(values[0])
    return tuple(np.concatenate((each, np.repeat(each[-1:], missing, axis=0))) for each in values)


def _passed(time: Array, over: Mask) -> float:
    """Give the time of the first sample of the last stretch that is `over` α, which lasts to the end."""
    return float(time[int(len(over) - np.argmin(over[::-1])) if not over.all() else 0])


def _leans(assembly: Assembly, run: _Run) -> Array:
    """Give the lean of each body, shape (n, b), as `BodyHistory` has it."""
    numbers = {name: number for number, name in enumerate(assembly.bodies)}
    leans = np.zeros(run.samples.shape[:2])
    for name, placed in assembly.bodies.items():
        with_it, own = standing_on(assembly, name), run.samples[:, numbers[name]]
        masses = np.array([assembly.bodies[other].block.mass for other in with_it])
        places = run.samples[:, [numbers[other] for other in with_it], :3]
        axis = rotation_matrices(own[:, 6:10])[:, :, 2]
        arm = np.einsum("nbi,b->ni", places, masses / masses.sum()) - (own[:, :3] - placed.centre_height * axis)
        leans[:, numbers[name]] = np.arctan2(np.hypot(arm[:, 0], arm[:, 1]), arm[:, 2]) / assembly.critical_angles[name]
    return leans


def _assembly_history(
    assembly: Assembly,
    law: ContactLaw,
    structure: Structure,
    motion: Motion,
    run: _Run,
    leans: Array,
    fallen: Mask,
) -> AssemblyHistory:
    """Name the columns body by body."""
    samples, joints, sums, leans = _held(motion, run.samples, run.joints, run.sums, leans)
    matrices = np.array([rotation_matrices(samples[:, number, 6:10]) for number in range(samples.shape[1])])
    numbers = {name: number for number, name in enumerate(assembly.bodies)}
    bodies: dict[str, BodyHistory] = {}
    base_force, joint = np.zeros((len(samples), 3)), 0
    for (name, placed), body in zip(assembly.bodies.items(), structure.bodies, strict=True):
        number, own = numbers[name], list(range(joint, joint + max(1, len(placed.on))))
        joint = own[-1] + 1
        place, level = samples[:, number, :3], assembly.levels[name]
        supports = {}
        for below, first in zip(placed.on, own, strict=False):
            target, turned = samples[:, numbers[below], :3], np.swapaxes(matrices[numbers[below]], 1, 2)
            apart = np.einsum("nij,nj->ni", turned, place - target) - structure.joints[first][0].apart
            supports[below] = Pose(**_pose(placed.block, body, turned @ matrices[number], apart))
        if not placed.on:
            base_force += joints[:, own[0], 4:7]
        impacts = [
            impacts_of(run.impacts[run.impacts[:, -1] == one], plane_block(body, assembly.gravity)) for one in own
        ]
        order = np.argsort(np.concatenate([times for times, _, _ in impacts]), kind="stable")
        times, before, after = (np.concatenate([found[i] for found in impacts])[order] for i in range(3))
        rest = place - [*placed.position, level + body.height]
        over = leans[:, number] > 1.0
        fell = _passed(motion.time, over) if over[-1] else float(motion.time[-1])
        bodies[name] = BodyHistory(
            **_pose(placed.block, body, matrices[number], rest),
            supports=supports,
            lean=leans[:, number],
            position=place,
            orientation=samples[:, number, 6:10],
            impact_times=times,
            impact_velocities=before,
            rebound_velocities=after,
            dissipated_contact=joints[:, own, 2].sum(axis=1),
            dissipated_friction=joints[:, own, 3].sum(axis=1),
            overturning_time=fell if fallen[number] else float("nan"),
        )
    return AssemblyHistory(
        assembly=assembly,
        law=law,
        time=motion.time,
        bodies=bodies,
        energies=_energies(assembly.gravity, structure, samples, joints, sums),
        base_force=base_force,
        step=run.interval / run.parts,
    )


def _energies(gravity: float, structure: Structure, samples: Array, joints: Array, sums: Array) -> EnergyBalance:
    """Add up the energies of bodies, of their modes and of the joints between them."""
    masses, inertias = (np.array([getattr(one, name) for one in structure.bodies]) for name in ("mass", "inertia"))
    speeds, turning = (samples[:, :, 3:6] ** 2).sum(axis=2), (samples[:, :, 10:13] ** 2 * inertias).sum(axis=2)
    return EnergyBalance(
        kinetic=0.5 * (speeds @ masses + turning.sum(axis=1)) + sums[:, 2],
        potential=gravity * samples[:, :, 2] @ masses,
        strain=sums[:, 3],
        contact=joints[:, :, 1].sum(axis=1),
        work=sums[:, 0],
        dissipated_contact=joints[:, :, 2].sum(axis=1),
        dissipated_friction=joints[:, :, 3].sum(axis=1),
        dissipated_bulk=sums[:, 1],
    )


def _pose(block: Block, body: ContactBody, matrices: Array, moved: Array) -> dict[str, Array]:
    """Give the pose of a body, turned by matrices and with its centre of mass `moved` from where it is at rest."""
    axis, half = matrices[:, :, 2], np.array([body.half_width, float(np.abs(body.nodes[:, 1]).max()), 0.0])
    angle = np.arctan2(axis[:, 0], axis[:, 2])
    pole = np.column_stack(
        (np.where(angle < 0.0, -1.0, 1.0) * body.half_width, np.zeros(len(angle)), np.full(len(angle), -body.height))
    )
    slide = moved + np.einsum("nij,nj->ni", matrices, pole) - pole
    across = np.abs(matrices[:, 2, :2])
    is_round = block.solid is not None and block.solid.base == "circle"
    reach = body.half_width * np.hypot(*across.T) if is_round else across @ half[:2]
    return {
        "angle": angle,
        "out_of_plane_angle": np.arctan2(-axis[:, 1], axis[:, 2]),
        "yaw": np.unwrap(np.arctan2(matrices[:, 1, 0] - matrices[:, 0, 1], matrices[:, 0, 0] + matrices[:, 1, 1])),
        "slide": slide[:, :2],
        "uplift": moved[:, 2] + body.height * (1.0 - axis[:, 2]) - reach,
    }
