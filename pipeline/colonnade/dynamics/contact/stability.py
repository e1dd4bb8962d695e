"""The longest step of the contact engine, and the fastest motion that sets it."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from colonnade.arrays import Array
from colonnade.dynamics.contact.kick import PASSES
from colonnade.dynamics.contact.structure import Interface, Structure

AROUND = 4
"""Equal points that have the second moments of a ring."""


def highest_frequency(structure: Structure) -> float:
    """
    Compute the highest angular frequency of bodies all of whose nodes stick to what they meet, rad/s.

    Fewer nodes in contact, or sliding ones, cannot have a higher one.
    """
    bodies, frequencies = structure.bodies, structure.bodies[0].frequencies
    matrix = np.diag(np.concatenate((np.zeros(6 * len(bodies)), frequencies**2)))
    for side in structure.interfaces:
        places, stiffness, owner = _points(side)
        shapes = np.zeros((len(places), 3, len(matrix)))
        # What a point moves relative to the target: with the carrier, and against it with the target.
        _add_rigid(shapes, bodies[side.carrier].mass, bodies[side.carrier].inertia, side.carrier, places, 1.0)
        if frequencies.size:
            shapes[:, :, 6:] = bodies[0].modes[owner]
        if side.target >= 0:
            _add_rigid(
                shapes, bodies[side.target].mass, bodies[side.target].inertia, side.target, places + side.apart, -1.0
            )
        weighted = np.sqrt(stiffness)[:, :, None] * shapes
        flat = weighted.reshape(-1, len(matrix))
        matrix += flat.T @ flat
    return float(np.sqrt(np.linalg.eigvalsh(matrix)[-1]))


def longest_step(structure: Structure) -> float:
    """
    Compute the longest stable step of the engine, s, at which the fastest motion of all would begin to grow.

    Notes
    -----
    From the spectral radius of the very step that the engine takes, for one mass of frequency ω and damping fraction
    ζ = ω c / 2 k (the largest c/k of a node): about 2/ω without damping, and less with it.
    """
    frequency, damping = highest_frequency(structure), 0.0
    for side in structure.interfaces:
        law = side.law
        ratio = max(1.0, law.tangential_damping / law.tangential_ratio)
        slowness = law.node_damping(side) / law.node_stiffness(side)
        damping = max(damping, 0.5 * frequency * ratio * float(slowness.max(initial=0.0)))
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


def _points(side: Interface) -> tuple[Array, Array, NDArray[np.int64]]:
    """Give an interface's points, with several of the same moments for each ring; their stiffness; whose they are."""
    whole = side.ring_radii > 0.0
    count = np.where(whole, AROUND, 1)
    owner = np.repeat(np.arange(len(count), dtype=np.int64), count)
    turned = np.concatenate([2.0 * np.pi * np.arange(each) / each for each in count] or [np.zeros(0)])
    radii = side.ring_radii[owner]
    ring = np.column_stack((radii * np.cos(turned), radii * np.sin(turned), side.nodes[owner, 2]))
    places = np.where(whole[owner][:, None], ring, side.nodes[owner])
    normal = side.law.node_stiffness(side)[owner] / count[owner]
    return places, normal[:, None] * np.array([side.law.tangential_ratio, side.law.tangential_ratio, 1.0]), owner


def _add_rigid(shapes: Array, mass: float, inertia: Array, body: int, places: Array, sign: float) -> None:
    """Add the displacements of places in the rigid motions of unit modal mass of a body."""
    for axis in range(3):
        about = np.zeros(3)
        about[axis] = 1.0 / np.sqrt(inertia[axis])
        shapes[:, axis, 6 * body + axis] += sign / np.sqrt(mass)
        shapes[:, :, 6 * body + 3 + axis] += sign * np.cross(about, places)
