"""Faults that no finding names: what they change in e, and what keeps them away."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from colonnade.arrays import Array
from colonnade.store.files import read
from colonnade.store.layout import Layout
from faults.fault import TIME, TOP, Change, in_file
from faults.sound import PRISM, RELEASE, RESTITUTION, findings, keep_only
from study import table

TEST = "free"
"""The test of the sound campaign that they are planted in."""


@dataclass(frozen=True)
class Unseen:
    """A fault of the free vibration: its name, how it is planted, why nothing shows it, what keeps it away."""

    name: str
    plant: Change
    why: str
    advice: str


def _added(signal: Callable[[Array], Array]) -> Change:
    def change(samples: Array) -> Array:
        samples[:, TOP] += signal(samples[:, TIME])
        return samples

    return in_file("free.csv", change)


UNSEEN = (
    Unseen("none", lambda folder: None, "", ""),
    Unseen(
        "hum of 3 mm at 50 Hz on top",
        _added(lambda time: 0.2 * np.sin(2 * np.pi * 50.0 * time)),
        "The low-pass takes most of it off, and the noise estimate includes what is left.",
        "Look at the spectrum of a record at rest.",
    ),
    Unseen(
        "zero of top drifts by 0.75 mm in 22 s",
        _added(lambda time: 0.05 * time / time[-1]),
        "It is below 0.005 α over the arcs, and the history allows for it.",
        "Record rest at both ends.",
    ),
)


@dataclass(frozen=True)
class Effect:
    """What a run gives of the free vibration: e and its interval, the angle at which it was held, what was printed."""

    restitution: float
    low: float
    high: float
    held: float
    told: str


def effect(fault: Unseen, folder: Path) -> Effect:
    """Plant a fault into a copy of the sound campaign, and run the free vibration."""
    keep_only(TEST, folder)
    fault.plant(folder)
    told = findings("run", folder)
    layout = Layout(folder)
    found, rocked = read(layout.stage(TEST, "restitution")), read(layout.stage(TEST, "rocking"))
    values = (float(found[name]) for name in ("restitution", "restitution_low", "restitution_high"))
    angle = rocked["rocking_angle"].to_numpy()[rocked["elapsed"].to_numpy() < RELEASE - 0.1]
    return Effect(*values, float(np.median(angle)) / PRISM.critical_angle, told)


def page(effects: list[tuple[Unseen, Effect]]) -> str:
    """Write the page."""
    heads = ("planted", "held at", "e", "95 % interval", "findings")
    rows = [
        (fault.name, f"{of.held:.3f} α", f"{of.restitution:.6f}", f"{of.low:.6f} to {of.high:.6f}", of.told or "none")
        for fault, of in effects
    ]
    reasons = [f"- **{fault.name}.** {fault.why} {fault.advice}" for fault, _ in effects if fault.why]
    return "\n".join(
        [
            "# What is not found",
            "",
            "A check can only find what contradicts something else. These faults were planted into the free vibration "
            f"of the same campaign, whose true e is {RESTITUTION:g} and whose prism was held at 0.55 α. The runs gave:",
            "",
            table(heads, rows),
            "",
            "e is a ratio and hardly changes; the angle, and with it every peak, has the error of the gain or the "
            "height, and no interval includes that.",
            "",
            "Why nothing is said, and what keeps such faults away:",
            "",
            *reasons,
            "",
        ]
    )
