"""What the paper prints, in SI units: its specimens, levels and settings; and its slips, each with the arithmetic."""

from __future__ import annotations

from math import cos, pi, sqrt, tan
from typing import Any, NamedTuple

from colonnade.dynamics.block import STANDARD_GRAVITY, Block


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

DEGREES_OF_FREEDOM_IN_TEXT = {"coarse": 1224, "medium": 5478, "fine": 20332}
"""Of the three meshes; Table 2 prints 20322 for the last."""

CHOSEN_FRACTION = 0.40
"""Critical damping fraction of all the numerical runs, on the medium mesh at 10 µs."""


def specimens() -> dict[str, Any]:
    """Give each specimen's properties from its dimensions, and what the printed columns give."""
    found = {}
    for name, (block, volume, printed) in TABLE_1.items():
        alpha = block.critical_angle
        found[name] = {
            "density": block.mass / volume,
            **{quantity: getattr(block, quantity) for quantity in LAST_DIGIT},
            "tangent": tan(alpha),
            "centre_height": block.pole_distance * cos(alpha),
            "rigid_restitution": block.restitution,
            "p_of_printed": sqrt(block.mass * STANDARD_GRAVITY * printed["pole_distance"] / printed["inertia"]),
        }
    return found


class Slip(NamedTuple):
    """
    A slip.

    Attributes
    ----------
    where : str
    printed : str
        What is printed, in our words.
    meant : str
        What it should be, or what it is.
    statement : str
        Id of the statement whose answer is the arithmetic; empty if the text alone shows it.
    """

    where: str
    printed: str
    meant: str
    statement: str = ""


SLIPS = (
    Slip(
        "Table 1, text of 2.2",
        "critical angles of 0.1886, 0.2132, 0.2203 rad",
        "they are tangents, base over height of the centre of mass twice; the angles are smaller by 1.2 to 1.6 %",
        "critical-angles-are-angles",
    ),
    Slip(
        "Table 1",
        "distances of 227 and 220 mm from pole to centre of mass, of cylinder and cone",
        "they are the heights of the centre of mass; the prism's 232 mm is a distance",
        "distances-are-distances",
    ),
    Slip(
        "Table 1",
        "p = 5.631 rad/s in the rows of cylinder and cone",
        "the printed weight, distance and inertia give another p",
        "p-follows-from-its-columns",
    ),
    Slip(
        "Table 1",
        "p = 5.631 rad/s three times",
        "the dimensions give it to prism and, almost, cylinder; not to the cone",
        "one-p-for-all",
    ),
    Slip(
        "Table 2, text of 4",
        "20322 degrees of freedom in the table, 20332 in the text",
        "nodes in space have three each: 20332 cannot be divided by three",
        "degrees-of-freedom",
    ),
    Slip(
        "2.2",
        "amplitudes A that rise from 1.05 to 3.35",
        "3.35 is the frequency ratio Ω of the three histories; their largest A is 1.80",
        "levels-to-335",
    ),
    Slip(
        "Table 2",
        "a step of 100 µs for elastic steel",
        "impossible for an explicit scheme unless modulus, mass, rigid parts or scheme are other than described",
        "step-of-100us-is-possible",
    ),
    Slip(
        "Table 2",
        "a step of 10 µs for elastic steel, which all later runs have",
        "the same",
        "step-of-10us-is-possible",
    ),
    Slip(
        "2.1, fig. 3",
        "free vibrations announced of the truncated cone",
        "the figure and its caption show the prism",
    ),
    Slip("fig. 4a", "captioned 4b, as the next one is", "the captions read 4b, 4b, 4c; A = 1.05 is the first"),
    Slip("fig. 1b", "captioned 1a, as the temple before it is", "the text calls the specimens' figure 1b"),
)
