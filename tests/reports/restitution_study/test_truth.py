"""The study's truth, integrated and in closed form, is the nonlinear equation as the virtual laboratory has it."""

from __future__ import annotations

import numpy as np
import pytest

from colonnade.dynamics.block import Block
from colonnade.laboratory.truth import simulate


@pytest.mark.parametrize("slenderness", [3.0, 12.0])
@pytest.mark.parametrize(("restitution", "released"), [(0.8, 0.9), (0.95, -0.5), (0.995, 0.2)])
def test_closed_form_and_adaptive_integration_agree_arc_for_arc(study, slenderness, restitution, released):
    block = Block.prism(width=1.0 / slenderness, depth=0.3, height=1.0, mass=100.0)
    time = np.linspace(0.0, 12.0, 3001)
    rocking = study.FreeRocking(block.critical_angle, block.p, restitution, released * block.critical_angle, 0.3)
    integrated = simulate(block, time, restitution=restitution, theta0=rocking.release_angle, release=0.3)
    shared = min(integrated.impact_times.size, 25)
    np.testing.assert_allclose(rocking.impact_times()[:shared], integrated.impact_times[:shared], atol=1e-9)
    compared = time < integrated.impact_times[shared - 1]
    np.testing.assert_allclose(rocking.angle(time)[compared], integrated.angle[compared], atol=1e-9)


@pytest.mark.parametrize("slenderness", [3.0, 12.0])
@pytest.mark.parametrize(("restitution", "released"), [(0.8, 0.9), (0.95, -0.5), (0.995, 0.2)])
def test_the_records_integration_and_the_closed_form_agree_to_the_end(study, slenderness, restitution, released):
    block = Block.prism(width=1.0 / slenderness, depth=0.3, height=1.0, mass=100.0)
    alpha = block.critical_angle
    rocking = study.FreeRocking(alpha, block.p, restitution, released * alpha, 0.3, zero_offset=0.01 * alpha)
    time = np.linspace(0.0, 40.0, 20001)
    np.testing.assert_allclose(study.integrated_angle(rocking, time)[0], rocking.angle(time), rtol=0, atol=1e-8 * alpha)


def test_peaks_are_the_highest_angles_and_the_offset_is_common_to_all(study):
    rocking = study.FreeRocking(0.2, 3.0, 0.9, 0.1, 0.1, zero_offset=1e-3)
    edges = np.concatenate(([0.0], rocking.impact_times()[:6]))
    for start, end, peak in zip(edges[:-1], edges[1:], rocking.peak_angles(), strict=False):
        angle = rocking.angle(np.linspace(start + 1e-9, end - 1e-9, 20001)) - 1e-3
        assert angle[np.argmax(np.abs(angle))] == pytest.approx(peak, abs=1e-9)


def test_the_record_ends_at_rest(study):
    rocking = study.FreeRocking(0.2, 3.0, 0.8, 0.1, 0.0, zero_offset=1e-3)
    assert rocking.angle(np.array([100.0])) == pytest.approx(1e-3, abs=0)
