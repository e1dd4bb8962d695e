"""The dimensions that colonnade knows, the quantities that can be recorded, and their names in messages."""

from __future__ import annotations

DIMENSIONS: dict[str, tuple[str, str]] = {
    "length": ("m", "mm"),
    "mass": ("kg", "kg"),
    "time": ("s", "s"),
    "frequency": ("s-1", "Hz"),
    "angle": ("rad", "deg"),
    "angular_velocity": ("rad s-1", "deg/s"),
    "velocity": ("m s-1", "mm/s"),
    "acceleration": ("m s-2", "g"),
    "force": ("kg m s-2", "kN"),
    "inertia": ("kg m2", "kg m^2"),
    "pressure": ("kg m-1 s-2", "GPa"),
    "voltage": ("V", "V"),
    "dimensionless": ("1", ""),
}
"""Dimension: its SI unit, and a unit that a laboratory would write."""

QUANTITY_DIMENSIONS: dict[str, str | None] = {
    "displacement": "length",
    "velocity": "velocity",
    "acceleration": "acceleration",
    "angle": "angle",
    "angular_velocity": "angular_velocity",
    "force": "force",
    "other": None,
}
"""What a channel can record, and its dimension; `other` may have any."""


def expected(dimension: str, value: float | None = None) -> str:
    """Say that a quantity of this dimension was expected, with an example."""
    example = DIMENSIONS[dimension][1]
    if dimension == "dimensionless":
        return "A plain number was expected."
    shown = example if value is None else f"{value:g} {example}"
    return f'{article(dimension).capitalize()} was expected, such as "{shown}".'


def article(dimension: str) -> str:
    """Name a dimension with its article."""
    name = words(dimension)
    return f"{'an' if name[0] in 'aei' else 'a'} {name}"


def words(dimension: str) -> str:
    """Name a dimension."""
    return {"inertia": "moment of inertia", "angular_velocity": "angular velocity"}.get(dimension, dimension)
