import re

import numpy as np
import pytest

from colonnade.dynamics.block import Block
from colonnade.dynamics.motion import Motion
from colonnade.dynamics.rock import RestitutionLaw, rock
from colonnade.identification.restitution.identify import identify_restitution
from colonnade.signals.filters import lowpass
from prism import PRISM

ALPHA = PRISM.critical_angle
NOISE = 2e-4
STEP = 0.002


class Record:
    """Free rocking by the model, with what an evaluation sees of it: noisy samples, times of impacts and peaks."""

    def __init__(self, *, restitution=0.95, block=PRISM, release=0.7, seed=0, offset=0.0, arcs=24, noise=NOISE):
        random = np.random.default_rng(seed)
        history = rock(
            block,
            Motion(np.zeros(12_000), STEP),
            restitution=restitution,
            model="nonlinear",
            theta0=release * block.critical_angle,
        )
        impacts = history.impact_times[: arcs + 1]
        self.time = history.time[history.time < impacts[-1]]
        self.truth = history.angle[: self.time.size]
        self.angle = self.truth + offset + noise * random.normal(size=self.time.size)
        self.impacts, self.block, self.random = impacts, block, random

    def departures(self, block=None, **measured):
        found = identify_restitution(self.time, self.angle, block or self.block, **measured)
        return {departure.name: departure for departure in found.departures}


def beyond(departure, truth):
    """Errors by which a departure's size is off the truth."""
    return abs(departure.size - truth) / departure.standard_error


def test_scatter_of_e_from_impact_to_impact_is_no_departure():
    speeds = np.linspace(0, 3, 400)
    for seed in range(12):
        law = RestitutionLaw(speeds, 0.95 + 0.004 * np.random.default_rng(seed).normal(size=speeds.size))
        assert Record(restitution=law, seed=seed).departures() == {}


@pytest.mark.parametrize("pair", [(0.94, 0.96), (0.975, 0.96), (0.85, 0.88)])
def test_an_interval_holds_the_mean_of_two_sides_that_differ_in_e(pair):
    for seed in range(6):
        record = Record(restitution=pair, seed=seed)
        found = identify_restitution(record.time, record.angle, PRISM)
        assert found.low <= np.sqrt(pair[0] * pair[1]) <= found.high


@pytest.mark.parametrize("tilt", [-0.05, 0.03])
def test_a_tilted_table_is_named_with_its_angle(tilt):
    sides = (ALPHA * (1 - tilt), ALPHA * (1 + tilt))
    tilted = Block.measured(
        mass=PRISM.mass, pole_distance=PRISM.pole_distance, critical_angle=sides, inertia=PRISM.inertia
    )
    errors = []
    for seed in range(8):
        found = Record(block=tilted, seed=seed).departures(PRISM)
        assert list(found) == ["unequal sides"]
        errors.append(beyond(found["unequal sides"], tilt * ALPHA))
    assert max(errors) < 4
    assert np.median(errors) < 1.6
    assert Record(block=tilted).departures() == {}  # known of the block, it is no departure


def test_a_measured_rotation_out_of_the_plane_asks_for_a_window_without_it():
    record = Record()
    decay = np.where(record.time < record.impacts[5], 0.2, 0.03)
    transverse = decay * record.truth + 1e-4 * record.random.normal(size=record.time.size)
    departure = record.departures(out_of_plane=transverse)["three-dimensional rocking"]
    assert departure.size == pytest.approx(0.2, rel=0.05)
    assert departure.refuses
    assert float(re.search(r"until ([\d.]+) s", departure.sentence)[1]) == pytest.approx(record.impacts[5], abs=0.01)
    later = record.time > record.impacts[5] + 0.01
    found = identify_restitution(record.time[later], record.angle[later], PRISM, out_of_plane=transverse[later])
    assert found.departures == ()
    assert found.low <= 0.95 <= found.high


@pytest.mark.parametrize(("jump", "refuses"), [(8e-5, False), (4e-4, True)], ids=["a little", "much"])
def test_sliding_at_impacts_is_summed(jump, refuses):
    record = Record()
    moved = jump * np.searchsorted(record.impacts[[2, 4, 7]], record.time)
    slide = moved + 0.002 * record.truth + 2e-6 * record.random.normal(size=record.time.size)
    departure = record.departures(slide=slide)["sliding"]
    assert departure.size == pytest.approx(3 * jump, rel=0.05)
    assert beyond(departure, 3 * jump) < 5
    assert departure.refuses is refuses
    assert "3 of" in departure.sentence


def test_a_transducer_that_shows_rocking_as_slide_is_no_sliding():
    record = Record()
    slide = np.where(record.truth > 0, 0.01, -0.004) * record.truth + 2e-6 * record.random.normal(size=record.time.size)
    assert record.departures(slide=slide) == {}


@pytest.mark.parametrize("cutoff", [None, 35.0], ids=["as recorded", "low-passed"])
@pytest.mark.parametrize("offset", [0.0, 0.002], ids=["zero right", "zero off"])
def test_a_sound_record_departs_in_nothing_to_its_end(cutoff, offset):
    for seed in range(4):
        record = Record(restitution=0.85 + 0.045 * seed, seed=seed, offset=offset, arcs=200)
        if cutoff is not None:
            record.angle = lowpass(record.angle, STEP, cutoff)
        transverse, slide = (size * record.random.normal(size=record.time.size) for size in (1e-4, 2e-5))
        assert record.departures(lowpass=cutoff) == {}
        assert record.departures(lowpass=cutoff, out_of_plane=transverse, slide=slide) == {}


def test_too_few_arcs_are_left_alone():
    assert Record(arcs=2).departures() == {}


@pytest.mark.parametrize("sign", [1.0, -1.0])
def test_a_base_whose_sign_is_turned_is_told_and_no_value_is_given(sign):
    time = np.arange(3000) * STEP
    shaken = 0.06 * PRISM.gravity * np.sin(2 * np.pi * 2.3 * time) * np.exp(-(((time - 3) / 1.5) ** 2))
    history = rock(PRISM, Motion(shaken, STEP), restitution=0.93, model="nonlinear", theta0=0.45 * ALPHA)
    angle = history.angle + NOISE * np.random.default_rng(3).normal(size=time.size)
    found = identify_restitution(time, angle, PRISM, base_acceleration=sign * shaken)
    assert found.table_moves
    if sign > 0:
        assert found.value == pytest.approx(0.93, abs=1e-3)
        assert found.departures == ()
    else:
        (departure,) = found.departures
        assert (found.value, departure.name, departure.refuses) == (None, "moving table", True)
        assert found.reason.startswith("With the sign of the table's acceleration turned, a history follows")
        assert departure.size > 2 * departure.standard_error > 0
