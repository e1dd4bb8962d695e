"""An elastic body, meshed, assembled and reduced to component modes: rigid motion apart, vibration, attachment."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from colonnade.arrays import Array
from colonnade.dynamics.block import Solid
from colonnade.dynamics.contact.body import ContactBody
from colonnade.dynamics.contact.mesh import Mesh, mesh_of, refine_rim

STEELS_MODULUS = 200e9
"""Young's modulus of steel, Pa."""

STEELS_POISSON_RATIO = 0.3


LINEAR_VISCOSITY = 0.06
"""b₁ of the pressure b₁ ρ c L ε̇ against the rate ε̇ of volume change: Abaqus/Explicit's default."""


@dataclass(frozen=True, eq=False)
class ElasticBody:
    """
    A meshed body: sparse matrices and nodal weights, axes at the centre of mass.

    Attributes
    ----------
    points : ndarray, shape (n, 3)
        Nodes relative to the centre of mass, m.
    base : ndarray, shape (b,)
        Nodes of the base.
    stiffness : scipy.sparse.csr_array, shape (3n, 3n)
        N/m; degree of freedom 3 i + k is node i along axis k.
    viscosity : scipy.sparse.csr_array, shape (e, 3n)
        Of each brick: the square of its product with nodal velocities is the power that bulk viscosity takes, W.
    node_mass : ndarray, shape (n,)
        Row sums of the consistent mass, kg.
    base_area : ndarray, shape (b,)
        The base's area that each of its nodes stands for, m².
    inertia : ndarray, shape (3,)
        Moments about the centre of mass of the meshed volume (not of the lumped masses), kg m².
    shift : float
        (rad/s)², added to the square of each mode's frequency while solving.
    description : str
    """

    points: Array
    base: NDArray[np.int64]
    stiffness: Any
    viscosity: Any
    node_mass: Array
    base_area: Array
    inertia: Array
    shift: float
    description: str


def assemble(
    mesh: Mesh,
    mass: float,
    description: str = "",
    *,
    modulus: float = STEELS_MODULUS,
    poisson_ratio: float = STEELS_POISSON_RATIO,
) -> ElasticBody:
    """
    Assemble the finite elements of a body of uniform density; its mass in kg, Young's modulus in Pa.

    Trilinear bricks, integrated at 2 × 2 × 2 points (scikit-fem's `intorder=2`; its default takes longer for the same
    matrix). They bend too stiffly, by a share that falls with the square of their size. The density is the mass over
    the mesh's volume, so that a round body's polygon costs it no mass.

    Bulk viscosity is a pressure against the mean rate of volume change of a brick, by its length, which is its volume
    over its largest face, and the speed of dilatational waves.
    """
    from scipy.sparse import csr_array
    from skfem import Basis, ElementHex1, ElementVector, FacetBasis, LinearForm
    from skfem.models.elasticity import lame_parameters, linear_elasticity

    scalar, vector = (Basis(mesh, each, intorder=2) for each in (ElementHex1(), ElementVector(ElementHex1())))
    density, (first, shear) = mass / float(scalar.dx.sum()), lame_parameters(modulus, poisson_ratio)
    weight = LinearForm(lambda v, _: v)
    node_mass = density * weight.assemble(scalar)
    centre = mesh.p @ node_mass / mass
    points = mesh.p.T - centre
    is_base = np.isclose(mesh.p[2], 0.0, atol=1e-9)
    under = FacetBasis(mesh, ElementHex1(), facets=mesh.facets_satisfying(lambda x: x[2] < 1e-9), intorder=2)

    volumes = scalar.dx.sum(axis=1)
    corners = mesh.p.T[mesh.facets]
    faces = np.linalg.norm(np.cross(corners[0] - corners[2], corners[1] - corners[3]), axis=1) / 2
    pressures = LINEAR_VISCOSITY * np.sqrt((first + 2 * shear) * density) * volumes / faces[mesh.t2f].max(axis=0)
    gradients = np.stack([field[0].grad for field in scalar.basis])
    means = np.einsum("ciep,ep->eci", gradients, scalar.dx) * np.sqrt(pressures / volumes)[:, None, None]
    rows, columns = np.repeat(np.arange(volumes.size), 24), (3 * mesh.t.T[:, :, None] + np.arange(3)).ravel()

    where = np.asarray(scalar.global_coordinates()) - centre[:, None, None]
    squares = density * np.einsum("iep,ep->i", where**2, scalar.dx)
    return ElasticBody(
        points=points,
        base=np.flatnonzero(is_base),
        stiffness=csr_array(linear_elasticity(first, shear).assemble(vector)),
        viscosity=csr_array((means.ravel(), (rows, columns)), shape=(volumes.size, points.size)),
        node_mass=node_mass,
        base_area=weight.assemble(under)[is_base],
        inertia=squares.sum() - squares,
        shift=SHIFT * modulus / density / float(np.ptp(points, axis=0).max()) ** 2,
        description=f"{description}, {points.size} degrees of freedom",
    )


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

