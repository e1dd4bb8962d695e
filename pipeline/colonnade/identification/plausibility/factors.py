"""Factors by which readings are wrong when a unit or a gain is, and what each is a sign of."""

from __future__ import annotations

from math import isfinite, log

LOOSE = 1.5
"""A scale within this factor of one is as expected: dimensions, friction and noise are in it."""

CLOSE = 1.12
"""A scale within this factor of a known one is a sign of it."""

UNKNOWN = "look at its gain and unit"
"""Cause of a scale that is a sign of nothing."""

_LENGTH = ((25.4, "inches taken for mm or the reverse"), (2.54, "inches taken for cm or the reverse"))
_CAUSES = {
    "acceleration": ((9.80665, "g taken for m/s² or the reverse, or a gain ten times off"),),
    "displacement": ((10.0, "a gain ten times off, or cm taken for mm"), *_LENGTH),
    "angle": ((57.29578, "degrees taken for radians or the reverse"), (10.0, "a gain ten times off")),
}
_EVERY = (
    (100.0, "a gain a hundred times off, or cm taken for m or Gal for m/s²"),
    (1000.0, "a gain a thousand times off, or mm taken for m, or mV for V"),
    (10.0, "a gain ten times off"),
)


def as_expected(scale: float) -> bool:
    """Whether a scale is one, as far as such a comparison shows; its sign does not count."""
    return isfinite(scale) and scale != 0 and abs(log(abs(scale))) < log(LOOSE)


def cause(scale: float, quantity: str) -> str:
    """
    Probable cause of a scale.

    Examples
    --------
    >>> cause(0.101, "displacement"), cause(3.3, "angle")
    ('a gain ten times off, or cm taken for mm', 'look at its gain and unit')
    """
    for factor, words in (*_CAUSES.get(quantity, ()), *_EVERY):
        if abs(abs(log(abs(scale))) - log(factor)) < log(CLOSE):
            return words
    return UNKNOWN
