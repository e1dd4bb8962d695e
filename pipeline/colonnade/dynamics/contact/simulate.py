"""One run of the contact model: body, law and table motion in, history out."""

from __future__ import annotations

from math import ceil, hypot

import numpy as np

from colonnade.arrays import Array, Mask
from colonnade.dynamics.block import STANDARD_GRAVITY, Block
from colonnade.dynamics.contact.body import ContactBody
from colonnade.dynamics.contact.engine.run import run
from colonnade.dynamics.contact.engine.state import COLUMNS, POINTS, Body, Near, State
from colonnade.dynamics.contact.history import ContactHistory, EnergyBalance, impacts_of, tilt
from colonnade.dynamics.contact.law import DEFAULT_STEP, ContactLaw
from colonnade.dynamics.contact.stability import longest_step
from colonnade.dynamics.contact.start import Start, rotation_matrices, standing
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
    >>> from colonnade.dynamics.contact.nodes import rigid_body
    >>> block = Block.prism(width=0.086, depth=0.086, height=0.456, mass=26.10)
    >>> body = rigid_body(block)
    >>> law = ContactLaw.stiff(body, block.gravity, damping_fraction=0.4)
    >>> simulate(body, law=law, theta0=0.3 * block.critical_angle, duration=0.2).outcome
    'rocking'
    """
    block = plane_block(body, gravity)
    motion = at_rest(block, duration) if motion is None else motion
    interval, parts = _division(body, law, motion, step)
    _check(motion, theta0, omega0, out_of_plane)
    if start is None:
        start = standing(body, law, gravity, theta0=theta0, omega0=omega0, out_of_plane=out_of_plane, yaw=yaw)
    table = np.zeros((motion.acceleration.size, 3))
    for axis, values in enumerate((motion.acceleration, motion.transverse, motion.vertical)):
        if values is not None:
            table[:, axis] = values
    samples, impacts = _run(body, law, gravity, start, table, interval, parts)
    falls = samples[-1] if len(samples) < len(table) else None
    overturned = falls is not None or _falls_later(body, law, block, samples[-1], interval, parts)
    return _history(body, law, block, motion, interval / parts, samples, impacts, overturned)


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


def _division(body: ContactBody, law: ContactLaw, motion: Motion, step: float | None) -> tuple[float, int]:
    longest = longest_step(body, law)
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


def _run(
    body: ContactBody, law: ContactLaw, gravity: float, start: Start, table: Array, interval: float, parts: int
) -> tuple[Array, Array]:
    """Call the engine; return the samples that it reached, shape (n, COLUMNS), and the impacts."""
    step = interval / parts
    orientation = start.orientation / np.linalg.norm(start.orientation)
    spin = body.inertia * (rotation_matrices(orientation[None])[0].T @ start.angular_velocity)
    normal, damping = law.node_stiffness(body), law.node_damping(body)
    contact = np.column_stack((normal, damping, law.tangential_ratio * normal, law.tangential_damping * damping))
    samples = np.zeros((len(table), COLUMNS))
    fixed = Body(
        float(body.mass),
        float(gravity),
        body.inertia,
        body.nodes,
        body.modes,
        body.frequencies,
        _propagators(body, 0.5 * step),
        body.ring_radii,
        np.concatenate(([0], np.cumsum(np.where(body.ring_radii > 0.0, POINTS, 1)))),
        np.array(np.polynomial.legendre.leggauss(POINTS)),
        body.half_width,
        body.height,
        contact,
        float(law.friction),
    )
    state = State.begin(fixed, np.concatenate((start.position, start.velocity, orientation, spin)))
    count, impacts = run(fixed, state, Near.room(fixed), table, interval, parts, samples)
    return samples[:count], impacts


def _propagators(body: ContactBody, step: float) -> Array:
    """Exact free motion of each mode over a step: η → a η + b η̇, η̇ → c η + d η̇; rows a, b, c, d, shape (4, m)."""
    frequency, damping = body.frequencies, body.modal_damping
    turning = frequency * np.sqrt((1.0 - damping**2).astype(complex))
    turning = np.where(np.abs(turning) < 1e-9 * frequency, 1e-9 * frequency, turning)
    fading = np.exp(-damping * frequency * step)
    cosine, sine = np.cos(turning * step), np.sin(turning * step) / turning
    rows = (cosine + damping * frequency * sine, sine, -(frequency**2) * sine, cosine - damping * frequency * sine)
    return np.ascontiguousarray(np.real(np.array(rows) * fading).reshape(4, -1))


def _falls_later(body: ContactBody, law: ContactLaw, block: Block, last: Array, interval: float, parts: int) -> bool:
    """Whether a body that is past α at the end falls, the table being at rest from there on."""
    if tilt(last[None, 6:10])[0] <= block.critical_angle:
        return False
    orientation = last[6:10]
    angular = rotation_matrices(orientation[None])[0] @ last[10:13]
    table = np.zeros((ceil(AFTERMATH / (block.p * interval)) + 1, 3))
    start = Start(last[:3], last[3:6], orientation, angular)
    return len(_run(body, law, block.gravity, start, table, interval, parts)[0]) < len(table)


def _history(
    body: ContactBody,
    law: ContactLaw,
    block: Block,
    motion: Motion,
    step: float,
    samples: Array,
    impacts: Array,
    overturned: bool,
) -> ContactHistory:
    """Name the columns; hold the last state of a body that lies."""
    matrices = rotation_matrices(samples[:, 6:10])
    axis = matrices[:, :, 2]
    turning = np.einsum("nij,nj->ni", matrices, samples[:, 10:13])
    angle, speed = _rocking(axis, turning)
    missing = motion.acceleration.size - len(samples)
    if missing:
        angle[-1], speed[-1] = np.copysign(0.5 * np.pi, axis[-1, 0]), 0.0
    side = np.where(angle < 0.0, -1.0, 1.0)
    pole = np.column_stack((side * body.half_width, np.zeros(len(side)), np.full(len(side), -body.height)))
    slide = (samples[:, :3] + np.einsum("nij,nj->ni", matrices, pole) - pole)[:, :2]
    times, speeds, rebounds = impacts_of(impacts, block)

    def whole(values: Array) -> Array:
        return np.concatenate((values, np.repeat(values[-1:], missing, axis=0))) if missing else values

    return ContactHistory(
        block,
        motion.time,
        whole(angle),
        whole(speed),
        times,
        speeds,
        rebounds,
        _passed(motion.time, tilt(samples[:, 6:10]) > block.critical_angle) if overturned else float("nan"),
        body=body,
        law=law,
        step=step,
        position=whole(samples[:, :3]),
        velocity=whole(samples[:, 3:6]),
        orientation=whole(samples[:, 6:10]),
        turning=whole(turning),
        out_of_plane=whole(np.arctan2(-axis[:, 1], axis[:, 2])),
        yaw=whole(np.unwrap(2.0 * np.arctan2(samples[:, 9], samples[:, 6]))),
        slide=whole(slide),
        uplift=whole(samples[:, 13]),
        base_force=whole(samples[:, 14:17]),
        energies=EnergyBalance(*(whole(samples[:, column]) for column in range(17, 25))),
        airborne=float(samples[-1, 25]),
    )


def _rocking(axis: Array, turning: Array) -> tuple[Array, Array]:
    """Give the rocking angle and its rate, of the body's axis and its angular velocity, shape (n, 3) each."""
    rate = np.cross(turning, axis)
    speed = (rate[:, 0] * axis[:, 2] - axis[:, 0] * rate[:, 2]) / (axis[:, 0] ** 2 + axis[:, 2] ** 2)
    return np.arctan2(axis[:, 0], axis[:, 2]), speed


def _passed(time: Array, over: Mask) -> float:
    """Give the time of the first sample of the last stretch that is `over` α, which lasts to the end."""
    return float(time[int(len(over) - np.argmin(over[::-1])) if not over.all() else 0])
