"""One call for every model: block, base motion and restitution in, rocking history out."""

from __future__ import annotations

from collections.abc import Callable
from importlib import import_module
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from colonnade.dynamics.block import Block, Sided
from colonnade.dynamics.history import History
from colonnade.dynamics.motion import Motion, at_rest
from colonnade.dynamics.restitution_law import RestitutionLaw
from colonnade.errors import nearest
from colonnade.validation import described, instance, number, sided, text

if TYPE_CHECKING:
    from colonnade.dynamics.contact.law import ContactLaw

Array = NDArray[np.float64]

MODELS = ("linear", "nonlinear")
"""Models of plane rocking that `rock` can run."""

CONTACT = "contact"
"""The model in space that `rock` can run."""

DEFAULT_REST_ANGLE = 1e-6
"""Fraction of α below which an arc after an impact is taken as rest."""

LEAST_REST_ANGLE = 1e-12
"""The same of any rest rule: arcs below it are so short that a run would not come to its end."""

HALF = np.pi / 2

LARGEST_ACCELERATION = 1e6
"""In g; more is no motion of a table."""

LARGEST_VELOCITY = 1e6
"""In p, of the initial state."""

LONGEST_SAMPLE = 300.0
"""In p dt; hyperbolic functions of more leave the range of floating-point numbers."""


