"""Overturning spectra of pulses against closed forms, published numbers and an independent integrator."""

import math

import numpy as np
import pytest
import scipy

from colonnade.dynamics.block import Block
from colonnade.dynamics.pulses import RICKER_REACH, mavroeidis_papageorgiou, overturning_spectrum, ricker
from colonnade.laboratory.table import TableMotion
from colonnade.laboratory.truth import simulate
from prism import PRISM

ALPHA = PRISM.critical_angle


def block_of(radius, angle):
    width, height = 2 * radius * math.sin(angle), 2 * radius * math.cos(angle)
    return Block.prism(width=width, depth=width, height=height, mass=1.0, gravity=9.80665)


def half_sine_limit(ratio):
    """Give a/(gα) of a half-sine: (ω/p) sin ψ − cos ψ = exp(−(p/ω)(π − ψ)), a/(gα) = 1/sin ψ."""
    phase = scipy.optimize.brentq(
        lambda psi: ratio * math.sin(psi) - math.cos(psi) - math.exp(-(math.pi - psi) / ratio), 1e-9, math.pi / 2
    )
    return 1 / math.sin(phase)


def test_half_sine_has_its_closed_form():
    ratios = [1, 2, 3, 4]
    found = overturning_spectrum(PRISM, "half-sine", frequency_ratio=ratios).lower * math.tan(ALPHA) / ALPHA
    np.testing.assert_allclose(found, [half_sine_limit(ratio) for ratio in ratios], atol=1e-9)
    np.testing.assert_allclose(found, [1.322397, 1.800724, 2.293872, 2.790798], atol=6e-7)


@pytest.mark.parametrize("length", [0.5, 1.0, 2.0])
def test_rectangular_pulse_has_its_closed_form(length):
    spectrum = overturning_spectrum(PRISM, "rectangular", frequency_ratio=[math.pi / length])
    expected = 1 / (1 - math.exp(-length))
    assert spectrum.lower[0] * math.tan(ALPHA) / ALPHA == pytest.approx(expected, abs=1e-9)
    assert spectrum.upper[0] == spectrum.lower[0]


@pytest.mark.parametrize(("length", "limit"), [(0.5, 2.54188), (1.0, 1.58219), (2.0, 1.15666)])
def test_nonlinear_rectangular_pulse_has_its_published_level(length, limit):  # Numerics-in-Motion
    block = block_of(1.0, 0.02)
    spectrum = overturning_spectrum(block, "rectangular", frequency_ratio=[math.pi / length], model="nonlinear")
    assert spectrum.lower[0] * math.tan(0.02) / 0.02 == pytest.approx(limit, abs=6e-6)


@pytest.mark.parametrize(
    ("radius", "limit"), [(0.25, 1.2618896), (0.5, 1.4584424), (1.0, 2.1637842), (2.0, 5.1549268), (4.0, math.nan)]
)
def test_nonlinear_sine_pulse_has_its_published_level(radius, limit):  # Numerics-in-Motion/blocks, ± 4.9e-6
    block = block_of(radius, 0.2)
    spectrum = overturning_spectrum(
        block, "sine", frequency_ratio=[4 * math.pi / block.p], model="nonlinear", largest=6.0
    )
    assert spectrum.lower[0] == pytest.approx(limit, abs=5e-6, nan_ok=True)


