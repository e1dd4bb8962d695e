"""Pulses of the base, in closed form or sampled as finely as their limits need, and limits of overturning by them."""

from __future__ import annotations

from dataclasses import dataclass
from functools import partial
from math import ceil, pi

import numpy as np
from numpy.typing import ArrayLike

from colonnade.arrays import Array
from colonnade.dynamics.block import Block, Sided
from colonnade.dynamics.models import DEFAULT, plane_model_of
from colonnade.dynamics.motion import Motion
from colonnade.dynamics.plane.run import Forcing, Harmonic, expect_usable, forcing_of, outcomes_of
from colonnade.dynamics.rock import DEFAULT_REST_ANGLE, of_sides
from colonnade.dynamics.search import (
    LARGEST_RATIO,
    LEAST_EDGE,
    WIDTH,
    OverFrequency,
    checked_ratios,
    checked_widths,
    limits_of,
    over_frequency,
    scan_over,
)
from colonnade.errors import nearest
from colonnade.validation import instance, number

SAMPLE = 0.0125
"""In ω t: step of the pulses that are sampled."""

RICKER_REACH = 10.0
"""In ω t: where Ricker's wavelet, fallen to 7e-10, is cut off."""

FINE = 3e-4
"""In ω t: step at which the largest acceleration of a pulse is looked for; it is found to 1e-8."""

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

    def forcing(self, block: Block, omega: float, cycles: float, phase: float) -> Forcing:
        """Give the pulse at ω (rad/s), over its largest acceleration, with its γ and ν (rad)."""
        if self.cycles is None:
            shape, step = sampled_pulse(self.name, cycles, phase)
            motion = Motion(shape, step / omega)
            expect_usable(block, motion)
            return forcing_of(motion, 1.0)
        length = 2 * pi * self.cycles / omega
        return Harmonic(0.0 if self.is_constant else omega, self.phase, (0.0, length, length)).forcing()


def sampled_pulse(name: str, cycles: float, phase: float) -> tuple[Array, float]:
    """
    Sample a pulse that is not harmonic, over its largest acceleration, at steps in ω t of at most `SAMPLE`; give the
    step too.

    A line between samples exceeds a curve that bends upwards by (step²/12) a'' in the mean. This is taken off the
    samples, so that the motion that is linear between them has the pulse's own integrals to fourth order. Limits of
    overturning by either pulse are then 1.5e-7 in A at most off those of a step of 0.002, in 20 random blocks.
    """
    reach, shape = pi * cycles, partial(mavroeidis_papageorgiou, cycles, phase)
    if name == RICKER.name:
        reach, shape = RICKER_REACH, partial(ricker)
    angle, fine = (np.linspace(-reach, reach, 2 * ceil(reach / step) + 1) for step in (SAMPLE, FINE))
    values = shape(angle) / np.abs(shape(fine)).max()
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


@dataclass(frozen=True, repr=False, kw_only=True)
class OverturningSpectrum(OverFrequency):
    """
    Limits of overturning by a pulse.

    Attributes
    ----------
    pulse : str
    frequency_ratio : ndarray, shape (n,)
        Ω = ω / p.
    lower, upper : ndarray, shape (n,)
        A = a / (g tan α), a the largest acceleration: from which the block first overturns over at least `width`, and
        up to which it last survives over at least `width`; NaN if there is no such limit up to the largest A.
    interval_frequency_ratio, interval_start, interval_end : ndarray, shape (k,)
        Every interval of A that overturns, islands included, by its Ω.
    options : dict
        What the limits depend on: model, restitution, γ and ν, largest A, width, edge, rest rule.

    Examples
    --------
    >>> import colonnade
    >>> block = colonnade.Block.prism(width=0.086, depth=0.086, height=0.456, mass=26.10)
    >>> limits = colonnade.overturning_spectrum(block, "half-sine", frequency_ratio=[2.0, 4.0])
    >>> limits.lower.round(2).tolist(), limits.islands.shape
    ([1.78, 2.76], (0, 3))
    >>> limits
    <OverturningSpectrum: frequency_ratio 2 to 4, lower 1.78 to 2.76, upper 1.78 to 2.76>
    """

    pulse: str


def overturning_spectrum(
    block: Block,
    pulse: str,
    *,
    frequency_ratio: ArrayLike,
    cycles: float = 2.0,
    phase: float = 0.0,
    restitution: Sided | None = None,
    model: str = DEFAULT,
    largest: float = 10.0,
    width: float = WIDTH,
    edge: float = LEAST_EDGE,
) -> OverturningSpectrum:
    """
    Find the amplitudes at which a pulse overturns a block at rest, over its frequency.

    Parameters
    ----------
    block : Block
    pulse : str
        One of `PULSES`.
    frequency_ratio : array_like, shape (n,)
        Ω = ω / p.
    cycles, phase : float, optional
        γ, from 1, and ν (rad) of "mavroeidis-papageorgiou"; other pulses have none.
    restitution : float or pair of float, optional
        e; default the rigid-body value.
    model : str, optional
        A plane one.
    largest : float, optional
        Largest A tried.
    width : float, optional
        In A: intervals narrower than this make no limit; those narrower than a fourth of it may be passed over.
    edge : float, optional
        In A: how closely the edges of intervals are found.

    Returns
    -------
    spectrum : OverturningSpectrum

    Raises
    ------
    ValueError
        If the pulse or model is not known, or an argument is out of its range.

    Notes
    -----
    Harmonic and rectangular pulses are not sampled: their limits are exact to `edge`. Ricker's and Mavroeidis and
    Papageorgiou's pulses are; see `sampled_pulse`.

    Examples
    --------
    >>> block = Block.prism(width=0.086, depth=0.086, height=0.456, mass=26.10)
    >>> spectrum = overturning_spectrum(block, "sine", frequency_ratio=[3.0], largest=8.0)
    >>> spectrum.lower.round(3).tolist(), spectrum.upper.round(3).tolist()
    ([1.368], [3.589])
    """
    instance("block", block, Block)
    if instance("pulse", pulse, str, "the name of a pulse") not in PULSES:
        raise ValueError(f'Unknown pulse "{pulse}".{nearest(pulse, PULSES)}')
    kind = PULSES[pulse]
    plane_model_of(model)
    omegas = checked_ratios("frequency_ratio", frequency_ratio)
    cycles = number("cycles", cycles, f"a number of cycles from 1 to {MOST_CYCLES:g}", low=1.0, high=MOST_CYCLES)
    phase = number("phase", phase, "a finite angle in rad")
    largest = number("largest", largest, "a positive A", above=0.0, high=LARGEST_RATIO)
    width, edge = checked_widths(width, edge, largest)
    e = of_sides(block, restitution)
    scan = scan_over(np.array([0.0, largest]), width)[1:]

    limits = []
    for ratio in omegas.tolist():
        forcing = kind.forcing(block, ratio * block.p, cycles, phase)
        runs = partial(outcomes_of, block=block, forcing=forcing, restitution=e, model=model)
        limits.append(limits_of(scan, runs, width=width, edge=edge))
    options = {"model": model, "restitution_negative": e[0], "restitution_positive": e[1]}
    options |= {"cycles": cycles, "phase": phase} if kind is MAVROEIDIS_PAPAGEORGIOU else {}
    options |= {"rest_angle": DEFAULT_REST_ANGLE, "largest": largest, "width": width, "edge": edge}
    return OverturningSpectrum(**over_frequency(omegas, limits), options=options, pulse=pulse)
