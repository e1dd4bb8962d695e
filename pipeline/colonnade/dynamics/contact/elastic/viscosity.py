"""Bulk viscosity: the damping of volume change that explicit finite-element codes add, and its equivalent a mode."""

from __future__ import annotations

import numpy as np

from colonnade.arrays import Array
from colonnade.dynamics.contact.elastic.assembly import ElasticBody

LINEAR_VISCOSITY = 0.06
"""b₁ of the pressure b₁ ρ c L ε̇ against the rate ε̇ of volume change: Abaqus/Explicit's default."""


def linear_coefficients(body: ElasticBody, linear: float = LINEAR_VISCOSITY) -> Array:
    """
    Give the pressure over the rate of volume change, b₁ ρ c L, of each brick.

    Parameters
    ----------
    body : ElasticBody
    linear : float, optional
        b₁.

    Returns
    -------
    coefficients : ndarray, shape (e,)
        Pa s. L is the brick's volume over its largest face and c the speed of dilatational waves.
    """
    material = body.material
    return linear * material.density * material.dilatational_speed * body.element_lengths


def modal_damping(body: ElasticBody, modes: Array, frequencies: Array, linear: float = LINEAR_VISCOSITY) -> Array:
    """
    Give each mode the damping that the linear bulk viscosity is to it.

    Parameters
    ----------
    body : ElasticBody
    modes : ndarray, shape (3n, m)
        Mass-normalised shapes, kg^-½.
    frequencies : ndarray, shape (m,)
        rad/s.
    linear : float, optional
        b₁.

    Returns
    -------
    damping : ndarray, shape (m,)
        Fraction of critical.

    Notes
    -----
    ζ = φᵀ C φ / 2ω with C = Σ_e V_e b₁ ρ c L_e d_e d_eᵀ, d_e the brick's mean divergence. For a mode of pure volume
    change it grows with the frequency, b₁ L ω / 2c; a mode of pure shear or torsion has none. What C couples between
    modes is left out. It is damping of the material and has a share of its own in the balance of energy, apart from
    that of the contact.
    """
    rates = body.volume_rate @ modes
    weights = body.volumes * linear_coefficients(body, linear)
    return np.asarray((weights @ rates**2) / (2 * frequencies))