def random_case(number):
    """A pulse, a block and its e: half of the cases of each pulse and of each model."""
    drawn = np.random.default_rng(number)
    block = block_of(drawn.uniform(0.2, 5.0), drawn.uniform(0.08, 0.35))
    pulse, model = ("cosine", "ricker")[number % 2], ("linear", "nonlinear")[number // 2 % 2]
    return block, pulse, model, float(drawn.uniform(0.8, 0.98)), float(drawn.uniform(1.0, 5.0))


FINE = np.linspace(-2 * math.pi, 2 * math.pi, 400_001)
SIZE = np.abs(mavroeidis_papageorgiou(2.0, 0.5, FINE)).max()
INDEPENDENT = {
    "cosine": (math.pi, lambda angle: np.cos(angle + math.pi)),
    "ricker": (RICKER_REACH, ricker),
    "mavroeidis-papageorgiou": (
        2 * math.pi,
        lambda angle: mavroeidis_papageorgiou(2.0, 0.5, angle) / SIZE,
    ),
}
"""Reach of each pulse in ω t, and its shape."""


SLENDER = 1e-4
"""α at which the nonlinear equation is the linear one but for parts of α²."""


def independent(block, pulse, model, restitution, ratio, level):
    """Whether the virtual specimen overturns, by an integrator that shares nothing with the kernels."""
    (reach, shape), p, alpha = INDEPENDENT[pulse], block.p, block.critical_angle
    strength = level * math.tan(alpha)
    if model == "linear":
        strength *= SLENDER / alpha
        block = block_of(0.75 * 9.80665 / p**2, SLENDER)
    middle = reach / (ratio * p)

    def acceleration(piece, time):
        return strength * block.gravity * float(shape(np.float64(ratio * p * (time - middle))))

    table = TableMotion(tuple(np.linspace(0.0, 2 * middle, 33).tolist()), acceleration, np.zeros_like)
    return simulate(block, [2 * middle + 40 / p], table, restitution=restitution).outcome == "overturned"


def expect_both_limits(number):
    block, pulse, model, restitution, ratio = random_case(number)
    spectrum = overturning_spectrum(block, pulse, frequency_ratio=[ratio], model=model, restitution=restitution)
    limits = {float(limit) for limit in (spectrum.lower[0], spectrum.upper[0]) if math.isfinite(limit)}
    for limit in limits:
        found = [independent(block, pulse, model, restitution, ratio, limit + off) for off in (-1e-6, 1e-6)]
        assert found == [False, True], (number, limit)
    return len(limits)


@pytest.mark.parametrize("number", [0, 1, 2, 3])
def test_both_limits_of_a_pulse_are_those_of_an_independent_integrator(number):
    assert expect_both_limits(number) > 0


@pytest.mark.parametrize("model", ["linear", "nonlinear"])
def test_mavroeidis_and_papageorgious_limits_are_those_of_an_independent_integrator(model):
    pulse, e = "mavroeidis-papageorgiou", 0.9
    spectrum = overturning_spectrum(
        PRISM, pulse, frequency_ratio=[3.0], cycles=2.0, phase=0.5, model=model, restitution=e, largest=6.0
    )
    for limit in {spectrum.lower[0], spectrum.upper[0]}:
        assert [independent(PRISM, pulse, model, e, 3.0, limit + off) for off in (-1e-6, 1e-6)] == [False, True]


@pytest.mark.slow
def test_both_limits_of_a_pulse_are_those_of_an_independent_integrator_in_200_cases():
    assert sum(expect_both_limits(number) for number in range(200)) > 200


def test_an_island_is_kept_apart_from_the_limits():
    ratios = np.linspace(3.0, 3.6, 13)
    spectrum = overturning_spectrum(PRISM, "sine", frequency_ratio=ratios, width=0.05, restitution=0.9)
    assert (spectrum.interval_end > spectrum.interval_start).all()
    both = np.isfinite(spectrum.lower) & np.isfinite(spectrum.upper)
    assert (spectrum.lower[both] <= spectrum.upper[both]).all()
    assert both.any()
    assert (spectrum.islands[:, 2] - spectrum.islands[:, 1] < 0.05).all()


@pytest.mark.parametrize(
    ("pulse", "arguments", "message"),
    [
        ("sinus", {}, 'Unknown pulse "sinus"'),
        ("sine", {"model": "x"}, "Unknown plane model"),
        ("sine", {"edge": 0.0}, "edge"),
        ("sine", {"frequency_ratio": [-1.0]}, "frequency_ratio is -1.0; a number from"),
        ("mavroeidis-papageorgiou", {"cycles": 0.5}, "cycles is 0.5"),
    ],
)
def test_impossible_arguments_are_clear_errors(pulse, arguments, message):
    with pytest.raises(ValueError, match=message):
        overturning_spectrum(PRISM, pulse, **{"frequency_ratio": [1.0]} | arguments)
