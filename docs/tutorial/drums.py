"""
Write the recordings of a virtual column of three drums into `raw/`: two tests, followed by an optical system.

The column moves as the contact model says; `truth.txt` has where each drum really stands at the end.
"""

from pathlib import Path

import numpy as np
from scipy.spatial.transform import Rotation

from colonnade import Assembly, Block, Motion, rock

DRUM = Block.cylinder(diameter=0.300, height=0.200, mass=34.0)
COLUMN = Assembly.stack(**{"1": DRUM, "2": DRUM, "3": DRUM})
MARKERS = {"a": (0.150, 0.0, 0.030), "b": (0.0, -0.150, 0.170), "c": (-0.150, 0.0, 0.100)}
"""On each drum, from the centre of its base, m."""
SYSTEM = np.array([[0, 1, 0], [-1, 0, 0], [0, 0, 1]])
"""X, Y and Z of the cameras in the frame of the table."""
STEP, NOISE = 0.005, 3e-5
RAW = Path("raw")

noise = np.random.default_rng(7)


def shaking(strength):
    """Three periods of 1.6 Hz, with rests before and after."""
    time = np.arange(0.0, 4.0, STEP)
    inside = (time > 0.6) & (time < 0.6 + 3 / 1.6)
    return Motion(np.where(inside, strength * np.sin(2 * np.pi * 1.6 * (time - 0.6)), 0.0), STEP)


def record(name, strength):
    """Shake the column, and write what the recorder and the cameras saw; return where the drums are at the end."""
    motion = shaking(strength)
    history = rock(COLUMN, motion, model="contact")
    columns = {
        "time [s]": history.time,
        "ACC [m/s^2]": motion.acceleration + 0.01 * noise.normal(size=history.time.size),
    }
    said = []
    for body, moved in history.bodies.items():
        turned = Rotation.from_quat(moved.orientation, scalar_first=True)
        for marker, at in MARKERS.items():
            place = moved.position + turned.apply(np.array(at) - (0.0, 0.0, 0.100))
            seen = 1e3 * (place + NOISE * noise.normal(size=place.shape)) @ SYSTEM.T
            columns |= {f"{body}{marker} {axis} [mm]": seen[:, k] for k, axis in enumerate("XYZ")}
        base = (moved.position + turned.apply([0.0, 0.0, -0.100]))[-round(0.5 / STEP) :].mean(axis=0)
        fell = np.isfinite(moved.overturning_time)
        said.append(f"{name}: drum {body} " + ("fell" if fell else f"moved by {1e3 * np.hypot(*base[:2]):.1f} mm"))
    table = np.column_stack(list(columns.values()))
    np.savetxt(RAW / f"{name}.csv", table, "%.4f", ",", header=",".join(columns), comments="")
    return said


RAW.mkdir(exist_ok=True)
truth = record("quake-1", 5.6) + record("quake-2", 7.0)
Path("truth.txt").write_text("\n".join(truth) + "\n", encoding="utf-8")
