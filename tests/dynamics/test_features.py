"""Everything that the engines can do, one record each, beside SciPy's DOP853 split at samples, landings and uplifts."""

import numpy as np
import pytest

from colonnade.dynamics.block import Block
from colonnade.dynamics.motion import Motion
from colonnade.dynamics.rock import RestitutionLaw, rock
from every import every
from independent_rocking import Reference
from prism import PRISM

LOPSIDED = Block.measured(mass=80.0, pole_distance=(0.61, 0.60), critical_angle=(0.21, 0.15), inertia=(41.2, 40.0))
INTERVAL = 0.02


def _waves(seed, level, count=100):
    rng = np.random.default_rng(seed)
    time = np.arange(count) * INTERVAL
    parts = [rng.normal() * np.sin(2 * np.pi * rng.uniform(0.8, 5) * time + rng.uniform(0, 6)) for _ in range(5)]
    base = np.sum(parts, axis=0)
    return level * base / np.abs(base).max()


FEATURES = {
    "vertical acceleration": {"vertical": 5.0 * np.sin(np.arange(100) * 0.4)},
    "unequal sides": {"block": LOPSIDED, "level": 2.6, "seed": 2},
    "a pair of restitutions": {"restitution": (0.85, 0.97)},
    "a law of restitution": {"restitution": RestitutionLaw([0.0, 0.2, 0.6], [0.98, 0.9, 0.8])},
    "a tilted table": {"level": 1.6, "offset": 0.2},
    "return from beyond the critical angle": {"theta0": 1.1, "omega0": -0.5, "seed": 10},
    "accumulating impacts and uplift from rest again": {"restitution": 0.3, "uplifts": 5},
    "all of it": {
        "block": LOPSIDED, "seed": 2, "level": 2.9, "offset": -0.2, "theta0": -0.4,
        "vertical": 3.0 * np.cos(np.arange(100)),
        "restitution": RestitutionLaw([0.0, 0.5], [0.9, 0.7]),
    },
}  # fmt: skip


@every("model", ["linear", "nonlinear"])
@every("name", FEATURES)
def test_an_integration_of_the_same_equation_agrees_with(name, model):
    feature = FEATURES[name]
    block = feature.get("block", PRISM)
    waves = _waves(feature.get("seed", 4), feature.get("level", 2.0)) + feature.get("offset", 0.0)
    motion = Motion(waves * block.uplift_acceleration, INTERVAL, vertical=feature.get("vertical"))
    start = {
        "theta0": feature.get("theta0", 0.0) * block.critical_angle,
        "omega0": feature.get("omega0", 0.0) * block.critical_angle * block.p,
    }
    given = feature.get("restitution", 0.9)
    history = rock(block, motion, restitution=given, model=model, **start)
    if isinstance(given, tuple):
        law = lambda sign, _: given[1 if sign > 0 else 0]  # noqa: E731
    else:
        law = lambda _, speed: given(speed) if callable(given) else given  # noqa: E731
    reference = Reference(block, motion, law, model)
    expected = reference.angles(start["theta0"], start["omega0"])
    assert history.outcome == "rocking"
    assert len(reference.impacts) >= 5
    assert reference.uplifts >= feature.get("uplifts", 0)
    np.testing.assert_allclose(history.angle, expected, rtol=0, atol=1e-9 * block.critical_angle)
    np.testing.assert_allclose(history.impact_velocities[:5], reference.impacts[:5], rtol=1e-5)


def test_the_vertical_acceleration_is_gravity_to_a_block_at_rest():
    # Half of gravity, half of the threshold: this record uplifts on a sinking base and not on a still one.
    level = np.full(50, 0.6 * PRISM.uplift_acceleration)
    sinking = np.full(50, -0.5 * PRISM.gravity)
    for model in ("linear", "nonlinear"):
        assert rock(PRISM, Motion(level, 0.01), model=model).outcome == "no-rocking"
        assert rock(PRISM, Motion(level, 0.01, vertical=sinking), model=model).outcome != "no-rocking"


@pytest.mark.parametrize("model", ["linear", "nonlinear"])
def test_a_constant_vertical_acceleration_is_another_gravity(model):
    waves = _waves(5, 2.0) * PRISM.uplift_acceleration
    heavier = Block.prism(width=0.086, depth=0.086, height=0.456, mass=26.10, gravity=1.3 * PRISM.gravity)
    lifted = rock(PRISM, Motion(waves, INTERVAL, vertical=np.full(100, 0.3 * PRISM.gravity)), model=model)
    other = rock(heavier, Motion(waves, INTERVAL), model=model)
    assert np.abs(other.angle).max() > 0.01
    np.testing.assert_allclose(lifted.angle, other.angle, rtol=0, atol=1e-9)
