"""Rest is told from motion."""

import numpy as np

from colonnade.signals.rest import drift, find_rest

TIME = np.arange(0, 5, 0.002)
NOISE = np.random.default_rng(0).normal(0, 1e-5, TIME.size)
DECAY = NOISE + np.where(TIME < 4, 0.01 * np.sin(9 * TIME), 0.0)


def test_the_quiet_end_of_a_decay_is_rest_and_its_moving_start_is_not():
    window = find_rest(TIME, {"top": (DECAY, 1e-5)}, end=True, duration=0.5)
    assert (window.quiet, window.stop) == (True, TIME[-1])
    window = find_rest(TIME, {"top": (DECAY, 1e-5), "bottom": (NOISE, 1e-5)}, end=False, duration=0.5)
    assert (window.quiet, window.start) == (False, TIME[0])


def test_what_a_transducer_drifts_between_two_rests_is_told():
    values = NOISE + 2e-4 * TIME / TIME[-1] + np.where((TIME > 2) & (TIME < 3), 0.01, 0.0)
    assert abs(drift(TIME, values, duration=0.5, noise=1e-5) - 1.8e-4) < 5e-6
    assert drift(TIME, DECAY, duration=0.5, noise=1e-5) == 0.0


def test_a_channel_without_values_is_not_at_rest():
    assert not find_rest(TIME, {"top": (np.full(TIME.size, np.nan), 1.0)}, end=True, duration=0.5).quiet
