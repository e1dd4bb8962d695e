import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from colonnade.dynamics.rock import rock
from colonnade.findings import Finding
from colonnade.signals.quality import (
    Flag,
    Verdict,
    check_clipping,
    check_dead,
    check_flat,
    check_missing,
    check_rails,
    check_spikes,
    check_torn,
    combine,
)
from colonnade.signals.samples import BLOCK
from every import every
from prism import PRISM

TIME = np.arange(0, 8, 0.002)


def _digitised(values, full_scale, seed=0, noise=5e-4):
    """Noise of 0.05 % of the range and 16 bits, as a recorder gives."""
    step = full_scale / 2**15
    noisy = values + np.random.default_rng(seed).normal(0, noise * full_scale, values.size)
    return np.round(noisy / step) * step


FREE = rock(PRISM, restitution=0.95, theta0=0.1, duration=8.0)
ROCKING = np.interp(TIME, FREE.time, FREE.angle)
MOTIONS = {
    "rocking": _digitised(0.44 * np.sin(ROCKING), 0.1),
    "sine at 7 Hz": _digitised(3 * np.sin(14 * np.pi * TIME), 20.0),
    "broad-band motion": _digitised(np.random.default_rng(1).normal(0, 2, TIME.size).cumsum() * 0.05, 20.0),
    "noise alone": _digitised(np.zeros(TIME.size), 0.1),
    "a fall onto the frame": _digitised(np.minimum(1e-4 * np.exp(5.6 * np.clip(TIME - 3, 0, None)), 0.09), 0.1),
    "a release": _digitised(0.03 * np.clip((1.01 - TIME) / 0.014, 0, 1), 0.1),
}


@pytest.mark.parametrize("values", MOTIONS.values(), ids=MOTIONS.keys())
def test_a_sound_record_has_no_spike(values):
    assert not check_spikes(TIME, values, threshold=8.0).where.any()


