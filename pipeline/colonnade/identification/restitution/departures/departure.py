"""A departure from the plane model: its name, its size, and its consequences."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Departure:
    """
    A way in which a free vibration is not plane rocking of a rigid block with one e.

    Attributes
    ----------
    name : str
        "three-dimensional rocking", "sliding", "bouncing", "unequal restitution", "unequal sides", "zero drift",
        "speed-dependent restitution" or "moving table".
    size, standard_error : float
        In `unit`; the sentence says what is measured.
    unit : str
        SI; "1" where it has none.
    sentence : str
        The finding for people: size with its error, and what was left out because of it.
    left_out : int
        Number of the first arcs that the departure spoils: they are not to enter an estimate of e.
    refuses : bool
        Whether too little is left for an e of the plane model.
    """

    name: str
    size: float
    standard_error: float
    unit: str
    sentence: str
    left_out: int = 0
    refuses: bool = False
