"""Measures of ground motions against closed forms and against eqsig."""

import math
from dataclasses import replace

import numpy as np
import pytest
import scipy
from hypothesis import given, settings
from hypothesis import strategies as st

from colonnade.assessment.measures import MEASURES, intensity_measures, measure_of
from colonnade.dynamics.motion import Motion
from every import every
from prism import PRISM

PEAK, FREQUENCY, CYCLES, STEP = 3.0, 2.0, 10, 5e-5
OMEGA = 2 * math.pi * FREQUENCY
TIME = np.arange(round(CYCLES / FREQUENCY / STEP) + 1) * STEP
SINE = Motion(PEAK * np.sin(OMEGA * TIME), STEP)


def energy_time(share):
    """Time at which t/2 − sin(2ωt)/(4ω), the integral of sin², comes to a share of its end."""
    end = CYCLES / FREQUENCY
    return scipy.optimize.brentq(lambda t: t / 2 - math.sin(2 * OMEGA * t) / (4 * OMEGA) - share * end / 2, 0, end)


EXACT = {
    "pga": PEAK,
    "pgv": 2 * PEAK / OMEGA,  # from rest: v = (1 − cos ωt) a/ω
    "pgd": PEAK / OMEGA * CYCLES / FREQUENCY,
    "arias": math.pi / (2 * 9.81) * PEAK**2 * CYCLES / FREQUENCY / 2,
    "d5_95": energy_time(0.95) - energy_time(0.05),
}


@every("name", EXACT)
def test_a_sine_has_its_closed_forms(name):
    assert intensity_measures(SINE, measures=[name]).values[name] == pytest.approx(EXACT[name], rel=1e-7)


def test_the_spectral_acceleration_at_resonance_is_that_of_steady_vibration():
    motion = Motion(np.sin(2 * math.pi * np.arange(6000) / 200), 0.005)
    assert intensity_measures(motion, measures=["sa(1 s)"]).values["sa(1 s)"] == pytest.approx(10.0, rel=2e-3)


def noise():
    acceleration = np.random.default_rng(3).normal(size=4001) * np.sin(np.linspace(0, math.pi, 4001)) ** 2
    return acceleration - acceleration.mean()


def test_measures_agree_with_eqsig():
    eqsig = pytest.importorskip("eqsig", reason="eqsig is of the extra `test`")
    values, step = noise(), 0.01
    theirs = eqsig.AccSignal(values, step)
    ours = intensity_measures(Motion(values, step), drift=10.0)
    assert ours.values["pga"] == pytest.approx(theirs.pga, rel=1e-12)
    assert ours.values["pgv"] == pytest.approx(np.abs(theirs.velocity).max(), rel=1e-9)
    assert ours.values["pgd"] == pytest.approx(np.abs(theirs.displacement).max(), rel=1e-3)
    assert ours.values["arias"] == pytest.approx(eqsig.im.calc_arias_intensity(theirs)[-1], rel=1e-12)
    assert ours.values["d5_95"] == pytest.approx(eqsig.im.calc_sig_dur(theirs), abs=2 * step)


@settings(max_examples=25)
@given(factor=st.floats(0.01, 100.0), name=st.sampled_from([*MEASURES, "sa(0.5 s)"]))
def test_a_stronger_motion_has_a_measure_by_its_power(factor, name):
    values = noise()[:401]
    one, other = (
        intensity_measures(Motion(scale * values, 0.01), measures=[name], drift=10.0).values[name]
        for scale in (1.0, factor)
    )
    assert other == pytest.approx(one * factor ** measure_of(name).power, rel=1e-6)


def test_a_record_that_drifts_has_no_velocity_and_says_why():
    drifting = Motion(0.3 + np.sin(np.linspace(0, 20 * math.pi, 2001)), 0.01)
    measured = intensity_measures(drifting)
    assert measured.drift == pytest.approx(0.3 * 20 / (0.3 * 20 + 1 / math.pi), abs=0.02)
    # The sine adds at most 2/ω = 1/π to the 6 m/s that the offset makes.
    integrated = {name for name, each in MEASURES.items() if each.is_integrated}
    assert set(measured.reasons) == integrated
    assert all(math.isnan(measured.values[name]) for name in integrated)
    assert "the record drifts, by 0.94 of its peak; at most 0.1 was expected" in measured.reasons["pgv"]
    assert "pgv" not in intensity_measures(drifting, drift=1.1).reasons


def test_the_gravity_of_the_arias_intensity_is_that_of_the_block():
    measures = {"measures": ["arias"]}
    heavy = intensity_measures(SINE, replace(PRISM, gravity=9.81 * 2), **measures).values["arias"]
    assert heavy == pytest.approx(intensity_measures(SINE, **measures).values["arias"] / 2)


@pytest.mark.parametrize("values", [np.zeros(500), [1.0], np.full(500, 1e200)], ids=["at rest", "one sample", "huge"])
def test_a_motion_of_no_use_has_reasons_and_no_error(values):
    measured = intensity_measures(Motion(values, 0.01), drift=2.0)
    assert all(math.isfinite(value) != (name in measured.reasons) for name, value in measured.values.items())
    assert all(reason.startswith("the motion is at rest") for reason in measured.reasons.values())
    assert measured.reasons


def test_the_result_is_shown_with_units():
    shown = repr(intensity_measures(SINE, measures=["pga", "sa(0.5 s)"]))
    assert shown.startswith("<IntensityMeasures: PGA 3 m/s², Sa(0.5 s) ")


@every(
    ("arguments", "message"),
    [
        ({"measures": ["pgx"]}, 'Unknown measure of intensity "pgx". Did you mean "pgv"'),
        ({"measures": ["sa"]}, 'has no period; one was expected in brackets, such as "sa'),
        ({"measures": ["sa(0.5)"]}, "has no unit"),
        ({"measures": ["sa(-1 s)"]}, "a positive time was expected"),
        ({"measures": ["pga(1 s)"]}, "Unknown measure"),
        ({"drift": 0.0}, "drift is 0.0"),
        ({"baseline": "cubic"}, 'Unknown baseline correction "cubic"'),
        ({"baseline": "linear(1 Hz)"}, 'Unknown baseline correction "linear'),
        ({"baseline": "highpass(1e-9 Hz)"}, "at least 0.001 Hz"),
        ({"baseline": "highpass(90 Hz)"}, "not below half the sampling rate"),
    ],
)
def test_impossible_arguments_are_clear_errors(arguments, message):
    with pytest.raises(ValueError, match=message):
        intensity_measures(Motion(noise(), 0.01), **arguments)
