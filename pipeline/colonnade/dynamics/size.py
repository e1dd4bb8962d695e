"""Sizes of bodies: what density a body may have, and from model to prototype."""

from __future__ import annotations

from math import pi

LIGHTEST, HEAVIEST = 100.0, 23_000.0
"""kg/m³: blocks are between cork or a hollow box, and osmium."""

FOAM = 20.0
"""kg/m³, below which not even a foam stands: something is wrong."""


def cone_volume(base_diameter: float, top_diameter: float, height: float) -> float:
    """Volume of a truncated cone, m³; lengths in m. Of a cylinder both diameters are the same."""
    return pi * height * (base_diameter**2 + base_diameter * top_diameter + top_diameter**2) / 12


EXPONENTS = {
    "length": 1.0,
    "time": 0.5,
    "frequency": -0.5,
    "velocity": 0.5,
    "acceleration": 0.0,
    "angle": 0.0,
    "angular_velocity": -0.5,
    "mass": 3.0,
    "inertia": 5.0,
}
"""Power of the scale by which each quantity grows."""


def at_prototype(quantity: str, value: float, scale: float) -> float:
    """
    Value at prototype scale of a quantity measured on a model.

    Parameters
    ----------
    quantity : str
        One of `EXPONENTS`.
    value : float
        At model scale.
    scale : float
        s of a 1:s model.

    Notes
    -----
    Gravity is the same for both, so accelerations are, and time goes with the square root of length. Mass and inertia
    are those of the same density. Angles, e, A and Ω do not change.

    Examples
    --------
    >>> at_prototype("length", 0.5, 20), round(at_prototype("frequency", 5.631, 20), 4)
    (10.0, 1.2591)
    """
    return float(value * scale ** EXPONENTS[quantity])
