"""The stability map: the paper's statements, the rules of its limits, and independence of how it is computed."""

import math
from functools import cache

import numpy as np
import pytest

from colonnade.dynamics.maps import MapPlan, map_part, stability_map
from colonnade.dynamics.plane.run import Harmonic, outcomes_of
from colonnade.dynamics.search import LEAST_EDGE, MOST_STEPS, STEPS_A_WIDTH
from every import every
from prism import PRISM

ALPHA, P = PRISM.critical_angle, PRISM.p
MODELS = ("linear", "nonlinear")
OMEGAS = np.array([1.1, 2.0, 4.5, 6.0, 7.8])
AMPLITUDES = np.concatenate([np.linspace(0.9, 1.6, 29), np.linspace(1.7, 9.0, 30)])


@cache
def prism_map(model):
    """The paper's prism, e = 0.976, 20 cycles from rest."""
    return stability_map(
        PRISM, restitution=0.976, frequency_ratio=OMEGAS, amplitude_ratio=AMPLITUDES, model=model, width=0.02
    )


@pytest.mark.parametrize("model", MODELS)
class TestThePapersStatements:
    def test_rocking_starts_at_one_amplitude_for_every_frequency(self, model):
        chart = prism_map(model)
        onset = ALPHA / math.tan(ALPHA) if model == "linear" else 1.0
        np.testing.assert_allclose(chart.no_rocking, onset, rtol=1e-15)
        assert (chart.outcome[:, onset - 1e-9 > AMPLITUDES] == 0).all()
        # Just above it the block only trembles, below a thousandth of α.
        assert (chart.outcome[:, onset + 0.06 < AMPLITUDES] > 0).all()

    def test_the_band_of_stable_rocking_is_narrow_at_small_frequencies(self, model):
        chart = prism_map(model)
        assert (chart.lower[:2] - chart.no_rocking[:2] < 0.05).all()
        assert (chart.upper[:2] - chart.no_rocking[:2] < 0.05).all()

    def test_the_limits_rise_steeply_with_frequency(self, model):
        chart = prism_map(model)
        assert chart.lower[2] > 1.5
        assert chart.lower[3] > 2.4
        assert chart.lower[4] > 3.0

    def test_there_are_two_limits(self, model):
        chart = prism_map(model)
        assert (chart.upper[2:] > chart.lower[2:] + 1.0).all()


@pytest.mark.parametrize("model", MODELS)
def test_every_interval_that_overturns_ends_where_single_runs_change(model):
    chart = prism_map(model)
    rows = np.flatnonzero(chart.interval_start > AMPLITUDES[0])[::40]
    assert rows.size > 3
    for row in rows:
        motion = Harmonic.cycles(chart.interval_frequency_ratio[row] * P, 20)
        around = chart.interval_start[row] + np.linspace(-5e-5, 5e-5, 201)
        codes = outcomes_of(around, block=PRISM, forcing=motion.forcing(), restitution=(0.976, 0.976), model=model)
        assert codes.min() < 2 == codes.max()


def test_columns_are_the_same_to_the_last_bit_in_any_order():
    plan = MapPlan(PRISM, restitution=0.976, frequency_ratio=OMEGAS, amplitude_ratio=AMPLITUDES, width=0.02)
    backwards = map_part(plan, [4, 3, 2, 1, 0])
    for name, values in vars(prism_map("linear")).items():
        if name == "options":
            assert values == backwards.options
        elif name in ("outcome", "overturning_fraction", "no_rocking", "lower", "upper"):
            assert values.tobytes() == getattr(backwards, name)[::-1].tobytes()


def test_a_ramp_raises_the_upper_limit():
    options = {"restitution": 0.976, "frequency_ratio": [7.81], "amplitude_ratio": np.linspace(1.0, 60.0, 60)}
    abrupt, ramped = (stability_map(PRISM, width=0.2, ramp=ramp, **options) for ramp in (0, 3))
    assert abrupt.upper[0] < 10
    assert 40 < ramped.upper[0] < 60


@every(
    ("arguments", "message"),
    [
        ({"frequency_ratio": []}, "frequency_ratio has shape"),
        ({"amplitude_ratio": [1.0, 1.0]}, "amplitude_ratio has to be increasing"),
        ({"amplitude_ratio": [-1.0, 1.0]}, "amplitude_ratio is -1.0; a number from"),
        ({"frequency_ratio": [math.nan]}, "frequency_ratio"),
        ({"restitution": 1.1}, "restitution is 1.1"),
        ({"cycles": 0.5}, "at least one cycle"),
        ({"ramp": -1}, "ramp is -1"),
        ({"phase": math.inf}, "phase is inf"),
        ({"width": 1e-5}, "edge is 0.0001; a number in A from 1e-09 to the width, 1e-05"),
        ({"model": "contact"}, 'Unknown plane model "contact"'),
    ],
)
def test_impossible_maps_are_clear_errors(arguments, message):
    given = {"frequency_ratio": [2.0], "amplitude_ratio": [1.0, 2.0]} | arguments
    with pytest.raises(ValueError, match=message):
        stability_map(PRISM, **given)


def plan(block=PRISM, **given):
    return MapPlan(block, **({"frequency_ratio": [2.0], "amplitude_ratio": [1.0, 1.5, 4.0], "width": 0.1} | given))


def test_the_scan_holds_the_amplitudes_of_the_map_and_steps_over_no_limit():
    scan = plan().scan
    assert np.isin([1.0, 1.5, 4.0], scan).all()
    assert (np.diff(scan) > 0).all()
    assert np.diff(scan).max() <= 0.1 / STEPS_A_WIDTH * (1 + 1e-9)
    assert scan.size == 1 + 3.0 / 0.1 * STEPS_A_WIDTH


def test_amplitudes_closer_than_a_step_are_scanned_as_they_are():
    np.testing.assert_array_equal(plan(amplitude_ratio=[1.0, 1.001, 1.002]).scan, [1.0, 1.001, 1.002])


def test_its_options_say_all_that_a_map_depends_on():
    found = plan(restitution=(0.9, 0.8), phase=7.0, cycles=5).options
    assert found["phase"] == pytest.approx(7.0 - 2 * np.pi)
    assert (found["restitution_negative"], found["restitution_positive"], found["cycles"]) == (0.9, 0.8, 5.0)


@pytest.mark.parametrize(
    ("given", "message"),
    [
        ({"frequency_ratio": [1e7]}, "a number from 1e-06 to 1e\\+06 was expected"),
        ({"amplitude_ratio": [1.0, 1e5], "width": 0.1}, "width is 0.1; a width in A, at least 0.4"),
        ({"edge": LEAST_EDGE / 2}, "edge is 5e-10"),
        ({"frequency_ratio": np.linspace(1, 2, 2000), "amplitude_ratio": np.linspace(1, 2, 501)}, "1002000 cells"),
    ],
)
def test_what_would_not_end_is_refused(given, message):
    assert MOST_STEPS == 1_000_000
    with pytest.raises(ValueError, match=message):
        plan(**given)
