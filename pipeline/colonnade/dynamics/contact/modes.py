"""The modes of an elastic body that a run keeps: those slow enough for its step."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from colonnade.dynamics.block import STANDARD_GRAVITY
from colonnade.dynamics.contact.body import ContactBody
from colonnade.dynamics.contact.law import ContactLaw
from colonnade.dynamics.contact.stability import longest_step
from colonnade.dynamics.contact.structure import Structure

FOLLOWED = 0.25
"""Of the longest stable step of a mode: a step that is longer does not follow it, and the energy balance suffers."""


def keep_modes(body: ContactBody, highest_frequency: float) -> ContactBody:
    """
    Leave out the modes above a frequency.

    Parameters
    ----------
    body : ContactBody
        As reduced; its low modes stay as accurate as they are, the base becomes stiffer.
    highest_frequency : float
        rad/s; `keep_modes_for_step` finds the one that a step and a contact allow.

    Returns
    -------
    body : ContactBody
        The rigid body if no mode is as low.
    """
    kept = int(np.searchsorted(body.frequencies, highest_frequency, side="right"))
    if kept == body.frequencies.size:
        return body
    return replace(
        body,
        modes=body.modes[:, :, :kept],
        frequencies=body.frequencies[:kept],
        modal_damping=body.modal_damping[:kept],
        description=f"{body.description}, of which {kept} up to {highest_frequency:.4g} rad/s",
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

    Raises
    ------
    ValueError
        If the step is too long even for the rigid body; the message gives the one that is not.
    """
    longest = longest_with(body, law, 0.0)
    if step > longest:
        raise ValueError(
            f"The step is {step:.3g} s; even the rigid body on this contact needs one of at most {longest:.3g} s"
        )
    frequencies = np.append(0.0, body.frequencies)
    low, high = 0, body.frequencies.size + 1
    while high - low > 1:
        middle = (low + high) // 2
        allowed = longest_with(body, law, frequencies[middle]) >= step / FOLLOWED
        low, high = (middle, high) if allowed else (low, middle)
    return keep_modes(body, frequencies[low])


def longest_with(body: ContactBody, law: ContactLaw, highest_frequency: float) -> float:
    """Give the longest stable step of a body on a law, s, with its modes up to a frequency, rad/s."""
    return longest_step(Structure.of_body(keep_modes(body, highest_frequency), law, STANDARD_GRAVITY))
