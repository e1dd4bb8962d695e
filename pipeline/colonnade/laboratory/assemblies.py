"""
A virtual campaign of several bodies: a column of four drums, a portal, two blocks at once.

MuJoCo moves them: a program of its own, whose boxes stand on each other by constraints that are almost rigid. An
optical system sees their markers, with noise. What became of each body is kept as the truth.
"""

from __future__ import annotations

from collections.abc import Callable
from importlib.resources import files as resources
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

from colonnade.arrays import Array
from colonnade.campaign import Campaign
from colonnade.campaign.assembly import Whole
from colonnade.campaign.channel import MAIN
from colonnade.dynamics.assembly import Assembly, Placed
from colonnade.laboratory.runs import WrittenCampaign, shake, with_its_truth
from colonnade.laboratory.table import ramped_sine
from colonnade.laboratory.truth import NO_ROCKING_RATIO
from colonnade.store.files import write_text

RATE = 200.0
"""Frames a second of the cameras, and samples of the accelerometer."""

STEP = 5e-5
"""s, of MuJoCo. In the first second half of it moves no axis by more than 0.4 % of α; then impacts part the two, and a
column's drums stand elsewhere in the end, by millimetres: the truth is that of one column."""

NOISE = {"marker": 2e-5, "acceleration": 0.01}
"""Standard deviations, m and m/s²."""

QUIET, AFTER = 0.6, 2.0
"""s, before the table moves and after."""

AT_END = 0.5
"""s, over which a body's place at the end is averaged."""

APART = 0.8
"""m, across the table, between blocks that are tested at once."""

SHAKEN = {
    "column-1": (3.0, 1.8),
    "column-2": (3.0, 3.2),
    "column-3": (3.0, 4.5),
    "column-4": (1.4, 5.0),
    "portal-1": (3.0, 1.5),
    "portal-2": (3.0, 2.6),
    "portal-3": (3.0, 3.6),
    "portal-4": (1.2, 3.6),
    "pair": (2.5, 2.8),
}
"""Frequency, Hz, and amplitude, m/s², of each recording's sine."""

CYCLES, RAMP = 3, 1

OUTCOMES = ("overturned", "rocking", "no-rocking")
"""The worst first."""

_MODEL = """
<mujoco>
  <option timestep="{step}" integrator="implicitfast" cone="elliptic" impratio="100"
    iterations="100" tolerance="1e-12"/>
  <default><geom solref="{softness} 1" solimp="0.99 0.999 1e-5" friction="0.6 0 0"/></default>
  <worldbody><geom type="plane" size="5 5 1"/>{bodies}</worldbody>
</mujoco>
"""
_BODY = '<body pos="{x} {y} {z}"><freejoint/><geom type="box" size="{a} {b} {c}" mass="{mass}"/></body>'


class Moved(NamedTuple):
    """How bodies moved on the table, m: places of their centres (n, b, 3) and rotation matrices (n, b, 3, 3)."""

    place: Array
    turned: Array


def write_assemblies(folder: Path, *, seed: int = 0, workers: int | None = 1) -> WrittenCampaign:
    """
    Write the campaign: its raw files, its truth and its campaign file.

    Parameters
    ----------
    folder : Path
    seed : int, optional
        Of the noise.
    workers : int or None, optional
        Processes; None takes one a core.

    Returns
    -------
    written : WrittenCampaign
        Its truth has, by test, `outcome` and `bodies`: of each body its outcome, and where its base is at the end, m.

    Raises
    ------
    ImportError
        If MuJoCo is not installed: it belongs to the extra `demo`.
    CampaignError
        If the folder holds a campaign that the laboratory did not write.
    """
    text = (resources("colonnade.laboratory") / "assemblies.toml").read_text(encoding="utf-8")
    done = shake(folder, text, _record, SHAKEN, seed=seed, workers=workers)
    return with_its_truth(folder, {"seed": seed, "tests": {name: true for each in done for name, true in each.items()}})


