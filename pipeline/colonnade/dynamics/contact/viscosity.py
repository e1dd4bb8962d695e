"""Bulk viscosity: the damping of volume change that explicit finite-element codes add, and its equivalent a mode."""

from __future__ import annotations

from dataclasses import dataclass
from math import hypot

import numpy as np
from numpy.typing import NDArray

from colonnade.dynamics.contact.assembly import ElasticBody

Array = NDArray[np.float64]


@dataclass(frozen=True)
class BulkViscosity:
    """
    A pressure against the rate ε̇ of volume change, p = b₁ ρ c L ε̇ + ρ (b₂ L)² |ε̇| min(0, ε̇), positive in tension.

    Attributes
    ----------
    linear : float
        b₁. Abaqus/Explicit's default is 0.06.
    quadratic : float
        b₂, in compression only. Abaqus/Explicit's default is 1.2.

    Notes
    -----
    L is the brick's volume over its largest face and c the speed of dilatational waves. It is damping of the
    material and has a share of its own in the balance of energy, apart from that of the contact.
    """

    linear: float = 0.06
    quadratic: float = 1.2

    def __post_init__(self) -> None:
        if self.linear < 0.0 or self.quadratic < 0.0:
            raise ValueError(
                f"The bulk viscosities are {self.linear} and {self.quadratic}; numbers from 0 on were expected"
            )


NO_VISCOSITY = BulkViscosity(0.0, 0.0)


def linear_coefficients(body: ElasticBody, viscosity: BulkViscosity) -> Array:
    """
    Give the linear part's pressure over rate, b₁ ρ c L, of each brick.

    Returns
    -------
    coefficients : ndarray, shape (e,)
        Pa s.
    """
    material = body.material
    return viscosity.linear * material.density * material.dilatational_speed * body.element_lengths


def quadratic_coefficients(body: ElasticBody, viscosity: BulkViscosity) -> Array:
    """
    Give the quadratic part's pressure over rate squared, ρ (b₂ L)², of each brick.

    Returns
    -------
    coefficients : ndarray, shape (e,)
        Pa s².
    """
    return np.asarray(body.material.density * (viscosity.quadratic * body.element_lengths) ** 2)


def modal_damping(body: ElasticBody, modes: Array, frequencies: Array, viscosity: BulkViscosity) -> Array:
    """
    Give each mode the damping that the linear bulk viscosity is to it.

    Parameters
    ----------
    body : ElasticBody
    modes : ndarray, shape (3n, m)
        Mass-normalised shapes, kg^-½.
    frequencies : ndarray, shape (m,)
        rad/s.
    viscosity : BulkViscosity

    Returns
    -------
    damping : ndarray, shape (m,)
        Fraction of critical.

    Notes
    -----
    ζ = φᵀ C φ / 2ω with C = Σ_e V_e b₁ ρ c L_e d_e d_eᵀ, d_e the brick's mean divergence. For a mode of pure volume
    change it grows with the frequency, b₁ L ω / 2c; a mode of pure shear or torsion has none. What C couples between
    modes is left out, and so is the quadratic part, which is far below the linear one at the strains of rocking.
    """
    rates = body.volume_rate @ modes
    weights = body.volumes * linear_coefficients(body, viscosity)
    return np.asarray((weights @ rates**2) / (2 * frequencies))


def stable_step(highest_frequency: float, damping: float = 0.0) -> float:
    """
    Give the largest stable step of central differences with lagged damping, 2 (sqrt(1 + ζ²) − ζ) / ω.

    Parameters
    ----------
    highest_frequency : float
        ω, rad/s.
    damping : float, optional
        ζ of that mode, fraction of critical.

    Returns
    -------
    step : float
        s.

    Examples
    --------
    >>> round(stable_step(1e6, 0.06) * 1e6, 3)
    1.884
    """
    return 2 * (hypot(1.0, damping) - damping) / highest_frequency
