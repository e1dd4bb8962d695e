"""Typical factors of a wrong unit or gain, and the mistake that each points to."""

from __future__ import annotations

from math import isfinite, log

from colonnade.findings import Finding, serious

LOOSE = 1.5
"""A scale within this factor of one is as expected: dimensions, friction and noise are in it."""

CLOSE = 1.12
"""A scale within this factor of a known one is a sign of it."""

STANDING = 8.0
"""Times its noise below which a channel does not move."""

DEAD = 0.1
"""Share of what others give below which a channel is dead."""

MISLEADING = 0.1
"""Relative departure of a scale from which on results are wrong."""

UNKNOWN = "look at its gain and unit"
"""Cause of a scale that is a sign of nothing."""

_LENGTH = ((25.4, "inches read as mm, or the reverse"), (2.54, "inches read as cm, or the reverse"))
_CAUSES = {
    "acceleration": ((9.80665, "g read as m/s² or the reverse, or a gain wrong by a factor of 10"),),
    "displacement": ((10.0, "a gain wrong by a factor of 10, or cm read as mm"), *_LENGTH),
    "angle": ((57.29578, "degrees read as radians, or the reverse"), (10.0, "a gain wrong by a factor of 10")),
}
_EVERY = (
    (100.0, "a gain wrong by a factor of 100, or cm read as m, or Gal as m/s²"),
    (1000.0, "a gain wrong by a factor of 1000, or mm read as m, or mV as V"),
    (10.0, "a gain wrong by a factor of 10"),
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
    ('a gain wrong by a factor of 10, or cm read as mm', 'look at its gain and unit')
    """
    for factor, words in (*_CAUSES.get(quantity, ()), *_EVERY):
        if abs(abs(log(abs(scale))) - log(factor)) < log(CLOSE):
            return words
    return UNKNOWN


def dead(still: str, shown: float, due: float, unit: str, by: str) -> Finding:
    """Say that a channel stands still (RMS in a unit) although others, `by`, give more."""
    return serious(
        "dead channel",
        f"channel {still} hardly moves ({shown:.2g} {unit} RMS), although {by} would give {due:.2g} {unit}: it is "
        "dead, or its gain is far too small. Check cable and sensor",
    )
