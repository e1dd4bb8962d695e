"""What could turn rocking three-dimensional: a specimen that is let go, or stands, not quite as it should."""

from __future__ import annotations

from dataclasses import replace
from math import pi, sin
from typing import Any

import numpy as np
from joblib import Parallel, delayed

from colonnade import identify_restitution
from colonnade.dynamics.block import Block
from colonnade.dynamics.contact.body import ContactBody
from colonnade.dynamics.contact.calibration import free_restitution
from colonnade.dynamics.contact.history import ContactHistory
from colonnade.dynamics.contact.law import DEFAULT_STEP, ContactLaw
from colonnade.dynamics.contact.nodes import rigid_body
from colonnade.dynamics.contact.simulate import simulate
from colonnade.dynamics.contact.start import Start, rotation_matrices, standing
from colonnade.dynamics.motion import Motion
from colonnade.dynamics.rock import rock
from contact_model.free import CONE, CYLINDER, GRAVITY, PRISM, TARGET, prism_body
from contact_model.space import calibrated

STEP = DEFAULT_STEP
LARGE = 0.9
"""|θ|/α of a large first amplitude."""
FIRST = 4
"""Half cycles at the start, over which the misfit is taken."""
SAMPLES = 500
"""In a time of 1/p."""
BLOCKS = {"prism": PRISM, "cylinder": CYLINDER, "cone": CONE}
FINE = 576
"""Nodes of each ring of a round base that is not plane or not round."""
ASKEW = pi / 6
"""rad: between the plane of rocking and the axis of what is uneven or oval, so that neither is a plane of symmetry."""

SIZES: dict[str, tuple[float, ...]] = {
    "none": (0.0,),
    "lean": (0.0025, 0.02),
    "push": (0.0005, 0.001, 0.0025, 0.01, 0.03),
    "spin": (0.0025, 0.01, 0.03, 0.1),
    "tilt": (0.0005, 0.001, 0.0025, 0.01),
    "warp": (1e-6, 3e-6, 1e-5, 1e-4),
    "feet": (1e-6, 3e-6, 1e-5, 1e-4),
    "oval": (1e-5, 3e-5, 1e-4, 3e-4),
}
"""
By disturbance. "lean": rotation about x at the start, of α; "push": angular velocity about x through the foot, of p α;
"spin": about the vertical, of p; "tilt": of the table across the plane of rocking, of α; "warp", "feet": the base is up
to so many m off its plane, with two or three low spots; "oval": the rim's radius is so many m larger in one direction
and smaller across.
"""
CONTROLLED = (("lean", 0.0025), ("push", 0.0025), ("spin", 0.01), ("tilt", 0.0025))
"""What is repeated with other steps, rings, nodes, stiffness and friction."""
ON_NODES = (("warp", 1e-5), ("feet", 1e-5), ("oval", 1e-4))
"""What is repeated with other nodes only."""


def bodies(around: int | None = None, rings: int = 4) -> dict[str, ContactBody]:
    """Build the rigid specimens, the round ones on whole rings or on so many nodes each."""
    found = {"prism": prism_body("5 × 5")}
    return found | {name: rigid_body(BLOCKS[name], rings=(rings, around)) for name in ("cylinder", "cone")}


def measure_misfit(
    sizes: dict[str, tuple[float, ...]] | None = None,
    releases: tuple[float, ...] = (LARGE, 0.5),
    duration: float = 4.0,
    workers: int = 1,
) -> list[Any]:
    """Fit plane rocking to the rocking in space of prism, cylinder and cone after each disturbance."""
    whole, fine = bodies(), bodies(FINE)
    pool = Parallel(n_jobs=workers)
    laws = dict(zip(whole, pool(delayed(calibrated)(BLOCKS[name], STEP) for name in whole), strict=True))
    jobs = []
    for release in releases:
        for kind, each in (SIZES if sizes is None else sizes).items():
            body = fine if kind in ("warp", "feet", "oval") else whole
            cases = [(name, size) for size in each for name in BLOCKS if (kind, name) != ("oval", "prism")]
            jobs += [delayed(_run)(name, body[name], laws[name], release, kind, size, duration) for name, size in cases]
    return list(pool(jobs))


