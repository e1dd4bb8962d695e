from dataclasses import replace
from math import pi, sin

import numpy as np
import pytest

from colonnade.dynamics.block import Block
from colonnade.dynamics.contact.body import ContactLaw, rigid_body
from colonnade.dynamics.contact.elastic import assemble, reduce_body
from colonnade.dynamics.contact.mesh import (
    mesh_of,
    prism_divisions,
    prism_mesh,
    refine_rim,
    round_divisions,
    round_mesh,
)
from colonnade.dynamics.contact.simulate import simulate
from colonnade.dynamics.contact.stability import keep_modes

PRISM = (0.086, 0.086, 0.456)
CYLINDER = (0.097, 0.097, 0.455)
CONE = (0.097, 0.0755, 0.480)


def faces_of(mesh):
    """How many bricks each face belongs to."""
    faces = {}
    for corners in ((0, 1, 4, 2), (0, 2, 6, 3), (0, 3, 5, 1), (2, 4, 7, 6), (1, 5, 7, 4), (3, 6, 7, 5)):
        for face in np.sort(mesh.cells[:, corners], axis=1).tolist():
            faces[tuple(face)] = faces.get(tuple(face), 0) + 1
    return faces


# Table 2 of the paper: 5478 and 20322 have no factors that make a grid of bricks.
@pytest.mark.parametrize(("asked", "found"), [(1224, 1224), (5478, 5481), (20322, 20328)])
def test_the_papers_prism_is_met_as_nearly_as_a_grid_can(asked, found):
    assert 3 * len(prism_mesh(*PRISM, prism_divisions(*PRISM, asked)).points) == found


@pytest.mark.parametrize("asked", [1224, 5478, 20322])
def test_round_bodies_come_within_one_per_cent_of_the_papers_numbers(asked):
    for dimensions in (CYLINDER, CONE):
        mesh = round_mesh(*dimensions, round_divisions(*dimensions, asked))
        assert 3 * len(mesh.points) == pytest.approx(asked, rel=0.01)


def test_divisions_of_a_flat_slab_still_exist():
    along_x, along_y, layers = prism_divisions(1.0, 1.0, 0.01, 300)
    assert layers >= 1
    assert along_x * along_y > 9


@pytest.mark.parametrize(
    "mesh",
    [
        prism_mesh(*PRISM, (3, 2, 4)),
        round_mesh(*CYLINDER, (2, 1, 3)),
        round_mesh(*CONE, (3, 2, 4)),
        round_mesh(*CONE, (1, 1, 1)),
    ],
    ids=["prism", "cylinder", "cone", "smallest"],
)
def test_bricks_fit_together_without_gaps(mesh):
    shared = np.array(list(faces_of(mesh).values()))
    assert shared.max() == 2
    assert 2 * (shared == 2).sum() + (shared == 1).sum() == 6 * len(mesh.cells)
    # Euler's relation of a ball divided into cells: vertices − edges + faces − cells = 1.
    pairs = ((0, 1), (0, 2), (0, 3), (1, 4), (1, 5), (2, 4), (2, 6), (3, 5), (3, 6), (4, 7), (5, 7), (6, 7))
    edges = {tuple(sorted(edge)) for pair in pairs for edge in mesh.cells[:, pair].tolist()}
    assert len(mesh.points) - len(edges) + shared.size - len(mesh.cells) == 1
    assert np.unique(mesh.cells).size == len(mesh.points)
    assert (mesh.points[mesh.base, 2] == 0.0).all()
    assert (mesh.points[:, 2] == 0.0).sum() == mesh.base.size


@pytest.mark.parametrize(("core", "rings"), [(1, 1), (2, 1), (4, 2), (6, 3)])
def test_a_round_body_stands_on_its_true_rim_and_has_its_polygons_volume(core, rings):
    base, top, height = CONE
    mesh = round_mesh(base, top, height, (core, rings, 3))
    radii = np.hypot(*mesh.points[mesh.base, :2].T)
    rim = 4 * core
    assert (np.isclose(radii, base / 2, rtol=1e-12)).sum() == rim
    assert radii.max() == pytest.approx(base / 2)
    frustum = height / 12 * (base**2 + base * top + top**2)
    body = assemble(mesh, 1.0)
    assert (body.volumes > 0.0).all()
    assert body.volumes.sum() == pytest.approx(frustum * rim / 2 * sin(2 * pi / rim), rel=1e-12)


GRAVITY = 9.81
SIZES = {"diameter": 0.097, "height": 0.455}
COLUMN = Block.cylinder(**SIZES, mass=26.30, gravity=GRAVITY)


@pytest.fixture(scope="module")
def meshed():
    """The coarse mesh of the cylinder with the eight nodes of its rim."""
    return reduce_body(assemble(mesh_of(SIZES, 1224), COLUMN.mass))


def test_area_mass_and_stiffness_are_spread_and_the_meshs_nodes_stay(meshed):
    fine = refine_rim(meshed, 100)
    on_rim = np.isclose(np.hypot(*fine.nodes[:, :2].T), 0.0485, rtol=1e-9)
    assert on_rim.sum() == 104  # the next multiple of 8
    assert fine.node_area.sum() == pytest.approx(meshed.node_area.sum(), rel=1e-12)
    assert fine.node_mass.sum() == pytest.approx(meshed.node_mass.sum(), rel=1e-12)
    law = ContactLaw.stiff(meshed, GRAVITY, penetration=1e-6)
    assert law.effective_damping(fine) == pytest.approx(law.effective_damping(meshed), rel=1e-9)
    for node, modes in zip(meshed.nodes, meshed.modes, strict=True):
        same = np.argmin(np.abs(fine.nodes - node).sum(axis=1))
        np.testing.assert_allclose(fine.nodes[same], node, atol=1e-12)
        np.testing.assert_allclose(fine.modes[same], modes, rtol=0, atol=1e-12)


def test_modes_are_linear_between_the_nodes_of_the_mesh(meshed):
    fine = refine_rim(meshed, 16)
    modes = fine.modes[-16:]  # all around: one of the mesh, one between
    assert np.ptp(np.hypot(*fine.nodes[-16:, :2].T)) < 1e-12
    np.testing.assert_allclose(modes[1::2], 0.5 * (modes[0::2] + np.roll(modes[0::2], -1, axis=0)), atol=1e-12)


def test_an_elastic_cylinder_stays_in_its_plane_as_its_rim_gets_nodes(meshed):
    """Released with a rotation about x of 0.25 % of α, which stays what it is on a whole rim."""
    elastic = keep_modes(meshed, meshed.frequencies[6])
    law = ContactLaw.stiff(meshed, GRAVITY, penetration=1e-6)
    largest = []
    for body in (elastic, refine_rim(elastic, 72), refine_rim(elastic)):
        history = simulate(
            body,
            law=law,
            gravity=GRAVITY,
            theta0=0.5 * COLUMN.critical_angle,
            out_of_plane=0.0025 * COLUMN.critical_angle,
            duration=0.8,
            step=1e-5,
        )
        largest.append(np.abs(history.out_of_plane_angle).max() / COLUMN.critical_angle)
    print(largest)
    assert largest[0] > 0.1
    assert largest[0] > 5.0 * largest[1]
    assert largest[2] < 0.005


def test_a_body_without_a_rim_is_refused(meshed):
    prism = rigid_body(Block.prism(width=0.2, depth=0.3, height=0.9, mass=10.0), grid=(2, 1))
    with pytest.raises(ValueError, match="The rim has 2 nodes"):
        refine_rim(replace(prism, description="a line"))
