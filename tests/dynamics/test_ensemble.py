"""Ensembles against propagation of error by hand, the spread of single runs, and themselves in other parts."""

import numpy as np
import pytest

from colonnade.dynamics.ensemble import LEVELS, PlanePlan, ensemble
from colonnade.dynamics.motion import Motion
from colonnade.dynamics.rock import rock
from colonnade.dynamics.uncertainty import Uncertainty
from prism import PRISM

ALPHA = PRISM.critical_angle
REST = Motion(np.zeros(700), 0.004)
PULSE = Motion(np.concatenate((2.0 * np.sin(2 * np.pi * np.arange(100) / 100), np.zeros(600))), 0.004)
SHAKEN = Motion(np.random.default_rng(8).standard_normal(1500).cumsum() * 0.05 * np.sin(np.arange(1500) * 0.06), 0.004)


def test_without_uncertainty_every_member_is_the_central_history():
    result = ensemble(PRISM, PULSE, restitution=0.97, uncertainty=Uncertainty(), count=5)
    np.testing.assert_allclose(result.bands, np.broadcast_to(result.central, result.bands.shape), atol=1e-6 * ALPHA)
    assert np.ptp(result.peak_ratio) == 0.0


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
    plan = plan_of(restitution=0.01, critical_angle=0.01, p=0.01, gain=0.02, noise=0.05, cutoff=25.0)
    angles = np.array([plan.member(member)[1].angle for member in range(plan.count)])
    np.testing.assert_allclose(plan.run().bands, np.quantile(angles, LEVELS, axis=0), atol=1e-7 * ALPHA)


@pytest.mark.parametrize("model", ["linear", "nonlinear"])
def test_a_member_is_the_same_whatever_their_number_and_another_with_another_seed(model):
    few, many, other = (
        plan_of(count=count, seed=seed, model=model, restitution=0.01, p=0.01, noise=0.05, cutoff=25.0, filter=0.1)
        for count, seed in ((10, 7), (30, 7), (10, 8))
    )
    first, same, another = few.run(), many.run(), other.run()
    for name in ("inputs", "peak_ratio", "overturning_time", "histories"):
        np.testing.assert_array_equal(getattr(first, name), getattr(same, name)[:10])
    assert not np.isin(another.inputs[:, 0], first.inputs[:, 0]).any()


def plan_of(*, count=200, seed=0, model="nonlinear", motion=SHAKEN, **deviations):
    uncertainty = Uncertainty(**deviations)
    return PlanePlan(
        block=PRISM,
        motion=motion,
        restitution=(0.95, 0.94),
        uncertainty=uncertainty,
        count=count,
        seed=seed,
        model=model,
    )


@pytest.mark.parametrize("correlation", [-0.9, 0.0, 0.9])
def test_alpha_and_p_that_vary_together_spread_the_angle_as_errors_add_up(correlation):
    """A linear block falls from θ₀ as α + (θ₀ − α) cosh pt: its derivatives by ln α and ln p, to first order."""
    free = {"block": PRISM, "motion": REST, "restitution": 0.9, "theta0": 0.5 * ALPHA, "model": "linear"}
    deviations = (0.002, 0.002)
    both = Uncertainty(critical_angle=0.002, p=0.002, correlations=(0.0, 0.0, correlation))
    found = PlanePlan(**free, uncertainty=both, count=1500).run()
    sample = 45
    before = found.time[sample]
    assert before < rock(**free).impact_times[0]
    phase = PRISM.p * before
    slopes = ALPHA * (1 - np.cosh(phase)), -0.5 * ALPHA * phase * np.sinh(phase)
    parts = np.multiply(slopes, deviations)
    variance = parts @ [[1.0, correlation], [correlation, 1.0]] @ parts
    assert found.bands[-1, sample] - found.bands[0, sample] == pytest.approx(2 * 1.96 * variance**0.5, rel=0.08)


def test_the_peak_spreads_less_where_errors_of_alpha_and_p_cancel():
    """Before the first impact θ/α falls as α grows and grows with p: where both grow together, the peak stays."""
    half = Motion(np.concatenate((1.9 * np.sin(np.pi * np.arange(50) / 50), np.zeros(60))), 0.004)
    spreads = [
        np.std(plan_of(critical_angle=0.001, p=0.01, correlations=(0.0, 0.0, each), motion=half).run().peak_ratio)
        for each in (-0.95, 0.0, 0.95)
    ]
    assert spreads[0] > 1.2 * spreads[1] > 1.2 * 1.2 * spreads[2]


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
    assert abs(result.overturning_probability - expected) < 3.3 * np.sqrt(expected * (1 - expected) / 2000)
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
