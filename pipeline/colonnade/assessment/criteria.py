"""
Criteria of practice for rocking and overturning by their ids: a new one is its entry here.

Formulas are those by which the papers are cited. Of Housner (1963) and Ishiyama (1982) summaries were read; both
formulas are held to their derivations by tests: the energy that a sudden velocity gives the block against the energy
that overturns it.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from math import cos, sqrt
from typing import Literal, NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from colonnade.arrays import Array, Mask
from colonnade.dynamics.block import Block
from colonnade.dynamics.spectra import response_spectrum

PERIODS = np.geomspace(0.1, 2.5, 60)
"""s, over which the velocity spectrum is taken as constant."""

ISHIYAMA_FACTOR = 0.4
"""Of the velocity that overturns at once, the least velocity of sines and earthquakes that overturned."""


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


@dataclass(frozen=True)
class Criterion:
    """
    A criterion.

    Attributes
    ----------
    id, name, source, formula : str
    predicts : {"rocking", "overturning"}
    remarks : str
        For which blocks and motions it was made, and what is known against it.
    ratio : callable
        Demand over capacity of a block, of demands; the criterion predicts it above 1. NaN if a demand is not known.
    """

    id: str
    name: str
    source: str
    formula: str
    predicts: Literal["rocking", "overturning"]
    remarks: str
    ratio: Callable[[Block, Demands], Array]


def sudden_velocity(block: Block) -> float:
    """
    Return the velocity of the base that overturns a block at rest if it comes at once, m/s.

    Notes
    -----
    A base that starts with v gives the block the angular velocity (m R cos α / I₀) v; it overturns if the energy
    reaches m g R (1 − cos α): v = g √(2 (1 − cos α)) / (p cos α) (Mallet 1862, for columns). For a rectangle this is
    √(8 g R (1 − cos α) / 3) / cos α.
    """
    return block.gravity * sqrt(2 * (1 - cos(block.critical_angle))) / (block.p * cos(block.critical_angle))


def _west(block: Block, demands: Demands) -> Array:
    return demands.acceleration / block.uplift_acceleration


def _ishiyama(block: Block, demands: Demands) -> Array:
    """Both have to be exceeded."""
    velocity = demands.velocity / (ISHIYAMA_FACTOR * sudden_velocity(block))
    return np.minimum(_west(block, demands), velocity)


def _housner(block: Block, demands: Demands) -> Array:
    return block.p * demands.spectral_velocity / (block.gravity * block.critical_angle)


CRITERIA = (
    Criterion(
        "west",
        "West",
        "C. D. West, in Milne (1885), Transactions of the Seismological Society of Japan 8; Kirkpatrick (1927), "
        "Bulletin of the Seismological Society of America 17, 95–109",
        "PGA > g tan α",
        "rocking",
        "Rigid block on a rigid base that does not slide, without vertical motion: the start of rocking is then exact. "
        "Long used as a limit of overturning, which it is not: large blocks stand far beyond it. Vertical motion "
        "changes the limit from instant to instant.",
        _west,
    ),
    Criterion(
        "ishiyama",
        "Ishiyama",
        "Ishiyama (1982), Earthquake Engineering and Structural Dynamics 10, 635–650; (1984), 8th World Conference",
        f"PGA > g tan α and PGV > {ISHIYAMA_FACTOR} √(8 g R (1 − cos α) / 3) / cos α for a rectangle, about 10 B/√H in "
        "cm and cm/s; any block with its own p",
        "overturning",
        "Lower limits of the acceleration and of the velocity of sines and recorded earthquakes that overturned "
        "rectangles, in simulations and on a shake table. "
        "Many motions above both do not overturn, so that it errs to overturning.",
        _ishiyama,
    ),
    Criterion(
        "housner",
        "Housner, nominal 50 %",
        "Housner (1963), Bulletin of the Seismological Society of America 53, 403–417",
        "S_v > α √(g I₀ / (M R)) = g α / p, S_v the level of the undamped velocity spectrum",
        "overturning",
        "Slender blocks (α below about 0.35 rad); motions like white noise, with a constant velocity spectrum. "
        "Equates the energy that an average spectrum gives an undamped oscillator with the one that overturns. A "
        "rocking block is not an oscillator, and impacts take energy: other shares than 50 % of simulated blocks "
        "overturn (Yim, Chopra and Penzien 1980), and a response spectrum does not replace a rocking spectrum "
        "(Makris and Konstantinidis 2003).",
        _housner,
    ),
)
"""In the order of pages."""


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

    Notes
    -----
    Housner (1963) takes the undamped spectrum as constant and does not say over which periods a recorded one is to be
    averaged; these are those of his spectrum intensity.
    """
    spectrum = response_spectrum(acceleration, interval, PERIODS, damping=0.0)
    return float((PERIODS / (2 * np.pi) * spectrum).mean())


def agreement(ratio: Array, happened: Mask) -> dict[str, int]:
    """
    Count how often a criterion agrees with what is computed.

    Parameters
    ----------
    ratio : ndarray, shape (n,)
        Demand over capacity of each motion (`Criterion.ratio`); NaN if a demand is not known.
    happened : ndarray of bool, shape (n,)
        Whether the block rocked or overturned, whichever the criterion predicts.

    Returns
    -------
    counts : dict of str to int
        Motions by what became of the prediction, under the names of `JudgedCriterion`.

    Examples
    --------
    >>> agreement(np.array([0.5, 2.0, 3.0]), np.array([False, False, True]))
    {'right_overturned': 1, 'right_stands': 1, 'false_alarms': 1, 'missed': 0, 'unknown': 0}
    """
    known, predicted = ~np.isnan(ratio), ratio > 1.0
    counted = {
        "right_overturned": predicted & happened,
        "right_stands": known & ~predicted & ~happened,
        "false_alarms": predicted & ~happened,
        "missed": known & ~predicted & happened,
        "unknown": ~known,
    }
    return {name: int(each.sum()) for name, each in counted.items()}
