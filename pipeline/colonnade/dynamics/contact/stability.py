"""The longest step of the contact engine, and the motions on its contact that set it."""

from __future__ import annotations

from bisect import bisect_left
from dataclasses import replace

import numpy as np
import scipy

from colonnade.dynamics.block import STANDARD_GRAVITY
from colonnade.dynamics.contact.body import ContactBody, ContactLaw
from colonnade.dynamics.contact.kick import PASSES
from colonnade.dynamics.contact.state import TABLE
from colonnade.dynamics.contact.structure import Structure

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
        around = AROUND if side.at.ring_radii.any() else 1
        places = side.at.around(around).reshape(-1, 3)
        # What each point moves relative to the target: with the carrier, and against it with the target.
        shapes = np.zeros((len(places), 3, len(matrix)))
        for body, arms, sign in ((side.carrier, places, 1.0), (side.target, places + side.apart, -1.0)):
            if body != TABLE:
                mass, inertia, first = bodies[body].mass, bodies[body].inertia, 6 * body
                turned = np.cross(np.eye(3), arms[:, None]).swapaxes(1, 2)
                shapes[:, :, first : first + 3] = sign * np.eye(3) / np.sqrt(mass)
                shapes[:, :, first + 3 : first + 6] = sign * turned / np.sqrt(inertia)
        if frequencies.size:
            shapes[:, :, 6:] = np.repeat(bodies[0].modes, around, axis=0)
        weights = np.sqrt(np.repeat(side.law.node_stiffness(side.at) / around, around))
        flat = (weights[:, None, None] * shapes).reshape(-1, len(matrix))
        matrix += flat.T @ flat
    return float(np.sqrt(np.linalg.eigvalsh(matrix)[-1]))


def longest_step(structure: Structure) -> float:
    """
    Compute the longest stable step of the engine, s, at which the fastest motion of all would begin to grow.

    Of one mass of frequency ω and damping fraction ζ = ω c / 2 k (the largest c/k of a node), by the very step that the
    engine takes, of h/ω: its kick is −h q (x + 2 ζ v) with q = Σ (−ζ h)ᵏ over the passes, so that its matrix has the
    determinant 1 − 2 ζ h q and the trace 2 − 2 ζ h q − h² q. Nothing grows up to h q (4 ζ + h) = 4: about 2/ω without
    damping, and less with it.
    """
    frequency, damping = highest_frequency(structure), 0.0
    for side in structure.interfaces:
        slowness = side.law.node_damping(side.at) / side.law.node_stiffness(side.at)
        damping = max(damping, 0.5 * frequency * float(slowness.max(initial=0.0)))

    def growth(step: float) -> float:
        passes = sum((-damping * step) ** turn for turn in range(PASSES))
        return step * passes * (4.0 * damping + step) - 4.0

    return float(scipy.optimize.brentq(growth, 0.0, 2.0)) / frequency


FOLLOWED = 0.25
"""Of the longest stable step of a mode: a step that is longer does not follow it, and the energy balance suffers."""


def keep_modes(body: ContactBody, count: int) -> ContactBody:
    """Leave out all but the lowest modes, which stay as accurate as they are; the base becomes stiffer."""
    if count == body.frequencies.size:
        return body
    kept = f"{count} up to {body.frequencies[count - 1]:.4g} rad/s" if count else "none"
    return replace(
        body,
        modes=body.modes[:, :, :count],
        frequencies=body.frequencies[:count],
        modal_damping=body.modal_damping[:count],
        description=f"{body.description}, of which {kept}",
    )


def keep_modes_for_step(body: ContactBody, law: ContactLaw, step: float) -> ContactBody:
    """
    Keep the lowest modes, as many as a step of the contact engine follows.

    Parameters
    ----------
    body : ContactBody
        As reduced.
    law : ContactLaw
        Its stiffness and damping shorten the step of fast modes.
    step : float
        s.

    Returns
    -------
    body : ContactBody
        With the modes that the step follows (`FOLLOWED`); the rigid body where it follows none.
    """

    def outruns(count: int) -> bool:
        """Whether the step is too long for so many modes."""
        return longest_step(Structure.of_body(keep_modes(body, count), law, STANDARD_GRAVITY)) < step / FOLLOWED

    return keep_modes(body, bisect_left(range(1, body.frequencies.size + 1), True, key=outruns))
