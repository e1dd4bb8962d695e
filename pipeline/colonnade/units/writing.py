"""SI values written for people."""

from __future__ import annotations

import re
from math import floor, isfinite, log10

from colonnade.units.conversion import from_si

MINUS = "−"
"""U+2212: as wide as a digit, and never broken off its number."""

PERCENT = "\u00a0%"
"""After a number: no line ends between the two."""

_EXPONENT = re.compile(r"e([+-]\d+)")
_RAISED = str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")


def format_quantity(value: float, unit: str, digits: int = 3) -> str:
    """
    Write an SI value in `unit`, with `digits` significant digits.

    Examples
    --------
    >>> format_quantity(0.086, "mm"), format_quantity(23.456, "m/s^2")
    ('86 mm', '23.5 m/s^2')
    """
    return f"{from_si(value, unit):.{digits}g} {unit}".rstrip()


def format_percent(share: float, decimals: int = 0, *, signed: bool = False) -> str:
    r"""
    Write a share in per cent, with its sign if asked.

    Examples
    --------
    >>> format_percent(0.9), format_percent(0.0012, 1), format_percent(-0.25), format_percent(0.1, signed=True)
    ('90\xa0%', '0.1\xa0%', '−25\xa0%', '+10\xa0%')
    """
    return with_minus(f"{100 * share:{'+' if signed else ''}.{decimals}f}{PERCENT}")


def with_minus(number: str) -> str:
    """
    Write a number that begins with a hyphen, and its exponent, as people read them.

    Examples
    --------
    >>> with_minus("-0.5"), with_minus("1.2e-05 m"), with_minus("3e+06")
    ('−0.5', '1.2·10⁻⁵ m', '3·10⁶')
    """
    if number.startswith("-"):
        number = MINUS + number[1:]
    return _EXPONENT.sub(lambda found: f"·10{str(int(found[1])).translate(_RAISED)}", number)


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
        return f"{with_minus(f'{value:.4g}')} {unit}".rstrip()
    decimals = _decimals(half_width)
    shown = max(decimals, 0)
    width = f"{round(half_width, decimals):.{shown}f}"
    return f"{with_minus(f'{round(value, decimals):.{shown}f}')} ± {width} {unit}".rstrip()


def _decimals(half_width: float) -> int:
    """Decimals with which a half-width is written; negative if it is rounded to tens."""
    decimals = -floor(log10(half_width))
    return decimals + 1 if round(half_width * 10.0**decimals, 1) < 2.0 else decimals
