from math import cosh, pi, sin, sinh, sqrt

import numpy as np
import pytest
from scipy.linalg import eigh
from scipy.optimize import brentq

from colonnade.dynamics.contact.elastic.assembly import assemble, rigid_modes
from colonnade.dynamics.contact.elastic.mesh import prism_mesh, round_mesh
from colonnade.dynamics.contact.elastic.reduction import reduce_body

WIDTH, HEIGHT, MASS = 0.086, 0.456, 26.10
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


@pytest.mark.parametrize("body", [PRISM, CONE], ids=["prism", "cone"])
def test_uniform_strain_has_its_energy_and_rate_of_volume_change(body):
    strain = np.array([[2.0, 0.3, -0.5], [0.3, -1.0, 0.7], [-0.5, 0.7, 0.4]]) * 1e-3
    displacement = (body.points @ strain).ravel()
    first, shear = body.material.lame
    density = 0.5 * first * np.trace(strain) ** 2 + shear * (strain**2).sum()
    volume = body.volumes.sum()
    assert 0.5 * displacement @ (body.stiffness @ displacement) == pytest.approx(density * volume, rel=1e-10)
    assert body.volume_rate @ displacement == pytest.approx(np.full(len(body.volumes), np.trace(strain)), rel=1e-9)


def test_a_brick_is_as_long_as_its_shortest_way_through():
    slab = assemble(prism_mesh(2.0, 1.0, 0.1, (1, 1, 1)), 1.0)
    assert slab.element_lengths == pytest.approx([0.1])


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
    speed = sqrt(200e9 / bar.material.density)
    expected = 2 * speed * elements / length * sin(mode * pi / (2 * elements))
    assert sqrt(squares[mode]) == pytest.approx(expected, rel=1e-10)


def timoshenko_free_free(width, length, material):
    """First bending frequency of a free square beam, rad/s (Huang 1961, J. Appl. Mech. 28, eq. 39; Cowper's κ)."""
    poisson = material.poisson_ratio
    kappa = 10 * (1 + poisson) / (12 + 11 * poisson)
    r = width / sqrt(12) / length
    s = r * sqrt(material.modulus / (kappa * material.lame[1]))

    def equation(b):
        root = sqrt((r * r - s * s) ** 2 + 4 / b**2)
        hyperbolic, circular = b * sqrt((root - r * r - s * s) / 2), b * sqrt((root + r * r + s * s) / 2)
        factor = b / sqrt(1 - (b * r * s) ** 2) * (b**2 * r**2 * (r**2 - s**2) ** 2 + 3 * r**2 - s**2)
        return 2 - 2 * cosh(hyperbolic) * np.cos(circular) + factor * sinh(hyperbolic) * sin(circular)

    return float(brentq(equation, 12.0, 22.5)) * sqrt(material.modulus / material.density) * r / length


def test_bending_converges_to_a_timoshenko_beam_nearly_with_the_square_of_the_brick():
    found = []
    for refinement in (1, 2, 3):
        mesh = prism_mesh(WIDTH, WIDTH, HEIGHT, (2 * refinement, 2 * refinement, 8 * refinement))
        body = assemble(mesh, MASS)
        found.append(reduce_body(body, vibration_modes=1).frequencies[0])
    limit = found[2] + (found[2] - found[1]) / ((3 / 2) ** 2 - 1)
    assert limit == pytest.approx(timoshenko_free_free(WIDTH, HEIGHT, body.material), rel=3e-3)
    # On 2 to 8 bricks across the order is 1.67: locking and lumped mass err in opposite directions.
    assert np.log2((found[0] - limit) / (found[1] - limit)) == pytest.approx(1.8, abs=0.25)
