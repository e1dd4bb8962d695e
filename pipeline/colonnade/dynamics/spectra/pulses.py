"""Overturning spectra: from which amplitude on a pulse of a given length overturns a block."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from math import pi

import numpy as np
from numpy.typing import ArrayLike, NDArray

from colonnade.arrays import Array
from colonnade.dynamics.block import Block, Sided, pair
from colonnade.dynamics.models.registry import DEFAULT, plane_model_of
from colonnade.dynamics.motion import Motion
from colonnade.dynamics.plane.harmonic import Harmonic, harmonic_outcomes
from colonnade.dynamics.rock import rock
from colonnade.errors import nearest

PULSES = ("half-sine", "sine", "cosine", "ricker", "rectangular")
"""Pulses, each of unit largest acceleration: half a sine wave, one wave of sine or cosine, Ricker's symmetric wavelet
(1 − ω²t²/2) exp(−ω²t²/4), which is sampled, and a constant that lasts half a period."""

RICKER_REACH, RICKER_SAMPLES = 12.0, 4001
"""The wavelet is cut off at |ω t| = 12, where it has fallen to 2e-14, and sampled so often."""


@dataclass(frozen=True)
class OverturningSpectrum:
    """
    Smallest overturning amplitudes of a pulse.

    Attributes
    ----------
    pulse, model : str
    frequency_ratio : ndarray, shape (n,)
        Ω = ω / p.
    amplitude_ratio : ndarray, shape (n,)
        A = a / (g tan α) from which the block overturns; NaN where it does not up to the largest A tried.
    """

    pulse: str
    model: str
    frequency_ratio: Array
    amplitude_ratio: Array


def overturning_spectrum(
    block: Block,
    pulse: str,
    *,
    frequency_ratio: ArrayLike,
    restitution: Sided | None = None,
    model: str = DEFAULT,
    largest: float = 10.0,
    scan_step: float = 0.02,
    edge: float = 1e-8,
) -> OverturningSpectrum:
    """
    Find the smallest amplitude that overturns a block at rest, over the frequency of a pulse.

    Parameters
    ----------
    block : Block
    pulse : str
        One of `PULSES`.
    frequency_ratio : array_like, shape (n,)
        Ω = ω / p.
    restitution : float or pair of float, optional
        e; default the rigid-body value.
    model : str, optional
        A plane one.
    largest : float, optional
        Largest A tried.
    scan_step : float, optional
        In A: narrower intervals of overturning may be passed over.
    edge : float, optional
        In A: how closely the amplitude is found.

    Returns
    -------
    spectrum : OverturningSpectrum

    Raises
    ------
    ValueError
        If the pulse or model is not known, or a number is not positive.
    """
    if pulse not in PULSES:
        raise ValueError(f'Unknown pulse "{pulse}".{nearest(pulse, PULSES)}')
    plane_model_of(model)
    omegas = np.atleast_1d(np.asarray(frequency_ratio, dtype=np.float64))
    if not ((omegas > 0).all() and 0 < edge < scan_step < largest):
        raise ValueError("Positive frequency ratios and 0 < edge < scan_step < largest were expected")
    e = pair(block.restitution if restitution is None else restitution)
    scan = np.linspace(0.0, largest, round(largest / scan_step) + 1)[1:]
    found = [
        _first_overturning(_overturns(block, pulse, omega * block.p, e, model), scan, edge) for omega in omegas.tolist()
    ]
    return OverturningSpectrum(pulse, model, omegas, np.array(found))


def _overturns(
    block: Block, pulse: str, omega: float, restitution: tuple[float, float], model: str
) -> Callable[[Array], NDArray[np.bool_]]:
    if pulse == "ricker":
        phase = np.linspace(-RICKER_REACH, RICKER_REACH, RICKER_SAMPLES)
        shape = (1 - phase**2 / 2) * np.exp(-(phase**2) / 4) * block.uplift_acceleration
        dt = float(phase[1] - phase[0]) / omega

        def sampled(amplitudes: Array) -> NDArray[np.bool_]:
            runs = [rock(block, Motion(a * shape, dt), restitution=restitution, model=model) for a in amplitudes]
            return np.array([run.outcome == "overturned" for run in runs])

        return sampled
    if pulse == "rectangular":
        end = pi / omega
        motion = Harmonic(0.0, pi / 2, (0.0, end, end))
    else:
        cycles = 0.5 if pulse == "half-sine" else 1.0
        motion = Harmonic.cycles(omega, cycles, phase=pi / 2 if pulse == "cosine" else 0.0)

    def harmonic(amplitudes: Array) -> NDArray[np.bool_]:
        overturned: NDArray[np.bool_] = harmonic_outcomes(block, motion, amplitudes, restitution, model) == 2
        return overturned

    return harmonic


def _first_overturning(overturns: Callable[[Array], NDArray[np.bool_]], scan: Array, edge: float) -> float:
    """Scan upwards, a part at a time, and halve the step in which the block first overturns."""
    below = 0.0
    for part in np.array_split(scan, max(1, scan.size // 16)):
        hits = overturns(part)
        if hits.any():
            index = int(np.argmax(hits))
            low, high = (part[index - 1] if index else below), part[index]
            while high - low > edge:
                middle = 0.5 * (low + high)
                if overturns(np.array([middle]))[0]:
                    high = middle
                else:
                    low = middle
            return float(0.5 * (low + high))
        below = part[-1]
    return float("nan")