SHIFT = 1e-3
"""Of the squared frequency (speed of sound over the largest length), added to every mode while solving."""


def reduce_body(body: ElasticBody, *, vibration_modes: int = VIBRATION_MODES) -> ContactBody:
    """
    Reduce a meshed body to modes that the contact engine can advance one by one: its lowest free vibration modes, exact
    for the mesh, and the residual deformation under a unit force at each base node along each axis. So the base's
    static flexibility is the mesh's own, whatever the number of vibration modes.

    Craig and Chang's method for a free body: the space of the vibration modes and of the inertia-relieved attachment
    modes, in which the small eigenproblem makes stiffness and mass both diagonal. Inertia forces of the rotation on the
    deformation are left out (strains are small). The inertia is that of the volume.
    """
    from scipy.sparse import diags_array, eye_array
    from scipy.sparse.linalg import LinearOperator, eigsh, splu

    elastic_modes = 3 * len(body.points) - 6
    if not 0 <= vibration_modes < elastic_modes:
        raise ValueError(f"{vibration_modes} vibration modes were asked for; 0 to {elastic_modes - 1} were expected")
    # In coordinates that are scaled by the square root of the mass.
    roots = np.sqrt(np.repeat(body.node_mass, 3))
    scaled = (diags_array(1 / roots) @ body.stiffness @ diags_array(1 / roots)).tocsr()
    rigid = roots[:, None] * rigid_modes(body.points, body.node_mass)
    shifted = (scaled + body.shift * eye_array(roots.size)).tocsc()
    factors = splu(shifted, permc_spec="MMD_AT_PLUS_A", diag_pivot_thresh=0.0, options={"SymmetricMode": True})

    def elastic(vectors: Array) -> Array:
        """Take the rigid motion out."""
        return np.asarray(vectors - rigid @ (rigid.T @ vectors))

    def flexibility(loads: Array) -> Array:
        return elastic(factors.solve(elastic(loads)))

    loaded = (3 * body.base[:, None] + np.arange(3)).ravel()
    loads = np.zeros((roots.size, loaded.size))
    loads[loaded, np.arange(loaded.size)] = 1 / roots[loaded]
    shapes = [rigid, flexibility(loads)]
    if vibration_modes:
        operator = LinearOperator(shifted.shape, matvec=flexibility, dtype=np.float64)
        start = np.random.default_rng(0).standard_normal(roots.size)
        shapes.insert(1, eigsh(operator, k=vibration_modes, which="LM", v0=start, tol=1e-10)[1])
    space = np.linalg.qr(np.hstack([each / np.linalg.norm(each, axis=0) for each in shapes]))[0][:, rigid.shape[1] :]
    squares, mixture = np.linalg.eigh(space.T @ (scaled @ space))
    modes, frequencies = space @ mixture / roots[:, None], np.sqrt(squares)
    return ContactBody(
        mass=float(body.node_mass.sum()),
        inertia=body.inertia,
        nodes=body.points[body.base],
        node_mass=body.node_mass[body.base],
        node_area=body.base_area,
        ring_radii=np.zeros(len(body.base)),
        modes=modes.reshape(-1, 3, frequencies.size)[body.base],
        frequencies=frequencies,
        modal_damping=modal_damping(body, modes, frequencies),
        description=f"{body.description}; {vibration_modes} vibration modes with attachment modes",
    )


def modal_damping(body: ElasticBody, modes: Array, frequencies: Array) -> Array:
    """
    Give each mode (mass-normalised shapes, (3n, m); rad/s) the damping, a fraction of critical, that the linear bulk
    viscosity is to it.

    ζ = φᵀ C φ / 2ω. For a mode of pure volume change it grows with the frequency, b₁ L ω / 2c; a mode of pure shear or
    torsion has none. What C couples between modes is left out. It is damping of the material and has a share of its own
    in the balance of energy, apart from that of the contact.
    """
    return np.asarray(((body.viscosity @ modes) ** 2).sum(axis=0) / (2 * frequencies))


def elastic_body(solid: Solid, mass: float, *, degrees_of_freedom: int, **elasticity: float) -> ContactBody:
    """
    Build the reduced elastic body of a shape and a mass.

    Parameters
    ----------
    solid : Solid
    mass : float
        kg.
    degrees_of_freedom : int
        Of the mesh, about; three a node.
    **elasticity : float, optional
        `modulus` and `poisson_ratio`, as of `assemble`.

    Returns
    -------
    body : ContactBody
        With all its modes; `keep_modes_for_step` leaves those that a step can follow.
    """
    mesh, description = mesh_of(solid, degrees_of_freedom)
    body = reduce_body(assemble(mesh, mass, description, **elasticity))
    return body if solid.base == "rectangle" else refine_rim(body)
