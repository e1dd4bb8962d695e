"""The motion of the ground or of a table: what it is integrated to, how far it drifts, corrections of its baseline."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import cached_property, partial

import numpy as np

from colonnade import units
from colonnade.arrays import Array
from colonnade.dynamics.block import STANDARD_GRAVITY
from colonnade.errors import UnitError, nearest
from colonnade.validation import instance

LARGEST_DRIFT = 0.1
"""Default of the largest end velocity over PGV of a record without drift."""

LARGEST_DRIFT_AT_REST = 0.25
"""The same of a table's motion: what a line may take off an integral, over its peak."""

RESTING = 0.02
"""Share of the record of a table, at each end, over which it is taken to rest."""

NONE = "none"
"""The name of no correction."""

CORNER = 0.1
"""Hz, of the high-pass, if its name gives no other."""

LEAST_CORNER = 1e-3
"""Hz: slower than any motion of the ground that is recorded; the zeros around the record grow with its inverse."""

ORDER = 2
"""Of the high-pass in each direction."""

PADDING = 1.5
"""Zeros before and after the record over the order of the whole filter and its corner: 1.5 n / f (Converse 1992)."""

Correction = Callable[[Array, float], Array]
"""Acceleration (m/s²) and interval (s) in, corrected acceleration out; shapes (n,)."""


@dataclass(frozen=True)
class Ground:
    """
    A motion on plain arrays; what is derived from it is computed once, when it is first asked for.

    Attributes
    ----------
    acceleration : ndarray, shape (n,)
        m/s², without gaps, linear between its samples.
    interval : float
        s.
    gravity : float
        m/s².
    at_rest : bool
        Whether it is known to begin and to end at rest, as a table does and nobody knows of the ground. A line through
        the means of the first and the last `RESTING` of each integral is then subtracted, as a constant error of the
        acceleration gives no more than a line.
    """

    acceleration: Array
    interval: float
    gravity: float = STANDARD_GRAVITY
    at_rest: bool = False

    @cached_property
    def velocity(self) -> Array:
        """Integral of the acceleration from rest, m/s: exact at the samples."""
        return self._velocity[0]

    @cached_property
    def displacement(self) -> Array:
        """Integral of the velocity from zero, m: exact at the samples, as the velocity is."""
        return self._displacement[0]

    @property
    def drift(self) -> float:
        """Velocity at the end, or what a line took off it, over the largest one; 0 of a motion that has none."""
        return self._velocity[1]

    @property
    def drift_of_displacement(self) -> float:
        """The larger of the drift of the velocity and, of a motion at rest at both ends, of its integral."""
        return max(self.drift, self._displacement[1]) if self.at_rest else self.drift

    @cached_property
    def _velocity(self) -> tuple[Array, float]:
        return self._settled(integral(self.acceleration, self.interval))

    @cached_property
    def _displacement(self) -> tuple[Array, float]:
        # The velocity is a parabola between samples.
        curved = self.interval**2 / 12 * (self.acceleration - self.acceleration[0])
        return self._settled(integral(self.velocity, self.interval) - curved)

    def _settled(self, whole: Array) -> tuple[Array, float]:
        """Return an integral, less the line through its ends if it rests there, and its drift over its peak."""
        off = abs(float(whole[-1]))
        if self.at_rest:
            size = max(int(RESTING * whole.size), 1)
            first, last = float(whole[:size].mean()), float(whole[-size:].mean())
            off = abs(last - first)
            steps = (np.arange(whole.size) - (size - 1) / 2) / max(whole.size - size, 1)
            whole = whole - first - (last - first) * steps
        peak = float(np.abs(whole).max())
        return whole, off / peak if peak > 0.0 else 0.0


def integral(values: Array, interval: float) -> Array:
    """Integrate from zero by trapezoids, without scipy, which the check of a campaign file must not load."""
    return np.concatenate(([0.0], np.cumsum(0.5 * interval * (values[1:] + values[:-1]))))


def correction_of(name: str) -> Correction:
    """
    Find a correction of the baseline by its name; that of the high-pass may give its corner, "highpass(0.05 Hz)".

    Raises
    ------
    ValueError
        If it is not known, or its corner is not a frequency.
    """
    bare, corner = split_name(instance("baseline", name, str, "the name of a correction"), {"highpass": "frequency"})
    if bare not in CORRECTIONS:
        raise ValueError(f'Unknown baseline correction "{name}".{nearest(name, CORRECTIONS)}')
    if corner is None:
        return CORRECTIONS[bare]
    if corner < LEAST_CORNER:
        raise ValueError(f'"{name}": a corner of at least {LEAST_CORNER:g} Hz was expected')
    return partial(_without_slow, corner=corner)


def _as_it_is(acceleration: Array, interval: float) -> Array:
    return acceleration


def _without_polynomial(acceleration: Array, interval: float, *, degree: int) -> Array:
    """
    Subtract the derivative of the polynomial through zero that is closest to the velocity.

    Of degree 1 a constant (Boore 2001), of degree 2 a line (Boore, Stephens and Joyner 2002).
    """
    velocity = Ground(acceleration, interval).velocity
    share = np.arange(acceleration.size) / max(acceleration.size - 1, 1)
    powers = np.arange(1, degree + 1)
    factors = np.linalg.lstsq(share[:, None] ** powers, velocity, rcond=None)[0]
    slope = share[:, None] ** (powers - 1) @ (powers * factors)
    return np.asarray(acceleration - slope / (max(acceleration.size - 1, 1) * interval))


def _without_slow(acceleration: Array, interval: float, *, corner: float) -> Array:
    """
    Run a Butterworth high-pass forwards and backwards over the record with zeros before and after, and cut it again.

    Boore and Bommer (2005).
    """
    import scipy  # the check of a campaign file must not load it

    if not corner < 0.5 / interval:
        raise ValueError(
            f"highpass: the corner {corner:g} Hz is not below half the sampling rate, {0.5 / interval:g} Hz"
        )
    sections = scipy.signal.butter(ORDER, corner, "highpass", fs=1 / interval, output="sos")
    padding = round(PADDING * 2 * ORDER / (corner * interval))
    filtered = scipy.signal.sosfiltfilt(sections, np.pad(acceleration, padding), padtype=None)
    return np.asarray(filtered[padding : padding + acceleration.size])


CORRECTIONS: dict[str, Correction] = {
    NONE: _as_it_is,
    "linear": partial(_without_polynomial, degree=1),
    "quadratic": partial(_without_polynomial, degree=2),
    "highpass": partial(_without_slow, corner=CORNER),
}
"""Corrections of the baseline by name. They are used only where one is asked for."""


def split_name(name: str, dimensions: Mapping[str, str]) -> tuple[str, float | None]:
    """
    Split a name from the quantity in its brackets, positive, in SI; a name that may have none is left whole.

    Raises
    ------
    ValueError
        If what is in the brackets is no such quantity.

    Examples
    --------
    >>> split_name("sa(500 ms)", {"sa": "time"}), split_name("pga", {"sa": "time"})
    (('sa', 0.5), ('pga', None))
    """
    bare, bracket, given = (part.strip() for part in name.partition("("))
    if not bracket or bare not in dimensions or not given.endswith(")"):
        return name.strip(), None
    try:
        value = units.to_si(given[:-1].strip(), dimensions[bare])
    except UnitError as error:
        raise ValueError(f'"{name}": {error}') from None
    if not value > 0:
        raise ValueError(
            f'"{name}": {given[:-1]} was found in the brackets; a positive {dimensions[bare]} was expected'
        )
    return bare, value
