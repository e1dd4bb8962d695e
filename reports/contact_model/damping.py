"""Table 2 of the paper redone: the critical damping fraction that gives its e, and what a free vibration costs."""

from __future__ import annotations

from dataclasses import asdict, replace
from typing import Any

import numpy as np
from joblib import Parallel, delayed

from colonnade.dynamics.contact.body import ContactBody
from colonnade.dynamics.contact.elastic.model import meshed_body
from colonnade.dynamics.contact.elastic.reduction import rigid_on_nodes
from colonnade.dynamics.contact.start import standing
from colonnade.errors import StageError
from colonnade.stages.contact import calibrate_specimen
from contact_model.free import (
    GRAVITY,
    MASS,
    MESHES,
    PRISM,
    RELEASE,
    SIZES,
    TARGET,
    inputs_of,
    law_for,
    prism_body,
    vibrate,
)
from contact_model.unreduced import BulkViscosity, ExplicitRun, explicit_step, run_explicit

STEPS = (1e-4, 1e-5, 1e-6)
BODIES = ("5 × 5", *MESHES)
PAPER = {
    ("coarse", 1e-4): (1.70, 25),
    ("coarse", 1e-5): (0.25, 200),
    ("coarse", 1e-6): (0.25, 2000),
    ("medium", 1e-4): (2.20, 70),
    ("medium", 1e-5): (0.40, 600),
    ("medium", 1e-6): (0.40, 6000),
    ("fine", 1e-4): (2.60, 300),
    ("fine", 1e-5): (0.40, 2700),
}
"""Critical damping fraction and seconds of the paper's Table 2."""
SCANNED = 1.2
"""s, of a run with the paper's fractions: three impacts."""
LONG_STEP = 1e-4
SOFT_DURATION = 1.6
"""s: a soft block takes longer until its first impact and the peak after it."""


def measure_table(bodies: tuple[str, ...] = BODIES, steps: tuple[float, ...] = STEPS, workers: int = 1) -> list[Any]:
    """Calibrate each body at each step, as the program does."""
    pool = Parallel(n_jobs=workers)
    return list(pool(delayed(_cell)(name, step) for step in steps for name in bodies))


def measure_papers_fractions(cases: tuple[tuple[str, float], ...] = tuple(PAPER), workers: int = 1) -> list[Any]:
    """Run our meshes with the paper's own damping fractions."""
    jobs = (delayed(_papers)(name, prism_body(name), step) for name, step in cases)
    return list(Parallel(n_jobs=workers)(jobs))


def _papers(name: str, body: ContactBody, step: float) -> dict[str, Any]:
    return asdict(vibrate(name, body, law_for(body, PAPER[name, step][0]), step, SCANNED))


def _cell(name: str, step: float) -> dict[str, Any]:
    """Find the law of one body at one step; also the range of e that stiffness 1 gives."""
    inputs = inputs_of("rigid" if name == "5 × 5" else name, step)
    try:
        found = calibrate_specimen(inputs, TARGET)
    except StageError:
        return {"body": name, "step": step, "reached": [], "damping_fraction": None}
    multiple = float(found.stiffnesses[int(np.nanargmin(np.abs(found.restitutions - TARGET)))])
    own = found.restitutions[(found.stiffnesses == 1.0) & np.isfinite(found.restitutions)]
    return {
        "body": name,
        "step": step,
        "reached": [float(own.min()), float(own.max())] if own.size else [],
        "multiple": multiple,
        "stiffness": found.law.stiffness,
        "damping_fraction": found.law.damping_fraction,
        "effective_damping": found.effective_damping,
        "restitution": found.restitution,
        "agrees": found.agrees,
        "modes": int(found.body.frequencies.size),
        "residual": found.residual,
        "cost": 10.0 * found.cost,
    }


def measure_unreduced(
    meshes: tuple[str, ...] = ("coarse",), softened: tuple[str, ...] = ("coarse", "medium"), duration: float = 0.55
) -> list[Any]:
    """Take the unreduced finite elements at their own stable step, and with a modulus that makes 100 µs stable."""
    found = []
    for mesh in dict.fromkeys((*meshes, *softened)):
        steel = meshed_body(SIZES, MASS, mesh=mesh)
        law = law_for(rigid_on_nodes(steel), PAPER[mesh, 1e-5][0])
        stable = explicit_step(steel, law, BulkViscosity())
        if mesh in meshes:
            found.append(_explicit(mesh, steel, law, 0.5 * stable, duration) | {"stable": stable})
        for step in (1e-5, 1e-4) if mesh in softened else ():
            damped = replace(law, damping_fraction=PAPER[mesh, step][0])
            share = (explicit_step(steel, damped, BulkViscosity()) / (1.01 * LONG_STEP)) ** 2
            soft = meshed_body(SIZES, MASS, mesh=mesh, modulus=share * steel.material.modulus)
            pressed = replace(damped, stiffness=share * law.stiffness)
            allowed = explicit_step(soft, pressed, BulkViscosity())
            run = _explicit(mesh, soft, pressed, min(LONG_STEP, allowed), SOFT_DURATION)
            found.append(run | {"stable": allowed})
    return found


def _explicit(mesh: str, body: Any, law: Any, step: float, duration: float) -> dict[str, Any]:
    """One impact of the unreduced model, from its peaks before and after."""
    start = standing(rigid_on_nodes(body), law, GRAVITY, theta0=RELEASE * PRISM.critical_angle)
    run = run_explicit(body, law, start, duration=duration, gravity=GRAVITY, step=step)
    largest = max(float(np.abs(part - part[0]).max()) for part in (run.kinetic, run.potential, run.strain))
    return {
        "mesh": mesh,
        "modulus": body.material.modulus,
        "stiffness": law.stiffness,
        "damping_fraction": law.damping_fraction,
        "step": run.step,
        "restitution": _returned(run),
        "residual": float(np.abs(run.residual).max()) / largest,
    }


def from_peaks(before: float, after: float) -> float:
    """Housner's relation between two peaks |θ|/α."""
    return float(np.sqrt((1.0 - (1.0 - after) ** 2) / (1.0 - (1.0 - before) ** 2)))


def _returned(run: ExplicitRun) -> float:
    """Restitution from the release and the peak of the arc after the first impact; NaN without one."""
    after = -float(np.arcsin(np.clip(run.turn[:, 1], -1.0, 1.0)).min()) / PRISM.critical_angle
    return from_peaks(RELEASE, after) if after > 0.0 else float("nan")