def measure_controls(duration: float = 4.0, workers: int = 1) -> list[Any]:
    """Repeat what disturbs the cylinder with other steps, rings, nodes, stiffness and friction."""
    whole = bodies()["cylinder"]
    law = calibrated(CYLINDER, STEP)
    variants: list[tuple[str, ContactBody, ContactLaw, float]] = [
        ("4 whole rings", whole, law, STEP),
        ("half the step", whole, law, 0.5 * STEP),
        ("8 whole rings", bodies(rings=8)["cylinder"], law, STEP),
        ("a tenth of the stiffness", whole, replace(law, stiffness=0.1 * law.stiffness), STEP),
        ("friction 0.3", whole, replace(law, friction=0.3), STEP),
        ("friction 1", whole, replace(law, friction=1.0), STEP),
    ]
    variants += [
        (f"4 rings of {around} nodes", bodies(around)["cylinder"], law, STEP) for around in (24, 72, 288, 576, 1152)
    ]
    jobs = (
        delayed(_run)("cylinder", body, chosen, LARGE, kind, size, duration, step=step, variant=variant)
        for variant, body, chosen, step in variants
        for kind, size in (("none", 0.0), *CONTROLLED, *(() if body.has_rings else ON_NODES))
    )
    return list(Parallel(n_jobs=workers)(jobs))


def _run(
    name: str,
    body: ContactBody,
    law: ContactLaw,
    release: float,
    kind: str,
    size: float,
    duration: float,
    *,
    step: float = STEP,
    variant: str = "",
) -> dict[str, Any]:
    block = BLOCKS[name]
    body = _shaped(body, kind, size)
    start, table = _release(body, block, law, release, kind, size, duration)
    history = simulate(body, table, law=law, gravity=GRAVITY, step=step, start=start)
    fitted = identify_restitution(history.time, history.angle, block)
    return {
        "specimen": name,
        "variant": variant,
        "kind": kind,
        "size": size,
        "release": release,
        "damping_fraction": law.damping_fraction,
        "fitted": fitted.value,
        "reason": fitted.reason,
        "own": free_restitution(history),
        "out_of_plane": float(np.abs(history.out_of_plane).max() / block.critical_angle),
        "overturned": history.outcome == "overturned",
        "misfit": misfits(history, block, TARGET if fitted.value is None else fitted.value, release),
    }


def _release(
    body: ContactBody, block: Block, law: ContactLaw, release: float, kind: str, size: float, duration: float
) -> tuple[Start, Motion]:
    """Put the specimen on its rim, with what disturbs it, on a table that tilts gravity."""
    alpha = block.critical_angle
    start = standing(body, law, GRAVITY, theta0=release * alpha, out_of_plane=size * alpha if kind == "lean" else 0.0)
    if kind == "push":
        foot = rotation_matrices(start.orientation[None])[0] @ np.array([body.half_width, 0.0, -body.height])
        angular = np.array([size * block.p * alpha, 0.0, 0.0])
        start = replace(start, velocity=np.cross(angular, -foot), angular_velocity=angular)
    if kind == "spin":
        start = replace(start, angular_velocity=np.array([0.0, 0.0, size * block.p]))
    intervals = round(duration * block.p * SAMPLES)
    across = np.full(intervals + 1, GRAVITY * sin(size * alpha) if kind == "tilt" else 0.0)
    return start, Motion(np.zeros(intervals + 1), duration / intervals, transverse=across)


def _shaped(body: ContactBody, kind: str, size: float) -> ContactBody:
    """Raise the base's nodes above its low spots, or stretch it one way and narrow it across."""
    if kind not in ("warp", "feet", "oval"):
        return body
    nodes = body.nodes.copy()
    distance, around = np.hypot(nodes[:, 0], nodes[:, 1]), np.arctan2(nodes[:, 1], nodes[:, 0]) - ASKEW
    share = distance / distance.max()
    if kind == "oval":
        nodes[:, :2] *= (1.0 + size / distance.max() * np.cos(2.0 * around))[:, None]
    else:
        nodes[:, 2] += 0.5 * size * share**2 * (1.0 + np.cos({"warp": 2.0, "feet": 3.0}[kind] * around))
    return replace(body, nodes=nodes)


def misfits(history: ContactHistory, block: Block, restitution: float, release: float) -> dict[str, float]:
    """Give the RMS of θ less plane rocking over α, up to the plane model's fourth impact, of either plane model."""
    found = {}
    for model in ("nonlinear", "linear"):
        plane = rock(
            block,
            restitution=restitution,
            model=model,
            theta0=release * block.critical_angle,
            duration=float(history.time[-1]),
        )
        angle = np.interp(history.time, plane.time, plane.angle)
        ends = plane.impact_times[FIRST - 1] if plane.impact_times.size >= FIRST else history.time[-1]
        early = history.time <= ends
        found[model] = float(np.sqrt(np.mean((history.angle - angle)[early] ** 2)) / block.critical_angle)
    return found
