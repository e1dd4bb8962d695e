"""The law of contact beside the closed forms of one mass on a spring and damper."""

import math

import numpy as np
import pytest

from colonnade.dynamics.block import Block
from colonnade.dynamics.contact.law import STATIC_PENETRATION, ContactLaw
from colonnade.dynamics.contact.nodes import rigid_body
from colonnade.dynamics.contact.simulate import simulate
from colonnade.dynamics.contact.start import Start
from colonnade.dynamics.motion import Motion
from every import every

SQUARE = Block.prism(width=0.5, depth=0.5, height=1.0, mass=2.0)

REBOUNDS = [  # Kelvin–Voigt contact that cannot pull (Schwager and Pöschel 2007)
    (0.01, 0.96926), (0.03, 0.91166), (0.05, 0.85876), (0.1, 0.74408), (0.2, 0.57174),
    (0.3, 0.45098), (0.5, 0.29844), (0.7, 0.21028), (0.9, 0.15528),
]  # fmt: skip


@every(("fraction", "ratio"), REBOUNDS)
def test_a_flat_drop_rebounds_as_one_mass_does(fraction, ratio):
    """Four equal nodes, each with a quarter of 2 kg, 5e5 N/m a node, 1 m/s, next to no gravity, 10 µs."""
    body = rigid_body(SQUARE, grid=(2, 2))
    law = ContactLaw(5e5 / body.node_area[0], damping_fraction=fraction, friction=0.0)
    start = Start(np.array([0.0, 0.0, 0.50137]), np.array([0.0, 0.0, -1.0]))
    history = simulate(body, Motion(np.zeros(3), 0.005), law=law, gravity=1e-9, step=1e-5, start=start)
    assert history.velocity[-1, 2] == pytest.approx(ratio, abs=1e-4)
    assert law.effective_damping(body) == pytest.approx(fraction)


def test_nodes_that_carry_half_an_element_have_the_effective_damping_of_their_mesh():
    element, height = 0.05, 1.0
    body = rigid_body(SQUARE)
    layer = body.node_area / body.node_area.sum() * SQUARE.mass * 0.5 * element / height
    mesh = type(body)(**{**vars(body), "node_mass": layer})
    law = ContactLaw(1e9, damping_fraction=0.4)
    assert law.effective_damping(mesh) == pytest.approx(0.4 * math.sqrt(element / (2 * height)))


def test_the_stiff_law_lets_bodies_of_all_sizes_sink_alike():
    for size in (0.1, 10.0):
        body = rigid_body(Block.prism(width=0.2 * size, depth=0.3 * size, height=size, mass=5.0))
        law = ContactLaw.stiff(body, 9.81)
        assert 5.0 * 9.81 / law.node_stiffness(body).sum() == pytest.approx(STATIC_PENETRATION * 0.5 * size, rel=1e-9)


@pytest.mark.parametrize(
    ("wrong", "message"),
    [
        ({"stiffness": 0.0}, "stiffness is 0.0; a positive number"),
        ({"stiffness": math.inf}, "stiffness is inf"),
        ({"damping_fraction": -0.1}, "damping_fraction is -0.1; a number from 0 on"),
        ({"friction": math.nan}, "friction is nan"),
        ({"tangential_ratio": 0.0}, "tangential_ratio is 0.0; a positive number"),
        ({"tangential_damping": math.inf}, "tangential_damping is inf"),
    ],
    ids=lambda value: next(iter(value)) if isinstance(value, dict) else "",
)
def test_a_law_that_cannot_be_is_refused(wrong, message):
    with pytest.raises(ValueError, match=message):
        ContactLaw(**{"stiffness": 1e9, **wrong})
