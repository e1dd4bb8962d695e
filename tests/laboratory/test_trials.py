"""Kinds of tests: what they ask of the table and of the specimen, on working days."""

from __future__ import annotations

from math import sqrt

import numpy as np
import pytest

from colonnade.dynamics.motion import Motion
from colonnade.laboratory.experiment import TESTS_A_DAY, begun
from colonnade.laboratory.programme import QUIET, RELEASES, SPANS, Placed, earthquakes, free_vibrations, sine
from prism import PRISM

PLACED = Placed("prism", PRISM, "bench", "table", "p-")
RECORD = Motion(np.sin(np.arange(400) * 0.1) * np.hanning(400), 0.02)


@pytest.mark.parametrize("seed", range(5))
def test_free_vibrations_start_near_their_angles_on_a_table_at_rest(seed: int) -> None:
    trials = list(free_vibrations(PLACED, np.random.default_rng(seed)))
    assert [trial.name for trial in trials] == ["p-free-01", "p-free-02", "p-free-03"]
    for trial, ratio in zip(trials, RELEASES, strict=True):
        assert trial.theta0 / PRISM.critical_angle == pytest.approx(ratio, abs=0.02)
        assert trial.release == pytest.approx(QUIET, abs=0.2)
        assert trial.table.stop == 0.0
        assert (trial.kind, trial.setup, trial.specimen) == ("free-vibration", "bench", "prism")


def test_the_generator_alone_decides_what_is_drawn() -> None:
    first, again, other = (
        [(trial.theta0, trial.release) for trial in free_vibrations(PLACED, np.random.default_rng(seed))]
        for seed in (1, 1, 2)
    )
    assert first == again
    assert len({*first, *other}) == 6


@pytest.mark.parametrize("frequency", [1.0, 2.5])
def test_a_sine_reaches_its_multiple_of_g_tan_alpha_between_its_ramps(frequency: float) -> None:
    trial = sine(PLACED, "sine", frequency, 1.4, cycles=6, ramp=2)
    assert (trial.name, trial.kind, trial.setup) == ("p-sine", "sine", "table")
    assert trial.entry == {"frequency": f"{frequency:g} Hz"}
    assert trial.table.stop == pytest.approx(QUIET + 10 / frequency)
    assert trial.duration == pytest.approx(trial.table.stop + 4.0)
    start, stop = trial.steady
    assert (stop - start) * frequency == pytest.approx(6.0)
    time = np.linspace(start, stop, 2401)
    amplitude = 1.4 * PRISM.gravity * np.tan(PRISM.critical_angle)
    assert np.abs(trial.table.acceleration(time)).max() == pytest.approx(amplitude, rel=1e-12)
    assert not trial.table.acceleration(np.linspace(0.0, QUIET - 1e-9, 50)).any()


def test_an_earthquake_is_played_at_three_spans_and_in_the_models_time() -> None:
    trials = list(earthquakes(PLACED, "a wave", RECORD))
    assert [trial.name for trial in trials] == ["p-span-2.0", "p-span-2.5", "p-span-3.0"]
    for trial, span in zip(trials, SPANS, strict=True):
        assert trial.entry == {"motion": "a wave", "span": span, "time_scale": pytest.approx(0.223607, abs=5e-7)}
        # Times of a 1:20 model are shorter by √20, accelerations are not: similitude of Froude.
        assert trial.table.stop - QUIET == pytest.approx(RECORD.duration / sqrt(20), rel=1e-9)
        assert trial.duration == pytest.approx(trial.table.stop + 9.0)
        time = QUIET + RECORD.time / sqrt(20)
        played = trial.table.acceleration(time)
        assert np.abs(played).max() == pytest.approx(1.5 * span, rel=0.05)
        assert np.corrcoef(played, RECORD.acceleration)[0, 1] > 0.999
        assert trial.spikes == 3


def test_tests_follow_each_other_on_working_days_between_nine_and_four() -> None:
    moments = [begun(position) for position in range(10 * TESTS_A_DAY)]
    assert moments == sorted(set(moments))
    assert len({moment.date() for moment in moments}) == 10
    assert np.is_busday([moment.date() for moment in moments]).all()
    assert {moment.hour for moment in moments} == set(range(9, 16))
