"""Scatter of e as a part of the noise: products over frequencies, and the likelihood by the book."""

from dataclasses import replace

import numpy as np
import pytest

from colonnade.identification.restitution.fitting.mixture import SCATTERS
from colonnade.identification.restitution.fitting.noise import passed_power
from colonnade.identification.restitution.fitting.scatter_likelihood import explained, reduced, solve
from colonnade.identification.restitution.fitting.scatter_model import PASSED, LinearModel, SpectralModel

COUNT, IMPACTS, INTERVAL = 400, 8, 0.01
TIME = np.arange(COUNT) / COUNT
STEPS = (TIME[:, None] > (1 + np.arange(IMPACTS)) / (IMPACTS + 1)).astype(float)
FIXED = np.column_stack((STEPS.sum(axis=1), np.ones(COUNT)))


def model(*, interval=INTERVAL, cutoff=None):
    random = np.random.default_rng(4)
    values = 1e-3 * (FIXED[:, 0] + STEPS @ random.normal(size=IMPACTS)) + 3e-4 + random.normal(0.0, 1e-4, COUNT)
    return LinearModel(values, FIXED, STEPS, COUNT, 1e-16, interval, cutoff)


def by_frequencies(linear, first, second, knee):
    """Sum of products of transforms, shape (f,), weighted by the noise's power at each frequency."""
    size = 2 * COUNT
    frequency = np.fft.rfftfreq(size, INTERVAL)
    power = np.ones(frequency.size)
    if linear.cutoff_hz is not None:
        power = passed_power(frequency, linear.cutoff_hz, INTERVAL)
    kept, twice = power > PASSED, np.full(frequency.size, 2.0)
    twice[[0, -1]] = 1.0
    weight = kept * twice / size / (1 + knee / np.maximum(frequency, 0.5 / (COUNT * INTERVAL)))
    one, other = (np.fft.rfft(each, size, axis=0) / (np.sqrt(power) if of else 1.0) for each, of in (first, second))
    return float((weight * (one.conj() * other).real)[kept].sum())


@pytest.mark.parametrize("cutoff", [None, 20.0], ids=["unfiltered", "through a low-pass"])
def test_products_are_those_over_all_frequencies(cutoff):
    """Bands of 2 % of the frequency in which the noise is even leave less than a thousandth."""
    linear = model(cutoff=cutoff)
    transformed = SpectralModel(linear)
    values, mean = (linear.values, cutoff is not None), (FIXED[:, 0], False)
    for products in transformed.all_products():
        expected = by_frequencies(linear, values, mean, products.knee)
        assert products.outer[0, 1] * products.lengths[0] == pytest.approx(expected, rel=1e-3)
        assert products.inner[2, 5] == pytest.approx(
            by_frequencies(linear, (STEPS[:, 2], False), (STEPS[:, 5], False), products.knee), rel=1e-3
        )
        own, others = transformed.products_with(STEPS[:, [2]], products.knee)
        assert own[0, 0] == pytest.approx(products.inner[2, 2], rel=1e-9)
        np.testing.assert_allclose(others[0, 3:], products.inner[2], rtol=1e-9)


def test_the_volume_is_that_of_the_noises_covariance():
    """ln det of a stationary covariance: the sum of ln of the power at its frequencies."""
    for products in SpectralModel(model()).all_products():
        frequency = np.maximum(np.abs(np.fft.fftfreq(2 * COUNT, INTERVAL)), 0.5 / (COUNT * INTERVAL))
        expected = 0.5 * np.log(1 + products.knee / frequency).sum()
        assert products.volume == pytest.approx(expected, rel=1e-3)


def test_white_noise_in_frequencies_is_that_in_time():
    linear = model(interval=None)
    plain, _ = solve(reduced(SpectralModel(linear).all_products()))
    spectral, _ = solve(reduced([SpectralModel(replace(linear, interval=0.01)).white()]))
    np.testing.assert_allclose(spectral.centre, plain.centre, rtol=2e-5)
    np.testing.assert_allclose(spectral.error, plain.error, rtol=0.02)


NOISE = 1e-4


def scattered_model(seed, *, scatter=0.0, interval=None, mean=0.0, offset=3e-4):
    random = np.random.default_rng(seed)
    own = random.normal(0.0, scatter, IMPACTS) if scatter else np.zeros(IMPACTS)
    values = FIXED @ [mean, offset] + STEPS @ own + random.normal(0.0, NOISE, COUNT)
    return LinearModel(values, FIXED, STEPS, COUNT, 1e-16, interval, None)


def solved(linear):
    return solve(reduced(SpectralModel(linear).all_products()))


def chance(linear, columns):
    transformed = SpectralModel(linear)
    _, best = solve(reduced(transformed.all_products()))
    return explained(best, *transformed.products_with(columns, best.products.knee))


