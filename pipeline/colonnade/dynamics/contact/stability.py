"""The longest step of the contact engine, and the fastest motion that sets it."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from colonnade.arrays import Array
from colonnade.dynamics.contact.body import ContactBody
from colonnade.dynamics.contact.engine.kick import PASSES
from colonnade.dynamics.contact.law import ContactLaw

AROUND = 4
"""Equal points that have the second moments of a ring."""


def highest_frequency(body: ContactBody, law: ContactLaw) -> float:
    """
    Compute the highest angular frequency of a body all of whose nodes stick to the table, rad/s.

    Parameters
    ----------
    body : ContactBody
    law : ContactLaw

    Returns
    -------
    frequency : float
        Fewer nodes in contact, or sliding ones, cannot have a higher one.
    """
    nodes, shares, owner = _spread(body)
    shapes = _mass_normalised(body, nodes, owner)
    normal = shares * law.node_stiffness(body)[owner]
    stiffness = normal[:, None] * np.array([law.tangential_ratio, law.tangential_ratio, 1.0])
    weighted = np.sqrt(stiffness)[:, :, None] * shapes
    flat = weighted.reshape(-1, shapes.shape[2])
    matrix = flat.T @ flat
    matrix[range(6, len(matrix)), range(6, len(matrix))] += body.frequencies**2
    return float(np.sqrt(np.linalg.eigvalsh(matrix)[-1]))


def longest_step(body: ContactBody, law: ContactLaw) -> float:
    """
    Compute the longest stable step of the engine, s.

    Parameters
    ----------
    body : ContactBody
    law : ContactLaw

    Returns
    -------
    step : float
        At which the fastest motion, damped as the contact damps it, would begin to grow.

    Notes
    -----
    From the spectral radius of the very step that the engine takes, for one mass of frequency ω and damping fraction
    ζ = ω c / 2 k (the largest c/k of a node): about 2/ω without damping, and less with it.
    """
    frequency = highest_frequency(body, law)
    damping = 0.5 * frequency * float((law.node_damping(body) / law.node_stiffness(body)).max())
    damping *= max(1.0, law.tangential_damping / law.tangential_ratio)
    low, high = 0.0, 2.0
    for _ in range(40):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if _grows_not(middle, damping) else (low, middle)
    return low / frequency


def _grows_not(step: float, damping: float) -> bool:
    """Whether one step of the scheme, in 1/ω, keeps a damped oscillation from growing."""
    half = np.array([[1.0, 0.5 * step], [0.0, 1.0]])
    before = np.array([0.0, 1.0])
    change = np.zeros(2)
    for _ in range(PASSES):
        change = -step * (np.array([1.0, 0.0]) + 2.0 * damping * (before + 0.5 * change))
    kick = np.eye(2)
    kick[1] += change
    return bool(np.abs(np.linalg.eigvals(half @ kick @ half)).max() <= 1.0 + 1e-9)


def _spread(body: ContactBody) -> tuple[Array, Array, NDArray[np.intp]]:
    """Put points of the same moments in the place of each ring: points (k, 3), share of their node, which that is."""
    whole = body.ring_radii > 0.0
    count = np.where(whole, AROUND, 1)
    owner = np.repeat(np.arange(len(count)), count)
    turned = np.concatenate([2.0 * np.pi * np.arange(each) / each for each in count])
    nodes, radii = body.nodes[owner], body.ring_radii[owner]
    ring = np.column_stack((radii * np.cos(turned), radii * np.sin(turned), nodes[:, 2]))
    return np.where(whole[owner][:, None], ring, nodes), 1.0 / count[owner], owner


def _mass_normalised(body: ContactBody, nodes: Array, owner: NDArray[np.intp]) -> Array:
    """Displacements of the points in the rigid and elastic modes of unit modal mass, shape (k, 3, 6 + m)."""
    shapes = np.zeros((len(nodes), 3, 6 + body.frequencies.size))
    for axis in range(3):
        shapes[:, axis, axis] = 1.0 / np.sqrt(body.mass)
        about = np.zeros(3)
        about[axis] = 1.0 / np.sqrt(body.inertia[axis])
        shapes[:, :, 3 + axis] = np.cross(about, nodes)
    shapes[:, :, 6:] = body.modes[owner]
    return shapes
