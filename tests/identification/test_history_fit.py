"""e of a whole history: the truth within its interval, and disagreement with the peaks where the block is another."""

from __future__ import annotations

from functools import cache

import numpy as np
import pytest
from scipy.signal import butter, lfilter, sosfiltfilt

from colonnade.dynamics.block import Block
from colonnade.dynamics.rock import rock
from colonnade.identification.history_fit import fit_history
from colonnade.identification.restitution import Peaks, Restitution, identify_restitution

PRISM = Block.prism(width=0.086, depth=0.086, height=0.456, mass=26.10)
ALPHA = PRISM.critical_angle
RATE = 500.0
NOISE = 1e-3 * ALPHA


def decay(restitution, *, model="nonlinear", released=0.6, duration=16.0, block=PRISM):
    history = rock(block, restitution=restitution, theta0=released * ALPHA, duration=duration, model=model)
    time = np.arange(0.0, duration, 1 / RATE)
    return time, np.interp(time, history.time, history.angle)


def white(rng, size):
    return rng.normal(0, NOISE, size)


def filtered(rng, size):
    return sosfiltfilt(butter(4, 25.0, fs=RATE, output="sos"), rng.normal(0, NOISE, size))


def slow(rng, size):
    memory = np.exp(-1 / (0.5 * RATE))
    return lfilter([np.sqrt(1 - memory**2)], [1, -memory], rng.normal(0, NOISE, size))


@pytest.mark.parametrize("model", ["linear", "nonlinear"])
@pytest.mark.parametrize("restitution", [0.85, 0.93, 0.976, 0.99])
def test_the_truth_is_found_by_the_model_that_made_it(model, restitution):
    time, angle = decay(restitution, model=model)
    fit = fit_history(time, angle + 3e-4 * ALPHA, PRISM, identify_restitution(time, angle, PRISM), model=model)
    assert fit.value == pytest.approx(restitution, abs=1e-5)
    assert fit.residual < 1e-4 * ALPHA


def test_an_e_above_the_rigid_bodys_is_not_held_back():
    time, angle = decay(0.99)
    fit = fit_history(time, angle, PRISM, identify_restitution(time, angle, PRISM))
    assert fit.low > PRISM.restitution == pytest.approx(0.9485, abs=1e-4)


@cache
def fitted_with(noise):
    """Fits of one true history under thirty seeds of a noise."""
    time, angle = decay(0.95, duration=10.0)
    fits = []
    for seed in range(30):
        seen = angle + noise(np.random.default_rng(seed), time.size)
        fits.append(fit_history(time, seen, PRISM, identify_restitution(time, seen, PRISM)))
    return fits


@pytest.mark.parametrize("noise", [white, filtered, slow], ids=["white", "filtered", "correlated over half a second"])
def test_intervals_hold_the_truth_however_the_noise_is_correlated(noise):
    fits = fitted_with(noise)
    assert sum(fit.low <= 0.95 <= fit.high for fit in fits) >= 26
    assert abs(np.mean([fit.value for fit in fits]) - 0.95) < 1e-5
    ratio = np.mean([fit.standard_error for fit in fits]) / np.std([fit.value for fit in fits])
    assert 0.7 < ratio < 2.5


def test_correlated_noise_of_the_same_size_scatters_the_value_more_and_is_told_to():
    independent, correlated = fitted_with(white), fitted_with(slow)
    assert np.std([fit.value for fit in correlated]) > 2 * np.std([fit.value for fit in independent])
    errors = [np.mean([fit.standard_error for fit in fits]) for fits in (independent, correlated)]
    assert errors[1] > 2 * errors[0]


@pytest.mark.parametrize(("factor", "warned"), [(1.0, False), (1.005, False), (1.05, True)])
def test_a_wrong_inertia_is_told_by_the_whole_history_and_not_seen_by_the_peaks(factor, warned):
    time, angle = decay(0.976)
    angle = angle + white(np.random.default_rng(0), time.size)
    assumed = PRISM.override(inertia=factor * PRISM.inertia)
    peaks = identify_restitution(time, angle, assumed)
    fit = fit_history(time, angle, assumed, peaks)
    assert peaks.value == pytest.approx(0.976, abs=1e-5)
    assert ("dimensions and mass" in fit.disagreement(peaks)) == warned


def test_missing_samples_are_passed_over():
    time, angle = decay(0.95)
    angle[2000:2040] = np.nan
    fit = fit_history(time, angle, PRISM, identify_restitution(time, angle, PRISM))
    assert fit.value == pytest.approx(0.95, abs=1e-5)


def test_what_cannot_be_fitted_has_a_reason_and_no_value():
    time, angle = decay(0.95)
    refused = Restitution(None, None, None, None, 0.95, "", "too few")
    assert "no value to start from" in fit_history(time, angle, PRISM, refused).reason
    found = identify_restitution(time, angle, PRISM)
    few = Restitution(
        found.value, found.low, found.high, found.standard_error, found.level, "",
        peaks=Peaks(*(getattr(found.peaks, name)[:4] for name in vars(found.peaks))),
    )  # fmt: skip
    assert "4 arcs are too few" in fit_history(time, angle, PRISM, few).reason
    rng = np.random.default_rng(1)
    other = fit_history(time, np.where(time > 2.0, rng.normal(0, 0.2 * ALPHA, time.size), angle), PRISM, found)
    assert other.value is None
    assert "is left over" in other.reason
