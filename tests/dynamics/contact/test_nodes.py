"""Rigid bodies on nodes: areas, inertias, and the plane block found again in the body."""

import math
from dataclasses import replace

import numpy as np
import pytest

from colonnade.dynamics.block import Block
from colonnade.dynamics.contact.body import rigid_body
from colonnade.dynamics.contact.simulate import plane_block

PRISM = Block.prism(width=0.2, depth=0.3, height=0.9, mass=10.0)
CYLINDER = Block.cylinder(diameter=0.2, height=0.9, mass=10.0)
CONE = Block.cone(base_diameter=0.2, top_diameter=0.1, height=0.9, mass=10.0)
THIN = replace(PRISM.positive, inertia=PRISM.mass * PRISM.pole_distance**2)
BLOCKS = pytest.mark.parametrize("block", [PRISM, CYLINDER, CONE], ids=["prism", "cylinder", "cone"])


@BLOCKS
def test_the_body_rocks_in_the_plane_as_its_block_does(block):
    body = rigid_body(block)
    plane = plane_block(body, block.gravity)
    for name in ("critical_angle", "pole_distance", "inertia", "p", "restitution"):
        assert getattr(plane, name) == pytest.approx(getattr(block, name), rel=1e-12)


@BLOCKS
def test_nodes_share_the_area_and_the_mass_of_the_base_about_its_centre(block):
    body = rigid_body(block)
    assert body.node_area.sum() == pytest.approx(0.06 if block is PRISM else math.pi * 0.1**2)
    assert body.node_mass.sum() == pytest.approx(block.mass)
    points = body.nodes[body.ring_radii == 0.0]
    np.testing.assert_allclose(body.node_area[body.ring_radii == 0.0] @ points[:, :2], 0.0, atol=1e-12)
    assert body.frequencies.size == 0


@pytest.mark.parametrize("block", [CYLINDER, CONE], ids=["cylinder", "cone"])
def test_a_round_base_stands_on_whole_rings_with_the_area_about_them(block):
    body = rigid_body(block)
    assert body.ring_radii.tolist() == pytest.approx([0.025, 0.05, 0.075, 0.1])
    edges = np.array([0.0, 0.0375, 0.0625, 0.0875, 0.1])
    np.testing.assert_allclose(body.node_area, math.pi * np.diff(edges**2), rtol=1e-12)
    np.testing.assert_allclose(body.node_mass / block.mass, body.node_area / body.node_area.sum(), rtol=1e-12)
    assert "4 whole rings" in body.description


def test_inertias_of_prism_cylinder_and_cone():
    np.testing.assert_allclose(rigid_body(PRISM).inertia, 10 / 12 * np.array([0.09 + 0.81, 0.04 + 0.81, 0.04 + 0.09]))
    np.testing.assert_allclose(rigid_body(CYLINDER).inertia, [10 * (0.0025 + 0.0675)] * 2 + [10 * 0.005])
    # A whole cone, by its known formulas: 3/80 m (4 r² + h²), 3/10 m r².
    cone = Block.cone(base_diameter=0.2, top_diameter=1e-9, height=0.9, mass=10.0)
    transverse = 3 / 80 * 10 * (4 * 0.01 + 0.81)
    np.testing.assert_allclose(rigid_body(cone).inertia, [transverse, transverse, 0.3 * 10 * 0.01], rtol=1e-7)


def test_measured_values_that_replace_dimensions_are_those_of_the_body():
    body = rigid_body(CYLINDER.override(critical_angle=0.2, inertia=3.0))
    assert body.half_width == pytest.approx(CYLINDER.pole_distance * math.sin(0.2))
    assert body.inertia[0] == body.inertia[1] == pytest.approx(3.0 - 10.0 * CYLINDER.pole_distance**2)


def test_unequal_sides_have_their_own_half_widths():
    lopsided = PRISM.override(critical_angle=(0.21, 0.2))
    x = rigid_body(lopsided).nodes[:, 0]
    assert -x.min() == pytest.approx(lopsided.negative.half_width)
    assert x.max() == pytest.approx(lopsided.positive.half_width)


def test_a_body_without_shape_or_with_too_little_inertia_is_refused():
    with pytest.raises(ValueError, match="a prism, a cylinder or a cone was expected"):
        rigid_body(Block.measured(mass=80.0, pole_distance=0.61, critical_angle=0.21, inertia=41.2))
    with pytest.raises(ValueError, match="I₀ − m R² is"):
        rigid_body(replace(PRISM, negative=THIN, positive=THIN))
