"""One call for every model: block, base motion and restitution in, rocking history out."""

from __future__ import annotations

from importlib import import_module
from math import ceil

import numpy as np

from colonnade.dynamics.block import Block, Sided, pair
from colonnade.dynamics.history import History
from colonnade.dynamics.motion import Motion
from colonnade.errors import nearest

MODELS = ("linear", "nonlinear")
"""Models that `rock` can run."""

DEFAULT_REST_ANGLE = 1e-6
"""Fraction of α below which an arc after an impact is taken as rest."""


def rock(
    block: Block,
    motion: Motion | None = None,
    *,
    restitution: Sided | None = None,
    model: str = "linear",
    theta0: float = 0.0,
    omega0: float = 0.0,
    duration: float | None = None,
    rest_angle: float = DEFAULT_REST_ANGLE,
) -> History:
    """
    Compute how a block rocks.

    Parameters
    ----------
    block : Block
    motion : Motion, optional
        Base motion; without it the block rocks freely for `duration`.
    restitution : float or pair of float, optional
        e, between 0 and 1; a pair is for impacts that end an arc at (θ < 0, θ > 0). Default: the rigid-body value.
    model : {"linear", "nonlinear"}
        The linear equation, solved exactly for a base motion that is linear between samples; or the full one, by Taylor
        series to rounding.
    theta0, omega0 : float, optional
        Initial angle (rad) and angular velocity (rad/s), positive when the top moves to +x.
    duration : float, optional
        s, only without a motion. The history is then sampled at about 1/(500 p).
    rest_angle : float, optional
        Fraction of α. After an impact whose next arc, under the base acceleration of that instant, would not rise above
        it, the block is at rest until it is uplifted again.

    Returns
    -------
    history : History
        At the motion's samples.

    Raises
    ------
    ValueError
        If an argument is out of its range or the model is not known.

    Examples
    --------
    >>> block = Block.prism(width=0.086, depth=0.086, height=0.456, mass=26.10)
    >>> rock(block, restitution=0.976, theta0=0.5 * block.critical_angle, duration=5.0).outcome
    'rocking'
    """
    if model not in MODELS:
        raise ValueError(f'There is no model "{model}".{nearest(model, MODELS)}')
    motion = _free(block, duration) if motion is None else motion
    e = pair(block.restitution if restitution is None else restitution)
    _check(block, motion, e, theta0, omega0, rest_angle)

    # The engine is compiled on import: only the one that is asked for.
    engine = import_module(f"colonnade.dynamics.{model}")
    sides = (block.negative, block.positive)
    angle, velocity, impact_times, impact_velocities, overturning_time = engine.propagate(
        motion.acceleration / block.gravity,
        motion.dt,
        np.array([side.critical_angle for side in sides]),
        np.array([block.side_p(side) for side in sides]),
        np.array(e),
        rest_angle,
        float(theta0),
        float(omega0),
    )
    return History(block, motion.time, angle, velocity, impact_times, impact_velocities, overturning_time)


def _free(block: Block, duration: float | None) -> Motion:
    if duration is None or not (np.isfinite(duration) and duration > 0):
        raise ValueError(f"duration is {duration}; without a motion a positive duration in seconds is needed")
    samples = max(ceil(duration * block.p * 500), 2)
    return Motion(np.zeros(samples + 1), duration / samples)


def _check(
    block: Block, motion: Motion, restitution: tuple[float, float], theta0: float, omega0: float, rest_angle: float
) -> None:
    for value in restitution:
        if not 0.0 <= value <= 1.0:
            raise ValueError(f"restitution is {value}; a number between 0 and 1 was expected")
    for name, value in (("theta0", theta0), ("omega0", omega0)):
        if not np.isfinite(value):
            raise ValueError(f"{name} is {value}; a finite number was expected")
    if not 0.0 < rest_angle < 1.0:
        raise ValueError(f"rest_angle is {rest_angle}; a fraction of the critical angle between 0 and 1 was expected")
    if motion.vertical is not None or motion.transverse is not None:
        raise ValueError(
            "The plane models take motion along x only; a Motion without `vertical` and `transverse` was expected"
        )
