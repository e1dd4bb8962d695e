"""What the calibrated rigid prism gives: e over amplitude, friction and disturbance."""

from __future__ import annotations

from dataclasses import asdict, replace
from typing import Any

import numpy as np
from joblib import Parallel, delayed

from colonnade.dynamics.block import Block
from colonnade.dynamics.contact.body import ContactBody
from colonnade.dynamics.contact.calibration import free_restitution
from colonnade.dynamics.contact.law import DEFAULT_STEP, STATIC_PENETRATION, ContactLaw
from colonnade.dynamics.ensembles.contact import ContactPlan, gather, run_member
from colonnade.stages.contact import calibrate_specimen
from contact_model.free import GRAVITY, PRISM, TARGET, inputs_of, prism_body, timed, vibrate

STEP = DEFAULT_STEP
RELEASES = (0.05, 0.1, 0.2, 0.3, 0.5, 0.7, 0.9)
FRICTIONS = (0.2, 0.3, 0.4, 0.6, 0.8, 1.0)
DISTURBANCES = (0.0, 0.001, 0.0025, 0.005, 0.01, 0.02)
"""Rotation about x at the start, of α."""
MEMBERS = 32
SEED = 2013


def calibrated(block: Block, step: float = STEP) -> ContactLaw:
    """Calibrate a rigid body to the paper's e of the prism, as the program does."""
    return calibrate_specimen(inputs_of("rigid", step, block, penetration=STATIC_PENETRATION), TARGET).law


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
