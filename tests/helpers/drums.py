"""A column of drums on a table, recorded by an optical system: moved by the contact engine, seen by exact rotations."""

import numpy as np
from scipy.spatial.transform import Rotation

from colonnade.dynamics.assembly import Assembly
from colonnade.dynamics.block import Block
from colonnade.dynamics.contact.body import ContactLaw
from colonnade.dynamics.contact.simulate import simulate_assembly
from colonnade.dynamics.motion import Motion

DRUM = Block.prism(width=0.2, depth=0.2, height=0.2, mass=20.0)
COLUMN = Assembly.stack(**{"1": DRUM, "2": DRUM, "3": DRUM})
STEP = 0.005
MARKERS = {"a": (0.1, 0.05, 0.02), "b": (0.1, -0.05, 0.18), "c": (-0.1, 0.0, 0.1)}
NOISE = 2e-5
"""m."""
AXES = np.array([[0, 1, 0], [-1, 0, 0], [0, 0, 1]])
"""Of the optical system, in the frame of the table."""

CAMPAIGN = """
schema = 1
campaign = "drums"
title = "A column of drums"

[specimens]
drum = {shape = "prism", width = "200 mm", depth = "200 mm", height = "200 mm", mass = "20 kg"}

[processing.predict.contact]
penetration = 1e-6
step = "20 us"

[processing.predict.ensemble.contact]
members = 0

[assemblies.column]
stack = ["drum", "drum", "drum"]

[setups.drums.channels]
table = {column = "table", quantity = "acceleration", unit = "m/s^2", on = "table", direction = [1, 0, 0]}

[setups.drums.tracking]
axes = [[0, 1, 0], [-1, 0, 0], [0, 0, 1]]
relative_to = "table"

[setups.drums.markers]
"""

TEST = """
[[tests]]
id = "quake"
kind = "earthquake"
specimen = "column"
setup = "drums"
file = "raw/quake.csv"
"""


def pulse(strength, duration=4.0):
    """A sine of three periods at 2 Hz with rests before and after, m/s²."""
    time = np.arange(round(duration / STEP) + 1) * STEP
    inside = (time > 0.5) & (time < 2.0)
    return Motion(np.where(inside, strength * np.sin(4 * np.pi * (time - 0.5)), 0.0), STEP)


def shaken(strength):
    """The history of the column, on a contact that is soft enough for long steps."""
    return simulate_assembly(COLUMN, pulse(strength), law=ContactLaw(penetration=1e-6), step=2e-5)


def recorded(history, seed=0):
    """Columns of the file: time, table, and X, Y, Z of each marker as the system sees it, mm."""
    random = np.random.default_rng(seed)
    columns = {"t": history.time, "table": None}
    for name, body in history.bodies.items():
        placed = history.assembly.bodies[name]
        turned = Rotation.from_quat(body.orientation, scalar_first=True)
        for marker, at in MARKERS.items():
            place = body.position + turned.apply(np.array(at) - (0.0, 0.0, placed.centre_height))
            seen = (place + NOISE * random.normal(size=place.shape)) @ AXES.T
            columns |= {f"{name}{marker} {axis}": 1e3 * seen[:, k] for k, axis in enumerate("XYZ")}
    return columns


def write_campaign(folder, history=None, strength=6.0):
    """Write the campaign of one test; return the history that it recorded."""
    history = history or shaken(strength)
    acceleration = pulse(strength).acceleration
    columns = recorded(history) | {
        "table": acceleration + 0.01 * np.random.default_rng(1).normal(size=acceleration.size)
    }
    (folder / "raw").mkdir(parents=True, exist_ok=True)
    table = np.column_stack(list(columns.values()))
    np.savetxt(folder / "raw/quake.csv", table, delimiter=",", header=",".join(columns), comments="", fmt="%.6f")
    markers = [
        f'm{name}{marker} = {{columns = ["{name}{marker} X", "{name}{marker} Y", "{name}{marker} Z"], unit = "mm", '
        f'on = "{name}", at = [{", ".join(repr(f"{1e3 * part:g} mm") for part in at)}]}}'.replace("'", '"')
        for name in history.bodies
        for marker, at in MARKERS.items()
    ]
    (folder / "campaign.toml").write_text(CAMPAIGN + "\n".join(markers) + "\n" + TEST)
    return history
