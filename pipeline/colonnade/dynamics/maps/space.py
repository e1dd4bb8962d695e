"""Runs of a stability map by the contact model: a sampled sine, and how the body overturns in space."""

from __future__ import annotations

from dataclasses import dataclass
from math import ceil, pi
from typing import Any

import numpy as np
from numpy.typing import NDArray

from colonnade.arrays import Array
from colonnade.dynamics.contact.body import ContactBody
from colonnade.dynamics.contact.law import ContactLaw
from colonnade.dynamics.contact.simulate import simulate
from colonnade.dynamics.motion import Motion
from colonnade.dynamics.plane.harmonic.motion import OUTCOMES, Harmonic

SAMPLES_A_CYCLE = 100
"""Samples of a sine for models without harmonic kernels, linear between them: error at most 5e-4 of its amplitude."""


@dataclass(frozen=True)
class InSpace:
    """
    What the contact model needs in addition to the plan of a map.

    Attributes
    ----------
    body : ContactBody
    law : ContactLaw
    step : float
        s.
    """

    body: ContactBody
    law: ContactLaw
    step: float

    @property
    def options(self) -> dict[str, Any]:
        """What the result depends on, by name."""
        return {
            "body": self.body.description,
            "contact_stiffness": self.law.node_stiffness(self.body).sum() / self.body.node_area.sum(),
            "damping_fraction": self.law.damping_fraction,
            "effective_damping": self.law.effective_damping(self.body),
            "friction": self.law.friction,
            "contact_step": self.step,
            "samples_a_cycle": SAMPLES_A_CYCLE,
        }


def outcomes(space: InSpace, unit: Array, dt: float, amplitudes: Array, gravity: float) -> NDArray[np.int8]:
    """
    Run a base motion at several amplitudes.

    Parameters
    ----------
    space : InSpace
    unit : ndarray, shape (n,)
        Base acceleration for A = 1, m/s².
    dt : float
        s.
    amplitudes : ndarray, shape (m,)
        A.
    gravity : float
        m/s².

    Returns
    -------
    codes : ndarray of int8, shape (m,)
        Index into `OUTCOMES`.
    """
    found = [
        simulate(space.body, Motion(unit * amplitude, dt), law=space.law, gravity=gravity, step=space.step).outcome
        for amplitude in amplitudes
    ]
    return np.array([OUTCOMES.index(outcome) for outcome in found], dtype=np.int8)


def sampled(harmonic: Harmonic) -> tuple[Array, float]:
    """Sample a sine of unit amplitude with its rise and fall, shape (n,), and give its sampling interval, s."""
    period = 2 * pi / harmonic.omega
    rise, full, end = harmonic.edges
    count = max(ceil(end / period * SAMPLES_A_CYCLE), 1)
    dt = end / count
    time = dt * np.arange(count + 1)
    share = np.ones_like(time)
    if rise > 0.0:
        share = np.minimum(share, time / rise)
    if end > full:
        share = np.minimum(share, (end - time) / (end - full))
    return np.append(share * np.sin(harmonic.omega * time + harmonic.phase), 0.0), dt