def by_the_book(linear, scatter, level):
    """Mean and its error by generalised least squares with the whole covariance."""
    covariance = level * np.eye(COUNT) + scatter**2 * linear.by_impact @ linear.by_impact.T
    weighted = np.linalg.solve(covariance, linear.fixed)
    inverse = np.linalg.inv(linear.fixed.T @ weighted)
    return (inverse @ weighted.T @ linear.values)[0], np.sqrt(inverse[0, 0])


@pytest.mark.parametrize("place", [0, 20, 35, 45])
def test_each_scatter_has_the_mean_of_generalised_least_squares(place):
    linear = scattered_model(3, scatter=2e-4, mean=1e-3)
    parts, best = solved(linear)
    # A scatter is tried as a share of the noise, whose level is then the likeliest.
    level = (parts.scatter[place] / SCATTERS[place]) ** 2 * leveled(parts, best, linear) if place else 1.0
    share = SCATTERS[place] ** 2 / leveled(parts, best, linear)
    centre, error = by_the_book(linear, np.sqrt(share * level), level)
    assert parts.centre[place] == pytest.approx(centre, rel=2e-5)
    if place:
        assert parts.error[place] == pytest.approx(error, rel=2e-5)


def leveled(parts, best, linear):
    """Level of the noise in whose unit the scatters are tried: what neither offset nor impacts explain."""
    columns = np.hstack((linear.fixed, linear.by_impact))
    left = linear.values - columns @ np.linalg.lstsq(columns, linear.values, rcond=None)[0]
    return left @ left / (parts.freedom - IMPACTS)


def test_the_likeliest_scatter_is_that_of_the_record():
    found = []
    for seed in range(30):
        parts, _ = solved(scattered_model(seed, scatter=3e-3))
        found.append(parts.scatter[np.argmax(parts.likelihood)])
    assert np.median(found) == pytest.approx(3e-3, rel=0.3)


def test_noise_of_power_one_over_f_is_told_from_white_noise():
    """Red noise from white: each frequency times the square root of 1 + knee / f."""
    linear, random = scattered_model(5, interval=0.01), np.random.default_rng(8)
    frequency = np.fft.rfftfreq(2 * COUNT, 0.01)
    shape = np.sqrt(1 + 5.0 / np.maximum(frequency, 0.1))
    red = np.fft.irfft(np.fft.rfft(random.normal(0, NOISE, 2 * COUNT)) * shape)[:COUNT]
    _, of_red = solved(replace(linear, values=red))
    _, of_white = solved(linear)
    assert of_white.products.knee == 0.0
    assert 1.0 < of_red.products.knee < 25.0


def test_the_covariance_is_that_of_generalised_least_squares():
    linear = scattered_model(6, scatter=1e-3)
    _, best = solved(linear)
    whole = best.level * np.eye(COUNT) + best.scatter**2 * STEPS @ STEPS.T
    expected = np.linalg.inv(FIXED.T @ np.linalg.solve(whole, FIXED))
    np.testing.assert_allclose(best.covariance(), expected, rtol=1e-6)


def test_columns_that_are_not_there_explain_as_much_as_chance_lets_them():
    columns = np.column_stack((np.sin(9 * TIME), np.cos(17 * TIME)))
    chances = []
    for seed in range(60):
        chances.append(chance(scattered_model(seed, scatter=1e-3), columns))
    assert 0.35 < np.mean(chances) < 0.65
    assert min(chances) > 1e-4


def test_a_column_that_is_there_is_not_chance():
    linear = scattered_model(7, scatter=1e-3)
    column = np.sin(9 * TIME)[:, None]
    assert chance(replace(linear, values=linear.values + 3 * NOISE * column[:, 0]), column) < 1e-9


@pytest.mark.parametrize("interval", [None, INTERVAL], ids=["white noise", "noise of every knee"])
def test_a_column_along_the_impacts_is_found_as_one_of_its_own(interval):
    """e that changes from impact to impact: as another column of X, wherever it is."""
    linear = replace(scattered_model(9, scatter=1e-3, mean=1e-3), interval=interval)
    direction = np.linspace(-0.5, 0.5, IMPACTS)
    within = reduced(SpectralModel(linear).all_products(), direction)
    along = (STEPS @ direction)[:, None]
    for order, fixed in (([2, 0, 1], np.hstack((along, FIXED))), ([0, 1, 2], np.hstack((FIXED, along)))):
        parts, _ = solve(within.of_columns(np.array(order)))
        expected, _ = solved(replace(linear, fixed=fixed))
        np.testing.assert_allclose(parts.centre, expected.centre, rtol=1e-2, atol=1e-7)
        np.testing.assert_allclose(parts.error, expected.error, rtol=1e-2)
