"""Elastic bodies: assembled, and reduced to their modes; the model and its viscosity."""

from math import cosh, pi, sin, sinh, sqrt

import numpy as np
import pytest
from scipy.linalg import eigh
from scipy.optimize import brentq

from colonnade.dynamics.block import Block
from colonnade.dynamics.contact.elastic import assemble, elastic_body, modal_damping, reduce_body, rigid_modes
from colonnade.dynamics.contact.mesh import prism_mesh, round_mesh

WIDTH, HEIGHT, MASS = 0.086, 0.456, 26.10
MODULUS, POISSON = 200e9, 0.3
SHEAR = MODULUS / 2.6
PRISM = assemble(prism_mesh(WIDTH, WIDTH, HEIGHT, (3, 2, 7)), MASS)
CONE = assemble(round_mesh(0.097, 0.0755, 0.480, (2, 1, 5)), 21.94)


@pytest.mark.parametrize("body", [PRISM, CONE], ids=["prism", "cone"])
def test_rigid_motion_costs_no_strain_energy(body):
    rigid = rigid_modes(body.points, body.node_mass)
    largest = abs(body.stiffness).max()
    assert abs(body.stiffness @ rigid).max() < 1e-12 * largest
    assert np.linalg.matrix_rank(body.stiffness.toarray(), tol=1e-9 * largest) == rigid.shape[0] - 6
    assert rigid.T @ (np.repeat(body.node_mass, 3)[:, None] * rigid) == pytest.approx(np.eye(6), abs=1e-12)


def test_a_prism_has_its_mass_centre_and_inertia():
    assert PRISM.node_mass.sum() == pytest.approx(MASS, rel=1e-12)
    assert PRISM.node_mass @ PRISM.points == pytest.approx(np.zeros(3), abs=1e-12)
    about_y, about_z = MASS / 12 * (WIDTH**2 + HEIGHT**2), MASS / 6 * WIDTH**2
    assert PRISM.inertia == pytest.approx([about_y, about_y, about_z], rel=1e-12)
    # Lumped at the ends of n equal bricks, L²/12 becomes L²/12 (1 + 2/n²).
    squares = MASS / 12 * np.array([WIDTH, WIDTH, HEIGHT]) ** 2 * (1 + 2 / np.array([3, 2, 7]) ** 2)
    lumped = PRISM.node_mass @ PRISM.points**2
    assert lumped.sum() - lumped == pytest.approx(squares.sum() - squares, rel=1e-12)


def test_a_cone_has_the_mass_and_centre_of_its_frustum():
    assert CONE.node_mass.sum() == pytest.approx(21.94, rel=1e-12)
    base, top = 0.097 / 2, 0.0755 / 2
    centre = 0.48 / 4 * (base**2 + 2 * base * top + 3 * top**2) / (base**2 + base * top + top**2)
    # Row sums put a tapering layer's mass a little off; Block.cone has the centre itself.
    assert -CONE.points[CONE.base, 2] == pytest.approx(centre, rel=2e-3)


@pytest.mark.parametrize(
    ("body", "area"),
    [(PRISM, WIDTH**2), (CONE, 4 * 0.0485**2 * sin(pi / 4))],
    ids=["prism", "octagon"],
)
def test_the_nodes_of_the_base_share_its_area(body, area):
    assert body.base_area.sum() == pytest.approx(area, rel=1e-12)
    assert (body.base_area > 0.0).all()


@pytest.mark.parametrize(("body", "volume"), [(PRISM, WIDTH**2 * HEIGHT), (CONE, None)], ids=["prism", "cone"])
def test_uniform_strain_has_its_energy(body, volume):
    strain = np.array([[2.0, 0.3, -0.5], [0.3, -1.0, 0.7], [-0.5, 0.7, 0.4]]) * 1e-3
    displacement = (body.points @ strain).ravel()
    first = 2 * SHEAR * POISSON / (1 - 2 * POISSON)
    density = 0.5 * first * np.trace(strain) ** 2 + SHEAR * (strain**2).sum()
    if volume is None:
        base, top = 0.0485, 0.03775
        volume = 0.48 / 3 * (base**2 + base * top + top**2) * 4 * sin(pi / 4)
    assert 0.5 * displacement @ (body.stiffness @ displacement) == pytest.approx(density * volume, rel=1e-10)