def _record(campaign: Campaign, recording: str, seed: np.random.SeedSequence) -> dict[str, dict[str, Any]]:
    """Shake what is on the table in one recording, and write its file; give what is true of its tests."""
    random = np.random.default_rng(seed)
    tests = [test for test in campaign.tests.values() if test.files[MAIN].stem == recording]
    whole, setup = campaign.specimens[tests[0].specimen], campaign.setups[tests[0].setup]
    if isinstance(whole, Whole):
        stood = whole.assembly(campaign.gravity)
    else:
        blocks = [(test.specimen, campaign.block(test.specimen)) for test in tests]
        stood = Assembly({name: Placed(block, (), (0.0, APART * row)) for row, (name, block) in enumerate(blocks)})
    frequency, amplitude = SHAKEN[recording]
    table = ramped_sine(frequency, amplitude, start=QUIET, cycles=CYCLES, ramp=RAMP)
    time = np.arange(round((table.stop + AFTER) * RATE) + 1) / RATE
    moved = move(stood, table.acceleration, time)
    base = table.acceleration(time)
    columns = {"time [s]": time, "table [m/s^2]": base + NOISE["acceleration"] * random.normal(size=time.size)}
    axes = np.array(setup.tracking.axes, dtype=np.float64)
    for marker in setup.markers.values():
        number, placed = list(stood.bodies).index(marker.on), stood.bodies[marker.on]
        arm = np.array(marker.at) - (0.0, 0.0, placed.centre_height)
        place = moved.place[:, number] + moved.turned[:, number] @ arm
        seen = (place + NOISE["marker"] * random.normal(size=place.shape)) @ axes.T
        columns |= {f"{name} [{marker.unit}]": 1e3 * seen[:, axis] for axis, name in enumerate(marker.columns)}
    rows = "\n".join(",".join(f"{value:.4f}" for value in row) for row in np.column_stack(list(columns.values())))
    write_text(campaign.path.parent / "raw" / f"{recording}.csv", f"{','.join(columns)}\n{rows}\n")
    bodies = became(stood, moved)
    true = {}
    for test in tests:
        own = {test.specimen: bodies[test.specimen]} if test.specimen in bodies else bodies
        true[test.id] = {"outcome": min((body["outcome"] for body in own.values()), key=OUTCOMES.index), "bodies": own}
    return true


def move(assembly: Assembly, acceleration: Callable[[Array], Array], time: Array, step: float = STEP) -> Moved:
    """
    Move an assembly of prisms by MuJoCo.

    Parameters
    ----------
    assembly : Assembly
    acceleration : callable
        Of the table, m/s², at times in s.
    time : ndarray, shape (n,)
        Even, of the samples, s.
    step : float, optional
        s.

    Returns
    -------
    moved : Moved
        Relative to the table.
    """
    import mujoco

    bodies = []
    for name, placed in assembly.bodies.items():
        solid, side = placed.block.solid, placed.block.governing
        if solid is None:
            raise ValueError(f"{name} has no shape; a prism was expected")
        half, (x, y) = (side.half_width, solid.half_depth, 0.5 * solid.height), placed.position
        z = assembly.levels[name] + half[2]
        bodies.append(_BODY.format(x=x, y=y, z=z, a=half[0], b=half[1], c=half[2], mass=placed.block.mass))
    text = _MODEL.format(step=step, softness=2 * step, bodies="".join(bodies))
    model = mujoco.MjModel.from_xml_string(text)
    data, count, interval = mujoco.MjData(model), len(bodies), float(time[1] - time[0])
    parts = round(interval / step)
    place, turned = np.zeros((time.size, count, 3)), np.zeros((time.size, count, 3, 3))
    for sample, begin in enumerate(time):
        mujoco.mj_kinematics(model, data)
        place[sample], turned[sample] = data.xpos[1:], data.xmat[1:].reshape(count, 3, 3)
        for base in acceleration(begin + (np.arange(parts) + 0.5) * step):
            model.opt.gravity[:] = [-base, 0.0, -assembly.gravity]
            mujoco.mj_step(model, data)
    return Moved(place, turned)


def became(assembly: Assembly, moved: Moved) -> dict[str, dict[str, Any]]:
    """Say what became of each body: its outcome, and where its base is at the end, m from where it stood."""
    numbers, found = {name: number for number, name in enumerate(assembly.bodies)}, {}
    for name, placed in assembly.bodies.items():
        own, turned = numbers[name], moved.turned[:, numbers[name]]
        below = [moved.turned[:, numbers[other], :, 2] for other in placed.on] or [np.array([[0.0, 0.0, 1.0]])]
        leans = [np.arccos(np.clip((turned[:, :, 2] * axis).sum(axis=1), -1.0, 1.0)).max() for axis in below]
        base = moved.place[:, own] - placed.centre_height * turned[:, :, 2]
        off = base[-round(AT_END * RATE) :].mean(axis=0) - base[0]
        fell = turned[-1, 2, 2] < 0.5 or base[-1, 2] < assembly.levels[name] - placed.centre_height
        rocked = max(leans) > NO_ROCKING_RATIO * assembly.critical_angles[name]
        outcome = "overturned" if fell else "rocking" if rocked else "no-rocking"
        found[name] = {"outcome": outcome, "residual_x": float(off[0]), "residual_y": float(off[1])}
    return found
