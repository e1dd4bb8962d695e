"""What is known of a specimen and a set-up, and the values of that in one member of an ensemble."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from colonnade.arrays import Array
from colonnade.dynamics.block import Block, Side, Sided, pair
from colonnade.dynamics.motion import MOST_SAMPLES, Motion
from colonnade.validation import number, samples, whole

INPUTS = ("restitution", "critical_angle", "p", "gain", "clock", "cutoff", "theta0")
"""Inputs drawn once for each member, in the order of `draw_inputs`; the noise is drawn separately."""

HIGHEST_ORDER = 20
"""Of a low-pass before it is run forwards and backwards; none is steeper."""

_ROUNDING = 1e-6
"""By which an eigenvalue of correlations may be below zero."""

_NEGLIGIBLE = 1e-3
"""Response of the filter below which no noise is drawn: it is 1e-6 of the noise's power."""


@dataclass(frozen=True)
class Uncertainty:
    """
    Standard deviations of what is known of a specimen and a set-up; zero for what is known exactly.

    Attributes
    ----------
    restitution : float
        Of e, the same for both sides.
    critical_angle, p : float
        Of α and p, relative.
    gain : float
        Of the accelerometer's calibration, relative.
    clock : float
        Of the sampling interval, relative.
    noise : float
        Of the noise that the base acceleration carries, m/s²: flat up to `cutoff`, or up to half the sampling rate.
    cutoff : float or None
        Hz, of the zero-phase Butterworth low-pass that the base acceleration went through; None for none.
    filter : float
        Of that cut-off, relative: how much the choice of the filter matters. Only with a cut-off.
    filter_order : int
        Of the low-pass, before it is run forwards and backwards.
    theta0 : float
        Of the initial angle, rad.
    angle_gain : float
        Of the calibration of the measured rocking angle, relative: for identification; a history does not use it.
    restitution_freedom : float or None
        e is drawn from Student's t of so many degrees of freedom, as of few tests, scaled by `restitution`; None for
        the normal distribution.
    correlations : (float, float, float)
        Of e with α, of e with p, and of α with p: of what one record said of all three.

    Raises
    ------
    ValueError
        If a deviation is negative or not finite, no three quantities have such correlations, or the filter is uncertain
        but no filter was used.

    Examples
    --------
    >>> Uncertainty(restitution=0.005, gain=0.01).deviations.tolist()
    [0.005, 0.0, 0.0, 0.01, 0.0, 0.0, 0.0]
    >>> root = Uncertainty(correlations=(0.5, 0.0, 0.0)).root
    >>> (root @ root).round(3).tolist()
    [[1.0, 0.5, 0.0], [0.5, 1.0, 0.0], [0.0, 0.0, 1.0]]
    """

    restitution: float = 0.0
    critical_angle: float = 0.0
    p: float = 0.0
    gain: float = 0.0
    clock: float = 0.0
    noise: float = 0.0
    cutoff: float | None = None
    filter: float = 0.0
    filter_order: int = 4
    theta0: float = 0.0
    angle_gain: float = 0.0
    restitution_freedom: float | None = None
    correlations: tuple[float, float, float] = (0.0, 0.0, 0.0)

    def __post_init__(self) -> None:
        for name in ("restitution", "critical_angle", "p", "gain", "clock", "noise", "filter", "theta0", "angle_gain"):
            number(name, getattr(self, name), "a standard deviation, zero or more,", low=0.0)
        given = samples("correlations", self.correlations)
        if given.shape != (3,) or np.linalg.eigvalsh(self._correlation).min() < -_ROUNDING:
            raise ValueError(f"correlations are {self.correlations}; those of three quantities were expected")
        whole("filter_order", self.filter_order, 1, HIGHEST_ORDER)
        for name in ("restitution_freedom", "cutoff"):
            if getattr(self, name) is not None:
                number(name, getattr(self, name), "a positive number, or None,", above=0.0)
        if self.filter > 0.0 and self.cutoff is None:
            raise ValueError("filter is uncertain, but no cutoff is given; the frequency of the low-pass was expected")

    @property
    def _correlation(self) -> Array:
        e_angle, e_p, angle_p = self.correlations
        return np.array([[1.0, e_angle, e_p], [e_angle, 1.0, angle_p], [e_p, angle_p, 1.0]])

    @cached_property
    def root(self) -> Array:
        """Matrix that makes independent standard deviates those of e, α and p, shape (3, 3)."""
        values, vectors = np.linalg.eigh(self._correlation)
        return np.asarray((vectors * np.sqrt(np.maximum(values, 0.0))) @ vectors.T)

    @property
    def deviations(self) -> Array:
        """Standard deviations in the order of `INPUTS`."""
        return np.array(
            [self.restitution, self.critical_angle, self.p, self.gain, self.clock, self.filter, self.theta0]
        )