def test_a_brick_takes_by_its_rate_of_volume_change_and_its_shortest_way_through():
    slab = assemble(prism_mesh(2.0, 1.0, 0.1, (1, 1, 1)), 1560.0)
    velocity = (slab.points @ np.diag([1.0, 2.0, 3.0]) * 1e-3).ravel()
    speed = sqrt((2 * SHEAR * POISSON / (1 - 2 * POISSON) + 2 * SHEAR) / 7800)
    assert (slab.viscosity @ velocity) ** 2 == pytest.approx([0.06 * 7800 * speed * 0.1 * 0.006**2 * 0.2], rel=1e-9)


@pytest.mark.parametrize("mode", [1, 2, 5])
def test_a_bar_of_lumped_elements_has_their_closed_form_frequencies(mode):
    elements, length = 12, 2.0
    bar = assemble(prism_mesh(0.2, 0.2, length, (1, 1, elements)), 624.0, poisson_ratio=0.0)
    along = np.arange(2, bar.stiffness.shape[0], 3)
    lateral = np.add.outer(along, np.zeros(1, int)).ravel()
    # Plane sections along z only: the four nodes of a level move together.
    gather = np.kron(np.eye(elements + 1), np.ones((4, 1)))
    stiffness = gather.T @ bar.stiffness[lateral][:, lateral].toarray() @ gather
    squares = eigh(stiffness, np.diag(gather.T @ bar.node_mass), eigvals_only=True)
    speed = sqrt(MODULUS / 7800)
    expected = 2 * speed * elements / length * sin(mode * pi / (2 * elements))
    assert sqrt(squares[mode]) == pytest.approx(expected, rel=1e-10)


def timoshenko_free_free(width, length, density):
    """First bending frequency of a free square beam, rad/s (Huang 1961, J. Appl. Mech. 28, eq. 39; Cowper's κ)."""
    kappa = 10 * (1 + POISSON) / (12 + 11 * POISSON)
    r = width / sqrt(12) / length
    s = r * sqrt(MODULUS / (kappa * SHEAR))

    def equation(b):
        root = sqrt((r * r - s * s) ** 2 + 4 / b**2)
        hyperbolic, circular = b * sqrt((root - r * r - s * s) / 2), b * sqrt((root + r * r + s * s) / 2)
        factor = b / sqrt(1 - (b * r * s) ** 2) * (b**2 * r**2 * (r**2 - s**2) ** 2 + 3 * r**2 - s**2)
        return 2 - 2 * cosh(hyperbolic) * np.cos(circular) + factor * sinh(hyperbolic) * sin(circular)

    return float(brentq(equation, 12.0, 22.5)) * sqrt(MODULUS / density) * r / length


def test_bending_converges_to_a_timoshenko_beam_nearly_with_the_square_of_the_brick():
    found = []
    for refinement in (1, 2, 3):
        mesh = prism_mesh(WIDTH, WIDTH, HEIGHT, (2 * refinement, 2 * refinement, 8 * refinement))
        body = assemble(mesh, MASS)
        found.append(reduce_body(body, vibration_modes=1).frequencies[0])
    limit = found[2] + (found[2] - found[1]) / ((3 / 2) ** 2 - 1)
    assert limit == pytest.approx(timoshenko_free_free(WIDTH, HEIGHT, MASS / (WIDTH**2 * HEIGHT)), rel=3e-3)
    # On 2 to 8 bricks across the order is 1.67: locking and lumped mass err in opposite directions.
    assert np.log2((found[0] - limit) / (found[1] - limit)) == pytest.approx(1.8, abs=0.25)


