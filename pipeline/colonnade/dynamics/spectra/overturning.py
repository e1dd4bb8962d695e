"""Overturning spectra: from which amplitude on a pulse overturns a block, and up to which it may not."""

from __future__ import annotations

from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from functools import partial
from math import ceil
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from colonnade.arrays import Array, Codes
from colonnade.digest import Digested
from colonnade.dynamics.block import Block, Sided
from colonnade.dynamics.maps.chart import MOST_THREADS
from colonnade.dynamics.maps.limits import Limits, Runs, islands_of, limits_of
from colonnade.dynamics.maps.plan import LARGEST_RATIO, LEAST_EDGE, STEPS_A_WIDTH, WIDTH, checked_widths
from colonnade.dynamics.models.registry import DEFAULT, plane_model_of
from colonnade.dynamics.motion import Motion
from colonnade.dynamics.plane.harmonic.motion import harmonic_outcomes
from colonnade.dynamics.plane.outcomes import ends_of, prepared
from colonnade.dynamics.rock import DEFAULT_REST_ANGLE
from colonnade.dynamics.spectra.pulses import MAVROEIDIS_PAPAGEORGIOU, MOST_CYCLES, PulseKind, pulse_of, sampled_pulse
from colonnade.validation import instance, number, samples, sided, whole


@dataclass(frozen=True, repr=False)
class OverturningSpectrum(Digested):
    """
    Limits of overturning by a pulse.

    Attributes
    ----------
    pulse, model : str
    frequency_ratio : ndarray, shape (n,)
        Ω = ω / p.
    lower, upper : ndarray, shape (n,)
        A = a / (g tan α), a the largest acceleration: from which the block first overturns over at least `width`, and
        up to which it last survives over at least `width`; NaN if there is no such limit up to the largest A.
    interval_frequency_ratio, interval_start, interval_end : ndarray, shape (k,)
        Every interval of A that overturns, islands included, by its Ω.
    options : dict
        What the limits depend on: restitution, γ and ν, largest A, width, edge, rest rule.

    Examples
    --------
    >>> import colonnade
    >>> block = colonnade.Block.prism(width=0.086, depth=0.086, height=0.456, mass=26.10)
    >>> limits = colonnade.overturning_spectrum(block, "half-sine", frequency_ratio=[2.0, 4.0])
    >>> limits.lower.round(2).tolist(), limits.islands.shape
    ([1.78, 2.76], (0, 3))
    >>> limits.digest()["lower limit"]
    'A = 1.78 to 2.76'
    """

    pulse: str
    model: str
    frequency_ratio: Array
    lower: Array
    upper: Array
    interval_frequency_ratio: Array
    interval_start: Array
    interval_end: Array
    options: dict[str, Any]

    def digest(self) -> dict[str, str]:
        """
        Return pulse, model and the range of the lower limit.

        Returns
        -------
        digest : dict of str to str
            Names and values with their units, as a notebook shows them.
        """
        known = self.lower[np.isfinite(self.lower)]
        return {
            "pulse": self.pulse,
            "model": self.model,
            "Ω": f"{self.frequency_ratio[0]:.3g} to {self.frequency_ratio[-1]:.3g} in {self.frequency_ratio.size}",
            "lower limit": f"A = {known.min():.3g} to {known.max():.3g}" if known.size else "above the largest A",
        }

    @property
    def islands(self) -> Array:
        """Overturning intervals narrower than `width`: rows of Ω, start and end in A, shape (k, 3)."""
        return islands_of(self.interval_frequency_ratio, self.interval_start, self.interval_end, self.options["width"])


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
    threads: int = 1,
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
    threads : int, optional
        Frequencies computed at a time. The result is the same to the last bit.

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
    kind = pulse_of(pulse)
    plane_model_of(model)
    omegas = samples("frequency_ratio", frequency_ratio, dimensions=(0, 1)).ravel()
    if not (omegas.min() >= 1 / LARGEST_RATIO and omegas.max() <= LARGEST_RATIO):
        raise ValueError(
            f"frequency_ratio goes from {omegas.min():g} to {omegas.max():g}; positive numbers from "
            f"{1 / LARGEST_RATIO:g} to {LARGEST_RATIO:g} were expected"
        )
    cycles = number("cycles", cycles, f"a number of cycles from 1 to {MOST_CYCLES:g}", low=1.0, high=MOST_CYCLES)
    phase = number("phase", phase, "a finite angle in rad")
    largest = number("largest", largest, "a positive A", above=0.0, high=LARGEST_RATIO)
    width, edge = checked_widths(width, edge, largest)
    threads = whole("threads", threads, 1, MOST_THREADS)
    given = block.restitution if restitution is None else restitution
    e = sided("restitution", given, "a number between 0 and 1", low=0.0, high=1.0)
    case = _Case(block, kind, cycles, phase, e, model)
    scan = np.linspace(0.0, largest, ceil(largest / width * STEPS_A_WIDTH) + 1)[1:]
    with ThreadPoolExecutor(threads) as pool:
        found = list(pool.map(partial(case.limits, scan, width, edge), omegas.tolist()))
    intervals = np.concatenate([each.intervals for each in found])
    return OverturningSpectrum(
        pulse,
        model,
        omegas,
        np.array([each.lower for each in found]),
        np.array([each.upper for each in found]),
        np.repeat(omegas, [len(each.intervals) for each in found]),
        intervals[:, 0],
        intervals[:, 1],
        case.options | {"largest": largest, "width": width, "edge": edge},
    )


@dataclass(frozen=True)
class _Case:
    """A block and a pulse; attributes as the arguments of `overturning_spectrum`."""

    block: Block
    pulse: PulseKind
    cycles: float
    phase: float
    restitution: tuple[float, float]
    model: str

    @property
    def options(self) -> dict[str, Any]:
        """What the limits depend on, but for the search."""
        shape = {"cycles": self.cycles, "phase": self.phase} if self.pulse is MAVROEIDIS_PAPAGEORGIOU else {}
        e = dict(zip(("restitution_negative", "restitution_positive"), self.restitution, strict=True))
        return {**e, **shape, "rest_angle": DEFAULT_REST_ANGLE}

    def limits(self, scan: Array, width: float, edge: float, frequency_ratio: float) -> Limits:
        """Find the limits at one Ω."""
        runs = self.runs(frequency_ratio * self.block.p)
        return limits_of(scan, runs(scan), runs, width=width, edge=edge)

    def runs(self, omega: float) -> Runs:
        """Give what runs some A at ω, rad/s."""
        block, harmonic = self.block, self.pulse.harmonic(omega)
        if harmonic is not None:
            return lambda amplitudes: harmonic_outcomes(block, harmonic, amplitudes, self.restitution, self.model)
        shape, step = sampled_pulse(self.pulse.name, self.cycles, self.phase)
        unit, sides = block.uplift_acceleration * shape, [prepared(block, self.restitution)]

        def sampled(amplitudes: Array) -> Codes:
            motions = (Motion(amplitude * unit, step / omega) for amplitude in amplitudes)
            return np.concatenate(
                [ends_of(each, sides, gravity=block.gravity, model=self.model).outcome for each in motions]
            )

        return sampled
