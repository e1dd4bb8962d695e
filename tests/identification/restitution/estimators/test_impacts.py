"""e impact by impact."""

import numpy as np
import pytest

from colonnade.identification.restitution.arcs.arcs import Arcs
from colonnade.identification.restitution.arcs.rocking_arc import free_arcs
from colonnade.identification.restitution.estimators.impact_by_impact import ImpactByImpact
from prism import PRISM

ALPHA = PRISM.critical_angle
ANGLE_ERROR = 2e-4 * ALPHA


def made(restitution, seed=None):
    """Arcs of exact rocking with e of each impact given, their peaks with errors."""
    count = len(restitution) + 1
    peaks, times, ends = free_arcs(
        np.array(restitution), 0.6 * ALPHA, 0.5, 1, np.full(2, ALPHA), np.full(2, PRISM.p), count, False
    )
    noise = np.zeros(count) if seed is None else np.random.default_rng(seed).normal(0, ANGLE_ERROR, count)
    starts = np.append(2 * times[0] - ends[0], ends[:-1])
    signed = peaks * (-1.0) ** np.arange(count) + noise
    errors = np.full(count, 1e-4)
    return Arcs(starts, ends, times, signed, np.full(count, ANGLE_ERROR), starts, ends, errors, errors, 0 * errors)


def judged(arcs):
    fit = ImpactByImpact().fit_arcs(arcs, 0.0, np.ones(arcs.start.size, dtype=bool), PRISM)
    return fit.impacts, fit.estimate, fit.constancy


def test_each_impact_has_its_own_e():
    truth = [0.95, 0.93, 0.96, 0.94, 0.95]
    singles, _, _ = judged(made(truth))
    np.testing.assert_allclose(singles.restitution, truth, rtol=1e-10)
    assert (np.diff(singles.velocity) < 0).all()


def test_a_constant_e_is_found_constant_within_its_errors():
    held, steep, scatter = 0, 0, []
    for seed in range(60):
        singles, estimate, constancy = judged(made([0.95] * 15, seed))
        held += estimate.low <= 0.95 <= estimate.high
        steep += abs(constancy.slope) > 3 * constancy.slope_standard_error
        scatter.append(constancy.scatter / np.median(singles.restitution_standard_error))
    assert held >= 53
    assert steep <= 2
    assert np.median(scatter) < 0.5


def test_an_e_that_falls_with_velocity_has_its_slope():
    restitution, peak = [], 0.6 * ALPHA
    for _ in range(15):
        speed = PRISM.p * np.sqrt(4 * np.sin(ALPHA - peak / 2) * np.sin(peak / 2))
        restitution.append(0.97 - 0.03 * speed)
        peaks, *_ = free_arcs(np.array(restitution), 0.6 * ALPHA, 0.0, 1, np.full(2, ALPHA), np.full(2, PRISM.p),
                              len(restitution) + 1, False)  # fmt: skip
        peak = peaks[-1]
    _, _, constancy = judged(made(restitution, 3))
    assert constancy.slope == pytest.approx(-0.03, abs=4 * constancy.slope_standard_error)
    assert abs(constancy.slope) > 5 * constancy.slope_standard_error


def test_scatter_from_impact_to_impact_is_told_apart_from_errors():
    truth = np.random.default_rng(5).normal(0.95, 0.01, 20)
    _, estimate, constancy = judged(made(truth, 6))
    assert constancy.scatter == pytest.approx(0.01, rel=0.5)
    assert estimate.standard_error > 1.5e-3


def test_of_few_impacts_none_is_judged():
    _, estimate, _ = judged(made([0.95, 0.95]))
    assert estimate.value is None
    assert estimate.reason.endswith("; the record has 2.")
