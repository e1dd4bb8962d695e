"""Pulses of the base, each of unit largest acceleration: in closed form, or sampled as finely as their limits need."""

from __future__ import annotations

from dataclasses import dataclass
from math import pi

import numpy as np
import scipy

from colonnade.arrays import Array
from colonnade.dynamics.plane.harmonic.motion import Harmonic
from colonnade.errors import nearest
from colonnade.validation import text

SAMPLE = 0.0125
"""In ω t: step of the pulses that are sampled."""

RICKER_REACH = 10.0
"""In ω t: where Ricker's wavelet, fallen to 7e-10, is cut off."""

MOST_CYCLES = 50.0
"""Largest γ."""


@dataclass(frozen=True)
class PulseKind:
    """
    A pulse.

    Attributes
    ----------
    name : str
    definition : str
        Its acceleration over the largest, φ = ω t.
    source : str
    cycles : float or None
        Of a harmonic pulse its number of cycles; None of one that is sampled.
    phase : float
        rad, of a harmonic pulse: sin(φ + phase). A frequency of 0 gives a constant.
    is_constant : bool
        Whether a harmonic pulse has the frequency 0.
    """

    name: str
    definition: str
    source: str
    cycles: float | None = None
    phase: float = 0.0
    is_constant: bool = False

    def harmonic(self, omega: float) -> Harmonic | None:
        """Give the pulse at ω (rad/s) as a harmonic motion; None if it is sampled."""
        if self.cycles is None:
            return None
        length = 2 * pi * self.cycles / omega
        return Harmonic(0.0 if self.is_constant else omega, self.phase, (0.0, length, length))


def pulse_of(name: str) -> PulseKind:
    """
    Return a pulse by its name.

    Raises
    ------
    ValueError
        If it is unknown; the message gives the nearest one.
    """
    if text("pulse", name, "the name of a pulse") not in PULSES:
        raise ValueError(f'Unknown pulse "{name}".{nearest(name, PULSES)}')
    return PULSES[name]


def sampled_pulse(name: str, cycles: float, phase: float, *, step: float = SAMPLE) -> tuple[Array, float]:
    """
    Sample a pulse that is not harmonic.

    Parameters
    ----------
    name : str
        "ricker" or "mavroeidis-papageorgiou".
    cycles, phase : float
        γ and ν (rad) of the latter.
    step : float, optional
        Largest step in ω t.

    Returns
    -------
    acceleration : ndarray, shape (n,)
        Over the largest.
    step : float
        In ω t.

    Notes
    -----
    A line between samples exceeds a curve that bends upwards by (step²/12) a'' in the mean. This is taken off the
    samples, so that the motion that is linear between them has the pulse's own integrals to fourth order. Limits of
    overturning by either pulse are then 1.5e-7 in A at most off those of a step of 0.002, in 20 random blocks.
    """
    reach = RICKER_REACH if name == RICKER.name else pi * cycles
    count = 2 * int(np.ceil(reach / step)) + 1
    angle = np.linspace(-reach, reach, count)
    values = ricker(angle) if name == RICKER.name else _normalised(cycles, phase, angle)
    values[1:-1] -= np.diff(values, 2) / 12
    return values, float(angle[1] - angle[0])


def ricker(angle: Array) -> Array:
    """Acceleration of Ricker's symmetric wavelet at ω t, over the largest; its middle is at 0."""
    return np.asarray((1 - angle**2 / 2) * np.exp(-(angle**2) / 4))


def mavroeidis_papageorgiou(cycles: float, phase: float, angle: Array) -> Array:
    """
    Acceleration of the pulse of Mavroeidis and Papageorgiou over ω times its largest velocity's bound A.

    Parameters
    ----------
    cycles, phase : float
        γ; ν, rad.
    angle : ndarray, shape (n,)
        ω t, between −πγ and πγ; its middle is at 0.

    Notes
    -----
    Derivative of v = (A/2) (1 + cos(ω t/γ)) cos(ω t + ν) (Mavroeidis and Papageorgiou 2003, eq. 3).
    """
    slow, fast = angle / cycles, angle + phase
    return np.asarray(-0.5 * (np.sin(slow) * np.cos(fast) / cycles + (1 + np.cos(slow)) * np.sin(fast)))


def _normalised(cycles: float, phase: float, angle: Array) -> Array:
    """Divide the pulse by its largest acceleration, which lies near the largest of finer samples."""
    fine = np.linspace(-pi * cycles, pi * cycles, 400 * int(np.ceil(cycles)) + 1)
    place = int(np.argmax(np.abs(mavroeidis_papageorgiou(cycles, phase, fine))))
    bounds = fine[max(place - 1, 0)], fine[min(place + 1, fine.size - 1)]
    found = scipy.optimize.minimize_scalar(
        lambda at: -abs(float(mavroeidis_papageorgiou(cycles, phase, np.array(at)))), bounds=bounds, method="bounded"
    )
    return mavroeidis_papageorgiou(cycles, phase, angle) / -float(found.fun)


RICKER = PulseKind("ricker", "(1 − φ²/2) exp(−φ²/4)", "Ricker 1943; Vassiliou and Makris 2011")
MAVROEIDIS_PAPAGEORGIOU = PulseKind(
    "mavroeidis-papageorgiou",
    "derivative of (1 + cos(φ/γ)) cos(φ + ν) for |φ| < πγ",
    "Mavroeidis and Papageorgiou 2003",
)

PULSES: dict[str, PulseKind] = {
    each.name: each
    for each in (
        PulseKind("rectangular", "1 for half a period, 0 < φ < π", "Housner 1963", 0.5, pi / 2, True),
        PulseKind("half-sine", "sin φ for 0 < φ < π", "Housner 1963", 0.5),
        PulseKind("sine", "sin φ for 0 < φ < 2π", "Zhang and Makris 2001", 1.0),
        PulseKind("cosine", "cos φ for 0 < φ < 2π", "Zhang and Makris 2001", 1.0, pi / 2),
        RICKER,
        MAVROEIDIS_PAPAGEORGIOU,
    )
}
"""All pulses by name."""
