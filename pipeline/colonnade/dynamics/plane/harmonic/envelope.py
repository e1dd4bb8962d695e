"""The level of a harmonic base motion over time: constant, or on a ramp that is linear or half a cosine."""

from __future__ import annotations

from math import cos, pi, sin

from colonnade.dynamics.kernel import kernel

Piece = tuple[float, float, float, float]
"""Level where a part begins, slope, swing and turn (rad/s): l(τ) = level + slope τ + swing cos(turn τ)."""


@kernel
def piece_between(begins: float, ends: float, duration: float, smooth: bool | None) -> Piece:
    """Envelope of a part between two levels; half a cosine with `smooth`, linear with None."""
    if smooth is None or begins == ends:
        return begins, (ends - begins) / duration, 0.0, 0.0
    return 0.5 * (begins + ends), 0.0, 0.5 * (begins - ends), pi / duration


@kernel
def level_at(piece: Piece, since: float) -> tuple[float, float]:
    """Level and its slope at a time since the part began."""
    level, slope, swing, turn = piece
    if swing == 0.0:
        return level + slope * since, slope
    return level + swing * cos(turn * since), -swing * turn * sin(turn * since)
