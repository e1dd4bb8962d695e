"""The campaign in which faults are planted, with nothing wrong; and what colonnade prints of a campaign."""

from __future__ import annotations

import contextlib
import io
import re
import textwrap
from pathlib import Path

import numpy as np

from colonnade.campaign.channel import MAIN
from colonnade.cli import invoke
from colonnade.dynamics.block import Block
from colonnade.dynamics.motion import Motion
from colonnade.laboratory.plan import Plan, Recorder, Trial
from colonnade.laboratory.runs import write
from colonnade.laboratory.table import ramped_sine, recorded
from colonnade.signals.filters import lowpass

PRISM = Block.prism(width=0.086, depth=0.086, height=0.456, mass=26.10)
RESTITUTION = 0.976
TIME_SCALE = 0.25
RATE, SECOND_RATE = 500.0, 400.0
"""Hz, of the two recorders."""
RELEASE = 1.5
"""s: until then nothing moves."""
SEED = 3

HEAD = Path(__file__).with_name("sound.toml")
"""The campaign file but for its tests."""


def earthquake(seed: int) -> Motion:
    """Make an earthquake of a minute, m/s², at 0.02 s."""
    rng = np.random.default_rng(seed)
    time = 0.02 * np.arange(3000)
    shape = np.clip(time / 4, 0, 1) * np.exp(-np.clip(time - 12, 0, None) / 15)
    values = lowpass(rng.normal(size=time.size), 0.02, 4.0) * shape
    values = values - lowpass(values, 0.02, 0.2)
    return Motion(6.0 * PRISM.uplift_acceleration * values / np.abs(values).max(), 0.02)


def plan() -> Plan:
    """Plan a free vibration on a table at rest and on one that moves, a sine test and an earthquake."""
    shaken = recorded(Motion(0.45 * earthquake(1).acceleration, TIME_SCALE * earthquake(1).dt), start=RELEASE)
    sine = ramped_sine(5.0, 1.5 * PRISM.uplift_acceleration, start=RELEASE, cycles=25, ramp=3)
    disturbance = Motion(0.06 * earthquake(2).acceleration[:1400], TIME_SCALE * earthquake(2).dt)
    quake = {"motion": "Valley", "time_scale": TIME_SCALE}
    held = {"theta0": 0.55 * PRISM.critical_angle, "release": RELEASE}
    alone = {MAIN: Recorder(RATE)}
    return Plan(
        HEAD.read_text(encoding="utf-8"),
        {"prism": RESTITUTION},
        {"frame": alone, "rig": alone | {"daq2": Recorder(SECOND_RATE, late=0.02)}},
        (
            Trial("free", "free-vibration", "frame", 22.0, **held),
            Trial("shaken", "free-vibration", "rig", 16.0, table=recorded(disturbance, start=RELEASE), **held),
            Trial("sine", "sine", "rig", sine.stop + 4.0, table=sine, entry={"frequency": "5 Hz"}),
            Trial("quake", "earthquake", "rig", shaken.stop + 5.0, table=shaken, entry=quake),
        ),
    )


def write_motion(path: Path, motion: Motion) -> None:
    """Write a record that the table was to follow."""
    rows = "".join(f"{k * motion.dt:.2f},{value:.6f}\n" for k, value in enumerate(motion.acceleration))
    path.write_text("time (s),acceleration (m/s^2)\n" + rows, encoding="utf-8")


def write_sound(folder: Path) -> None:
    """Write the campaign."""
    write(plan(), folder, seed=SEED)
    write_motion(folder / "valley.csv", earthquake(1))
    write_motion(folder / "hill.csv", earthquake(2))


COMMANDS = {"check": ("check",), "run": ("run", "--until", "restitution", "--workers", "1")}
"""`check` stops before the identification of e, which some faults show up in."""


def keep_only(test: str, folder: Path) -> None:
    """Take the other tests out of a campaign."""
    path = folder / "campaign.toml"
    head, *entries = re.split(r"(?=^\[\[tests\]\]\n)", path.read_text(encoding="utf-8"), flags=re.MULTILINE)
    [kept] = [entry for entry in entries if f'id = "{test}"\n' in entry]
    path.write_text(head + kept, encoding="utf-8")


def findings(command: str, folder: Path) -> str:
    """
    Run a command on the campaign in a folder, and give the problems and findings that it prints, a line each.

    Lines on what was done, such as paths and counts, are left out.
    """
    out, err = io.StringIO(), io.StringIO()
    with contextlib.chdir(folder), contextlib.redirect_stdout(out), contextlib.redirect_stderr(err):
        invoke(list(COMMANDS[command]))
    said = out.getvalue() + err.getvalue()
    kept = re.findall(
        r"^ *(?:serious|warning|note|follows from the above|problem|would fail)\b.*(?:\n {4}.*)*", said, re.MULTILINE
    )
    return textwrap.dedent("\n".join(kept))
