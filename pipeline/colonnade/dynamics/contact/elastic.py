"""An elastic body, meshed, assembled and reduced to component modes: rigid motion apart, vibration, attachment."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from colonnade.arrays import Array
from colonnade.dynamics.contact.body import ContactBody
from colonnade.dynamics.contact.mesh import Mesh, mesh_of, refine_rim

STEELS_MODULUS = 200e9
"""Young's modulus of steel, Pa."""

STEELS_POISSON_RATIO = 0.3


@dataclass(frozen=True, eq=False)
class ElasticBody:
    """
    A meshed body: sparse matrices and nodal weights, axes at the centre of mass.

    Attributes
    ----------
    density, modulus, dilatation : float
        kg/m³; Young's modulus, and Lamé's λ + 2µ, Pa.
    points : ndarray, shape (n, 3)
        Nodes relative to the centre of mass, m.
    base : ndarray, shape (b,)
        Nodes of the base.
    stiffness : scipy.sparse.csr_array, shape (3n, 3n)
        N/m; degree of freedom 3 i + k is node i along axis k.
    node_mass : ndarray, shape (n,)
        Row sums of the consistent mass, kg.
    base_area : ndarray, shape (b,)
        The base's area that each of its nodes stands for, m².
    volume_rate : scipy.sparse.csr_array, shape (e, 3n)
        Mean divergence of each brick's nodal velocities, 1/m.
    volumes : ndarray, shape (e,)
        m³.
    element_lengths : ndarray, shape (e,)
        Each brick's volume over its largest face, m: the shortest way through it.
    inertia : ndarray, shape (3,)
        Moments about the centre of mass of the meshed volume (not of the lumped masses), kg m².
    description : str
    """

    density: float
    modulus: float
    dilatation: float
    points: Array
    base: NDArray[np.int64]
    stiffness: Any
    node_mass: Array
    base_area: Array
    volume_rate: Any
    volumes: Array
    element_lengths: Array
    inertia: Array
    description: str


def assemble(
    mesh: Mesh, mass: float, *, modulus: float = STEELS_MODULUS, poisson_ratio: float = STEELS_POISSON_RATIO
) -> ElasticBody:
    """
    Assemble the finite elements of a body of uniform density; its mass in kg, Young's modulus in Pa.

    Trilinear bricks, integrated at 2 × 2 × 2 points (scikit-fem's `intorder=2`; its default takes longer for the same
    matrix). They bend too stiffly, by a share that falls with the square of their size. The density is the mass over
    the mesh's volume, so that a round body's polygon costs it no mass.
    """
    from scipy.sparse import csr_array
    from skfem import Basis, ElementHex1, ElementVector, FacetBasis, LinearForm, MeshHex
    from skfem.models.elasticity import lame_parameters, linear_elasticity

    hexahedra = MeshHex(mesh.points.T.copy(), mesh.cells.T.copy())
    scalar = Basis(hexahedra, ElementHex1(), intorder=2)
    density, (first, shear) = mass / float(scalar.dx.sum()), lame_parameters(modulus, poisson_ratio)
    weight = LinearForm(lambda v, _: v)
    node_mass = density * weight.assemble(scalar)
    centre = node_mass @ mesh.points / mass
    points = mesh.points - centre

    vector = Basis(hexahedra, ElementVector(ElementHex1()), intorder=2)
    order = np.asarray(vector.nodal_dofs).T.ravel()
    stiffness = csr_array(linear_elasticity(first, shear).assemble(vector))[order][:, order]
    facets = hexahedra.facets_satisfying(lambda x: np.isclose(x[2], 0.0, atol=1e-9), boundaries_only=True)
    area = weight.assemble(FacetBasis(hexahedra, ElementHex1(), facets=facets, intorder=2))

    gradients = np.stack([field[0].grad for field in scalar.basis])
    volumes = scalar.dx.sum(axis=1)
    means = np.einsum("ciep,ep->eci", gradients, scalar.dx) / volumes[:, None, None]
    rows = np.repeat(np.arange(len(volumes)), 24)
    columns = (3 * mesh.cells[:, :, None] + np.arange(3)).ravel()
    volume_rate = csr_array((means.ravel(), (rows, columns)), shape=(len(volumes), 3 * len(points)))

    where = np.asarray(scalar.global_coordinates()) - centre[:, None, None]
    squares = density * np.einsum("iep,ep->i", where**2, scalar.dx)
    return ElasticBody(
        density=density,
        modulus=modulus,
        dilatation=first + 2 * shear,
        points=points,
        base=mesh.base,
        stiffness=stiffness,
        node_mass=node_mass,
        base_area=area[mesh.base],
        volume_rate=volume_rate,
        volumes=volumes,
        element_lengths=volumes / _largest_faces(mesh),
        inertia=squares.sum() - squares,
        description=mesh.description,
    )


