"""What criteria of practice ask of a motion: acceleration, velocity, and the level of its velocity spectrum."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from colonnade.arrays import Array
from colonnade.dynamics.spectra.response import response_spectrum

PERIODS = np.geomspace(0.1, 2.5, 60)
"""s, over which the velocity spectrum is taken as constant."""


class Demands(NamedTuple):
    """
    Of motions, in arrays of one shape; NaN if not known, as the velocity of a record that drifts.

    Attributes
    ----------
    acceleration, velocity : ndarray
        PGA in m/s², PGV in m/s.
    spectral_velocity : ndarray
        As of `spectral_velocity`, m/s.
    """

    acceleration: Array
    velocity: Array
    spectral_velocity: Array


def spectral_velocity(acceleration: ArrayLike, interval: float) -> float:
    """
    Return the level of the undamped velocity spectrum of a motion.

    Parameters
    ----------
    acceleration : array_like, shape (n,)
        m/s².
    interval : float
        s.

    Returns
    -------
    velocity : float
        Mean undamped pseudo-velocity over `PERIODS`, evenly in ln T, m/s; proportional to the motion.

    Raises
    ------
    ValueError
        As of `response_spectrum`.

    Notes
    -----
    Housner (1963) takes the undamped spectrum as constant and does not say over which periods a recorded one is to be
    averaged; these are those of his spectrum intensity.
    """
    spectrum = response_spectrum(acceleration, interval, PERIODS, damping=0.0)
    return float((2 * np.pi / spectrum.period * spectrum.displacement).mean())
