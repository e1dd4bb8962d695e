"""What drives a specimen: a steady sine, a table that moves or stands; and the boundaries of its responses."""

import numpy as np
import pytest

from colonnade.identification.response.base_motion import LEAST_MOTION, base_velocity, fit_forcing, table_moves
from colonnade.identification.response.boundaries import Bracket, MapPoint, bracket_boundaries
from prism import PRISM


def ramped(frequency, amplitude, *, cycles=12, ramp=3.0, interval=0.002, rest=1.5):
    period = 1 / frequency
    length = (cycles + 2 * ramp) * period
    time = np.arange(0.0, length + 2 * rest, interval)
    since = time - rest
    envelope = np.clip(np.minimum(since, length - since) / (ramp * period), 0.0, 1.0)
    return time, amplitude * envelope * np.sin(2 * np.pi * frequency * since), rest + ramp * period


@pytest.mark.parametrize("frequency", [1.0, 1.93, 3.0, 5.04, 7.0])
@pytest.mark.parametrize("noise", [0.0, 0.02], ids=["clean", "noisy"])
def test_frequency_amplitude_and_steady_part_are_found(frequency, noise):
    time, motion, start = ramped(frequency, 2.0)
    found = fit_forcing(time, motion + np.random.default_rng(0).normal(0, noise, time.size))
    assert found.frequency == pytest.approx(frequency, rel=1e-3)
    assert found.amplitude == pytest.approx(2.0, rel=3e-3)
    assert found.start == pytest.approx(start, abs=1 / frequency)
    assert 10.5 < (found.stop - found.start) * frequency < 13.5


def test_an_offset_and_harmonics_do_not_enter_the_amplitude():
    time, motion, _ = ramped(3.0, 2.0)
    found = fit_forcing(time, motion + 0.5 + 0.1 * motion**2)
    assert found.amplitude == pytest.approx(2.0, rel=3e-3)
    assert found.distortion == pytest.approx(0.1, rel=0.05)  # 0.1 · 2² / 2 at twice the frequency, over 2


def test_samples_that_are_missing_at_the_ends_do_no_harm():
    time, motion, _ = ramped(3.0, 2.0)
    motion[:50] = np.nan
    assert fit_forcing(time, motion).amplitude == pytest.approx(2.0, rel=3e-3)


@pytest.mark.parametrize(
    "motion",
    [
        np.zeros(4000),
        np.random.default_rng(1).normal(0, 1, 4000),
        np.sin(np.linspace(0, 60, 4000)) * np.exp(-np.linspace(0, 10, 4000)),
        np.sin(np.linspace(0, 8, 4000)),
    ],
    ids=["rest", "noise", "decay", "one cycle"],
)
def test_what_is_no_steady_sine_gives_nothing(motion):
    assert fit_forcing(np.arange(4000) * 0.002, motion) is None


STEP = 0.002
TIME = np.arange(0.0, 20.0, STEP)
WEIGHT = PRISM.gravity * PRISM.critical_angle


@pytest.mark.parametrize("frequency", [0.5, 2.0, 5.0])
def test_a_sine_counts_by_the_velocity_that_it_gives(frequency):
    share = base_velocity(0.05 * WEIGHT * np.sin(2 * np.pi * frequency * TIME), STEP, PRISM)
    expected = 0.05 / np.sqrt(2) / np.hypot(1, 2 * np.pi * frequency / PRISM.p)
    assert share == pytest.approx(expected, rel=0.02)


def test_a_push_at_the_end_of_a_record_does_not_act_on_its_start():
    within, at_end = (np.where(np.abs(TIME - when) < 0.1, 1.0, 0.0) for when in (10.0, 20.0))
    # Half of the push, and of what it does.
    ratio = base_velocity(at_end, STEP, PRISM) / base_velocity(within, STEP, PRISM)
    assert ratio == pytest.approx(0.5, abs=0.02)


@pytest.mark.parametrize("frequency", [0.5, 2.0, 5.0, 8.0])
def test_a_twentieth_of_what_uplifts_moves_the_table(frequency):
    assert table_moves(0.05 * WEIGHT * np.sin(2 * np.pi * frequency * TIME), STEP, PRISM)


def test_noise_and_bias_of_an_accelerometer_are_no_motion():
    noise = np.random.default_rng(1).normal(0.0, 0.005 * 9.81, TIME.size)
    assert not table_moves(noise + 0.02, STEP, PRISM)
    assert base_velocity(noise, STEP, PRISM) > 0.1 * LEAST_MOTION


def test_missing_samples_are_no_motion():
    assert not table_moves(np.full(TIME.size, np.nan), STEP, PRISM)
    moving = 0.05 * WEIGHT * np.sin(2 * np.pi * TIME)
    moving[100:120] = np.nan
    assert table_moves(moving, STEP, PRISM)


LETTERS = {"n": "no-rocking", "r": "rocking", "o": "overturned"}


def points(outcomes, frequency=3.35, amplitudes=(0.9, 1.1, 1.3, 1.5, 1.7)):
    return [
        MapPoint(f"test-{amplitude}", frequency, amplitude, LETTERS[letter])
        for amplitude, letter in zip(amplitudes, outcomes, strict=False)
    ]


@pytest.mark.parametrize(
    ("outcomes", "rocking", "overturning"),
    [
        ("nrroo", Bracket(0.9, 1.1), Bracket(1.3, 1.5)),
        ("nnooo", Bracket(1.1, 1.3), Bracket(1.1, 1.3)),
        ("nnrrr", Bracket(1.1, 1.3), Bracket(1.7, None)),
        ("rrroo", Bracket(None, 0.9), Bracket(1.3, 1.5)),
        ("nnnnn", Bracket(1.7, None), Bracket(1.7, None)),
        ("nroro", Bracket(0.9, 1.1), Bracket(1.1, 1.3, (1.5,))),
        ("nrnro", Bracket(0.9, 1.1, (1.3,)), Bracket(1.5, 1.7)),
    ],
    ids=[
        "in order",
        "nothing between rest and overturning",
        "none overturned",
        "all rocked",
        "none rocked",
        "one stood above one that fell",
        "one stayed still above one that rocked",
    ],
)
def test_brackets(outcomes, rocking, overturning):
    (found,) = bracket_boundaries(points(outcomes))
    assert (found.rocking, found.overturning) == (rocking, overturning)


def test_recorded_frequencies_that_differ_a_little_are_one_group():
    found = bracket_boundaries([*points("nr", 3.35), *points("ro", 3.37, (1.3, 1.5)), *points("nr", 4.46)])
    assert [round(each.frequency_ratio, 2) for each in found] == [3.36, 4.46]
    assert found[0].overturning == Bracket(1.3, 1.5)


def test_the_middle_is_known_only_where_both_sides_are():
    assert Bracket(1.0, 1.2).middle == pytest.approx(1.1)
    assert Bracket(1.0, None).middle is None
