"""What only a body in space can tell: e over amplitude, friction and disturbance; rocking that leaves its plane."""

from __future__ import annotations

from dataclasses import asdict, replace
from typing import Any

import numpy as np
from joblib import Parallel, delayed

from colonnade import identify_restitution
from colonnade.dynamics.block import Block
from colonnade.dynamics.contact.body import ContactBody
from colonnade.dynamics.contact.calibration import calibrate, free_restitution
from colonnade.dynamics.contact.ensembles import ContactPlan, gather, run_member
from colonnade.dynamics.contact.history import ContactHistory
from colonnade.dynamics.contact.law import ContactLaw
from colonnade.dynamics.contact.layout import rigid_body
from colonnade.dynamics.rock import rock
from contact_model.free import CONE, CYLINDER, GRAVITY, PRISM, TARGET, law_for, prism_body, timed, vibrate

STEP = 1e-5
RELEASES = (0.05, 0.1, 0.2, 0.3, 0.5, 0.7, 0.9)
FRICTIONS = (0.2, 0.3, 0.4, 0.6, 0.8, 1.0)
DISTURBANCES = (0.0, 0.001, 0.0025, 0.005, 0.01, 0.02)
"""Rotation about x at the start, of α."""
IMPACTS = 6
"""Of a calibration."""
MEMBERS = 32
SEED = 2013
LARGE = 0.9
"""|θ|/α of a large first amplitude."""
FIRST = 4
"""Half cycles at the start, over which the misfit is taken."""
ROUND = {"rings of 24": (4, 24), "rings of 72": (2, 72)}
"""Rings of a round base, and nodes on each."""


def calibrated(name: str, body: ContactBody, step: float = STEP, target: float = TARGET) -> ContactLaw:
    """Calibrate a body to the paper's e of the prism."""
    return calibrate(body, law_for(body, 0.4), target, gravity=GRAVITY, step=step, impacts=IMPACTS).law


def measure_amplitudes(law: ContactLaw, releases: tuple[float, ...] = RELEASES, workers: int = 1) -> list[Any]:
    """Run the calibrated rigid prism from small and large releases, two impacts each."""
    body = prism_body("5 × 5")
    jobs = (
        delayed(vibrate)(
            "5 × 5", body, law, STEP, 0.1 + 3.4 * float(np.arccosh(1 / (1 - release))) / PRISM.p, release=release
        )
        for release in releases
    )
    return [asdict(run) for run in Parallel(n_jobs=workers)(jobs)]


def measure_friction(law: ContactLaw, frictions: tuple[float, ...] = FRICTIONS, workers: int = 1) -> list[Any]:
    """Run the calibrated rigid prism with other friction."""
    body = prism_body("5 × 5")
    jobs = (delayed(_one)(body, replace(law, friction=friction), 0.0) for friction in frictions)
    return list(Parallel(n_jobs=workers)(jobs))


def measure_disturbance(law: ContactLaw, disturbances: tuple[float, ...] = DISTURBANCES, workers: int = 1) -> list[Any]:
    """Run the calibrated rigid prism let go slightly out of its plane."""
    body = prism_body("5 × 5")
    return list(Parallel(n_jobs=workers)(delayed(_one)(body, law, disturbance) for disturbance in disturbances))


def _one(body: ContactBody, law: ContactLaw, disturbance: float) -> dict[str, Any]:
    alpha = PRISM.critical_angle
    history, _ = timed(body, law, STEP, 3.4, out_of_plane=disturbance * alpha)
    plane, _ = timed(body, replace(law, friction=0.6), STEP, 3.4)
    return {
        "friction": law.friction,
        "disturbance": disturbance,
        "restitution": free_restitution(history, impacts=6),
        "largest_change": float(np.abs(history.angle - plane.angle).max() / alpha),
        "out_of_plane": float(np.abs(history.out_of_plane).max() / alpha),
    }


def measure_ensemble(law: ContactLaw, members: int = MEMBERS, workers: int = 1) -> dict[str, Any]:
    """Vary friction, damping fraction and disturbance together."""
    fraction = law.damping_fraction
    plan = ContactPlan(
        prism_body("5 × 5"),
        law,
        friction=(min(FRICTIONS), max(FRICTIONS)),
        damping_fraction=(0.8 * fraction, 1.2 * fraction),
        out_of_plane=(0.0, max(DISTURBANCES) * PRISM.critical_angle),
        duration=3.4,
        theta0=0.5 * PRISM.critical_angle,
        gravity=GRAVITY,
        step=2 * STEP,
        count=members,
        seed=SEED,
    )
    found = gather(plan, Parallel(n_jobs=workers)(delayed(run_member)(plan, member) for member in range(members)))
    low, middle, high = np.quantile(found.restitution, (0.05, 0.5, 0.95))
    return {
        "members": members,
        "damping_fraction": plan.damping_fraction,
        "friction": plan.friction,
        "restitution": (low, middle, high),
        "band": float((found.bands[-1] - found.bands[0]).max() / PRISM.critical_angle),
        "out_of_plane": float(found.largest_out_of_plane.max()),
        "correlations": found.correlations(found.restitution),
    }


def measure_misfit(
    disturbances: tuple[float, ...] = DISTURBANCES,
    releases: tuple[float, ...] = (LARGE, 0.5),
    bases: tuple[str, ...] = tuple(ROUND),
    duration: float = 4.0,
    workers: int = 1,
) -> list[Any]:
    """Fit plane rocking to rocking in space, of prism, cylinder and cone."""
    cases: list[tuple[str, str, Block, ContactBody]] = [("prism", "5 × 5", PRISM, prism_body("5 × 5"))]
    for base in bases:
        cases += [
            (name, base, block, rigid_body(block, rings=ROUND[base]))
            for name, block in (("cylinder", CYLINDER), ("cone", CONE))
        ]
    pool = Parallel(n_jobs=workers)
    laws = pool(delayed(calibrated)(name, body, 2 * STEP) for name, _, _, body in cases)
    jobs = (
        delayed(_misfit)(*case, law, release, disturbance, duration)
        for case, law in zip(cases, laws, strict=True)
        for release in releases
        for disturbance in disturbances
    )
    return list(pool(jobs))


def _misfit(
    name: str,
    base: str,
    block: Block,
    body: ContactBody,
    law: ContactLaw,
    release: float,
    disturbance: float,
    duration: float,
) -> dict[str, Any]:
    history, _ = timed(body, law, 2 * STEP, duration, release=release, out_of_plane=disturbance * block.critical_angle)
    fitted = identify_restitution(history.time, history.angle, block)
    return {
        "specimen": name,
        "base": base,
        "damping_fraction": law.damping_fraction,
        "stiffness": law.stiffness,
        "release": release,
        "disturbance": disturbance,
        "fitted": fitted.value,
        "reason": fitted.reason,
        "own": free_restitution(history),
        "out_of_plane": float(np.abs(history.out_of_plane).max() / block.critical_angle),
        "overturned": history.outcome == "overturned",
        "misfit": misfits(history, block, TARGET if fitted.value is None else fitted.value, release),
    }


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
