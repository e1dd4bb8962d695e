"""Forces between block and base along a rocking history, and where they break the model's assumptions."""

from __future__ import annotations

from dataclasses import dataclass
from math import pi

import numpy as np

from colonnade.arrays import Array
from colonnade.dynamics.history import History
from colonnade.dynamics.models import MODELS
from colonnade.dynamics.motion import Motion
from colonnade.validation import instance


@dataclass(frozen=True)
class Reactions:
    """
    Forces of the base on the block.

    Attributes
    ----------
    time : ndarray, shape (n,)
        s, of the history's samples.
    horizontal, vertical : ndarray, shape (n,)
        N, along +x and +z, between impacts; NaN where the block has overturned.
    required_friction : ndarray, shape (n,)
        |H|/N, dimensionless; inf where the vertical force does not press.
    impact_times, impact_friction : ndarray, shape (m,)
        s; ratio of the horizontal to the vertical impulse of each impact.

    Examples
    --------
    >>> import numpy as np
    >>> import colonnade
    >>> block = colonnade.Block.prism(width=0.086, depth=0.086, height=0.456, mass=26.10)
    >>> time = np.arange(200) * 0.01
    >>> motion = colonnade.Motion(3.0 * np.sin(4 * np.pi * time) * (time < 0.5), 0.01)
    >>> forces = colonnade.reactions(colonnade.rock(block, motion, restitution=0.9), motion)
    >>> float(forces.required_friction[1].round(4)), round(float(forces.vertical[0]), 2)
    (0.0383, 256.04)
    """

    time: Array
    horizontal: Array
    vertical: Array
    required_friction: Array
    impact_times: Array
    impact_friction: Array


def reactions(history: History, motion: Motion) -> Reactions:
    """
    Compute the forces of the base on a block that rocks or rests.

    Parameters
    ----------
    history : History
    motion : Motion
        The base motion that it is the answer to.

    Returns
    -------
    reactions : Reactions

    Raises
    ------
    ValueError
        If the motion has not as many samples as the history.

    Notes
    -----
    The centre of mass turns about the pole at distance R. With ψ = α sgn θ − θ it lies −R sin ψ along x and R cos ψ
    above the pole, so that H = m [a + R (θ̈ cos ψ + θ̇² sin ψ)] and N = m [g + v + R (θ̈ sin ψ − θ̇² cos ψ)], θ̈ from the
    model's own equation. An impact takes the horizontal velocity from R cos α ω to e times that and turns the vertical
    one round: for a symmetric block its impulses are as (1 − e) : (1 + e) tan α.

    Examples
    --------
    >>> from colonnade.dynamics.block import Block
    >>> from colonnade.dynamics.rock import rock
    >>> block = Block.prism(width=0.086, depth=0.086, height=0.456, mass=26.10)
    >>> motion = Motion([0.0, 1.0], 0.01)
    >>> reactions(rock(block, motion), motion).horizontal.round(2).tolist()
    [0.0, 26.1]
    """
    instance("history", history, History)
    instance("motion", motion, Motion)
    if motion.acceleration.size != history.time.size:
        raise ValueError(
            f"The motion has {motion.acceleration.size} samples and the history {history.time.size}; "
            "the motion that the history was computed from was expected"
        )
    block, angle, velocity = history.block, history.angle, history.angular_velocity
    rests = (angle == 0.0) & (velocity == 0.0)
    side = np.where(angle == 0.0, velocity, angle)
    distance = np.where(side < 0.0, *(each.pole_distance for each in block.sides))
    square = block.p_at(side) ** 2
    lean = np.where(side < 0.0, -1.0, 1.0) * block.critical_angle_at(side) - angle
    weight = block.gravity + (0.0 if motion.vertical is None else motion.vertical)
    pull, lift = motion.acceleration / block.gravity, weight / block.gravity
    if MODELS[history.model].is_linearised:
        turning = -square * (lift * lean + pull)
    else:
        turning = -square * (lift * np.sin(lean) + pull * np.cos(lean))
    turning = np.where(rests, 0.0, turning)
    # The beam of a frame turns at twice the distance.
    distance = distance * (1 + 2 * block.beam_ratio) / (1 + block.beam_ratio)
    along = motion.acceleration + distance * (turning * np.cos(lean) + velocity**2 * np.sin(lean))
    above = weight + distance * (turning * np.sin(lean) - velocity**2 * np.cos(lean))
    lies = np.abs(angle) >= 0.5 * pi
    horizontal = np.where(lies, np.nan, block.mass * along)
    vertical = np.where(lies, np.nan, block.mass * above)
    with np.errstate(divide="ignore", invalid="ignore"):
        required = np.where(vertical <= 0.0, np.inf, np.abs(horizontal) / vertical)
    # The velocities of the centre of mass before and after each impact.
    before, after = history.impact_velocities, history.rebound_velocities
    height = [side.pole_distance * np.cos(side.critical_angle) for side in block.sides]
    half_width = [side.half_width for side in block.sides]
    arriving = before > 0.0
    level = np.where(arriving, *height[::-1]) * after - np.where(arriving, *height) * before
    turned = np.where(arriving, *half_width[::-1]) * np.abs(after) + np.where(arriving, *half_width) * np.abs(before)
    return Reactions(history.time, horizontal, vertical, required, history.impact_times, np.abs(level) / turned)