def rock(
    block: Block,
    motion: Motion | None = None,
    *,
    restitution: Sided | RestitutionLaw | Callable[[float], float] | None = None,
    model: str = "linear",
    theta0: float = 0.0,
    omega0: float = 0.0,
    duration: float | None = None,
    rest_angle: float = DEFAULT_REST_ANGLE,
    contact: ContactLaw | None = None,
    out_of_plane: float = 0.0,
) -> History:
    """
    Compute how a block rocks.

    Parameters
    ----------
    block : Block
    motion : Motion, optional
        Base motion along x and, where given, z; without it the block rocks freely for `duration`. The contact model
        takes motion along y too.
    restitution : float, pair of float, RestitutionLaw or function, optional
        e, between 0 and 1; a pair is for impacts that end an arc at (θ < 0, θ > 0); a law or a function gives e at
        |ω| (rad/s) just before the impact. Default: the rigid-body value. Not for the contact model, whose restitution
        follows from its law.
    model : {"linear", "nonlinear", "contact"}
        The linear equation, solved exactly for a base motion that is linear between samples; or the full one, by Taylor
        series to rounding (with vertical motion both by Taylor series); or a rigid body in space on nodes that touch
        the table, step by step.
    theta0, omega0 : float, optional
        Initial angle (rad) and angular velocity (rad/s), positive when the top moves to +x.
    duration : float, optional
        s, only without a motion. The history is then sampled at about 1/(500 p).
    rest_angle : float, optional
        Fraction of α. After an impact whose next arc, under the base acceleration of that instant, would not rise above
        it, the block is at rest until it is uplifted again. Not for the contact model.
    contact : ContactLaw, optional
        Of the contact model. Default: `ContactLaw.stiff` of the block.
    out_of_plane : float, optional
        Initial rotation about x, rad, of the contact model.

    Returns
    -------
    history : History
        At the motion's samples; a `ContactHistory` of the contact model.

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
    if text("model", model, "the name of a model") not in (*MODELS, CONTACT):
        raise ValueError(f'There is no model "{model}".{nearest(model, (*MODELS, CONTACT))}')
    instance("block", block, Block)
    if motion is not None:
        instance("motion", motion, Motion)
        if duration is not None:
            raise ValueError(f"duration is {described(duration)}, and a motion is given; one of the two was expected")
    between = "an angle between −π/2 and π/2, where the block lies,"
    theta0 = number("theta0", theta0, between, above=-HALF, below=HALF, unit="rad")
    fastest = LARGEST_VELOCITY * max(block.side_p(block.negative), block.side_p(block.positive))
    omega0 = number("omega0", omega0, f"less than {fastest:.4g} rad/s", above=-fastest, below=fastest, unit="rad/s")
    out_of_plane = number("out_of_plane", out_of_plane, between, above=-HALF, below=HALF, unit="rad")
    expected = f"a fraction of the critical angle from {LEAST_REST_ANGLE:g} to 1"
    rest_angle = number("rest_angle", rest_angle, expected, low=LEAST_REST_ANGLE, below=1.0)
    if contact is not None:
        _expect_law(contact)
    if model == CONTACT:
        return _in_space(block, motion, restitution, theta0, omega0, duration, contact, out_of_plane)
    if contact is not None or out_of_plane:
        raise ValueError(f'contact and out_of_plane are for the model "{CONTACT}"; the model is "{model}"')
    motion = at_rest(block, duration) if motion is None else motion
    law = _law(block, restitution)
    _check(block, motion)
    while True:
        history = _propagated(block, motion, law, model, theta0, omega0, rest_angle)
        wider = law.reaching(history.impact_velocities) if isinstance(law, RestitutionLaw) else law
        if wider is law:
            return history
        law = wider


def _in_space(
    block: Block,
    motion: Motion | None,
    restitution: Sided | RestitutionLaw | Callable[[float], float] | None,
    theta0: float,
    omega0: float,
    duration: float | None,
    contact: ContactLaw | None,
    out_of_plane: float,
) -> History:
    # Its engine is compiled on import.
    from colonnade.dynamics.contact.law import ContactLaw
    from colonnade.dynamics.contact.layout import rigid_body
    from colonnade.dynamics.contact.simulate import simulate

    if restitution is not None:
        raise ValueError(
            "The contact model has no restitution of its own to be given: it follows from `contact`, the law of contact"
        )
    body = rigid_body(block)
    law = ContactLaw.stiff(body, block.gravity) if contact is None else contact
    return simulate(
        body,
        motion,
        law=law,
        gravity=block.gravity,
        duration=duration,
        theta0=theta0,
        omega0=omega0,
        out_of_plane=out_of_plane,
    )


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


def _table(law: RestitutionLaw | tuple[float, float]) -> tuple[Array, Array]:
    """Speeds, shape (m,), and e at them on the one side and then on the other, shape (2 m,)."""
    if isinstance(law, RestitutionLaw):
        return law.speeds, np.tile(law.values, 2)
    return np.zeros(1), np.array(law)


def _propagated(
    block: Block,
    motion: Motion,
    law: RestitutionLaw | tuple[float, float],
    model: str,
    theta0: float,
    omega0: float,
    rest_angle: float,
) -> History:
    # The engine is compiled on import: only the one that is asked for.
    by_series = model == "nonlinear" or motion.vertical is not None
    engine = import_module(f"colonnade.dynamics.{'nonlinear' if by_series else 'linear'}")
    sides = (block.negative, block.positive)
    options: dict[str, Any] = {}
    if by_series:
        vertical = np.zeros_like(motion.acceleration) if motion.vertical is None else motion.vertical / block.gravity
        options = {"vertical": vertical, "linearised": model == "linear"}
    law_speeds, values = _table(law)
    angle, velocity, impact_times, impact_velocities, overturning_time = engine.propagate(
        motion.acceleration / block.gravity,
        motion.dt,
        np.array([side.critical_angle for side in sides]),
        np.array([block.side_p(side) for side in sides]),
        values,
        rest_angle,
        theta0,
        omega0,
        speeds=law_speeds,
        **options,
    )
    e = law(np.abs(impact_velocities)) if isinstance(law, RestitutionLaw) else np.where(impact_velocities > 0.0, *law)
    rebounds = e * impact_velocities
    return History(
        block, motion.time, angle, velocity, impact_times, impact_velocities, rebounds, overturning_time, model
    )


def _expect_law(contact: object) -> None:
    from colonnade.dynamics.contact.law import ContactLaw

    instance("contact", contact, ContactLaw)


def _check(block: Block, motion: Motion) -> None:
    fastest = max(block.side_p(block.negative), block.side_p(block.positive))
    if not motion.peak <= LARGEST_ACCELERATION * block.gravity:
        raise ValueError(
            f"The acceleration is {motion.peak:.4g} m/s² at sample {int(np.abs(motion.acceleration).argmax())}; "
            f"at most {LARGEST_ACCELERATION:g} g was expected. Is its unit right?"
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
