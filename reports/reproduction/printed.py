"""What the paper prints, in SI units: its specimens, levels and settings."""

from __future__ import annotations

from math import pi
from typing import NamedTuple

from colonnade.dynamics.block import Block


class Row(NamedTuple):
    """A row of Table 1: the block of its dimensions and mass, and what the table prints."""

    block: Block
    volume: float
    """m³, of the dimensions."""
    printed: dict[str, float]


def _cone_volume(base: float, top: float, height: float) -> float:
    return pi * height / 12 * (base**2 + base * top + top**2)


SIZES = {"width": 0.086, "depth": 0.086, "height": 0.456}
"""m, of the prism."""

TABLE_1 = {
    "prism": Row(
        Block.prism(**SIZES, mass=26.10),
        SIZES["width"] * SIZES["depth"] * SIZES["height"],
        {"critical_angle": 0.1886, "pole_distance": 0.232, "inertia": 1.873, "p": 5.631},
    ),
    "cylinder": Row(
        Block.cylinder(diameter=0.097, height=0.455, mass=26.30),
        _cone_volume(0.097, 0.097, 0.455),
        {"critical_angle": 0.2132, "pole_distance": 0.227, "inertia": 1.883, "p": 5.631},
    ),
    "cone": Row(
        Block.cone(base_diameter=0.097, top_diameter=0.0755, height=0.480, mass=21.94),
        _cone_volume(0.097, 0.0755, 0.480),
        {"critical_angle": 0.2203, "pole_distance": 0.220, "inertia": 1.527, "p": 5.631},
    ),
}
"""The specimens from their dimensions, next to what the paper's Table 1 prints."""

TABLE_2 = {
    ("coarse", 1e-4): (1.70, 25),
    ("coarse", 1e-5): (0.25, 200),
    ("coarse", 1e-6): (0.25, 2000),
    ("medium", 1e-4): (2.20, 70),
    ("medium", 1e-5): (0.40, 600),
    ("medium", 1e-6): (0.40, 6000),
    ("fine", 1e-4): (2.60, 300),
    ("fine", 1e-5): (0.40, 2700),
}
"""Critical damping fraction and seconds of each mesh and step (s)."""

LAST_DIGIT = {"critical_angle": 1e-4, "pole_distance": 1e-3, "inertia": 1e-3, "p": 1e-3}
"""One unit of the last digit that the table prints."""

RESTITUTION = 0.976
"""e of the prism."""

FREQUENCIES = tuple(float(each) for each in range(1, 8))
"""Hz, of the sine tests."""

SHOWN = (1.05, 1.10, 1.80)
"""A of the histories that are shown at 3 Hz, Ω = 3.35."""

SHOWN_FREQUENCY, SHOWN_RATIO = 3.0, 3.35

SPANS = (2.0, 2.5, 3.0)

MISFIT_TIME = 6.0
"""s, about: when the computed response to Span 2.5 grows."""

DEGREES_OF_FREEDOM_IN_TEXT = {"coarse": 1224, "medium": 5478, "fine": 20332}
"""Of the three meshes; Table 2 prints 20322 for the last."""

CHOSEN_FRACTION = 0.40
"""Critical damping fraction of all the numerical runs, on the medium mesh at 10 µs."""
