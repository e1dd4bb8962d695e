"""A body starts as deep in the table as bears its weight, tilted about its pole."""

import numpy as np
import pytest

from colonnade.dynamics.block import Block
from colonnade.dynamics.contact.body import STATIC_PENETRATION, ContactLaw, rigid_body, rotation_matrices
from on_contact import alone

GRAVITY = 9.81
PRISM = rigid_body(Block.prism(width=0.2, depth=0.3, height=0.9, mass=150.0))
CYLINDER = rigid_body(Block.cylinder(diameter=0.2, height=0.9, mass=70.0))


def law_of(body):
    return ContactLaw().bearing(body, GRAVITY)


def heights(body, start):
    """Of the nodes over the table."""
    return start.position[2] + body.nodes @ rotation_matrices(start.orientation[None])[0][2]


@pytest.mark.parametrize("tilts", [{}, {"theta0": 0.1}, {"theta0": -1e-6}, {"theta0": 0.05, "out_of_plane": -0.02}])
def test_the_springs_bear_the_weight(tilts):
    start, law = alone(PRISM, law_of(PRISM), GRAVITY, **tilts), law_of(PRISM)
    depths = np.maximum(-heights(PRISM, start), 0.0)
    assert law.node_stiffness(PRISM) @ depths == pytest.approx(PRISM.mass * GRAVITY, rel=1e-9)


@pytest.mark.parametrize("body", [PRISM, CYLINDER], ids=["nodes", "rings"])
def test_an_upright_body_is_as_deep_as_its_law_says(body):
    start = alone(body, law_of(body), GRAVITY)
    assert start.position[2] == pytest.approx(body.height * (1 - STATIC_PENETRATION), rel=1e-12)
    np.testing.assert_allclose(start.orientation, [1.0, 0.0, 0.0, 0.0])
    assert not start.angular_velocity.any()


@pytest.mark.parametrize("body", [PRISM, CYLINDER], ids=["nodes", "rings"])
@pytest.mark.parametrize("theta0", [0.15, -0.1])
def test_it_leans_about_the_pole_on_that_side(body, theta0):
    start = alone(body, law_of(body), GRAVITY, theta0=theta0, omega0=0.3)
    matrix = rotation_matrices(start.orientation[None])[0]
    assert np.arctan2(matrix[0, 2], matrix[2, 2]) == pytest.approx(theta0)
    pole = np.array([np.sign(theta0) * body.half_width, 0.0, -body.height])
    foot = start.position + matrix @ pole
    assert foot[0] == pytest.approx(pole[0])
    assert -1e-4 < foot[2] < 0.0
    still = start.velocity + np.cross(start.angular_velocity, matrix @ pole)
    np.testing.assert_allclose(still, 0.0, atol=1e-15)
    np.testing.assert_allclose(start.angular_velocity, [0.0, 0.3, 0.0])


def test_rotation_matrices_are_those_of_their_quaternions():
    half = 0.5 * np.array([0.3, -1.1, 2.0])
    about = np.zeros((3, 4))
    about[:, 0] = np.cos(half)
    about[range(3), range(1, 4)] = np.sin(half)
    for axis, matrix in enumerate(rotation_matrices(about)):
        after, last = (axis + 1) % 3, (axis + 2) % 3
        assert matrix[axis, axis] == pytest.approx(1.0)
        assert (matrix[after, after], matrix[last, after]) == pytest.approx(
            (np.cos(2 * half[axis]), np.sin(2 * half[axis]))
        )
    assert np.linalg.det(rotation_matrices(about)) == pytest.approx(1.0)
