"""One call for every model: block, base motion and restitution in, rocking history out."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, TypedDict, Unpack, overload

import numpy as np
from numpy.typing import ArrayLike

from colonnade.arrays import Array
from colonnade.dynamics.assembly import Assembly
from colonnade.dynamics.block import Block, Sided
from colonnade.dynamics.contact.body import ContactLaw, InSpace, rigid_body
from colonnade.dynamics.history import History
from colonnade.dynamics.models import DEFAULT, model_of
from colonnade.dynamics.motion import Motion, at_rest
from colonnade.validation import described, instance, number, samples, sided

if TYPE_CHECKING:
    from colonnade.dynamics.contact.history import AssemblyHistory


DEFAULT_REST_ANGLE = 1e-6
"""Fraction of α below which an arc after an impact counts as rest."""

LEAST_REST_ANGLE = 1e-12
"""The same of any rest rule: arcs below it are so short that a run would not come to its end."""

HALF = np.pi / 2

FASTEST = 1e9
"""rad/s, of the initial state."""


@dataclass(frozen=True, eq=False)
class RestitutionLaw:
    """
    Coefficient of restitution over the speed of the impact, linear between its points, for both sides of the block.

    Attributes
    ----------
    speeds : ndarray, shape (m,)
        |ω| just before an impact, rad/s, rising; below the first and above the last e stays as it is there.
    values : ndarray, shape (m,)
        e at these speeds, between 0 and 1.

    Raises
    ------
    ValueError
        If speeds do not rise from 0 or above, a value is not between 0 and 1, or their numbers differ.

    Examples
    --------
    >>> law = RestitutionLaw([0.0, 1.0], [1.0, 0.9])
    >>> float(law(0.5)), float(law(3.0))
    (0.95, 0.9)
    """

    speeds: Array
    values: Array

    def __post_init__(self) -> None:
        speeds, values = samples("speeds", self.speeds), samples("values", self.values)
        object.__setattr__(self, "speeds", speeds)
        object.__setattr__(self, "values", values)
        if speeds.size != values.size:
            raise ValueError(f"values has {values.size} numbers; one for each of {speeds.size} speeds was expected")
        if speeds[0] < 0.0 or not (np.diff(speeds) > 0.0).all():
            raise ValueError("The speeds of a restitution law have to be rising numbers from 0 rad/s on")
        for speed, e in zip(speeds.tolist(), values.tolist(), strict=True):
            number(f"e at {speed:g} rad/s", e, "a number between 0 and 1", low=0.0, high=1.0)

    def __call__(self, speed: ArrayLike) -> Array:
        """Give e at |ω| (rad/s), shape of `speed`."""
        speeds = samples("speed", speed, dimensions=(0, 1, 2, 3), fewest=0)
        return np.asarray(np.interp(speeds, self.speeds, self.values), dtype=np.float64)


Given = Sided | RestitutionLaw | None
"""e as it may be given: one value, a pair, or a law; None for the rigid-body value."""


def of_sides(block: Block, restitution: Sided | None) -> tuple[float, float]:
    """Give e of impacts that end an arc at θ < 0, and at θ > 0; ValueError if it is not between 0 and 1."""
    given = block.restitution if restitution is None else restitution
    return sided("restitution", given, "a number between 0 and 1", low=0.0, high=1.0)


class Options(TypedDict, total=False):
    """What `rock` takes beside block and motion, which it describes."""

    restitution: Given
    model: str
    theta0: float
    omega0: float
    duration: float | None
    rest_angle: float
    contact: ContactLaw | None
    out_of_plane: float


@overload
def rock(block: Block, motion: Motion | None = None, **options: Unpack[Options]) -> History: ...


@overload
def rock(block: Assembly, motion: Motion | None = None, **options: Unpack[Options]) -> AssemblyHistory: ...


def rock(
    block: Block | Assembly,
    motion: Motion | None = None,
    *,
    restitution: Given = None,
    model: str = DEFAULT,
    theta0: float = 0.0,
    omega0: float = 0.0,
    duration: float | None = None,
    rest_angle: float = DEFAULT_REST_ANGLE,
    contact: ContactLaw | None = None,
    out_of_plane: float = 0.0,
) -> History | AssemblyHistory:
    """
    Compute how a block rocks, or an assembly of blocks.

    Parameters
    ----------
    block : Block or Assembly
        An assembly needs the contact model; θ₀ and ω₀ are those of the blocks on the table.
    motion : Motion, optional
        Base motion along x and, where given, z; without it the block rocks freely for `duration`. The contact model
        takes motion along y too.
    restitution : float, pair of float or RestitutionLaw, optional
        e, between 0 and 1; a pair is for impacts that end an arc at (θ < 0, θ > 0); a law gives e at |ω| (rad/s) just
        before the impact. Default: the rigid-body value. Not for the contact model, whose restitution follows from
        its law.
    model : str, optional
        "linear" (default): the linear equation, solved exactly for a base motion that is linear between samples;
        "nonlinear": the full one, by Taylor series to rounding (with vertical motion both by Taylor series);
        "contact": a rigid body in space on nodes that touch the table, step by step.
    theta0, omega0 : float, optional
        Initial angle (rad) and angular velocity (rad/s), positive when the top moves to +x.
    duration : float, optional
        s, only without a motion. The history is then sampled at about 1/(500 p).
    rest_angle : float, optional
        Fraction of α. After an impact whose next arc, under the base acceleration of that instant, would not rise above
        it, the block is at rest until it is uplifted again. Not for the contact model.
    contact : ContactLaw, optional
        Of the contact model. Default: `ContactLaw()`, with its stiffness under the block.
    out_of_plane : float, optional
        Initial rotation about x, rad, of the contact model.

    Returns
    -------
    history : History
        At the motion's samples; a `ContactHistory` of the contact model, an `AssemblyHistory` of an assembly.

    Raises
    ------
    ValueError
        If an argument is out of its range or the model is not known.

    Notes
    -----
    The equations are Housner's (1963): nonlinear, θ̈ = −p² [sin(α sgn θ − θ) + (a/g) cos(α sgn θ − θ)], and linear,
    θ̈ = p² (θ − α sgn θ − a/g). Each impact multiplies the angular velocity by e.

    Examples
    --------
    >>> block = Block.prism(width=0.086, depth=0.086, height=0.456, mass=26.10)
    >>> rock(block, restitution=0.976, theta0=0.5 * block.critical_angle, duration=5.0).outcome
    'rocking'
    """
    asked = model_of(model)
    several = block.bodies.values() if isinstance(block, Assembly) else ()
    blocks = [body.block for body in several] or [instance("block", block, Block)]
    if motion is not None and duration is not None:
        raise ValueError(f"duration is {described(duration)}, and a motion is given; one of the two was expected")
    between = "an angle between −π/2 and π/2"
    theta0 = number("theta0", theta0, between, above=-HALF, below=HALF)
    omega0 = number("omega0", omega0, f"less than {FASTEST:g} rad/s", above=-FASTEST, below=FASTEST)
    out_of_plane = number("out_of_plane", out_of_plane, between, above=-HALF, below=HALF)
    expected = f"a fraction of the critical angle from {LEAST_REST_ANGLE:g} to 1"
    rest_angle = number("rest_angle", rest_angle, expected, low=LEAST_REST_ANGLE, below=1.0)
    motion = at_rest(blocks[0], duration) if motion is None else instance("motion", motion, Motion)
    if asked.in_space:
        if restitution is not None:
            raise ValueError(
                f"Do not give `restitution` to the {model} model: it follows from `contact`, the law of contact"
            )
        if any(one.beam_ratio for one in blocks):
            raise ValueError(
                "block is a frame, which rocks as one block in the plane only; a single body was expected. On contact "
                "its columns and its beam are bodies: build an `Assembly.frame`"
            )
        law = ContactLaw() if contact is None else instance("contact", contact, ContactLaw)
        space = InSpace(block if isinstance(block, Assembly) else rigid_body(block), law)
        return space.run(motion, blocks[0].gravity, theta0=theta0, omega0=omega0, out_of_plane=out_of_plane)
    if isinstance(block, Assembly) or contact is not None or out_of_plane:
        raise ValueError(
            f'model is "{model}"; bodies on each other, contact and out_of_plane are for model="contact", which was '
            "expected with them"
        )
    # The kernels are decorated on import.
    from colonnade.dynamics.plane.run import run

    return run(asked, block, motion, restitution, theta0=theta0, omega0=omega0, rest_angle=rest_angle)
