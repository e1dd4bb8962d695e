"""Density: whether the lengths and the mass of a block can be of one body, and what was probably mistaken if not."""

from __future__ import annotations

from math import pi

LIGHTEST, HEAVIEST = 100.0, 23_000.0
"""kg/m³: what blocks are made of lies between cork or a hollow box, and osmium."""

FOAM = 20.0
"""kg/m³, below which not even a foam stands: something is wrong."""

_SMALLER = {"mm": 1e3, "cm": 1e2}
"""Units that are taken for metres, and how many of them a metre has."""


class UnlikelyBlockWarning(UserWarning):
    """A block's lengths and mass look as if they were in other units."""


def prism_volume(width: float, depth: float, height: float) -> float:
    """Volume of a prism, m³; lengths in m."""
    return width * depth * height


def cone_volume(base_diameter: float, top_diameter: float, height: float) -> float:
    """Volume of a truncated cone, m³; lengths in m. Of a cylinder both diameters are the same."""
    return pi * height * (base_diameter**2 + base_diameter * top_diameter + top_diameter**2) / 12


def is_likely(density: float) -> bool:
    """Whether a density, kg/m³, is that of a material."""
    return LIGHTEST <= density <= HEAVIEST


def mistaken_lengths(density: float) -> tuple[str, int]:
    """
    Find in which unit lengths were, and how many of the three, so that a density that is not likely becomes so.

    Returns
    -------
    unit : str
        "mm" or "cm", taken for m; empty where neither explains it.
    count : int
        How many of the three lengths: all of them if that explains it, else fewer.

    Examples
    --------
    >>> mistaken_lengths(7.7e-6), mistaken_lengths(7.7), mistaken_lengths(7700.0)
    (('mm', 3), ('mm', 1), ('', 0))
    """
    if not is_likely(density):
        for count in (3, 1, 2):
            for unit, factor in _SMALLER.items():
                if is_likely(density * factor**count):
                    return unit, count
    return "", 0
