"""
A thousand worst cases, seeded: a right answer or a clear error, and none hangs.

Run in a process of its own, so that one that hangs in compiled code ends with the limit below, far beyond any run.
"""

import math
import re
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

from colonnade.dynamics.block import Block
from colonnade.dynamics.motion import Motion
from colonnade.dynamics.rock import rock

HANGS_AFTER = 500
"""s."""

SEEDS = 50
MODELS = ("linear", "nonlinear")


def _any_block(rng):
    height = 10 ** rng.uniform(-2, 1.5)
    return Block.prism(width=height * rng.uniform(0.02, 0.9), depth=1.0, height=height, mass=10 ** rng.uniform(-2, 5))


def _threshold(block, model):
    return block.gravity * (block.critical_angle if model == "linear" else math.tan(block.critical_angle))


def _refused(words, **arguments):
    with pytest.raises(ValueError, match=re.escape(words)):
        rock(**arguments)


def _sound(history):
    assert np.isfinite(history.angle).all()
    assert np.isfinite(history.angular_velocity).all()
    assert (np.diff(history.impact_times) >= 0).all()
    assert history.outcome in ("no-rocking", "rocking", "overturned")


def _no_samples(rng, block, model):
    with pytest.raises(ValueError, match="at least one sample"):
        Motion([], 10 ** rng.uniform(-4, 2))


def _one_sample(rng, block, model):
    theta0 = rng.uniform(-1.5, 1.5) * block.critical_angle * rng.choice([0.0, 1e-9, 1.0])
    if abs(theta0) >= math.pi / 2:
        return
    history = rock(block, Motion([rng.normal() * 100], rng.uniform(1e-6, 10)), model=model, theta0=theta0)
    assert history.angle.tolist() == [theta0]
    # Let go from rest beyond α it falls, else it comes back, and cannot rise as far again.
    assert (history.outcome == "overturned") == (abs(theta0) > block.critical_angle)


def _at_the_threshold(rng, block, model):
    sign = rng.choice([-1.0, 1.0])
    count, dt = int(rng.integers(2, 300)), 10 ** rng.uniform(-3, 0) / block.p
    level = _threshold(block, model)
    # The engines see a/g: the largest level that g does not round above the threshold.
    limit = math.nextafter(level, 0.0)
    still = rock(block, Motion(np.full(count, sign * limit), dt), model=model)
    assert (still.angle == 0.0).all()
    moved = rock(block, Motion(np.full(count, sign * level * (1 + 1e-9)), dt), model=model)
    assert sign * moved.angle[-1] < 0.0
    if model == "linear" and abs(moved.angle[-1]) < 1:
        fallen = 1e-9 * block.critical_angle * (math.cosh(block.p * moved.time[-1]) - 1)
        assert abs(abs(moved.angle[-1]) - fallen) < 1e-5 * fallen + 1e-15


def _no_rebound(rng, block, model):
    level = rng.normal(size=200) * _threshold(block, model) * rng.uniform(0.2, 2)
    history = rock(block, Motion(level, 0.05 / block.p), model=model, restitution=0.0)
    _sound(history)
    assert (history.rebound_velocities == 0.0).all()
    free = rock(block, model=model, restitution=0.0, theta0=0.5 * block.critical_angle, duration=10 / block.p)
    assert free.impact_times.size == 1
    assert (free.angle[free.time > free.impact_times[0]] == 0.0).all()


def _no_loss(rng, block, model):
    theta0 = 10 ** rng.uniform(-5, -0.1) * block.critical_angle
    history = rock(block, model=model, restitution=1.0, theta0=theta0, duration=30 / block.p)
    _sound(history)
    assert np.ptp(history.energy) < 1e-9 * history.energy.max()
    waves = np.sin(np.arange(500)) * _threshold(block, model) * rng.uniform(0.5, 3)
    _sound(rock(block, Motion(waves, 0.05 / block.p), model=model, restitution=1.0))


def _huge_steps(rng, block, model):
    step = rng.uniform(0.5, 290) / block.p
    theta0, e = rng.uniform(0.05, 0.95) * block.critical_angle, rng.uniform(0, 0.97)
    coarse = rock(block, Motion(np.zeros(3), step), model=model, restitution=e, theta0=theta0)
    fine = rock(block, model=model, restitution=e, theta0=theta0, duration=2 * step)
    assert coarse.outcome == fine.outcome
    # Both walk the same impacts, as far as arcs are not yet lost in their own rounding.
    count = min(coarse.impact_times.size, fine.impact_times.size, 10)
    assert np.allclose(coarse.impact_times[:count], fine.impact_times[:count], rtol=1e-6)
    level = rng.normal(size=4) * _threshold(block, model) * 3
    _sound(rock(block, Motion(level, step), model=model, restitution=e))
    too_long = rng.uniform(301, 1e6) / block.p
    _refused("Check their units.", block=block, motion=Motion(level, too_long), model=model)


