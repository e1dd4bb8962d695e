from __future__ import annotations

import numpy as np
import pytest

from colonnade.dynamics.contact.assembly import assemble
from colonnade.dynamics.contact.mesh import prism_mesh
from colonnade.dynamics.contact.viscosity import (
    NO_VISCOSITY,
    BulkViscosity,
    linear_coefficients,
    modal_damping,
    quadratic_coefficients,
    stable_step,
)

BAR = assemble(prism_mesh(0.1, 0.1, 1.0, (1, 1, 10)), 78.0, poisson_ratio=0.0)


def test_coefficients_are_those_of_the_formula() -> None:
    speed = np.sqrt(200e9 / 7800)
    assert linear_coefficients(BAR, BulkViscosity()) == pytest.approx(np.full(10, 0.06 * 7800 * speed * 0.1))
    assert quadratic_coefficients(BAR, BulkViscosity()) == pytest.approx(np.full(10, 7800 * 0.12**2))
    assert not linear_coefficients(BAR, NO_VISCOSITY).any()


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
    damping = modal_damping(BAR, modes, frequencies, BulkViscosity(linear=0.06))
    assert damping == pytest.approx(0.06 * 0.1 * frequencies / (2 * speed), rel=1e-9)


def test_a_bar_that_twists_is_not_damped() -> None:
    x, y, z = BAR.points.T
    twist = np.column_stack((-y * z, x * z, 0 * z)).reshape(-1, 1)
    assert modal_damping(BAR, twist, np.ones(1), BulkViscosity()) == pytest.approx([0.0], abs=1e-12)


@pytest.mark.parametrize("damping", [0.0, 0.06, 0.4, 1.5])
def test_a_step_just_below_the_stable_one_decays_and_one_just_above_grows(damping: float) -> None:
    def growth(step: float) -> float:
        # v⁺ = v − h (ω² x + 2 ζ ω v), x⁺ = x + h v⁺ with ω = 1.
        scheme = np.array([[1 - step**2, step * (1 - 2 * damping * step)], [-step, 1 - 2 * damping * step]])
        return float(abs(np.linalg.eigvals(scheme)).max())

    largest = stable_step(1.0, damping)
    assert growth(0.999 * largest) <= 1 + 1e-9
    assert growth(1.001 * largest) > 1 + 1e-4


def test_negative_viscosity_is_refused() -> None:
    with pytest.raises(ValueError, match="numbers from 0 on were expected"):
        BulkViscosity(linear=-0.1)
