"""An elastic body, meshed, assembled and reduced to component modes: rigid motion apart, vibration, attachment."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import replace
from typing import Any

import numpy as np

from colonnade.arrays import Array
from colonnade.dynamics.contact.body import ContactBody
from colonnade.dynamics.contact.elastic.assembly import ElasticBody, assemble, rigid_modes
from colonnade.dynamics.contact.elastic.mesh import mesh_of, refine_rim

VIBRATION_MODES = 40
"""Free vibration modes kept by default."""

DEPENDENCE = 1e-9
"""Share of the strain energy below which a mixture of attachment shapes adds nothing to the others."""

SHIFT = 1e-3
"""Of the squared frequency (speed of sound over the largest length), added to every mode while solving."""


def reduce_body(body: ElasticBody, *, vibration_modes: int = VIBRATION_MODES) -> ContactBody:
    """
    Reduce a meshed body to modes that the contact engine can advance one by one.

    Beside vibration modes it keeps the residual deformation under a unit force at each base node along each axis: so
    the base's static flexibility is the mesh's own, whatever the number of vibration modes.

    Parameters
    ----------
    body : ElasticBody
    vibration_modes : int, optional
        Lowest free vibration modes, exact for the mesh.

    Returns
    -------
    reduced : ContactBody
        Modes by rising frequency. Its inertia is that of the volume, its rigid motion is free of the modes.

    Raises
    ------
    ValueError
        If the number of modes is negative or not below the mesh's.

    Notes
    -----
    Craig and Chang's method for a free body: inertia-relieved attachment modes less their share in the vibration modes,
    made orthogonal to each other through the small eigenproblem of their flexibility, so that stiffness and mass are
    both diagonal. Inertia forces of the rotation on the deformation are left out (strains are small).
    """
    from scipy.sparse import diags_array, eye_array
    from scipy.sparse.linalg import splu

    elastic_modes = 3 * len(body.points) - 6
    if not 0 <= vibration_modes < elastic_modes:
        raise ValueError(f"{vibration_modes} vibration modes were asked for; 0 to {elastic_modes - 1} were expected")
    roots = np.sqrt(np.repeat(body.node_mass, 3))
    weights = diags_array(1 / roots)
    scaled = (weights @ body.stiffness @ weights).tocsr()
    rigid = roots[:, None] * rigid_modes(body.points, body.node_mass)
    shift = SHIFT * body.material.modulus / body.material.density / float(np.ptp(body.points, axis=0).max()) ** 2
    shifted = (scaled + shift * eye_array(roots.size)).tocsc()
    factors = splu(shifted, permc_spec="MMD_AT_PLUS_A", diag_pivot_thresh=0.0, options={"SymmetricMode": True})

    def flexibility(loads: Array) -> Array:
        return _without(rigid, factors.solve(_without(rigid, loads)))

    modes, frequencies = _vibration(scaled, flexibility, rigid, vibration_modes)
    loads = np.zeros((roots.size, 3 * len(body.base)))
    loaded = (3 * body.base[:, None] + np.arange(3)).ravel()
    loads[loaded, np.arange(loaded.size)] = 1 / roots[loaded]
    shapes, attached = _attachment(scaled, _without(modes, flexibility(_without(modes, loads))))
    modes, frequencies = np.hstack((modes, shapes)), np.concatenate((frequencies, attached))
    order = np.argsort(frequencies)
    frequencies, modes = frequencies[order], modes[:, order] / roots[:, None]
    return replace(
        rigid_on_nodes(body),
        modes=modes.reshape(-1, 3, frequencies.size)[body.base],
        frequencies=frequencies,
        modal_damping=modal_damping(body, modes, frequencies),
        description=f"{body.description}; {vibration_modes} vibration modes with attachment modes",
    )


def rigid_on_nodes(body: ElasticBody) -> ContactBody:
    """Give the rigid block that stands on the same nodes, with the same weights."""
    return ContactBody(
        mass=float(body.node_mass.sum()),
        inertia=body.inertia,
        nodes=body.points[body.base],
        node_mass=body.node_mass[body.base],
        node_area=body.base_area,
        modes=np.empty((len(body.base), 3, 0)),
        frequencies=np.empty(0),
        modal_damping=np.empty(0),
        description=f"{body.description}, rigid",
    )


def _vibration(scaled: Any, flexibility: Callable[[Array], Array], rigid: Array, count: int) -> tuple[Array, Array]:
    """Lowest elastic modes in coordinates scaled by the square root of the mass, and their frequencies."""
    from scipy.sparse.linalg import LinearOperator, eigsh

    size = len(rigid)
    if count == 0:
        return np.empty((size, 0)), np.empty(0)
    operator = LinearOperator((size, size), matvec=flexibility, dtype=np.float64)
    start = np.random.default_rng(0).standard_normal(size)
    _, modes = eigsh(operator, k=count, which="LM", v0=start, tol=1e-10)
    modes, _ = np.linalg.qr(_without(rigid, modes))
    squares, mixture = np.linalg.eigh(modes.T @ (scaled @ modes))
    return modes @ mixture, np.sqrt(squares)


def _attachment(scaled: Any, shapes: Array) -> tuple[Array, Array]:
    """Mix shapes into orthonormal modes that the stiffness does not couple, and give their frequencies."""
    shapes = shapes / np.sqrt(np.diagonal(shapes.T @ (scaled @ shapes)))
    shares, mixture = np.linalg.eigh(shapes.T @ (scaled @ shapes))
    kept = shares > DEPENDENCE * shares[-1]
    shapes = shapes @ (mixture[:, kept] / np.sqrt(shares[kept]))
    # Strain energies are now alike, so the flexibilities are the masses, 1/ω².
    flexibilities, mixture = np.linalg.eigh(shapes.T @ shapes)
    return (shapes @ mixture) / np.sqrt(flexibilities), 1 / np.sqrt(flexibilities)


def _without(basis: Array, vectors: Array) -> Array:
    """Take the components along an orthonormal basis out of vectors."""
    return np.asarray(vectors - basis @ (basis.T @ vectors))


LINEAR_VISCOSITY = 0.06
"""b₁ of the pressure b₁ ρ c L ε̇ against the rate ε̇ of volume change: Abaqus/Explicit's default."""


