"""
The unreduced finite elements on the same contact law and a table at rest: the check of the reduced model.

Far slower than the reduced model, and not meant for predictions; the scheme is that of `unreduced_steps`.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import ceil, hypot, sqrt

import numpy as np

from colonnade.arrays import Array
from colonnade.dynamics.contact.elastic.assembly import ElasticBody
from colonnade.dynamics.contact.elastic.reduction import rigid_on_nodes
from colonnade.dynamics.contact.elastic.viscosity import LINEAR_VISCOSITY, linear_coefficients, modal_damping
from colonnade.dynamics.contact.law import ContactLaw
from colonnade.dynamics.contact.start import Start, rotation_matrices
from unreduced_steps import advance

STEP_MARGIN = 0.5
"""Default step, as a share of the estimated stable one: nearer to 1, contact that comes and goes gains energy."""


@dataclass(frozen=True)
class BulkViscosity:
    """
    A pressure against the rate ε̇ of volume change, p = b₁ ρ c L ε̇ + ρ (b₂ L)² |ε̇| min(0, ε̇), positive in tension.

    Attributes
    ----------
    linear : float
        b₁.
    quadratic : float
        b₂, in compression only; Abaqus/Explicit's default is 1.2. At the strains of rocking this part is far below the
        linear one.
    """

    linear: float = LINEAR_VISCOSITY
    quadratic: float = 1.2

    def __post_init__(self) -> None:
        if self.linear < 0.0 or self.quadratic < 0.0:
            raise ValueError(
                f"The bulk viscosities are {self.linear} and {self.quadratic}; numbers from 0 on were expected"
            )


NO_VISCOSITY = BulkViscosity(0.0, 0.0)


@dataclass(frozen=True, eq=False)
class ExplicitRun:
    """
    What the unreduced model did, at every step.

    Attributes
    ----------
    time : ndarray, shape (n,)
        s.
    force : ndarray, shape (n, 3)
        Of the table on the body, N.
    centre, velocity : ndarray, shape (n, 3)
        Of the centre of mass, m and m/s.
    angular_momentum : ndarray, shape (n, 3)
        About the centre of mass, kg m²/s.
    turn : ndarray, shape (n, 3)
        Half the skew part of the mean rotation (the sine of the angle along its axis), rad for small angles.
    kinetic, potential, strain, contact : ndarray, shape (n,)
        Energies, J; `contact` is in the springs of the nodes.
    contact_loss, friction_loss, bulk_loss : ndarray, shape (n,)
        Dissipated so far, J.
    step : float
        s.
    """

    time: Array
    force: Array
    centre: Array
    velocity: Array
    angular_momentum: Array
    turn: Array
    kinetic: Array
    potential: Array
    strain: Array
    contact: Array
    contact_loss: Array
    friction_loss: Array
    bulk_loss: Array
    step: float

    @property
    def residual(self) -> Array:
        """Energy that the balance has won since the start, J."""
        total = self.kinetic + self.potential + self.strain + self.contact
        total = total + self.contact_loss + self.friction_loss + self.bulk_loss
        return np.asarray(total - total[0])


def highest_frequency(body: ElasticBody, law: ContactLaw | None = None) -> tuple[float, Array]:
    """
    Estimate the mesh's highest frequency, which limits the explicit step.

    Parameters
    ----------
    body : ElasticBody
    law : ContactLaw, optional
        With it all base nodes are on their contact springs.

    Returns
    -------
    frequency : float
        rad/s.
    mode : ndarray, shape (3n,)
        Its mass-normalised shape, kg^-½.
    """
    from scipy.sparse import diags_array
    from scipy.sparse.linalg import eigsh

    mass = np.repeat(body.node_mass, 3)
    stiffness = body.stiffness
    if law is not None:
        springs = np.zeros((len(body.points), 3))
        normal = law.node_stiffness(rigid_on_nodes(body))
        springs[body.base] = normal[:, None] * np.array([law.tangential_ratio, law.tangential_ratio, 1.0])
        stiffness = stiffness + diags_array(springs.ravel())
    roots = diags_array(1 / np.sqrt(mass))
    start = np.random.default_rng(0).standard_normal(mass.size)
    squares, modes = eigsh(roots @ stiffness @ roots, k=1, which="LM", v0=start, tol=1e-4)
    return sqrt(float(squares[0])), np.asarray(modes[:, 0] / np.sqrt(mass))


def quadratic_coefficients(body: ElasticBody, viscosity: BulkViscosity) -> Array:
    """Give the quadratic part's pressure over rate squared, ρ (b₂ L)², of each brick, Pa s², shape (e,)."""
    return np.asarray(body.material.density * (viscosity.quadratic * body.element_lengths) ** 2)


