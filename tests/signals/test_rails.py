"""A channel that saturates below any range that is given, and what only looks so."""

from __future__ import annotations

import numpy as np
import pytest

from colonnade.signals.quality import Flag
from colonnade.signals.rails import check_rails

TIME = np.arange(0, 10, 1 / 400)
NOISE = 0.01
GENERATOR_SEED = 2


def _noisy(values, noise=NOISE):
    return values + np.random.default_rng(GENERATOR_SEED).normal(0, noise, values.size)


def _shaken(power=1.0):
    """A sine of 5 Hz that grows, dies and rests, of amplitude 10; its tops are flatter with a smaller power."""
    wave = np.sin(2 * np.pi * 5.0 * TIME)
    return 10.0 * np.clip(np.minimum(TIME - 1, 8 - TIME), 0, 1) * np.sign(wave) * np.abs(wave) ** power


def _quake():
    return _shaken() * np.exp(-(((TIME - 4.03) / 0.3) ** 2))


@pytest.mark.parametrize("limit", [9.0, 8.0, 6.2], ids=["10 %", "20 %", "38 %"])
@pytest.mark.parametrize("motion", [_shaken, _quake])
@pytest.mark.parametrize("noise_behind", [True, False], ids=["noise behind it", "noise before it"])
def test_a_saturated_channel_is_told_whatever_its_noise(limit, motion, noise_behind):
    values = motion()
    values = _noisy(np.clip(values, -limit, limit)) if noise_behind else np.clip(_noisy(values), -limit, limit)
    verdict = check_rails(TIME, values)
    assert verdict.flag is Flag.SUSPECT
    assert verdict.kind == "end of the range"
    assert "the channel saturates, and the value was larger. Its peaks are lower bounds" in verdict.reason
    beyond = np.abs(motion()) > limit
    assert verdict.where[beyond].mean() > 0.5
    assert (np.abs(motion())[verdict.where] > 0.9 * limit).all()


def test_a_channel_without_noise_saturates_within_a_step():
    verdict = check_rails(TIME, np.round(np.clip(_quake(), -6.2, 6.2), 1))
    assert verdict.where[np.abs(_quake()) > 6.2].mean() > 0.5


def test_one_side_may_saturate_alone():
    verdict = check_rails(TIME, _noisy(np.minimum(_shaken(), 7.0)))
    assert (_shaken()[verdict.where] > 6.0).all()
    assert verdict.where.any()


@pytest.mark.parametrize(
    "values",
    [
        _noisy(_shaken()),
        _noisy(_quake()),
        _noisy(_shaken(0.5)),
        _shaken(),
        np.round(_shaken(), 1),
        _noisy(np.abs(_shaken())),
        _noisy(-10.0 * np.sin(2 * np.pi * 5.0 * TIME).clip(0, None)),
        _noisy(np.minimum(TIME, 5.0)),
        _noisy(np.zeros_like(TIME)),
        np.zeros_like(TIME),
        np.full_like(TIME, np.nan),
    ],
    ids=[
        "sine",
        "one peak",
        "flat",
        "no noise",
        "coarse",
        "rest",
        "between strokes",
        "a ramp that stays",
        "noise",
        "dead",
        "nothing",
    ],
)
def test_peaks_and_rest_are_no_saturation(values):
    assert check_rails(TIME, values).reason == ""
