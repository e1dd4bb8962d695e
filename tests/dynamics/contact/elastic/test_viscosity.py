from __future__ import annotations

import numpy as np
import pytest

from colonnade.dynamics.contact.elastic.assembly import assemble
from colonnade.dynamics.contact.elastic.mesh import prism_mesh
from colonnade.dynamics.contact.elastic.viscosity import linear_coefficients, modal_damping

BAR = assemble(prism_mesh(0.1, 0.1, 1.0, (1, 1, 10)), 78.0, poisson_ratio=0.0)


def test_coefficients_are_those_of_the_formula() -> None:
    speed = np.sqrt(200e9 / 7800)
    assert linear_coefficients(BAR) == pytest.approx(np.full(10, 0.06 * 7800 * speed * 0.1))
    assert not linear_coefficients(BAR, 0.0).any()


def test_a_bar_that_stretches_is_damped_by_b1_l_omega_over_2c() -> None:
    # With lumped masses and ν = 0 the modes of ten elements are cos(nπj/10), at 2c/L sin(nπ/20).
    number, level = np.arange(1, 11), np.rint((BAR.points[:, 2] + 0.5) * 10)
    shapes = np.zeros((len(BAR.points), 3, 10))
    shapes[:, 2] = np.cos(np.pi / 10 * np.outer(level, number))
    modes = shapes.reshape(-1, 10)
    modes /= np.sqrt(np.repeat(BAR.node_mass, 3) @ modes**2)
    speed = np.sqrt(200e9 / 7800)
    frequencies = 2 * speed / 0.1 * np.sin(np.pi * number / 20)
    assert np.einsum("im,im->m", modes, BAR.stiffness @ modes) == pytest.approx(frequencies**2)
    damping = modal_damping(BAR, modes, frequencies, 0.06)
    assert damping == pytest.approx(0.06 * 0.1 * frequencies / (2 * speed), rel=1e-9)


def test_a_bar_that_twists_is_not_damped() -> None:
    x, y, z = BAR.points.T
    twist = np.column_stack((-y * z, x * z, 0 * z)).reshape(-1, 1)
    assert modal_damping(BAR, twist, np.ones(1)) == pytest.approx([0.0], abs=1e-12)
