"""SI values written for people."""

from __future__ import annotations

from math import floor, isfinite, log10

from colonnade.units.conversion import from_si


def format_quantity(value: float, unit: str, digits: int = 3) -> str:
    """
    Write an SI value in `unit`, with `digits` significant digits.

    Examples
    --------
    >>> format_quantity(0.086, "mm"), format_quantity(23.456, "m/s^2")
    ('86 mm', '23.5 m/s^2')
    """
    return f"{from_si(value, unit):.{digits}g} {unit}".rstrip()


def format_uncertain(value: float, half_width: float, unit: str = "") -> str:
    """
    Write an SI value in `unit` with as many digits as its half-width allows: one, two where it starts with 1.

    Examples
    --------
    >>> format_uncertain(0.97608, 0.0008), format_uncertain(0.23204, 0.0012, "mm")
    ('0.9761 ± 0.0008', '232.0 ± 1.2 mm')
    """
    value, half_width = from_si(value, unit), abs(from_si(half_width, unit))
    if not (isfinite(half_width) and half_width > 0.0 and isfinite(value)):
        return f"{value:.4g} {unit}".rstrip()
    decimals = -floor(log10(half_width))
    if round(half_width * 10.0**decimals, 1) < 2.0:
        decimals += 1
    shown = max(decimals, 0)
    return f"{round(value, decimals):.{shown}f} ± {round(half_width, decimals):.{shown}f} {unit}".rstrip()
