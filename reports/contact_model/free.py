"""Free vibrations of the paper's specimens in the contact model, each told in a few numbers."""

from __future__ import annotations

import itertools
import time
from dataclasses import dataclass
from functools import cache
from typing import Any

import numpy as np

from colonnade.campaign.settings import ContactSettings, RestitutionSettings
from colonnade.dynamics.block import Block
from colonnade.dynamics.contact.body import ContactBody
from colonnade.dynamics.contact.calibration import free_restitution
from colonnade.dynamics.contact.elastic.model import elastic_body
from colonnade.dynamics.contact.history import ContactHistory
from colonnade.dynamics.contact.law import ContactLaw
from colonnade.dynamics.contact.modes import keep_modes, keep_modes_for_step
from colonnade.dynamics.contact.nodes import rigid_body
from colonnade.dynamics.contact.simulate import plane_block, simulate
from colonnade.stages.contact import ContactInputs

GRAVITY = 9.81
MASS = 26.10
SIZES = {"width": 0.086, "depth": 0.086, "height": 0.456}
"""The paper's prism, kg and m."""

PRISM = Block.prism(**SIZES, mass=MASS, gravity=GRAVITY)
CYLINDER = Block.cylinder(diameter=0.097, height=0.455, mass=26.30, gravity=GRAVITY)
CONE = Block.cone(base_diameter=0.097, top_diameter=0.0755, height=0.480, mass=21.94, gravity=GRAVITY)
TARGET = 0.976
"""The paper's e of the prism."""

MESHES = ("coarse", "medium", "fine")
RELEASE = 0.5
"""|θ|/α at the start of a free vibration, unless told."""
FRICTION = 0.6

PENETRATION = 1e-6
"""Of the stiffness called 1, in heights of the centre of mass: soft enough for the paper's step of 100 µs."""


@dataclass(frozen=True)
class FreeRun:
    """
    One free vibration.

    Stiffness in N/m³, step and duration in s, cost in seconds of processor time for a second of motion, residual of the
    energy balance over the largest energy, peaks in |θ|/α.
    """

    body: str
    modes: int
    step: float
    stiffness: float
    damping_fraction: float
    effective_damping: float
    friction: float
    release: float
    restitution: float
    impacts: int
    peaks: tuple[float, ...]
    residual: float
    cost: float


@cache
def prism_body(name: str) -> ContactBody:
    """Build the prism as "coarse", "medium", "fine" elastic mesh, or rigid on "5 × 5" nodes."""
    if name in MESHES:
        return elastic_body(SIZES, MASS, mesh=name)
    along, across = (int(number) for number in name.split(" × "))
    return rigid_body(PRISM, grid=(along, across))


def inputs_of(mesh: str, step: float, block: Block = PRISM, *, penetration: float = PENETRATION) -> ContactInputs:
    """Give what the program calibrates by: "rigid" of any block, or a mesh of the prism, from a stiffness on."""
    return ContactInputs(
        block=block,
        shape="prism",
        sizes=tuple(sorted(SIZES.items())),
        settings=ContactSettings(mesh=mesh, step=f"{step} s", friction=FRICTION, penetration=penetration),
        lowest_amplitude=RestitutionSettings().lowest_amplitude,
    )


def law_for(body: ContactBody, fraction: float, *, multiple: float = 1.0, friction: float = FRICTION) -> ContactLaw:
    """Give the law whose stiffness is a multiple of that called 1."""
    penetration = PENETRATION / multiple
    return ContactLaw.stiff(body, GRAVITY, damping_fraction=fraction, friction=friction, penetration=penetration)


def with_modes(body: ContactBody, law: ContactLaw, step: float, modes: int | None = None) -> ContactBody:
    """Keep the lowest modes, or as many as the step follows."""
    if modes is None:
        return keep_modes_for_step(body, law, step)
    return keep_modes(body, float(body.frequencies[modes - 1]) if modes else 0.0)


def vibrate(
    name: str,
    body: ContactBody,
    law: ContactLaw,
    step: float,
    duration: float,
    *,
    modes: int | None = None,
    release: float = RELEASE,
) -> FreeRun:
    """Let a body rock freely in the plane."""
    kept = with_modes(body, law, step, modes)
    history, cost = timed(kept, law, step, duration, release=release)
    return FreeRun(
        body=name,
        modes=int(kept.frequencies.size),
        step=history.step,
        stiffness=law.stiffness,
        damping_fraction=law.damping_fraction,
        effective_damping=history.effective_damping,
        friction=law.friction,
        release=release,
        restitution=free_restitution(history),
        impacts=int(np.isfinite(history.impact_restitution).sum()),
        peaks=peaks_of(history),
        residual=history.energies.relative_residual,
        cost=cost,
    )


def timed(
    body: ContactBody, law: ContactLaw, step: float, duration: float, *, release: float = RELEASE, **start: Any
) -> tuple[ContactHistory, float]:
    """Run a free vibration; also the seconds of processor time for a second of motion, compiled before."""
    theta0 = release * plane_block(body, GRAVITY).critical_angle
    simulate(body, law=law, gravity=GRAVITY, theta0=theta0, duration=2 * step, step=step, **start)
    began = time.process_time()
    history = simulate(body, law=law, gravity=GRAVITY, theta0=theta0, duration=duration, step=step, **start)
    return history, (time.process_time() - began) / duration


def peaks_of(history: ContactHistory) -> tuple[float, ...]:
    """Give the largest |θ|/α of each whole arc after the first impact, between samples by a parabola."""
    ratio = np.abs(history.angle) / history.block.critical_angle
    edges = np.searchsorted(history.time, history.impact_times)
    found = []
    for first, last in itertools.pairwise(edges):
        if last - first < 3:
            continue
        top = first + int(np.argmax(ratio[first:last]))
        if not first < top < last - 1:
            continue
        before, at, after = ratio[top - 1 : top + 2]
        found.append(float(at - (after - before) ** 2 / (8.0 * (before - 2.0 * at + after))))
    return tuple(found)