def modal_damping(body: ElasticBody, modes: Array, frequencies: Array) -> Array:
    """
    Give each mode the damping that the linear bulk viscosity is to it.

    Parameters
    ----------
    body : ElasticBody
    modes : ndarray, shape (3n, m)
        Mass-normalised shapes, kg^-½.
    frequencies : ndarray, shape (m,)
        rad/s.

    Returns
    -------
    damping : ndarray, shape (m,)
        Fraction of critical.

    Notes
    -----
    ζ = φᵀ C φ / 2ω with C = Σ_e V_e b₁ ρ c L_e d_e d_eᵀ; d_e is the brick's mean divergence, L_e its volume over its
    largest face and c the speed of dilatational waves. For a mode of pure volume change it grows with the frequency,
    b₁ L ω / 2c; a mode of pure shear or torsion has none. What C couples between modes is left out. It is damping of
    the material and has a share of its own in the balance of energy, apart from that of the contact.
    """
    first, shear = body.material.lame
    pressures = LINEAR_VISCOSITY * np.sqrt((first + 2 * shear) * body.material.density) * body.element_lengths
    return np.asarray((body.volumes * pressures) @ (body.volume_rate @ modes) ** 2 / (2 * frequencies))


def elastic_body(
    sizes: Mapping[str, float], mass: float, *, degrees_of_freedom: int, **elasticity: float
) -> ContactBody:
    """
    Build the reduced elastic body of given dimensions and mass.

    Parameters
    ----------
    sizes, degrees_of_freedom
        As of `mesh_of`.
    mass : float
        kg.
    **elasticity : float, optional
        `modulus` and `poisson_ratio`, as of `assemble`.

    Returns
    -------
    body : ContactBody
        With all its modes; `keep_modes_for_step` leaves those that a step can follow.

    Raises
    ------
    ValueError
        If the dimensions are those of no known shape.
    """
    body = reduce_body(assemble(mesh_of(sizes, degrees_of_freedom), mass, **elasticity))
    return body if "width" in sizes else refine_rim(body)