@every("restitution", [0.95, 0.976])
@every("rate", [200, 400, 500, 1000])
def test_the_cusps_of_a_vertical_transducer_are_no_spikes(rate, restitution):
    history = rock(PRISM, restitution=restitution, theta0=0.05, duration=12.0)
    time = np.arange(0, 8, 1 / rate)
    values = _digitised(400 * np.abs(np.interp(time, history.time, history.angle)), 50.0)
    assert not check_spikes(time, values, threshold=8.0).where.any()
    values[time.size // 2] += 5.0
    assert np.flatnonzero(check_spikes(time, values, threshold=8.0).where).tolist() == [time.size // 2]


@pytest.mark.parametrize("values", MOTIONS.values(), ids=MOTIONS.keys())
@given(places=st.sets(st.integers(60, 390), min_size=1, max_size=3), sign=st.sampled_from([-1, 1]))
def test_planted_spikes_are_found_at_their_places(values, places, sign):
    spiked = values.copy()
    planted = np.zeros(values.size, dtype=bool)
    for place in places:
        planted[10 * place] = True
    spiked[planted] += sign * 0.6 * np.abs(values).max() + sign * 0.02
    found = check_spikes(TIME, spiked, threshold=8.0).where
    assert (found == planted).all()


def test_values_beyond_the_range_are_in_another_unit():
    verdict = check_clipping(TIME, 40.0 * np.sin(TIME), full_scale=10.0)
    assert (verdict.finding.kind, verdict.finding.severity) == ("unit", "serious")
    assert "beyond the range of ±10, up to 40: the values are in another unit" in verdict.reason
    spiked = np.sin(TIME)
    spiked[300] = 90.0
    assert check_clipping(TIME, spiked, full_scale=10.0).finding.kind == "end of the range"


@pytest.mark.parametrize("bits", [12, 16, 24])
def test_the_top_code_of_a_converter_is_the_end_of_its_range(bits):
    step = 10.0 / 2 ** (bits - 1)
    values = np.clip(np.round(11 * np.sin(TIME) / step) * step, -10.0, 10.0 - step)
    clipped = np.abs(11 * np.sin(TIME)) > 10.0
    verdict = check_clipping(TIME, values, full_scale=10.0)
    assert (verdict.where >= clipped).all()
    assert verdict.where.sum() <= clipped.sum() + 0.001 * TIME.size
    assert "end of the range (±10), the first at" in verdict.reason
    assert not check_clipping(TIME, 0.9 * values, full_scale=10.0).where.any()


def test_a_value_that_stays_the_same_is_flat_only_beyond_the_duration():
    values = np.sin(TIME)
    values[1000:1300] = values[1000]
    assert check_flat(TIME, values, duration=0.5).where.sum() == 300
    assert not check_flat(TIME, values, duration=0.7).where.any()
    assert "the channel is dead" in check_flat(TIME, np.full(TIME.size, 2.0), duration=0.5).reason


def test_missing_values_and_times_are_counted():
    values, time = np.sin(TIME), TIME.copy()
    values[5], time[9] = np.nan, np.nan
    assert np.flatnonzero(check_missing(time, values).where).tolist() == [5, 9]


def test_a_channel_beside_a_moving_table_that_hardly_moves_is_dead():
    table = np.sin(TIME)
    assert "practically dead" in check_dead(0.01 * table, table, share=0.08).reason
    assert check_dead(0.1 * table, table, share=0.08).reason == ""


def test_the_worst_flag_of_a_sample_stands():
    verdicts = [
        Verdict(Flag.FAIL, np.array([True, False, False]), Finding("a")),
        Verdict(Flag.SUSPECT, np.array([True, True, False]), Finding("b")),
        Verdict.good(3),
    ]
    flags, found = combine(verdicts, 3)
    assert flags.tolist() == [Flag.FAIL, Flag.SUSPECT, Flag.GOOD]
    assert [each.text for each in found] == ["a", "b"]


@pytest.mark.parametrize("place", range(BLOCK - 4, BLOCK + 3))
def test_a_spike_in_a_long_record_is_found_wherever_blocks_meet(place):
    time = np.arange(3 * BLOCK) * 0.001
    values = np.sin(time) + np.random.default_rng(5).normal(0, 1e-3, time.size)
    values[place] += 1.0
    assert np.flatnonzero(check_spikes(time, values, threshold=8.0).where).tolist() == [place]


TIME_RAILS = np.arange(0, 10, 1 / 400)


def _noisy(values, noise=0.01):
    return values + np.random.default_rng(2).normal(0, noise, values.size)


def _shaken(power=1.0):
    """A sine of 5 Hz that grows, dies and rests, of amplitude 10; its tops are flatter with a smaller power."""
    wave = np.sin(2 * np.pi * 5.0 * TIME_RAILS)
    return 10.0 * np.clip(np.minimum(TIME_RAILS - 1, 8 - TIME_RAILS), 0, 1) * np.sign(wave) * np.abs(wave) ** power


def _quake():
    return _shaken() * np.exp(-(((TIME_RAILS - 4.03) / 0.3) ** 2))


@pytest.mark.parametrize("limit", [9.0, 8.0, 6.2], ids=["10 %", "20 %", "38 %"])
@pytest.mark.parametrize("motion", [_shaken, _quake])
@pytest.mark.parametrize("noise", ["behind it", "before it", "none"])
def test_a_saturated_channel_is_told_whatever_its_noise(limit, motion, noise):
    values = np.clip(_noisy(motion()) if noise == "before it" else motion(), -limit, limit)
    values = {"behind it": _noisy, "before it": np.asarray, "none": lambda each: np.round(each, 1)}[noise](values)
    verdict = check_rails(TIME_RAILS, values)
    assert verdict.flag is Flag.SUSPECT
    assert verdict.finding.kind == "end of the range"
    assert "the channel saturates, and the value was larger. Its peaks are lower bounds" in verdict.reason
    beyond = np.abs(motion()) > limit
    assert verdict.where[beyond].mean() > 0.5
    assert (np.abs(motion())[verdict.where] > 0.9 * limit).all()


UNSATURATED = {
    "sine": _noisy(_shaken()),
    "one peak": _noisy(_quake()),
    "flat": _noisy(_shaken(0.5)),
    "no noise": _shaken(),
    "coarse": np.round(_shaken(), 1),
    "flatter, under noise": _noisy(_shaken(0.25), 0.1),
    "rest": _noisy(np.abs(_shaken())),
    "between strokes": _noisy(-10.0 * np.sin(2 * np.pi * 5.0 * TIME_RAILS).clip(0, None)),
    "a ramp that stays": _noisy(np.minimum(TIME_RAILS, 5.0)),
    "noise": _noisy(np.zeros_like(TIME_RAILS)),
    "dead": np.zeros_like(TIME_RAILS),
    "nothing": np.full_like(TIME_RAILS, np.nan),
}


@every("what", UNSATURATED)
def test_peaks_and_rest_are_no_saturation(what):
    assert check_rails(TIME_RAILS, UNSATURATED[what]).reason == ""


RELEASED = np.interp(TIME - 1.5, FREE.time, FREE.angle)
"""Held tilted for a second and a half, then let go, rad."""

FALL = np.where(TIME > 4.0, 1e-3 * np.expm1(PRISM.p * np.clip(TIME - 4.0, 0, None)), 0.02 * np.sin(9 * TIME))
LIFTED = 0.1 * np.clip((TIME - 1.0) / 0.3, 0, 1) ** 2


@pytest.mark.parametrize("share", [0.97, 0.9, 0.8, 0.6])
def test_a_transducer_that_saturates_at_the_peaks_of_a_rocking_block_is_told(share):
    limit = share * np.abs(RELEASED[1000:]).max()
    verdict = check_rails(TIME, _noisy(np.clip(RELEASED, -limit, limit), 1e-4), longest=0.5)
    assert "Its peaks are lower bounds" in verdict.reason
    assert np.abs(RELEASED[verdict.where]).min() > 0.98 * limit


@pytest.mark.parametrize("share", [0.3, 0.6, 0.9])
def test_a_cable_that_tears_is_told_with_its_jump(share):
    torn = np.where(np.arange(TIME.size) > np.argmax(-share * np.abs(RELEASED[1000:]).max() > RELEASED), 0.0, RELEASED)
    verdict = check_torn(TIME, _noisy(torn, 1e-4))
    jump = share * np.abs(RELEASED[1000:]).max()
    assert float(verdict.reason.split()[3]) == pytest.approx(jump, rel=0.05)
    assert verdict.finding.severity == "serious"


ROCKED = {
    "is held and rocks": RELEASED,
    "falls onto its frame": np.minimum(FALL, 0.28),
    "falls onto the floor": np.minimum(FALL, 1.4),
    "leans to the end": np.minimum(FALL, 0.15)[:2700],
    "is lifted and let go": np.concatenate((LIFTED[:900], RELEASED[500:])),
    "is held and let go again": np.concatenate((RELEASED[750:3500], LIFTED[500:900], RELEASED)),
    "stands": np.zeros(TIME.size),
    "comes to rest before a spike": 0.1 * np.exp(-2 * TIME) * np.cos(9 * TIME) + 0.2 * (np.abs(TIME - 6.0) < 5e-4),
    "was pushed": np.where(TIME > 4.0, 0.01, 0.0),
    "was not seen": np.full(TIME.size, np.nan),
}


@every("what", ROCKED)
def test_a_block_is_neither_stuck_nor_torn_off_that(what):
    values = _noisy(ROCKED[what], 1e-4)
    time = 0.002 * np.arange(values.size)
    assert check_rails(time, values, longest=0.5).reason == ""
    assert check_torn(time, values).reason == ""
