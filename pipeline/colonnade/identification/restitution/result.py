"""What an identification of the coefficient of restitution returns."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from colonnade.arrays import Array, Mask
from colonnade.units.text import Digested, format_percent, interval

EXACT = 1e-9
"""Standard deviation of the logarithm of what is known exactly: of α, p or the angle's gain."""


@dataclass(frozen=True)
class Estimate:
    """
    A value of e, or the reason why it is missing.

    Attributes
    ----------
    name : {"history", "peaks"}
        From the samples of the whole history; from the peaks alone, the cross-check.
    level : float
    reason : str
        Why refused; empty otherwise.
    value, low, high, standard_error : float or None
        e, its interval of confidence at `level` and its standard error; None if refused.
    """

    name: str
    level: float
    reason: str = ""
    value: float | None = None
    low: float | None = None
    high: float | None = None
    standard_error: float | None = None


@dataclass(frozen=True)
class Peaks:
    """The peaks that an identification saw: s, rad, rad, rad, and whether each entered the fit; all shape (n,)."""

    time: Array
    angle: Array
    standard_error: Array
    fitted_angle: Array
    used: Mask


@dataclass(frozen=True)
class Impacts:
    """
    The impacts between two arcs of a history, in order; all of shape (n,).

    Attributes
    ----------
    time : ndarray
        s, of the zero of the averaged angle.
    velocity : ndarray
        Magnitude of the angular velocity just before, rad/s, from the energy of the arc before.
    restitution, restitution_standard_error : ndarray
        e of this impact alone, from the arcs before and after; NaN where one of them has no peak.
    used : ndarray of bool
        Whether both arcs have a peak that counts.
    """

    time: Array
    velocity: Array
    restitution: Array
    restitution_standard_error: Array
    used: Mask


_NONE = np.empty(0)
NO_PEAKS = Peaks(_NONE, _NONE, _NONE, _NONE, np.empty(0, dtype=bool))
NO_IMPACTS = Impacts(_NONE, _NONE, _NONE, _NONE, np.empty(0, dtype=bool))


@dataclass(frozen=True)
class FittedHistory:
    """
    The history laid through the record.

    Attributes
    ----------
    time, angle, residual : ndarray, shape (n,)
        s; rad, as the record shows it; rad, measured − fitted, NaN where a sample did not count.
    """

    time: Array
    angle: Array
    residual: Array


@dataclass(frozen=True)
class Joint:
    """
    What a record says of e, α and p together.

    Attributes
    ----------
    mean : ndarray, shape (3,)
        Of ln e, and of ln of α and of p over those of the block.
    covariance : ndarray, shape (3, 3)
        Of these, over all scatters of e that the record allows.
    gain : float
        ln of the angle's gain, its posterior mean.
    """

    mean: Array
    covariance: Array
    gain: float = 0.0


@dataclass(frozen=True, repr=False)
class Restitution(Digested):
    """
    An identified coefficient of restitution, or the reason why it is missing.

    Attributes
    ----------
    value, low, high : float or None
        e and its interval of confidence at `level`, for the mean of all impacts like those of this record; None if
        refused.
    standard_error : float or None
        Of e.
    level : float
        Probability of the interval.
    method : str
        In words.
    reason : str
        Why refused; empty otherwise.
    zero_offset : float
        rad, common to all peaks; already taken off `peaks.angle`.
    peaks : Peaks
    impacts : Impacts
    estimates : tuple of Estimate
        From the whole history, and from the peaks.
    history : FittedHistory or None
    departures : tuple of Departure
        From the plane model with one e.
    recommended : str
        Name of the estimate whose value this is; empty if refused.
    table_moves : bool or None
        Whether the recorded motion of the table drives the history; None if it was not recorded, or refused before.
    joint : Joint or None
        Of e, α and p; None if refused.
    doubts : tuple of (str, str)
        Kind and sentence of what makes the value doubtful: α, p or the gain far from what was given.

    Examples
    --------
    >>> import colonnade
    >>> block = colonnade.Block.prism(width=0.086, depth=0.086, height=0.456, mass=26.10)
    >>> history = colonnade.rock(block, theta0=0.09, restitution=0.9, duration=5.0, model="nonlinear")
    >>> found = colonnade.identify_restitution(history.time, history.angle, block)
    >>> round(found.value, 4), found.recommended, found.reason
    (0.9, 'history', '')
    >>> sorted(found.digest())
    ['e', 'method', 'peaks used']
    """

    value: float | None
    low: float | None
    high: float | None
    standard_error: float | None
    level: float
    method: str
    reason: str = ""
    zero_offset: float = 0.0
    peaks: Peaks = NO_PEAKS
    impacts: Impacts = NO_IMPACTS
    estimates: tuple[Estimate, ...] = ()
    history: FittedHistory | None = None
    departures: tuple[Departure, ...] = ()
    recommended: str = ""
    table_moves: bool | None = None
    joint: Joint | None = None
    doubts: tuple[tuple[str, str], ...] = ()

    def digest(self) -> dict[str, str]:
        """
        Return e with its interval, the method and the peaks that it is from, or why it is missing.

        Returns
        -------
        digest : dict of str to str
            Names and values with their units, as a notebook shows them.
        """
        if self.value is None or self.low is None or self.high is None:
            return {"e": "–", "reason": self.reason}
        e = f"{interval(self.value, self.low, self.high)} ({format_percent(self.level)}, mean of such impacts)"
        seen = f"{int(self.peaks.used.sum())} of {self.peaks.used.size}"
        return {"e": e, "method": self.recommended or self.method, "peaks used": seen}


@dataclass(frozen=True)
class Departure:
    """
    A way in which a free vibration is not plane rocking of a rigid block with one e.

    Attributes
    ----------
    name : str
        "three-dimensional rocking", "sliding", "unequal sides", "speed-dependent restitution" or "moving table".
    size, standard_error : float
        In `unit`; the sentence says what is measured.
    unit : str
        SI; "1" where it has none.
    sentence : str
        The finding for people: size with its error, and what follows.
    refuses : bool
        Whether no e of the plane model is left.
    """

    name: str
    size: float
    standard_error: float
    unit: str
    sentence: str
    refuses: bool = False
