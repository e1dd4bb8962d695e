"""Stiffness, mass, base weights and rates of volume change of a meshed elastic body."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from colonnade.arrays import Array
from colonnade.dynamics.contact.elastic.mesh import Mesh

STEELS_MODULUS = 200e9
"""Young's modulus of steel, Pa."""

STEELS_POISSON_RATIO = 0.3


@dataclass(frozen=True)
class Material:
    """
    An isotropic linear elastic material.

    Attributes
    ----------
    density : float
        kg/m³.
    modulus : float
        Young's modulus, Pa.
    poisson_ratio : float
    """

    density: float
    modulus: float = STEELS_MODULUS
    poisson_ratio: float = STEELS_POISSON_RATIO

    @property
    def lame(self) -> tuple[float, float]:
        """Lamé's λ and µ, Pa."""
        shear = self.modulus / (2 * (1 + self.poisson_ratio))
        return 2 * shear * self.poisson_ratio / (1 - 2 * self.poisson_ratio), shear


@dataclass(frozen=True, eq=False)
class ElasticBody:
    """
    A meshed body: sparse matrices and nodal weights, axes at the centre of mass.

    Attributes
    ----------
    material : Material
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

    material: Material
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
    Assemble the finite elements of a body of uniform density.

    Parameters
    ----------
    mesh : Mesh
        From `prism_mesh` or `round_mesh`.
    mass : float
        kg. The density is this mass over the mesh's volume, so that a round body's polygon costs it no mass.
    modulus : float, optional
        Young's modulus, Pa.
    poisson_ratio : float, optional

    Returns
    -------
    body : ElasticBody

    Notes
    -----
    Trilinear bricks, integrated at 2 × 2 × 2 points (scikit-fem's `intorder=2`; its default takes longer for the same
    matrix). They bend too stiffly, by a share that falls with the square of their size.
    """
    from scipy.sparse import csr_array
    from skfem import Basis, ElementHex1, ElementVector, FacetBasis, LinearForm, MeshHex
    from skfem.models.elasticity import linear_elasticity

    hexahedra = MeshHex(mesh.points.T.copy(), mesh.cells.T.copy())
    scalar = Basis(hexahedra, ElementHex1(), intorder=2)
    volume = float(scalar.dx.sum())
    material = Material(mass / volume, modulus, poisson_ratio)
    weight = LinearForm(lambda v, _: v)
    node_mass = material.density * weight.assemble(scalar)
    centre = node_mass @ mesh.points / mass
    points = mesh.points - centre

    vector = Basis(hexahedra, ElementVector(ElementHex1()), intorder=2)
    order = np.asarray(vector.nodal_dofs).T.ravel()
    stiffness = csr_array(linear_elasticity(*material.lame).assemble(vector))[order][:, order]
    facets = hexahedra.facets_satisfying(lambda x: np.isclose(x[2], 0.0, atol=1e-9), boundaries_only=True)
    area = weight.assemble(FacetBasis(hexahedra, ElementHex1(), facets=facets, intorder=2))

    gradients = np.stack([field[0].grad for field in scalar.basis])
    volumes = scalar.dx.sum(axis=1)
    means = np.einsum("ciep,ep->eci", gradients, scalar.dx) / volumes[:, None, None]
    rows = np.repeat(np.arange(len(volumes)), 24)
    columns = (3 * mesh.cells[:, :, None] + np.arange(3)).ravel()
    volume_rate = csr_array((means.ravel(), (rows, columns)), shape=(len(volumes), 3 * len(points)))

    where = np.asarray(scalar.global_coordinates()) - centre[:, None, None]
    squares = material.density * np.einsum("iep,ep->i", where**2, scalar.dx)
    return ElasticBody(
        material=material,
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
    Translations and rotations of a body, orthonormal to the mass.

    Parameters
    ----------
    points : ndarray, shape (n, 3)
        Nodes relative to the centre of mass, in principal axes, m.
    node_mass : ndarray, shape (n,)
        kg.

    Returns
    -------
    modes : ndarray, shape (3n, 6)
        kg^-½: along x, y, z, then about x, y, z.
    """
    axes = np.eye(3)
    shapes = [np.broadcast_to(axis, points.shape) for axis in axes] + [np.cross(axis, points) for axis in axes]
    modes = np.stack([shape.ravel() for shape in shapes], axis=1)
    return np.asarray(modes / np.sqrt(np.repeat(node_mass, 3) @ modes**2))
