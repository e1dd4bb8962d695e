"""Numbers for people: SI values in their units, with sensible digits; a dash if unknown."""

from __future__ import annotations

import re
from collections.abc import Sequence
from math import floor, isfinite, log10

from colonnade.units.quantity import from_si

MINUS = "−"
"""U+2212: as wide as a digit, and never broken off its number."""

PERCENT = "\u00a0%"
"""After a number: no line ends between the two."""

NOTHING = "–"
"""Of a value that is not known."""

LEAST_RATIO = 1e-3
"""Angles below this share of the critical angle are noise: 0.1 mm at the top of a block of half a metre."""

USUAL_LEVEL = 0.95
"""± is half of the interval of this level; another level is named."""

CHANNEL_UNITS = {
    "displacement": "mm",
    "velocity": "mm/s",
    "acceleration": "m/s²",
    "angle": "mrad",
    "angular_velocity": "rad/s",
    "force": "N",
}
"""Units in which a channel is written and drawn, by its quantity."""

_EXPONENT = re.compile(r"e([+-]\d+)")
_RAISED = str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")


def number(value: float | None, digits: int = 3) -> str:
    """
    Write a plain number with significant digits.

    Examples
    --------
    >>> number(0.41234), number(float("nan")), number(None), number(12345.6)
    ('0.412', '–', '–', '12300')
    """
    if value is None or not isfinite(value):
        return NOTHING
    text = f"{value:.{digits}g}"
    return with_minus(text if "e" not in text or abs(value) < 1e-4 else f"{float(text):.0f}")


def ratio(value: float | None, digits: int = 3) -> str:
    """
    Write an angle or a misfit over the critical angle; of less than `LEAST_RATIO` nothing more is said.

    Examples
    --------
    >>> ratio(0.41234), ratio(4e-6), ratio(0.0), ratio(None)
    ('0.412', '< 0.001', '0', '–')
    """
    return f"< {LEAST_RATIO:g}" if value and abs(value) < LEAST_RATIO else number(value, digits)


def signed_ratio(value: float) -> str:
    """
    Write a difference of angles over the critical angle with its sign, as `ratio` does.

    Examples
    --------
    >>> signed_ratio(0.0123), signed_ratio(-0.5), signed_ratio(-4e-6), signed_ratio(float("nan"))
    ('+0.012', '−0.5', '< 0.001', '–')
    """
    if abs(value) < LEAST_RATIO or not isfinite(value):
        return ratio(value)
    return with_minus(f"{value:+.2g}")


def quantity(value: float | None, unit: str, digits: int = 3) -> str:
    """
    Write an SI value in a unit.

    Examples
    --------
    >>> quantity(0.23202, "mm", 4), quantity(None, "mm")
    ('232 mm', '–')
    """
    if value is None or not isfinite(value):
        return NOTHING
    return f"{number(from_si(value, unit), digits)} {unit}".rstrip()


def acceleration(value: float | None) -> str:
    """
    Write an acceleration in both units of the field.

    Examples
    --------
    >>> acceleration(2.3)
    '2.3 m/s² (0.235 g)'
    """
    if value is None or not isfinite(value):
        return NOTHING
    return f"{quantity(value, 'm/s²')} ({quantity(value, 'g')})"


def interval(value: float | None, low: float | None, high: float | None, level: float | None = None) -> str:
    r"""
    Write a coefficient of restitution with the half-width of its interval; its level is named if it is not 95 %.

    Examples
    --------
    >>> interval(0.97608, 0.97528, 0.97688, 0.95), interval(0.97608, 0.97548, 0.97668, 0.9)
    ('0.9761 ± 0.0008', '0.9761 ± 0.0006 (90\xa0% interval)')
    >>> interval(0.976, float("nan"), float("nan"))
    '0.976'
    """
    if value is None or not isfinite(value):
        return NOTHING
    if low is None or high is None or not isfinite(high - low):
        return number(value, 4)
    named = (
        "" if level is None or not isfinite(level) or level == USUAL_LEVEL else f" ({format_percent(level)} interval)"
    )
    return format_uncertain(value, (high - low) / 2) + named


def share(part: int, whole: int) -> str:
    r"""
    Write a part of a whole in per cent; what is there is never rounded to nothing.

    Examples
    --------
    >>> share(3, 40), share(3, 60000), share(0, 10)
    ('7.5\xa0%', '< 0.01\xa0%', '0\xa0%')
    """
    if part == 0:
        return f"0{PERCENT}"
    percent = 100 * part / whole
    return f"< 0.01{PERCENT}" if percent < 0.01 else f"{percent:.2g}{PERCENT}"


def probability(value: float) -> str:
    """
    Write a probability in per cent; what is not certain is never rounded to certainty.

    Examples
    --------
    >>> probability(0.432), probability(5e-17), probability(0.998), probability(1.0)
    ('43 %', '< 1 %', '> 99 %', '100 %')
    """
    if value in (0.0, 1.0):
        return f"{100 * value:.0f} %"
    return "< 1 %" if value < 0.01 else "> 99 %" if value > 0.99 else f"{100 * value:.0f} %"


def listed(names: Sequence[str], longest: int = 8) -> str:
    """
    List names, the first few of them where they are many.

    Examples
    --------
    >>> listed(["a", "b"]), listed(list("abcdefgh"), longest=3)
    ('a, b', 'a, b, c and 5 more')
    """
    if len(names) <= longest:
        return ", ".join(names)
    return f"{', '.join(names[:longest])} and {len(names) - longest} more"


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
