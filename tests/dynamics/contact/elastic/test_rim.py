"""The rim of a meshed round body: more nodes than the mesh has, the same body."""

from dataclasses import replace

import numpy as np
import pytest

from colonnade.dynamics.block import Block
from colonnade.dynamics.contact.body import ContactLaw, rigid_body
from colonnade.dynamics.contact.elastic.assembly import assemble
from colonnade.dynamics.contact.elastic.mesh import mesh_of, refine_rim
from colonnade.dynamics.contact.elastic.reduction import reduce_body
from colonnade.dynamics.contact.simulate import simulate
from colonnade.dynamics.contact.stability import keep_modes

GRAVITY = 9.81
SIZES = {"diameter": 0.097, "height": 0.455}
CYLINDER = Block.cylinder(**SIZES, mass=26.30, gravity=GRAVITY)
ALPHA = CYLINDER.critical_angle


@pytest.fixture(scope="module")
def meshed():
    """The coarse mesh of the cylinder with the eight nodes of its rim."""
    return reduce_body(assemble(mesh_of(SIZES, 1224), CYLINDER.mass))


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
            body, law=law, gravity=GRAVITY, theta0=0.5 * ALPHA, out_of_plane=0.0025 * ALPHA, duration=0.8, step=1e-5
        )
        largest.append(np.abs(history.out_of_plane).max() / ALPHA)
    print(largest)
    assert largest[0] > 0.1
    assert largest[0] > 5.0 * largest[1]
    assert largest[2] < 0.005


def test_a_body_without_a_rim_is_refused(meshed):
    prism = rigid_body(Block.prism(width=0.2, depth=0.3, height=0.9, mass=10.0), grid=(2, 1))
    with pytest.raises(ValueError, match="The rim has 2 nodes"):
        refine_rim(replace(prism, description="a line"))