def _largest_faces(mesh: Mesh) -> Array:
    """Area of the largest face of each brick, from the diagonals of the faces, m²."""
    from skfem.refdom import RefHex

    corners = mesh.points[mesh.cells[:, np.array(RefHex.facets)]]
    diagonals = corners[:, :, 2] - corners[:, :, 0], corners[:, :, 3] - corners[:, :, 1]
    return np.asarray(np.linalg.norm(np.cross(*diagonals), axis=2).max(axis=1) / 2)


def rigid_modes(points: Array, node_mass: Array) -> Array:
    """
    Translations along x, y, z and rotations about them of a body (points about its centre of mass, in principal axes,
    m), orthonormal to the mass, kg^-½, shape (3n, 6).
    """
    axes = np.eye(3)
    shapes = [np.broadcast_to(axis, points.shape) for axis in axes] + [np.cross(axis, points) for axis in axes]
    modes = np.stack([shape.ravel() for shape in shapes], axis=1)
    return np.asarray(modes / np.sqrt(np.repeat(node_mass, 3) @ modes**2))


VIBRATION_MODES = 40
"""Free vibration modes kept by default."""

DEPENDENCE = 1e-9
"""Share of the strain energy below which a mixture of attachment shapes adds nothing to the others."""

SHIFT = 1e-3
"""Of the squared frequency (speed of sound over the largest length), added to every mode while solving."""


def reduce_body(body: ElasticBody, *, vibration_modes: int = VIBRATION_MODES) -> ContactBody:
    """
    Reduce a meshed body to modes that the contact engine can advance one by one: its lowest free vibration modes, exact
    for the mesh, and the residual deformation under a unit force at each base node along each axis. So the base's
    static flexibility is the mesh's own, whatever the number of vibration modes.

    Craig and Chang's method for a free body: inertia-relieved attachment modes less their share in the vibration modes,
    made orthogonal to each other through the small eigenproblem of their flexibility, so that stiffness and mass are
    both diagonal. Inertia forces of the rotation on the deformation are left out (strains are small). The inertia is
    that of the volume.
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
    shift = SHIFT * body.modulus / body.density / float(np.ptp(body.points, axis=0).max()) ** 2
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
        ring_radii=np.zeros(len(body.base)),
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
    Give each mode (mass-normalised shapes, (3n, m); rad/s) the damping, a fraction of critical, that the linear bulk
    viscosity is to it.

    ζ = φᵀ C φ / 2ω with C = Σ_e V_e b₁ ρ c L_e d_e d_eᵀ; d_e is the brick's mean divergence, L_e its volume over its
    largest face and c the speed of dilatational waves. For a mode of pure volume change it grows with the frequency, b₁
    L ω / 2c; a mode of pure shear or torsion has none. What C couples between modes is left out. It is damping of the
    material and has a share of its own in the balance of energy, apart from that of the contact.
    """
    pressures = LINEAR_VISCOSITY * np.sqrt(body.dilatation * body.density) * body.element_lengths
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
