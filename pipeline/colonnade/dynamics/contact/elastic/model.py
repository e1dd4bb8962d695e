"""From a body's dimensions to its reduced elastic model, on meshes about as fine as the paper's three."""

from __future__ import annotations

from collections.abc import Mapping

from colonnade.dynamics.contact.body import ContactBody
from colonnade.dynamics.contact.elastic.assembly import STEELS_MODULUS, STEELS_POISSON_RATIO, ElasticBody, assemble
from colonnade.dynamics.contact.elastic.mesh import (
    PAPERS_DEGREES_OF_FREEDOM,
    Mesh,
    prism_divisions,
    prism_mesh,
    round_divisions,
    round_mesh,
)
from colonnade.dynamics.contact.elastic.reduction import reduce_body
from colonnade.dynamics.contact.elastic.rim import refine_rim
from colonnade.errors import nearest


def mesh_of(sizes: Mapping[str, float], mesh: str) -> Mesh:
    """
    Mesh a body by its outer dimensions.

    Parameters
    ----------
    sizes : mapping of str to float
        m; "width", "depth", "height" of a prism, "diameter", "height" of a cylinder, "base_diameter", "top_diameter",
        "height" of a truncated cone.
    mesh : {"coarse", "medium", "fine"}

    Returns
    -------
    mesh : Mesh
        With about the degrees of freedom of the paper's (Table 2).

    Raises
    ------
    ValueError
        If the mesh is unknown, or the dimensions are those of no known shape.
    """
    if mesh not in PAPERS_DEGREES_OF_FREEDOM:
        raise ValueError(f'Unknown mesh "{mesh}".{nearest(mesh, PAPERS_DEGREES_OF_FREEDOM)}')
    number = PAPERS_DEGREES_OF_FREEDOM[mesh]
    if sizes.keys() == {"width", "depth", "height"}:
        edges = sizes["width"], sizes["depth"], sizes["height"]
        return prism_mesh(*edges, prism_divisions(*edges, number))
    if sizes.keys() == {"diameter", "height"}:
        lengths = sizes["diameter"], sizes["diameter"], sizes["height"]
    elif sizes.keys() == {"base_diameter", "top_diameter", "height"}:
        lengths = sizes["base_diameter"], sizes["top_diameter"], sizes["height"]
    else:
        raise ValueError(f"The dimensions are {', '.join(sizes)}; those of a prism, a cylinder or a cone were expected")
    return round_mesh(*lengths, round_divisions(*lengths, number))


def meshed_body(
    sizes: Mapping[str, float],
    mass: float,
    *,
    mesh: str,
    modulus: float = STEELS_MODULUS,
    poisson_ratio: float = STEELS_POISSON_RATIO,
) -> ElasticBody:
    """Assemble a body of given mass (kg) from its dimensions; arguments and errors as for `mesh_of` and `assemble`."""
    return assemble(mesh_of(sizes, mesh), mass, modulus=modulus, poisson_ratio=poisson_ratio)


def elastic_body(
    sizes: Mapping[str, float],
    mass: float,
    *,
    mesh: str,
    modulus: float = STEELS_MODULUS,
    poisson_ratio: float = STEELS_POISSON_RATIO,
) -> ContactBody:
    """
    Build the reduced elastic body of given dimensions and mass.

    Parameters
    ----------
    sizes, mesh
        As of `mesh_of`.
    mass : float
        kg.
    modulus : float, optional
        Young's modulus, Pa.
    poisson_ratio : float, optional

    Returns
    -------
    body : ContactBody
        With all its modes; `keep_modes_for_step` leaves those that a step can follow.

    Raises
    ------
    ValueError
        If an argument is out of its range.
    """
    body = reduce_body(meshed_body(sizes, mass, mesh=mesh, modulus=modulus, poisson_ratio=poisson_ratio))
    return body if "width" in sizes else refine_rim(body)
