from math import pi, sin

import numpy as np
import pytest

from colonnade.dynamics.contact.elastic.assembly import assemble
from colonnade.dynamics.contact.elastic.mesh import (
    prism_divisions,
    prism_mesh,
    round_divisions,
    round_mesh,
)

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
