"""From model to prototype: a 1:s model of the same material shaken in the same gravity."""

from __future__ import annotations

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

    Raises
    ------
    ValueError
        If the quantity is not known or the scale is not positive.

    Notes
    -----
    Gravity is the same for both, so accelerations are, and time goes with the square root of length. Mass and inertia
    are those of the same density. Angles, e, A and Ω do not change.

    Examples
    --------
    >>> at_prototype("length", 0.5, 20), round(at_prototype("frequency", 5.631, 20), 4)
    (10.0, 1.2591)
    """
    if quantity not in EXPONENTS:
        raise ValueError(f"{quantity!r} is not a quantity that scales; one of {', '.join(EXPONENTS)} was expected")
    if not scale > 0:
        raise ValueError(f"scale is {scale}; a positive number was expected")
    return float(value * scale ** EXPONENTS[quantity])
