"""Table 2 of the paper redone: the critical damping fraction that gives its e, and what a free vibration costs."""

from __future__ import annotations

from dataclasses import asdict, replace
from typing import Any

import numpy as np
from joblib import Parallel, delayed

from colonnade.dynamics.contact.body import ContactBody
from colonnade.dynamics.contact.calibration import calibrate
from colonnade.dynamics.contact.elastic.model import meshed_body
from colonnade.dynamics.contact.elastic.reduction import rigid_on_nodes
from colonnade.dynamics.contact.start import standing
from contact_model.free import (
    GRAVITY,
    MASS,
    MESHES,
    PRISM,
    RELEASE,
    SIZES,
    TARGET,
    law_for,
    prism_body,
    vibrate,
    with_modes,
)
from contact_model.unreduced import BulkViscosity, ExplicitRun, explicit_step, run_explicit

STEPS = (1e-4, 1e-5, 1e-6)
BODIES = ("5 × 5", *MESHES)
MULTIPLES = (1.0, 10.0, 3.0, 0.3, 0.1, 0.03, 0.01)
"""Of the default stiffness, in the order in which they are tried."""
FRACTIONS = (0.1, 0.4, 1.0, 2.0, 3.0, 4.0)
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
AROUND = (0.05, 0.2, 0.5, 0.8, 1.25)
"""Of the fraction that 10 µs gave: those that are tried first with shorter steps, which follow more modes."""
SCANNED = 1.2
"""s, of a trial: three impacts."""
LONG_STEP = 1e-4
SOFT_DURATION = 1.6
"""s: a soft block takes longer until its first impact and the peak after it."""
SHORT = 3
"""Impacts of a calibration with a step below 10 µs."""
LONG = 8


def measure_table(bodies: tuple[str, ...] = BODIES, steps: tuple[float, ...] = STEPS, workers: int = 1) -> list[Any]:
    """Calibrate each body at each step; a step below 10 µs starts from what 10 µs gave."""
    coarser = [step for step in steps if step >= 1e-5]
    pool = Parallel(n_jobs=workers)
    cells = pool(delayed(_cell)(name, prism_body(name), step) for name in bodies for step in coarser)
    near = {cell["body"]: cell for cell in cells if cell["step"] == min(coarser)}
    finer = [step for step in steps if step < 1e-5]
    cells += pool(delayed(_finer)(name, prism_body(name), step, near[name]) for name in bodies for step in finer)
    return [dict(cell) for cell in cells]


def measure_papers_fractions(cases: tuple[tuple[str, float], ...] = tuple(PAPER), workers: int = 1) -> list[Any]:
    """Run our meshes with the paper's own damping fractions."""
    jobs = (delayed(_papers)(name, prism_body(name), step) for name, step in cases)
    return list(Parallel(n_jobs=workers)(jobs))


def _papers(name: str, body: ContactBody, step: float) -> dict[str, Any]:
    return asdict(vibrate(name, body, law_for(body, PAPER[name, step][0]), step, SCANNED))


def _cell(name: str, body: ContactBody, step: float) -> dict[str, Any]:
    """Scan damping fractions at one stiffness after the other, up to the first that brackets e, and close in."""
    reached: tuple[float, float] | None = None
    unstable = []
    for multiple in MULTIPLES:
        before = None
        found = []
        for fraction in FRACTIONS:
            try:
                run = vibrate(name, body, law_for(body, fraction, multiple=multiple), step, SCANNED)
            except ValueError:
                unstable.append(multiple)
                break
            found.append(run.restitution)
            if before is not None and before[1] >= TARGET >= run.restitution:
                ends = (before[0], fraction, 1.25 * fraction)
                return _closed(name, body, step, multiple, ends, LONG) | {"reached": reached, "unstable": unstable}
            before = fraction, run.restitution
        if multiple == 1.0 and found:
            reached = min(found), max(found)
    return {"body": name, "step": step, "reached": reached, "unstable": unstable, "damping_fraction": None}


def _finer(name: str, body: ContactBody, step: float, near: dict[str, Any]) -> dict[str, Any]:
    """Close in around the damping fraction that a longer step gave."""
    if near["damping_fraction"] is None:
        return {"body": name, "step": step, "reached": None, "unstable": [], "damping_fraction": None}
    centre = near["damping_fraction"]
    fractions = tuple(share * centre for share in AROUND)
    return _closed(name, body, step, near["multiple"], fractions, SHORT)


def _closed(
    name: str, body: ContactBody, step: float, multiple: float, fractions: tuple[float, ...], impacts: int
) -> dict[str, Any]:
    """Calibrate with the modes that the step follows at the largest of the fractions."""
    law = law_for(body, fractions[-1], multiple=multiple)
    kept = with_modes(body, law, step)
    result = calibrate(
        kept,
        law,
        TARGET,
        gravity=GRAVITY,
        step=step,
        release=RELEASE,
        impacts=impacts,
        fractions=fractions,
        vary_stiffness=False,
    )
    return {
        "body": name,
        "step": step,
        "multiple": multiple,
        "stiffness": result.law.stiffness,
        "damping_fraction": result.law.damping_fraction,
        "effective_damping": result.effective_damping,
        "restitution": result.restitution,
        "agrees": result.agrees,
        "modes": int(kept.frequencies.size),
        "residual": result.residual,
        "impacts": impacts,
        "cost": 10.0 * result.cost,
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