def draw_inputs(uncertainty: Uncertainty, random: np.random.Generator) -> Array:
    """
    Draw what one member takes, shape (7,), in the order of `INPUTS`.

    Returns
    -------
    inputs : ndarray
        Of e and θ₀ what is added (e stays within 0..1, see `member_restitution`), of the others the factor, which is
        log-normal so that nothing changes sign.
    """
    from scipy.special import ndtr, stdtrit

    drawn = random.standard_normal(len(INPUTS))
    drawn[:3] = uncertainty.root @ drawn[:3]
    if uncertainty.restitution_freedom is not None:
        drawn[0] = -np.sign(drawn[0]) * stdtrit(uncertainty.restitution_freedom, ndtr(-abs(drawn[0])))
    change = uncertainty.deviations * drawn
    factors = np.exp(change)
    factors[0], factors[-1] = change[0], change[-1]
    return factors


def member_restitution(restitution: Sided, change: float) -> tuple[float, float]:
    """Return e of both sides, changed alike and kept between 0 and 1."""
    negative, positive = pair(restitution)
    return min(max(negative + change, 0.0), 1.0), min(max(positive + change, 0.0), 1.0)


def member_block(block: Block, critical_angle: float, p: float) -> Block:
    """Return the block with α and p of both sides multiplied; the pole distances stay."""
    negative, positive = (
        Side(side.critical_angle * critical_angle, side.pole_distance, side.inertia / p**2) for side in block.sides
    )
    return replace(block, negative=negative, positive=positive)


class MotionDraws:
    """
    Motions that could have been the recorded one.

    Parameters
    ----------
    motion : Motion
        As recorded; accelerations along y and z go unchanged.
    uncertainty : Uncertainty

    Notes
    -----
    The record's spectrum is multiplied by the ratio of two Butterworth responses, 1/(1 + (f/f_c)²ⁿ) of the drawn
    cut-off over that of the given one; noise is drawn in the same spectrum, so that only frequencies that pass the
    filter cost anything. A wrong clock changes the interval between samples, not their values.
    """

    def __init__(self, motion: Motion, uncertainty: Uncertainty) -> None:
        from scipy.fft import next_fast_len

        self._motion, cutoff = motion, uncertainty.cutoff
        memory = 0.0 if cutoff is None else min(4.0 / (cutoff * motion.dt), MOST_SAMPLES)
        self._length = next_fast_len(motion.acceleration.size + int(memory), real=True)
        frequency = np.fft.rfftfreq(self._length, motion.dt)
        # (f/f_c)²ⁿ of the given filter; with f_c multiplied by k it is k⁻²ⁿ times that.
        self._order = 2 * uncertainty.filter_order
        self._power = np.zeros_like(frequency) if cutoff is None else (frequency / cutoff) ** self._order
        response = 1.0 / (1.0 + self._power)
        shape = response[: max(int(np.count_nonzero(response > _NEGLIGIBLE)), 2)].copy()
        shape[0] = 0.0  # the mean of the noise was taken off with the zero
        power = max(2.0 * float(np.sum(shape**2)), 1e-300)  # 0 where nothing passes
        self._noise = uncertainty.noise * shape * self._length / np.sqrt(2.0 * power)
        # The record without its filter, to be filtered again.
        self._spectrum = None
        if uncertainty.filter > 0.0:
            self._spectrum = np.fft.rfft(motion.acceleration, self._length) * (1.0 + self._power)

    def draw(self, random: np.random.Generator, *, gain: float, clock: float, cutoff: float) -> Motion:
        """Return one motion: factors of calibration, sampling interval and cut-off as drawn, and noise of its own."""
        recorded, size = self._motion, self._motion.acceleration.size
        acceleration, spectrum = recorded.acceleration, np.zeros(self._power.size, dtype=np.complex128)
        if self._spectrum is not None:
            response = 1.0 / (1.0 + self._power * cutoff**-self._order)
            acceleration, spectrum = np.zeros(size), self._spectrum * response
        if self._noise.any():
            parts = random.standard_normal((2, self._noise.size))
            spectrum[: self._noise.size] += self._noise * (parts[0] + 1j * parts[1])
        if spectrum.any():
            acceleration = acceleration + np.fft.irfft(spectrum, self._length)[:size]
        return Motion(gain * acceleration, clock * recorded.dt, recorded.vertical, recorded.transverse)