def _released_beyond(rng, block, model):
    alpha = block.critical_angle
    theta0 = rng.uniform(1.0001, min(3.0, 1.5 / alpha)) * alpha
    lean = theta0 - alpha
    # Speed that just brings it back over its pole.
    barrier = block.p * (lean if model == "linear" else 2 * math.sin(lean / 2))
    falls = rock(block, model=model, theta0=theta0, omega0=-0.999 * barrier, duration=20 / block.p, restitution=0.3)
    assert falls.outcome == "overturned"
    back = rock(block, model=model, theta0=theta0, omega0=-1.001 * barrier, duration=40 / block.p, restitution=0.3)
    assert back.impact_times.size > 0
    assert back.outcome == "rocking"
    _refused("an angle between −π/2 and π/2", block=block, model=model, theta0=rng.uniform(1.58, 100), duration=1.0)


def _not_a_number(rng, block, model):
    wrong = rng.choice([math.nan, math.inf, -math.inf])
    samples = rng.normal(size=5)
    place = int(rng.integers(5))
    samples[place] = wrong
    with pytest.raises(ValueError, match=f"not finite at sample {place}"):
        Motion(samples, 0.01)
    for name in ("theta0", "omega0", "restitution", "rest_angle", "duration"):
        _refused(f"{name} is {wrong}", block=block, model=model, **({"duration": 1.0} | {name: wrong}))


def _extremes(rng, block, model):
    level = rng.normal(size=50) * 10 ** rng.uniform(-300, 5) * block.gravity
    dt = 10 ** rng.uniform(-9, math.log10(290 / block.p))
    history = rock(block, Motion(level, dt), model=model, restitution=rng.uniform(0, 1))
    _sound(history)
    if np.abs(level).max() < _threshold(block, model):
        assert (history.angle == 0.0).all()
    _refused("Check their units.", block=block, motion=Motion([0.0, 2e6 * block.gravity], dt), model=model)
    tiny = rock(block, model=model, theta0=10 ** rng.uniform(-300, -12), duration=1 / block.p)
    assert tiny.outcome == "no-rocking"
    _sound(rock(block, model=model, omega0=rng.normal() * 1e5 * block.p, duration=1 / block.p))


FAMILIES = {
    "a record without samples": _no_samples,
    "a record of one sample": _one_sample,
    "a constant acceleration at the threshold": _at_the_threshold,
    "e = 0": _no_rebound,
    "e = 1": _no_loss,
    "huge steps": _huge_steps,
    "released beyond the critical angle": _released_beyond,
    "not a number": _not_a_number,
    "extreme magnitudes": _extremes,
    "all blocks": lambda rng, block, model: _sound(
        rock(block, Motion(rng.normal(size=100) * block.uplift_acceleration, 0.05 / block.p), model=model)
    ),
}


def _run_all():
    """Print a line for each family and model: how many seeds passed, and the first that did not."""
    for family, case in FAMILIES.items():
        for model in MODELS:
            passed, complaint = 0, ""
            for seed in range(SEEDS):
                rng = np.random.default_rng(seed)
                try:
                    case(rng, _any_block(rng), model)
                    passed += 1
                except (Exception, pytest.fail.Exception) as error:
                    complaint = complaint or f"seed {seed}: {error!r}"
            print(f"{family}|{model}|{passed}|{complaint}", flush=True)


@pytest.fixture(scope="module")
def verdicts():
    done = subprocess.run(
        [sys.executable, Path(__file__)], capture_output=True, text=True, timeout=HANGS_AFTER, check=False
    )
    assert done.returncode == 0, done.stderr
    rows = [line.split("|", 3) for line in done.stdout.splitlines()]
    return {(family, model): (int(passed), complaint) for family, model, passed, complaint in rows}


@pytest.mark.parametrize("model", MODELS)
@pytest.mark.parametrize("family", FAMILIES)
def test_a_right_answer_or_a_clear_error_for(family, model, verdicts):
    passed, complaint = verdicts[family, model]
    assert passed == SEEDS, complaint


if __name__ == "__main__":
    _run_all()
