"""Closed forms to hold the engines against."""

from dataclasses import dataclass
from math import atan2, cosh, pi, sinh, sqrt, tan

import pytest


@dataclass(frozen=True)
class SymmetricResponse:
    """
    A harmonic response with two equal and opposite arcs a cycle.

    Attributes
    ----------
    phase : float
        Phase ω t of the base acceleration a sin ω t, rad, at which an arc with θ > 0 begins.
    velocity : float
        |θ'| just after each impact, rad/s; before it is 1/e times as large.
    """

    phase: float
    velocity: float


def _symmetric_responses(block, *, frequency_ratio, amplitude_ratio, restitution):
    """
    Symmetric harmonic responses of the linear model in closed form, stable or not, the larger velocity first.

    Parameters
    ----------
    block : Block
        Symmetric.
    frequency_ratio, amplitude_ratio : float
        Ω and A.
    restitution : float
        e > 0.

    Returns
    -------
    responses : list of SymmetricResponse
        None, one or two. Whether the angle keeps its sign over the arc and whether the response is stable is not asked.

    Raises
    ------
    ValueError
        If the block is not symmetric.

    Notes
    -----
    With F = A tan α/(α (1 + Ω²)), k = coth(π/2Ω), β the phase and v the velocity over α p, the arc's ends h = 0 at
    x = 0 and π/Ω and h'(π/Ω) = −v/e give

        F sin β = v (1 − 1/e)/(2 k),     F Ω cos β = v (1 + 1/e)/2 − 1/k,

    whose squares make a quadratic equation for v.
    """
    if not block.is_symmetric:
        raise ValueError("The block has unequal sides; a symmetric one was expected")
    alpha, e = block.critical_angle, restitution
    gain = amplitude_ratio * tan(alpha) / alpha / (1 + frequency_ratio**2)
    half = pi / frequency_ratio / 2
    k = cosh(half) / sinh(half)
    across, along = (1 - 1 / e) / (2 * k), (1 + 1 / e) / (2 * frequency_ratio)
    offset = 1 / (k * frequency_ratio)
    # (across v)² + (along v − offset)² = gain²
    square, middle, constant = across**2 + along**2, along * offset, offset**2 - gain**2
    discriminant = middle**2 - square * constant
    if discriminant < 0:
        return []
    roots = [(middle + sign * sqrt(discriminant)) / square for sign in (1, -1)]
    return [
        SymmetricResponse(atan2(across * v, along * v - offset) % (2 * pi), v * alpha * block.p) for v in roots if v > 0
    ]


@pytest.fixture(name="symmetric_responses", scope="session")
def symmetric_responses_of_the_linear_model():
    """Symmetric harmonic responses of the linear model in closed form."""
    return _symmetric_responses


@pytest.fixture
def interpreted(request, monkeypatch):
    """
    Run the kernels of some modules as the Python that they are written in: nothing is compiled for a few calls.

    The test's own names of them change too: a compiled kernel that calls interpreted ones cannot be compiled again.
    """

    def run(*modules):
        chosen = {module.__name__ for module in modules}
        for module in (*modules, request.module):
            for name, value in list(vars(module).items()):
                if hasattr(value, "py_func") and (module is not request.module or value.__module__ in chosen):
                    monkeypatch.setattr(module, name, value.py_func)

    return run
