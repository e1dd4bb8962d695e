"""Spectra of a recorded motion: the largest angle of rectangular blocks, and the largest response of oscillators."""

from __future__ import annotations

from dataclasses import dataclass
from math import ceil, pi

import numpy as np
import scipy
from numpy.typing import ArrayLike

from colonnade.arrays import Array, Mask
from colonnade.dynamics.block import STANDARD_GRAVITY, Block, Side, Sided
from colonnade.dynamics.models import NONLINEAR, plane_model_of
from colonnade.dynamics.motion import Motion
from colonnade.dynamics.plane.run import ends_of, expect_usable
from colonnade.units.text import Digested
from colonnade.validation import instance, number, samples

DAMPING = 0.05
"""Fraction of critical damping that is usual."""

FEWEST_PER_PERIOD = 100
"""Instants a period at which the response is looked at: its peak is missed by 0.05 % (1 − cos(π/100)) at most."""


@dataclass(frozen=True, repr=False)
class RockingSpectrum(Digested):
    """
    Largest angles of blocks on one motion.

    Attributes
    ----------
    critical_angle : ndarray, shape (n,)
        α, rad.
    period : ndarray, shape (m,)
        2π/p, s.
    peak_ratio : ndarray, shape (n, m)
        Largest |θ|/α; NaN where the block overturns, 0 where it does not uplift.
    overturned : ndarray of bool, shape (n, m)
        Whether the block overturns.
    model : str
        Its name.

    Examples
    --------
    >>> import numpy as np
    >>> import colonnade
    >>> motion = colonnade.Motion(3.0 * np.sin(np.pi * np.arange(51) / 25), 0.01)
    >>> found = colonnade.rocking_spectrum(motion, critical_angle=[0.2], period=[1.0, 2.0])
    >>> found.overturned.tolist()
    [[True, False]]
    >>> found
    <RockingSpectrum: model nonlinear, critical_angle 0.2 to 0.2 rad, period 1 to 2 s, peak_ratio 0.259 to 0.259>
    """

    _ESSENCE = "model, critical_angle rad, period s, peak_ratio"

    critical_angle: Array
    period: Array
    peak_ratio: Array
    overturned: Mask
    model: str


def rocking_spectrum(
    motion: Motion,
    *,
    critical_angle: ArrayLike,
    period: ArrayLike,
    restitution: Sided | None = None,
    model: str = NONLINEAR.name,
    gravity: float = STANDARD_GRAVITY,
) -> RockingSpectrum:
    """
    Compute the rocking spectrum of a recorded motion.

    Parameters
    ----------
    motion : Motion
        Along x and, if given, z.
    critical_angle : array_like, shape (n,)
        α of the blocks, rad.
    period : array_like, shape (m,)
        2π/p of the blocks, s; for a rectangular block p² = 3 g/(4 R).
    restitution : float or pair of float, optional
        e, the pair for impacts that end an arc at (θ < 0, θ > 0); by default that of a rigid rectangular
        block without bounce, 1 − (3/2) sin² α.
    model : str, optional
        A plane one.
    gravity : float, optional
        m/s².

    Returns
    -------
    spectrum : RockingSpectrum

    Raises
    ------
    ValueError
        If an angle, a period or e is out of its range or the model is not known.

    Notes
    -----
    After Makris and Konstantinidis (2003): p, unlike a natural period, is a measure of size only, and the spectrum has
    to be read for one slenderness at a time.

    Examples
    --------
    >>> motion = Motion(3.0 * np.sin(np.linspace(0, 2 * np.pi, 200)), 0.005)
    >>> spectrum = rocking_spectrum(motion, critical_angle=[0.2, 0.4], period=[0.8, 6.0])
    >>> spectrum.overturned.tolist()
    [[True, False], [False, False]]
    """
    instance("motion", motion, Motion)
    angles = samples("critical_angle", critical_angle, dimensions=(0, 1)).ravel()
    periods = samples("period", period, dimensions=(0, 1)).ravel()
    gravity = number("gravity", gravity, "a positive acceleration in m/s²", above=0.0)
    plane_model_of(model)
    blocks = [rectangular(alpha, one, gravity) for alpha in angles.tolist() for one in periods.tolist()]
    expect_usable(max(blocks, key=lambda block: block.p), motion)
    # The kernels are decorated on import.
    from colonnade.dynamics.plane.sides import sides_of

    sides = [sides_of(block, restitution) for block in blocks]
    peak = ends_of(motion, sides, gravity=gravity, model=model)[1].reshape(angles.size, periods.size)
    return RockingSpectrum(angles, periods, peak, np.isnan(peak), model)


def rectangular(critical_angle: float, period: float, gravity: float = STANDARD_GRAVITY) -> Block:
    """
    Build a rectangular block by its α (rad) and 2π/p (s); its mass is 1 kg.

    Raises
    ------
    ValueError
        If one of them is out of its range.
    """
    period = number("period", period, "a positive number of seconds", above=0.0)
    distance = 0.75 * gravity / (2 * pi / period) ** 2
    side = Side(critical_angle, distance, 4 / 3 * distance**2)
    return Block(1.0, gravity, side, side)


def response_spectrum(
    acceleration: ArrayLike, interval: float, period: ArrayLike, *, damping: float = DAMPING
) -> Array:
    """
    Compute the response spectrum of a base acceleration.

    Parameters
    ----------
    acceleration : array_like, shape (m,)
        Of the base, m/s², linear between its samples; it starts from zero within one interval before the first.
    interval : float
        s.
    period : array_like, shape (n,)
        Of the undamped oscillators, s, positive.
    damping : float, optional
        Fraction of critical damping, from 0 to less than 1.

    Returns
    -------
    pseudo_acceleration : ndarray, shape (n,)
        ω² times the largest displacement |u| relative to the base, m/s².

    Notes
    -----
    u'' + 2ζω u' + ω² u = −a has, for a linear between two samples, a closed form that is linear in state and samples
    (Nigam and Jennings 1969). u alone follows a recursion of second order, which is run as a digital filter. For short
    periods the motion is given further samples on its own lines, which changes nothing but where u is looked at.

    Examples
    --------
    >>> response_spectrum(np.ones(2000), 0.01, [0.5], damping=0.0).round(2).tolist()
    [2.0]
    """
    periods = np.asarray(period, dtype=np.float64)
    from_zero = np.concatenate(([0.0], acceleration))
    largest = np.empty_like(periods)
    for index, each in enumerate(periods):
        parts = max(ceil(FEWEST_PER_PERIOD * interval / each), 1)
        # Further samples on the motion's own lines.
        fine = np.arange((from_zero.size - 1) * parts + 1) / parts
        finer = np.interp(fine, np.arange(from_zero.size), from_zero)
        response = scipy.signal.lfilter(*_recursion(2 * pi / each, damping, interval / parts), finer)
        largest[index] = np.abs(response).max(initial=0.0)
    return np.asarray((2 * pi / periods) ** 2 * largest)


def _recursion(omega: float, damping: float, step: float) -> tuple[Array, Array]:
    """Coefficients of u over a, as a filter of second order: exact for a that is linear over each step."""
    system = np.array([[0.0, 1.0], [-(omega**2), -2 * damping * omega]])
    continuous = system, np.array([[0.0], [-1.0]]), np.array([[1.0, 0.0]]), np.zeros((1, 1))
    numerator, denominator = scipy.signal.ss2tf(*scipy.signal.cont2discrete(continuous, step, method="foh")[:4])
    return numerator[0], denominator
