"""Ensembles against propagation of error by hand, the spread of single runs, and themselves in other parts."""

import numpy as np
import pytest

from colonnade.dynamics.ensembles.ensemble import Plan, ensemble, gather, run_member, run_members
from colonnade.dynamics.ensembles.uncertainty import Uncertainty
from colonnade.dynamics.motion import Motion
from colonnade.dynamics.rock import rock
from prism import PRISM

ALPHA = PRISM.critical_angle
REST = Motion(np.zeros(700), 0.004)
PULSE = Motion(np.concatenate((2.0 * np.sin(2 * np.pi * np.arange(100) / 100), np.zeros(600))), 0.004)
SHAKEN = Motion(np.random.default_rng(8).standard_normal(1500).cumsum() * 0.05 * np.sin(np.arange(1500) * 0.06), 0.004)


def test_without_uncertainty_every_member_is_the_central_history():
    result = ensemble(PRISM, PULSE, restitution=0.97, uncertainty=Uncertainty(), count=5)
    np.testing.assert_allclose(result.bands, np.broadcast_to(result.central, result.bands.shape), atol=1e-6 * ALPHA)
    assert np.ptp(result.peak_ratio) == 0.0
    assert result.sensitivity() == {}


def test_the_band_of_free_rocking_grows_as_the_error_of_e_propagates():
    """First impact at a known time: then dθ/de = ω₁ sinh(p t)/p, exactly linear in e."""
    theta0, deviation = 0.5 * ALPHA, 0.004
    result = ensemble(
        PRISM,
        REST,
        restitution=0.9,
        uncertainty=Uncertainty(restitution=deviation),
        count=3000,
        theta0=theta0,
    )
    free = rock(PRISM, REST, restitution=0.9, theta0=theta0)
    first, after = free.impact_times[0], 0.04
    sample = int((first + after) / REST.dt)
    elapsed = result.time[sample] - first
    slope = abs(free.impact_velocities[0]) * np.sinh(PRISM.p * elapsed) / PRISM.p
    half = 1.9600 * deviation * slope
    low, high = result.bands[0, sample], result.bands[-1, sample]
    assert high - low == pytest.approx(2 * half, rel=0.05)
    assert (high + low) / 2 == pytest.approx(result.central[sample], abs=0.1 * half)
    before = int(0.9 * first / REST.dt)
    np.testing.assert_allclose(result.bands[:, :before], np.tile(result.central[:before], (5, 1)), atol=1e-6 * ALPHA)


def test_bands_are_the_quantiles_of_the_members_own_histories():
    uncertainty = Uncertainty(restitution=0.01, critical_angle=0.01, p=0.01, gain=0.02, noise=0.05, cutoff=25.0)
    plan = Plan(PRISM, SHAKEN, 0.95, uncertainty, count=200)
    result = gather(plan, [run_members(plan, 0, 200)], levels=(0.1, 0.5, 0.9))
    angles = np.array([run_member(plan, member)[1].angle for member in range(200)])
    exact = np.quantile(angles, (0.1, 0.5, 0.9), axis=0)
    spread = np.quantile(angles, 0.9, axis=0) - np.quantile(angles, 0.1, axis=0)
    # A quantile between two members may be any value between them, and lies in a bin an eighth wide.
    assert np.mean(np.abs(result.bands - exact) <= 0.08 * spread + 1e-5 * ALPHA) > 0.95


@pytest.mark.parametrize("model", ["linear", "nonlinear"])
def test_parts_run_anywhere_and_put_together_in_any_order_are_the_whole_bit_for_bit(model):
    uncertainty = Uncertainty(restitution=0.01, p=0.01, noise=0.05, cutoff=25.0, filter=0.1)
    plan = Plan(PRISM, PULSE, (0.95, 0.94), uncertainty, count=30, seed=7, model=model)
    whole = gather(plan, [run_members(plan, 0, 30)])
    parts = gather(plan, [run_members(plan, start, stop) for start, stop in ((17, 30), (0, 1), (1, 17))])
    for name in ("bands", "inputs", "peak_ratio", "overturning_time"):
        np.testing.assert_array_equal(getattr(whole, name), getattr(parts, name))


def test_a_missing_part_is_noticed():
    plan = Plan(PRISM, PULSE, 0.95, Uncertainty(p=0.01), count=10)
    with pytest.raises(ValueError, match="starts with member 5; 3 was expected"):
        gather(plan, [run_members(plan, 5, 10), run_members(plan, 0, 3)])
    with pytest.raises(ValueError, match="hold 5 members; 10"):
        gather(plan, [run_members(plan, 0, 5)])


def test_the_probability_of_overturning_is_that_of_the_factor_that_overturns():
    """The edge is known by bisection; a log-normal factor of known deviation passes it with a known probability."""
    low, high = 0.5, 3.0
    for _ in range(40):
        middle = (low + high) / 2
        outcome = rock(PRISM, Motion(middle * PULSE.acceleration, PULSE.dt), restitution=0.9).outcome
        low, high = (low, middle) if outcome == "overturned" else (middle, high)
    deviation = 0.001
    motion = Motion(low * np.exp(-0.5 * deviation) * PULSE.acceleration, PULSE.dt)  # half a deviation below the edge
    result = ensemble(PRISM, motion, restitution=0.9, uncertainty=Uncertainty(gain=deviation), count=2000)
    expected = 0.308538  # P(z > 0.5)
    below, above = result.overturning_interval(3.3)
    assert below < expected < above
    assert above - below < 0.08
    assert np.isinf(result.peak_quantiles((0.9,))).all()
    assert np.isnan(result.peak_ratio[np.isfinite(result.overturning_time)]).all()


def test_a_long_record_is_banded_on_every_second_sample():
    long = Motion(np.zeros(30_001), 0.001)
    result = ensemble(
        PRISM, long, restitution=0.9, uncertainty=Uncertainty(restitution=0.01), count=2, theta0=0.3 * ALPHA
    )
    assert result.time.size == 15_001
    assert result.time[1] == 0.002


def test_an_ensemble_of_nobody_is_refused():
    with pytest.raises(ValueError, match="at least one member"):
        ensemble(PRISM, PULSE, uncertainty=Uncertainty(), count=0)
