"""One run of a plane model under a sampled base motion: checks, the law of restitution, and the model's kernels."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

import numpy as np

from colonnade.dynamics.block import Block, Sided
from colonnade.dynamics.history import History
from colonnade.dynamics.motion import Motion, at_rest
from colonnade.dynamics.restitution_law import RestitutionLaw
from colonnade.validation import sided

if TYPE_CHECKING:
    from colonnade.dynamics.models.model import Case
    from colonnade.dynamics.plane.nonlinear import BySeries
from colonnade.dynamics.models.plane import PlaneModel

LARGEST_ACCELERATION = 1e6
"""In g; no table reaches more."""

LONGEST_SAMPLE = 300.0
"""In p dt; hyperbolic functions of more leave the range of floating-point numbers."""


def run(model: PlaneModel, case: Case) -> History:
    """
    Run a plane model.

    Raises
    ------
    ValueError
        If the case asks for what only a model in space has, or an argument is out of its range.
    """
    if case.contact is not None or case.out_of_plane:
        raise ValueError(f'contact and out_of_plane are for models in space; the model is "{model.name}"')
    motion = at_rest(case.block, case.duration) if case.motion is None else case.motion
    law = _law(case.block, case.restitution)
    expect_usable(case.block, motion)
    while True:
        history = _propagated(model, case, motion, law)
        wider = law.reaching(history.impact_velocities) if isinstance(law, RestitutionLaw) else law
        if wider is law:
            return history
        law = wider


def _law(
    block: Block, restitution: Sided | RestitutionLaw | Callable[[float], float] | None
) -> RestitutionLaw | tuple[float, float]:
    """Give e as a pair, or as a law that begins with speeds up to a few times that of a fall from α."""
    if restitution is None:
        restitution = block.restitution
    if isinstance(restitution, RestitutionLaw):
        return restitution
    if callable(restitution):
        return RestitutionLaw.of(restitution, largest_speed=4.0 * block.p * block.critical_angle)
    return sided("restitution", restitution, "a number between 0 and 1", low=0.0, high=1.0)


def _propagated(model: PlaneModel, case: Case, motion: Motion, law: RestitutionLaw | tuple[float, float]) -> History:
    # The kernels are decorated on import.
    from colonnade.dynamics.plane.sampled_march import propagate
    from colonnade.dynamics.plane.sides import sides_of

    block = case.block
    angle, velocity, impact_times, impact_velocities, overturning_time = propagate(
        motion.acceleration / block.gravity,
        motion.dt,
        sides_of(block, law, case.rest_angle),
        case.theta0,
        case.omega0,
        series_of(model, motion, block.gravity),
    )
    e = law(np.abs(impact_velocities)) if isinstance(law, RestitutionLaw) else np.where(impact_velocities > 0.0, *law)
    return History(
        block,
        motion.time,
        angle,
        velocity,
        impact_times,
        impact_velocities,
        e * impact_velocities,
        overturning_time,
        model.name,
    )


def series_of(model: PlaneModel, motion: Motion, gravity: float) -> BySeries | None:
    """Prepare the solution by series of a model under a motion (`gravity` in m/s²); None if it has a closed form."""
    from colonnade.dynamics.plane.nonlinear import by_series

    if model.is_linearised and motion.vertical is None:
        return None
    vertical = np.zeros_like(motion.acceleration) if motion.vertical is None else motion.vertical / gravity
    return by_series(vertical, model.is_linearised)


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