def stable_step(highest_frequency: float, damping: float = 0.0) -> float:
    """
    Give the largest stable step of central differences with lagged damping, 2 (sqrt(1 + ζ²) − ζ) / ω.

    Parameters
    ----------
    highest_frequency : float
        ω, rad/s.
    damping : float, optional
        ζ of that mode, fraction of critical.

    Returns
    -------
    step : float
        s.

    Examples
    --------
    >>> round(stable_step(1e6, 0.06) * 1e6, 3)
    1.884
    """
    return 2 * (hypot(1.0, damping) - damping) / highest_frequency


def explicit_step(body: ElasticBody, law: ContactLaw, viscosity: BulkViscosity) -> float:
    """Estimate the largest stable step of a body on its contact, s; damping of the contact and the bulk shorten it."""
    frequency, mode = highest_frequency(body, law)
    bulk = float(modal_damping(body, mode[:, None], np.array([frequency]), viscosity.linear)[0])
    return stable_step(frequency, max(bulk, law.damping_fraction))


def run_explicit(
    body: ElasticBody,
    law: ContactLaw,
    start: Start,
    *,
    duration: float,
    gravity: float,
    viscosity: BulkViscosity | None = None,
    step: float | None = None,
) -> ExplicitRun:
    """
    Let the unreduced body go, undeformed, and follow it.

    Parameters
    ----------
    body : ElasticBody
    law : ContactLaw
    start : Start
    duration : float
        s.
    gravity : float
        m/s², downwards.
    viscosity : BulkViscosity, optional
        By default `BulkViscosity()`.
    step : float, optional
        s; by default half the estimated stable one.

    Returns
    -------
    run : ExplicitRun

    Raises
    ------
    ValueError
        If the step given is above the stable one; the message gives it.
    """
    from scipy.sparse import bsr_array

    viscosity = viscosity or BulkViscosity()
    largest = explicit_step(body, law, viscosity)
    step = STEP_MARGIN * largest if step is None else step
    if not 0.0 < step <= largest:
        raise ValueError(
            f"The step is {step:.3g} s; the unreduced mesh ({body.description}) is stable up to {largest:.3g} s"
        )
    contact = rigid_on_nodes(body)
    stiffness, damping = law.node_stiffness(contact), law.node_damping(contact)
    blocks = bsr_array(body.stiffness, blocksize=(3, 3))
    rates = body.volume_rate
    quadratic = quadratic_coefficients(body, viscosity)
    positions = start.position + body.points @ rotation_matrices(start.orientation[None])[0].T
    velocities = start.velocity + np.cross(start.angular_velocity, positions - start.position)
    count = ceil(duration / step) + 1
    record = advance(
        body.points,
        body.node_mass,
        blocks.indptr,
        blocks.indices,
        np.ascontiguousarray(blocks.data),
        body.base,
        np.column_stack((stiffness, damping, law.tangential_ratio * stiffness, law.tangential_damping * damping)),
        law.friction,
        rates.indptr,
        rates.indices,
        rates.data,
        np.column_stack((body.volumes, linear_coefficients(body, viscosity.linear), quadratic)),
        positions,
        velocities,
        gravity,
        step,
        count,
    )
    return ExplicitRun(
        time=step * np.arange(count, dtype=np.float64),
        force=record[:, 0:3],
        centre=record[:, 3:6],
        velocity=record[:, 6:9],
        angular_momentum=record[:, 9:12],
        turn=record[:, 12:15],
        kinetic=record[:, 15],
        potential=record[:, 16],
        strain=record[:, 17],
        contact=record[:, 18],
        contact_loss=record[:, 19],
        friction_loss=record[:, 20],
        bulk_loss=record[:, 21],
        step=step,
    )
