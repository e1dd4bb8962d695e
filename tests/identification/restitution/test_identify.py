"""Restitution from peaks: truth is the full nonlinear equation, integrated adaptively between impacts."""

import functools
from types import SimpleNamespace

import numpy as np
import pytest

from colonnade.dynamics.rock import RestitutionLaw, rock
from colonnade.identification.restitution import identify
from colonnade.identification.restitution.identify import identify_restitution
from colonnade.laboratory.truth import simulate
from prism import PRISM

ALPHA = PRISM.critical_angle


@functools.cache
def _nonlinear_decay(restitution, interval=0.002, duration=14.0, tilt=0.0):
    time = np.arange(0, duration, interval)
    leaning = PRISM.override(critical_angle=(ALPHA - tilt, ALPHA + tilt))
    return time, simulate(leaning, time, restitution=restitution, theta0=0.5 * ALPHA).angle


@pytest.mark.parametrize("restitution", [0.85, 0.93, 0.976, 0.99])
def test_the_nonlinear_truth_is_found_without_noise(restitution):
    result = identify_restitution(*_nonlinear_decay(restitution), PRISM)
    assert result.value == pytest.approx(restitution, abs=3e-5)
    assert result.zero_offset == pytest.approx(0, abs=1e-5 * ALPHA)


@pytest.mark.parametrize("degrees", [0.02, 0.05, -0.1, 0.2])
@pytest.mark.parametrize("noise", [1e-6, 2e-5])
def test_a_tilted_table_is_found_and_does_not_refuse_e(degrees, noise):
    time, angle = _nonlinear_decay(0.976, tilt=np.deg2rad(degrees))
    result = identify_restitution(time, angle + np.random.default_rng(0).normal(0, noise, time.size), PRISM)
    assert result.low <= 0.976 <= result.high
    assert result.value == pytest.approx(0.976, abs=1e-4)
    assert "moving table" not in {each.name for each in result.departures}
    sides = [each.size for each in result.departures if each.name == "unequal sides"]
    # Named from 0.5 % of α on; e allows for it always.
    assert sides == ([pytest.approx(np.deg2rad(degrees), rel=0.03)] if abs(np.deg2rad(degrees)) > 0.005 * ALPHA else [])


@pytest.mark.whole
def test_intervals_hold_the_truth_as_often_as_they_say():
    time, angle = _nonlinear_decay(0.976)
    rng = np.random.default_rng(2013)
    results = [identify_restitution(time, angle + rng.normal(0, 2e-4, time.size) + 1e-4, PRISM) for _ in range(30)]
    held = sum(result.low <= 0.976 <= result.high for result in results)
    assert 26 <= held <= 30
    assert abs(np.mean([result.value for result in results]) - 0.976) < 1e-5
    assert np.mean([result.zero_offset for result in results]) == pytest.approx(1e-4, rel=0.05)


def test_restitution_that_differs_from_impact_to_impact_widens_the_interval():
    speeds = np.linspace(0, 5, 2001)
    steady, uneven = (
        rock(PRISM, restitution=law, theta0=0.5 * ALPHA, duration=12.0, model="nonlinear")
        for law in (0.976, RestitutionLaw(speeds, 0.976 + 0.003 * np.sin(400 * speeds)))
    )
    steady, uneven = (identify_restitution(each.time, each.angle, PRISM) for each in (steady, uneven))
    assert uneven.standard_error > 20 * steady.standard_error
    assert uneven.low < 0.976 < uneven.high


def _refusal(angle, interval=0.002):
    result = identify_restitution(np.arange(angle.size) * interval, angle, PRISM)
    assert result.value is None
    return result.reason


TIME = np.arange(0, 14, 0.002)


@pytest.mark.parametrize(
    ("angle", "words"),
    [
        (np.empty(0), "fewer than 8 values"),
        (np.random.default_rng(0).normal(0, 1e-3, TIME.size), "the record of 14 s has 0"),
        (np.where(TIME < 2, 0.05, 0.0), "the record of 14 s has 0"),
        (0.05 * np.sin(2 * np.pi * 5 * TIME), "Times between impacts"),
        (0.05 * np.sin(2 * np.pi * 1.69 * TIME), "not the arc of"),
        (rock(PRISM, restitution=0.5, theta0=0.5 * ALPHA, duration=4.0).angle, "At least 2 peaks"),
    ],
    ids=["nothing", "noise", "a step", "a fast sine", "a sine at the rocking frequency", "few peaks"],
)
def test_what_is_no_free_rocking_is_refused_with_its_reason(angle, words):
    assert words in _refusal(angle)


def test_degrees_and_milliseconds_are_refused_with_the_unit_that_was_expected():
    time, angle = _nonlinear_decay(0.976)
    assert "at these amplitudes, in rad" in identify_restitution(time, np.degrees(angle), PRISM).reason
    assert "the record of 1.4e+04 s has 0" in identify_restitution(1e3 * time, angle, PRISM).reason


def test_time_that_does_not_increase_is_an_error():
    with pytest.raises(ValueError, match="does not increase"):
        identify_restitution([0.0, 1.0, 1.0], [0.0, 0.0, 0.0], PRISM)


def test_an_interval_beyond_all_numbers_ends_above_one():
    solved = SimpleNamespace(mean=[-0.05], quantile=lambda share: 4000.0 * (share - 0.5) - 0.05)
    found = identify._estimate("peaks", 0.95, solved)
    assert (found.low, found.value) == (0.0, pytest.approx(np.exp(-0.05)))
    assert 1.0 < found.high < 10.0


def test_uneven_steps_give_as_good_an_e_as_even_ones():
    time, angle = _nonlinear_decay(0.93, interval=0.001, duration=10.0)
    random = np.random.default_rng(5)
    uneven = time[::2] + random.choice([0.0, 0.001], time[::2].size)
    even, found = (
        identify_restitution(each, np.interp(each, time, angle) + random.normal(0, 1e-4, each.size), PRISM)
        for each in (time[::2], uneven)
    )
    assert found.low <= 0.93 <= found.high
    assert found.standard_error < 1.3 * even.standard_error
    assert found.departures == ()
