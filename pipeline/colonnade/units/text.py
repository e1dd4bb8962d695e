"""Numbers and words for people: SI values in their units with sensible digits, a dash if unknown; lists; results."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from math import ceil, floor, isfinite, log10, nan

from colonnade.units import from_si

MINUS = "−"
"""U+2212: as wide as a digit, and never broken off its number."""

PERCENT = "\u00a0%"
"""After a number: no line ends between the two."""

NOTHING = "–"
"""Of a value that is not known."""

LEAST_RATIO = 1e-3
"""Angles below this share of the critical angle are noise: 0.1 mm at the top of a block of half a metre."""

FEW_DIGITS = 2e-4
"""Half-width of an interval of e below which it is rounded up to the fourth decimal."""

USUAL_LEVEL = 0.95
"""± is half of the interval of this level; another level is named."""

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


def written(value: float | None, unit: str = "", digits: int = 4) -> str:
    """
    Write a number with the unit that it is in.

    Examples
    --------
    >>> written(0.41234, "rad"), written(None, "rad")
    ('0.4123 rad', '–')
    """
    return NOTHING if value is None or not isfinite(value) else f"{number(value, digits)} {unit}".rstrip()


def ratio(value: float | None, digits: int = 3) -> str:
    """
    Write an angle or a misfit over the critical angle; of less than `LEAST_RATIO` nothing more is said.

    Examples
    --------
    >>> ratio(0.41234), ratio(4e-6), ratio(0.0), ratio(None)
    ('0.412', '< 0.001', '0', '–')
    """
    return f"< {LEAST_RATIO:g}" if value and abs(value) < LEAST_RATIO else number(value, digits)


def quantity(value: float | None, unit: str, digits: int = 3) -> str:
    """
    Write an SI value in a unit.

    Examples
    --------
    >>> quantity(0.23202, "mm", 4), quantity(None, "mm")
    ('232 mm', '–')
    """
    return NOTHING if value is None else written(from_si(value, unit), unit, digits)


def acceleration(value: float | None) -> str:
    """
    Write an acceleration in both units of the field.

    Examples
    --------
    >>> acceleration(2.3), acceleration(None)
    ('2.3 m/s² (0.235 g)', '–')
    """
    return NOTHING if value is None or not isfinite(value) else f"{written(value, 'm/s²', 3)} ({quantity(value, 'g')})"


def interval(value: float | None, low: float | None, high: float | None, level: float | None = None) -> str:
    r"""
    Write a coefficient of restitution with the half-width of its interval; its level is named if it is not 95 %.

    Examples
    --------
    >>> interval(0.97608, 0.97528, 0.97688, 0.95), interval(0.97608, 0.97548, 0.97668, 0.9)
    ('0.9761 ± 0.0008', '0.9761 ± 0.0006 (90\xa0% interval)')
    >>> interval(0.976, float("nan"), float("nan")), interval(0.976, 0.975999, 0.976001)
    ('0.976', '0.9760 ± 0.0001')

    Notes
    -----
    No more than four decimals, the half-width rounded up: no block is known so well that more would mean something.
    """
    half_width = nan if low is None or high is None else (high - low) / 2
    if value is None or not isfinite(value) or not isfinite(half_width):
        return number(value, 4)
    named = f" ({format_percent(level)} interval)" if level and isfinite(level) and level != USUAL_LEVEL else ""
    if half_width < FEW_DIGITS:
        return f"{value:.4f} ± {max(ceil(1e4 * half_width - 1e-6), 1) / 1e4:.4f}" + named
    return format_uncertain(value, half_width) + named


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
        return written(value, unit)
    decimals = -floor(log10(half_width))
    decimals += round(half_width * 10.0**decimals, 1) < 2.0
    shown, width = (f"{round(each, decimals):.{max(decimals, 0)}f}" for each in (value, half_width))
    return f"{with_minus(shown)} ± {width} {unit}".rstrip()


def format_percent(share: float, decimals: int = 0, *, signed: bool = False) -> str:
    r"""
    Write a share in per cent, with its sign if asked.

    Examples
    --------
    >>> format_percent(0.9), format_percent(0.0012, 1), format_percent(-0.25), format_percent(0.1, signed=True)
    ('90\xa0%', '0.1\xa0%', '−25\xa0%', '+10\xa0%')
    """
    return with_minus(f"{100 * share:{'+' if signed else ''}.{decimals}f}{PERCENT}")


def percent(share: float | None) -> str:
    r"""
    Write a share that may be very small in per cent, with two digits.

    Examples
    --------
    >>> percent(0.00413), percent(2.5), percent(2.2e-7)
    ('0.41\xa0%', '250\xa0%', '2.2·10⁻⁵\xa0%')
    """
    return NOTHING if share is None or not isfinite(share) else number(100 * share, 2) + PERCENT


def probability(value: float) -> str:
    r"""
    Write a probability in per cent; what is not certain is never rounded to certainty.

    Examples
    --------
    >>> probability(0.432), probability(5e-17), probability(0.998), probability(1.0)
    ('43\xa0%', '< 1\xa0%', '> 99\xa0%', '100\xa0%')
    """
    doubt = "< " if 0.0 < value < 0.01 else "> " if 0.99 < value < 1.0 else ""
    return doubt + format_percent(min(max(value, 0.01), 0.99) if doubt else value)


def with_minus(number: str) -> str:
    """
    Write a number that begins with a hyphen, and its exponent, as people read them.

    Examples
    --------
    >>> with_minus("-0.5"), with_minus("1.2e-05 m"), with_minus("3e+06")
    ('−0.5', '1.2·10⁻⁵ m', '3·10⁶')
    """
    return _EXPONENT.sub(lambda found: f"·10{str(int(found[1])).translate(_RAISED)}", re.sub("^-", MINUS, number))


def listed(names: Sequence[str], longest: int = 8, what: str = "") -> str:
    """
    List names, the first few of them where they are many.

    Examples
    --------
    >>> listed(["a", "b"]), listed(list("abcdefgh"), longest=3, what="tests")
    ('a, b', 'a, b, c and 5 more tests')
    """
    shown = ", ".join(names[:longest])
    return shown if len(names) <= longest else f"{shown} and {len(names) - longest} more {what}".rstrip()


def joined(names: Sequence[str], last: str = "and") -> str:
    """
    List all names as in a sentence.

    Examples
    --------
    >>> joined(["a"]), joined(["a", "b"]), joined(["a", "b", "c"], "or")
    ('a', 'a and b', 'a, b or c')
    """
    return f" {last} ".join([*filter(None, [", ".join(names[:-1])]), *names[-1:]])


class Digested:
    """A result whose `repr` shows what is most worth knowing in a line, also in a notebook."""

    _ESSENCE = ""
    """Attributes, each with its unit."""

    def digest(self) -> Mapping[str, str]:
        """
        Return what is most worth knowing.

        Returns
        -------
        shown : mapping of str to str
            Attributes by name, with their units.

        Examples
        --------
        >>> import colonnade
        >>> colonnade.Block.prism(width=0.086, depth=0.086, height=0.456, mass=26.10).digest()["p"]
        '5.631 rad/s'
        """
        named = [each.partition(" ") for each in self._ESSENCE.split(", ")]
        return {name: shown(getattr(self, name), unit) for name, _, unit in named}

    def __repr__(self) -> str:
        """Write it in a line."""
        said = ", ".join(f"{name} {text}" for name, text in self.digest().items())
        return f"<{type(self).__name__}: {said}>"


def shown(value: object, unit: str = "") -> str:
    """
    Write a value of any kind: four digits of a number, a list in one line, the range of an array.

    Examples
    --------
    >>> shown(None), shown(0.123456, "s"), shown([1, 2.5]), shown(True)
    ('–', '0.1235 s', '1; 2.5', 'True')
    """
    if value is None or isinstance(value, float):
        return written(value, unit)
    if hasattr(value, "flat"):
        known = [float(each) for each in value.flat if isfinite(each)]
        return f"{number(min(known, default=nan))} to {written(max(known, default=nan), unit, 3)}"
    return "; ".join(map(shown, value)) if isinstance(value, (list, tuple, Mapping)) else str(value)
