"""Elastic bodies reduced to their modes: the model and its viscosity."""

import numpy as np
import pytest
from scipy.linalg import eigh

from colonnade.dynamics.block import Block
from colonnade.dynamics.contact.elastic.assembly import assemble, rigid_modes
from colonnade.dynamics.contact.elastic.mesh import mesh_of, prism_mesh, round_mesh
from colonnade.dynamics.contact.elastic.reduction import (
    elastic_body,
    modal_damping,
    reduce_body,
)

PRISM = assemble(prism_mesh(0.086, 0.086, 0.456, (2, 2, 6)), 26.10)
CONE = assemble(round_mesh(0.097, 0.0755, 0.480, (2, 1, 4)), 21.94)
BODIES = pytest.mark.parametrize("body", [PRISM, CONE], ids=["prism", "cone"])


def point_flexibility(body):
    """Displacement of each base node under a unit force on itself, by the modes alone, m/N, shape (n, 3)."""
    return np.asarray(np.einsum("nkm,m->nk", body.modes**2, body.frequencies**-2.0))


def all_modes(body):
    """Every elastic mode of the mesh by a dense solver: shapes at the base (b, 3, m) and frequencies."""
    squares, modes = eigh(body.stiffness.toarray(), np.diag(np.repeat(body.node_mass, 3)))
    return modes[:, 6:].reshape(-1, 3, len(squares) - 6)[body.base], np.sqrt(squares[6:])


@BODIES
def test_vibration_modes_are_the_meshs_own(body):
    _, frequencies = all_modes(body)
    reduced = reduce_body(body, vibration_modes=12)
    assert reduced.frequencies[:12] == pytest.approx(frequencies[:12], rel=1e-8)
    assert reduced.frequencies[-1] <= frequencies[-1] * (1 + 1e-8)
    assert (np.diff(reduced.frequencies) >= 0.0).all()


@BODIES
@pytest.mark.parametrize("vibration_modes", [0, 6, 20])
def test_with_attachment_modes_the_base_is_as_flexible_as_the_mesh(body, vibration_modes):
    shapes, frequencies = all_modes(body)
    exact = np.einsum("ikm,jlm,m->ikjl", shapes, shapes, frequencies**-2.0)
    reduced = reduce_body(body, vibration_modes=vibration_modes)
    found = np.einsum("ikm,jlm,m->ikjl", reduced.modes, reduced.modes, reduced.frequencies**-2.0)
    assert found == pytest.approx(exact, abs=1e-6 * exact.max())
    assert point_flexibility(reduced) == pytest.approx(np.einsum("ikik->ik", exact), rel=1e-6)


def test_vibration_and_attachment_modes_together_are_a_whole_basis_where_the_mesh_is_small():
    body = assemble(prism_mesh(0.1, 0.12, 0.4, (1, 1, 2)), 10.0)
    reduced = reduce_body(body, vibration_modes=28)
    elastic = reduced.modes.reshape(12, -1)
    rigid = rigid_modes(body.points, body.node_mass).reshape(-1, 3, 6)[body.base].reshape(12, 6)
    # All mass-normalised modes, rigid ones with them, add up to the inverse of the mass.
    assert elastic @ elastic.T + rigid @ rigid.T == pytest.approx(np.diag(np.repeat(1 / body.node_mass[body.base], 3)))


def test_damping_of_the_modes_grows_with_their_frequency():
    reduced = reduce_body(PRISM)
    assert reduced.modal_damping.min() >= 0.0
    assert reduced.modal_damping[:10].max() < 0.2 * reduced.modal_damping.max()
    assert reduced.modal_damping.max() < 0.06


def test_the_same_mesh_gives_the_same_modes():
    once, again = reduce_body(CONE), reduce_body(CONE)
    assert (once.modes == again.modes).all()


@pytest.mark.parametrize("count", [-1, 3 * len(CONE.points) - 6])
def test_an_impossible_number_of_modes_is_refused(count):
    with pytest.raises(ValueError, match="0 to 248 were expected"):
        reduce_body(CONE, vibration_modes=count)


SIZES = {"width": 0.086, "depth": 0.086, "height": 0.456}


@pytest.mark.parametrize(
    ("sizes", "block"),
    [
        (SIZES, Block.prism(**SIZES, mass=26.1)),
        ({"diameter": 0.097, "height": 0.455}, Block.cylinder(diameter=0.097, height=0.455, mass=26.3)),
        (
            {"base_diameter": 0.097, "top_diameter": 0.0755, "height": 0.48},
            Block.cone(base_diameter=0.097, top_diameter=0.0755, height=0.48, mass=21.94),
        ),
    ],
    ids=["prism", "cylinder", "cone"],
)
def test_a_meshed_body_has_the_blocks_mass_and_inertia(sizes, block):
    body = elastic_body(sizes, block.mass, degrees_of_freedom=1224)
    assert body.mass == pytest.approx(block.mass)
    about_pole = body.inertia[1] + body.mass * (body.half_width**2 + body.height**2)
    # The polygon of a coarse round mesh has its matter nearer to the axis than the disc.
    assert about_pole == pytest.approx(block.inertia, rel=0.01)
    assert body.frequencies.size > 0


def test_what_cannot_be_meshed_is_refused():
    with pytest.raises(ValueError, match="dimensions"):
        mesh_of({"height": 1.0}, 1224)


BAR = assemble(prism_mesh(0.1, 0.1, 1.0, (1, 1, 10)), 78.0, poisson_ratio=0.0)


def test_a_bar_that_stretches_is_damped_by_b1_l_omega_over_2c():
    # With lumped masses and ν = 0 the modes of ten elements are cos(nπj/10), at 2c/L sin(nπ/20).
    number, level = np.arange(1, 11), np.rint((BAR.points[:, 2] + 0.5) * 10)
    shapes = np.zeros((len(BAR.points), 3, 10))
    shapes[:, 2] = np.cos(np.pi / 10 * np.outer(level, number))
    modes = shapes.reshape(-1, 10)
    modes /= np.sqrt(np.repeat(BAR.node_mass, 3) @ modes**2)
    speed = np.sqrt(200e9 / 7800)
    frequencies = 2 * speed / 0.1 * np.sin(np.pi * number / 20)
    assert np.einsum("im,im->m", modes, BAR.stiffness @ modes) == pytest.approx(frequencies**2)
    damping = modal_damping(BAR, modes, frequencies)
    assert damping == pytest.approx(0.06 * 0.1 * frequencies / (2 * speed), rel=1e-9)


def test_a_bar_that_twists_is_not_damped():
    x, y, z = BAR.points.T
    twist = np.column_stack((-y * z, x * z, 0 * z)).reshape(-1, 1)
    assert modal_damping(BAR, twist, np.ones(1)) == pytest.approx([0.0], abs=1e-12)
