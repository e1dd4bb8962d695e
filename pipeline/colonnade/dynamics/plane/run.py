"""Runs of the plane models under a sampled base motion: a history, and how many blocks end."""

from __future__ import annotations

from collections.abc import Sequence
from math import pi
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from colonnade.arrays import Array, Codes
from colonnade.dynamics.block import Block
from colonnade.dynamics.history import NO_ROCKING_RATIO, History
from colonnade.dynamics.models import Model, plane_model_of
from colonnade.dynamics.motion import Motion
from colonnade.dynamics.restitution_law import Given, RestitutionLaw, law_of

if TYPE_CHECKING:
    from colonnade.dynamics.plane.march import Forcing
    from colonnade.dynamics.plane.sides import Sides

LARGEST_ACCELERATION = 1e6
"""In g; no table reaches more."""

LONGEST_SAMPLE = 300.0
"""In p dt; hyperbolic functions of more leave the range of floating-point numbers."""

OUTCOMES = ("no-rocking", "rocking", "overturned")
"""What the codes 0, 1 and 2 mean."""

STANDS, ROCKS, OVERTURNS = range(len(OUTCOMES))
"""Indices into `OUTCOMES`."""


def run(
    model: Model, block: Block, motion: Motion, restitution: Given, *, theta0: float, omega0: float, rest_angle: float
) -> History:
    """
    Run a plane model; arguments as of `rock`.

    Raises
    ------
    ValueError
        If e is not between 0 and 1, or the motion is not usable.
    """
    # The kernels are decorated on import.
    from colonnade.dynamics.plane.march import propagate
    from colonnade.dynamics.plane.sides import sides_of

    law = law_of(block, restitution)
    expect_usable(block, motion)
    forcing = forcing_of(motion, block.gravity)
    while True:
        sides = sides_of(block, law, rest_angle)
        angle, velocity, times, before, end = propagate(
            forcing, sides, is_linearised=model.is_linearised, angle=theta0, velocity=omega0
        )
        wider = law.reaching(before) if isinstance(law, RestitutionLaw) else law
        if wider is law:
            break
        law = wider
    e = law(np.abs(before)) if isinstance(law, RestitutionLaw) else np.where(before > 0.0, *law)
    return History(block, motion.time, angle, velocity, times, before, e * before, end.time, model.name)


def forcing_of(motion: Motion, gravity: float) -> Forcing:
    """Put a base motion along x and, if given, z into the form that the kernels take; gravity in m/s²."""
    from colonnade.dynamics.plane.march import NONE, Forcing

    weights = NONE if motion.vertical is None else 1.0 + motion.vertical / gravity
    return Forcing(0.0, 0.5 * pi, motion.dt, NONE, motion.acceleration / gravity, weights)


def expect_usable(block: Block, motion: Motion) -> None:
    """
    Refuse a motion that the plane models cannot run.

    Raises
    ------
    ValueError
        If it is stronger or its samples are longer than they solve, it has a transverse component, or the base falls
        faster than the block.
    """
    fastest = max(block.side_p(block.negative), block.side_p(block.positive))
    if not motion.peak <= LARGEST_ACCELERATION * block.gravity:
        raise ValueError(
            f"The acceleration is {motion.peak:.4g} m/s² at sample {int(np.abs(motion.acceleration).argmax())}; "
            f"at most {LARGEST_ACCELERATION:g} g was expected. Check its unit."
        )
    if fastest * motion.dt > LONGEST_SAMPLE:
        raise ValueError(
            f"dt is {motion.dt} s, {fastest * motion.dt:.4g}/p; a sampling interval below {LONGEST_SAMPLE:g}/p "
            f"({LONGEST_SAMPLE / fastest:.4g} s) was expected"
        )
    if motion.transverse is not None:
        raise ValueError("The plane models take motion along x and z only; a Motion without `transverse` was expected")
    if motion.vertical is not None and not motion.vertical.min() > -block.gravity:
        raise ValueError(
            f"vertical is {motion.vertical.min():.6g} m/s² at sample {int(motion.vertical.argmin())}: the base falls "
            f"faster than the block; more than −{block.gravity:g} m/s² was expected"
        )


class Ends(NamedTuple):
    """
    How the histories of n blocks end.

    Attributes
    ----------
    outcome : ndarray of int8, shape (n,)
        Index into `OUTCOMES`.
    peak_ratio : ndarray, shape (n,)
        Largest |θ|/α at the samples; NaN if the block overturns.
    peak_velocity : ndarray, shape (n,)
        Largest |ω| at the samples up to overturning, rad/s.
    """

    outcome: Codes
    peak_ratio: Array
    peak_velocity: Array


def ends_of(motion: Motion, blocks: Sequence[Sides], *, gravity: float, model: str) -> Ends:
    """
    Run blocks from rest under one motion.

    Parameters
    ----------
    motion : Motion
        Along x and, if given, z; usable as `expect_usable` says.
    blocks : sequence of Sides
        By `sides_of`.
    gravity : float
        m/s².
    model : str
        A plane one.

    Returns
    -------
    ends : Ends
        The same, to the last bit, as outcome and `peak_ratio` of `rock`.

    Notes
    -----
    A block that the motion cannot uplift is not run: with a vertical component none is left out.
    """
    from colonnade.dynamics.plane.march import propagate

    chosen, forcing = plane_model_of(model), forcing_of(motion, gravity)
    largest = np.inf if forcing.weights.size > 0 else float(np.abs(forcing.levels).max())
    codes = np.full(len(blocks), STANDS, dtype=np.int8)
    peaks, speeds = np.zeros((2, len(blocks)))
    for number, sides in enumerate(blocks):
        if largest <= chosen.uplift_threshold(min(sides.critical)):
            continue
        angles, velocities, _, _, (time, _, _) = propagate(forcing, sides, is_linearised=chosen.is_linearised)
        if np.isfinite(time):
            codes[number], peaks[number] = OVERTURNS, np.nan
            speeds[number] = np.abs(velocities[: int(time / motion.dt) + 1]).max()
            continue
        peaks[number] = max(-angles.min() / sides.critical[0], angles.max() / sides.critical[1])
        speeds[number] = np.abs(velocities).max()
        codes[number] = ROCKS if peaks[number] > NO_ROCKING_RATIO else STANDS
    return Ends(codes, peaks, speeds)
