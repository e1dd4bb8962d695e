"""Seconds of computing a second of motion: rigid, reduced, unreduced, and MuJoCo at the same step."""

from __future__ import annotations

import time
from importlib.util import find_spec
from typing import Any

import numpy as np

from colonnade.dynamics.contact.elastic.model import meshed_body
from colonnade.dynamics.contact.elastic.reduction import rigid_on_nodes
from colonnade.dynamics.contact.start import standing
from contact_model.free import GRAVITY, MASS, MESHES, PRISM, RELEASE, SIZES, law_for, prism_body, vibrate
from contact_model.unreduced import run_explicit

STEP = 1e-5
PAPERS_SECONDS = 600.0
"""Of the paper's free vibration, medium mesh at 10 µs (Table 2)."""

MUJOCO = f"""
<mujoco>
  <option timestep="{STEP}" integrator="implicitfast" cone="elliptic" impratio="100"
    iterations="100" tolerance="1e-12"/>
  <default><geom friction="2 0 0" solref="0.0001 1" solimp="0.99 0.999 1e-5"/></default>
  <worldbody>
    <geom type="plane" size="5 5 1"/>
    <body pos="0 0 0.228"><freejoint/><geom type="box" size="0.043 0.043 0.228" mass="26.1"/></body>
  </worldbody>
</mujoco>
"""
"""The stiff box that the tests compare with, at our step."""


def measure_speed(bodies: tuple[str, ...] = ("5 × 5", *MESHES), duration: float = 1.0, repeats: int = 3) -> list[Any]:
    """Time one engine after the other on this machine, alone in its process; the fastest of a few."""
    found = []
    for name in bodies:
        body = prism_body(name)
        runs = [vibrate(name, body, law_for(body, 0.4), STEP, duration) for _ in range(repeats)]
        found.append({"engine": name, "modes": runs[0].modes, "step": STEP, "cost": min(run.cost for run in runs)})
    for name in bodies:
        if name in MESHES:
            found.append(_unreduced(name, repeats))
    if find_spec("mujoco") is not None:
        found.append(
            {"engine": "MuJoCo, box", "modes": 0, "step": STEP, "cost": min(_mujoco() for _ in range(repeats))}
        )
    return found


def _unreduced(mesh: str, repeats: int, steps: int = 400) -> dict[str, Any]:
    """Time some steps of the unreduced model at its own step; a second of motion scaled from them."""
    body = meshed_body(SIZES, MASS, mesh=mesh)
    contact = rigid_on_nodes(body)
    law = law_for(contact, 0.4)
    start = standing(contact, law, GRAVITY, theta0=RELEASE * PRISM.critical_angle)

    def seconds(duration: float) -> tuple[float, int, float]:
        began = time.process_time()
        run = run_explicit(body, law, start, duration=duration, gravity=GRAVITY)
        return time.process_time() - began, len(run.time), run.step

    _, _, step = seconds(1e-6)
    pairs = [(seconds(10 * step), seconds((10 + steps) * step)) for _ in range(repeats)]
    each = float(np.median([(long[0] - short[0]) / (long[1] - short[1]) for short, long in pairs]))
    return {"engine": f"{mesh}, unreduced", "modes": 3 * len(body.points), "step": step, "cost": each / step}


def _mujoco(duration: float = 0.1) -> float:
    import mujoco

    model = mujoco.MjModel.from_xml_string(MUJOCO)
    data = mujoco.MjData(model)
    mujoco.mj_step(model, data)
    began = time.process_time()
    for _ in range(round(duration / STEP)):
        mujoco.mj_step(model, data)
    return (time.process_time() - began) / duration
