"""Slides and bounces at single impacts, on arcs of closed form."""

from dataclasses import replace

import numpy as np
import pytest

from colonnade.identification.restitution.departures.contacts import (
    FRICTION,
    LEAST_LIFT,
    find_bouncing,
    find_sliding,
)

NOISE = 1e-8


@pytest.fixture(scope="module")
def arcs(rocked):
    return rocked()


@pytest.fixture(scope="module")
def record(arcs, sampled):
    return sampled(arcs)


def steps(arcs, time, jumps):
    """Slide of jumps (m) at impacts, by the impact's number."""
    return sum(size * (time >= arcs.impacts[number]) for number, size in jumps.items())


def slid(arcs, record, prism, jumps, beside=0.0):
    time, angle = record
    noise = NOISE * np.random.default_rng(0).normal(size=time.size)
    return find_sliding(time, angle, steps(arcs, time, jumps) + beside + noise, prism, arcs.series)


@pytest.mark.parametrize(
    ("share", "found", "refuses"),
    [(0.0095, False, False), (0.0105, True, False), (0.095, True, False), (0.105, True, True)],
    ids=["let pass", "named", "named still", "refused"],
)
def test_a_slide_counts_by_its_friction_work_over_the_energy_lost(arcs, record, prism, share, found, refuses):
    speed = arcs.series.speed
    lost = prism.inertia / 2 * (speed[0] ** 2 - speed[-1] ** 2)
    total = share * lost / (FRICTION * prism.mass * prism.gravity)
    departure = slid(arcs, record, prism, {3: 0.6 * total, 8: 0.4 * total})
    assert (departure is not None) is found
    if departure is not None:
        assert departure.size == pytest.approx(total, rel=1e-3)
        assert departure.refuses is refuses
        assert (departure.unit, departure.left_out) == ("m", 0)


def test_slides_to_and_fro_add_up_and_the_sentence_has_what_is_left_of_them(arcs, record, prism):
    departure = slid(arcs, record, prism, {3: 2e-4, 6: -1.5e-4})
    assert departure.size == pytest.approx(3.5e-4, rel=1e-3)
    assert f"slides at 2 of {arcs.series.number.size - 1} impacts" in departure.sentence
    assert "+0.05 mm with its sign" in departure.sentence


def test_a_record_that_loses_nearly_no_energy_gets_no_long_percentage(arcs, record, prism):
    time, angle = record
    even = replace(arcs.series, energy=np.full_like(arcs.series.energy, arcs.series.energy[0]))
    noise = NOISE * np.random.default_rng(0).normal(size=time.size)
    departure = find_sliding(time, angle, steps(arcs, time, {3: 3e-4}) + noise, prism, even)
    assert "this is more than 10 times the energy lost; too much" in departure.sentence
    assert len(departure.sentence) < 300


def test_what_goes_with_the_angle_of_a_side_is_no_slide(arcs, record, prism):
    angle = record[1]
    beside = np.where(angle > 0, 0.02, -0.01) * angle
    assert slid(arcs, record, prism, {}, beside) is None
    assert slid(arcs, record, prism, {4: 3e-4}, beside).size == pytest.approx(3e-4, rel=1e-3)


def test_an_arc_without_samples_hides_its_own_jumps_alone(arcs, record, prism):
    time = record[0]
    missing = np.where((time > arcs.impacts[6]) & (time < arcs.impacts[7]), np.nan, 0.0)
    departure = slid(arcs, record, prism, {3: 2e-4, 6: 5e-4}, missing)
    assert departure.size == pytest.approx(2e-4, rel=1e-3)


def test_a_jump_below_the_noise_is_none(arcs, record, prism):
    time, angle = record
    noise = 1e-2 * np.random.default_rng(1).normal(size=time.size)
    assert find_sliding(time, angle, steps(arcs, time, {3: 3e-4}) + noise, prism, arcs.series) is None


@pytest.mark.parametrize(
    ("height", "share", "found"),
    [(0.95, 0.1, False), (1.05, 0.1, True), (5.0, 0.6, False)],
    ids=["too low", "high enough", "long after the impact"],
)
def test_a_base_in_the_air_early_in_an_arc_is_a_bounce(arcs, record, prism, height, share, found):
    time, angle = record
    # The prism's half width is 43 mm.
    lift = height * LEAST_LIFT * 0.043
    middle = arcs.impacts[5] + share * (arcs.impacts[6] - arcs.impacts[5])
    uplift = np.where(np.abs(time - middle) < 0.004, lift, 0.0)
    departure = find_bouncing(time, angle, uplift, prism, arcs.series)
    assert (departure is not None) is found
    if departure is not None:
        assert departure.size == pytest.approx(lift)
        assert "after 1 of 20 impacts" in departure.sentence
        assert (departure.left_out, departure.refuses) == (0, False)


def test_a_lift_that_the_noise_may_have_made_is_none(arcs, record, prism):
    time, angle = record
    uplift = 1e-3 * np.random.default_rng(2).normal(size=time.size)
    uplift[np.searchsorted(time, arcs.impacts[5] + 0.01)] = 4.5e-3
    assert find_bouncing(time, angle, uplift, prism, arcs.series) is None


def test_an_angle_that_passes_upright_at_once_has_no_pause(arcs, record, prism):
    assert find_bouncing(*record, None, prism, arcs.series) is None


@pytest.mark.parametrize("uplift", [None, np.nan], ids=["not measured", "missing throughout"])
@pytest.mark.parametrize("pause", [0.09, 0.12])
def test_a_pause_has_its_length(rocked, sampled, prism, pause, uplift):
    arcs = rocked(pauses={4: pause, 9: 0.05})
    time, angle = sampled(arcs)
    # With the pause in its duration, a series sees arcs that are longer; their peaks stay.
    lifted = None if uplift is None else np.full(time.size, uplift)
    departure = find_bouncing(time, angle, lifted, prism, arcs.series)
    assert departure.unit == "s"
    assert departure.size == pytest.approx(pause, abs=0.004)
    assert "After 2 of 19 impacts" in departure.sentence


def test_a_pause_that_is_a_small_part_of_its_arc_is_let_pass(rocked, sampled, prism):
    arcs = rocked(pauses={4: 0.05})
    assert 0.15 * (arcs.impacts[5] - arcs.impacts[4]) > 0.05
    assert find_bouncing(*sampled(arcs), None, prism, arcs.series) is None


def test_a_pause_before_the_first_arc_that_is_used_is_not_told(rocked, sampled, prism):
    arcs = rocked(pauses={4: 0.1}, first=5)
    assert find_bouncing(*sampled(arcs), None, prism, arcs.series) is None
