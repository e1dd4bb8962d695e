"""Bounds of the quantities and numbers of a campaign: a value beyond them is a mistake."""

from __future__ import annotations

UNITS = {"frequency": "Hz", "acceleration": "m/s^2", "inertia": "kg m^2", "pressure": "Pa", "mass": "kg"} | {
    "length": "m",
    "velocity": "m/s",
    "time": "s",
    "angle": "rad",
    "angular_velocity": "rad/s",
}
"""In which bounds are written, by dimension."""

BETWEEN = {
    "length": (1e-3, 1e3),
    "mass": (1e-6, 1e9),
    "time": (1e-6, 1e6),
    "frequency": (1e-4, 1e7),
    "angle": (1e-6, 3.2),
    "velocity": (1e-4, 1e3),
    "acceleration": (1e-2, 1e4),
    "inertia": (1e-12, 1e15),
    "pressure": (1e3, 1e13),
}
"""Least and largest SI value of a quantity that has to be above zero, by its dimension."""

AT_MOST = {"length": 1e4, "time": 1e10, "angle": 6.3}
"""Largest magnitude, SI, of a quantity that may have either sign: a position, a delay or an instant, a tilt."""

STEP = (1e-7, 1e-3)
"""Of the step of the contact model, s."""

CONVERSION = (1e-15, 1e15)
"""Of the SI value of one recorded unit; offsets and ranges are at most the latter."""

FACTOR = (1e-9, 1e9)
"""Of what a review multiplies a gain by."""

SCALE = (1e-3, 1e5)
"""Of a model: 1e5 means 1:100 000."""

PLAIN = (1e-6, 1e6)
"""Of other numbers that have no unit."""

FREQUENCY_PARAMETER = (1e-2, 1e3)
"""Of a specimen's p, rad/s: of columns of 1 km and of less than 0.1 mm."""

MAP_RATIO = (1e-3, 1e3)
"""Of the frequency and amplitude ratios of a map."""

MOST_CYCLES = 10_000.0
"""Of a sine of a map, and of its rise."""

MOST_POINTS = 10_000
"""Of either axis of a map."""


def outside(value: float, between: tuple[float, float], unit: str = "") -> str:
    """
    Say that a number's magnitude is too small or too large.

    Returns
    -------
    expected : str
        A sentence with what was expected; empty if it is between.

    Examples
    --------
    >>> outside(1e300, (1.0, 10.0), "m")
    'A value between 1 m and 10 m was expected.'
    """
    low, high = between
    if low <= abs(value) <= high:
        return ""
    written = [f"{bound:g} {unit}".rstrip() for bound in between]
    return f"A value between {written[0]} and {written[1]} was expected."


def too_large(value: float, dimension: str) -> str:
    """Say that the magnitude of a quantity of either sign is too large; empty if it is not."""
    largest = AT_MOST.get(dimension, CONVERSION[1])
    return "" if abs(value) <= largest else f"At most {largest:g} {UNITS[dimension]} was expected."