COARSE_PRISM = assemble(prism_mesh(0.086, 0.086, 0.456, (2, 2, 6)), 26.10)
COARSE_CONE = assemble(round_mesh(0.097, 0.0755, 0.480, (2, 1, 4)), 21.94)
COARSE_BODIES = pytest.mark.parametrize("body", [COARSE_PRISM, COARSE_CONE], ids=["prism", "cone"])


def all_modes(body):
    """Every elastic mode of the mesh by a dense solver: shapes at the base (b, 3, m) and frequencies."""
    squares, modes = eigh(body.stiffness.toarray(), np.diag(np.repeat(body.node_mass, 3)))
    return modes[:, 6:].reshape(-1, 3, len(squares) - 6)[body.base], np.sqrt(squares[6:])


@COARSE_BODIES
def test_vibration_modes_are_the_meshs_own(body):
    _, frequencies = all_modes(body)
    reduced = reduce_body(body, vibration_modes=12)
    assert reduced.frequencies[:12] == pytest.approx(frequencies[:12], rel=1e-8)
    assert reduced.frequencies[-1] <= frequencies[-1] * (1 + 1e-8)
    assert (np.diff(reduced.frequencies) >= 0.0).all()


@COARSE_BODIES
@pytest.mark.parametrize("vibration_modes", [0, 6, 20])
def test_with_attachment_modes_the_base_is_as_flexible_as_the_mesh(body, vibration_modes):
    shapes, frequencies = all_modes(body)
    exact = np.einsum("ikm,jlm,m->ikjl", shapes, shapes, frequencies**-2.0)
    reduced = reduce_body(body, vibration_modes=vibration_modes)
    found = np.einsum("ikm,jlm,m->ikjl", reduced.modes, reduced.modes, reduced.frequencies**-2.0)
    assert found == pytest.approx(exact, abs=1e-6 * exact.max())


def test_vibration_and_attachment_modes_together_are_a_whole_basis_where_the_mesh_is_small():
    body = assemble(prism_mesh(0.1, 0.12, 0.4, (1, 1, 2)), 10.0)
    reduced = reduce_body(body, vibration_modes=28)
    elastic = reduced.modes.reshape(12, -1)
    rigid = rigid_modes(body.points, body.node_mass).reshape(-1, 3, 6)[body.base].reshape(12, 6)
    # All mass-normalised modes, rigid ones with them, add up to the inverse of the mass.
    assert elastic @ elastic.T + rigid @ rigid.T == pytest.approx(np.diag(np.repeat(1 / body.node_mass[body.base], 3)))


def test_damping_of_the_modes_grows_with_their_frequency():
    reduced = reduce_body(COARSE_PRISM)
    assert reduced.modal_damping.min() >= 0.0
    assert reduced.modal_damping[:10].max() < 0.2 * reduced.modal_damping.max()
    assert reduced.modal_damping.max() < 0.06


@pytest.mark.parametrize("count", [-1, 3 * len(COARSE_CONE.points) - 6])
def test_an_impossible_number_of_modes_is_refused(count):
    with pytest.raises(ValueError, match="0 to 248 were expected"):
        reduce_body(COARSE_CONE, vibration_modes=count)


SIZES = {"width": 0.086, "depth": 0.086, "height": 0.456}


@pytest.mark.parametrize(
    "block",
    [
        Block.prism(**SIZES, mass=26.1),
        Block.cylinder(diameter=0.097, height=0.455, mass=26.3),
        Block.cone(base_diameter=0.097, top_diameter=0.0755, height=0.48, mass=21.94),
    ],
    ids=["prism", "cylinder", "cone"],
)
def test_a_meshed_body_has_the_blocks_mass_and_inertia(block):
    body = elastic_body(block.solid, block.mass, degrees_of_freedom=1224)
    assert body.mass == pytest.approx(block.mass)
    about_pole = body.inertia[1] + body.mass * (body.half_width**2 + body.height**2)
    # The polygon of a coarse round mesh has its matter nearer to the axis than the disc.
    assert about_pole == pytest.approx(block.inertia, rel=0.01)
    assert body.frequencies.size > 0


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
