"""How many blocks end under one motion: as `rock` says of each, to the last bit."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from colonnade.dynamics.motion import Motion
from colonnade.dynamics.plane.harmonic.motion import OUTCOMES
from colonnade.dynamics.plane.outcomes import ends_of, prepared
from colonnade.dynamics.rock import rock
from prism import PRISM

LEANING = replace(PRISM, positive=replace(PRISM.positive, critical_angle=1.3 * PRISM.critical_angle))
TIME = np.arange(0.0, 4.0, 0.005)
SHAKEN = np.sin(2 * np.pi * 2.0 * TIME) * np.sin(np.pi * TIME / 4.0) * PRISM.gravity
LIFTED = 0.4 * np.cos(2 * np.pi * 5.0 * TIME) * PRISM.gravity


@pytest.mark.parametrize("model", ["linear", "nonlinear"])
@pytest.mark.parametrize("vertical", [None, LIFTED, 0.0 * LIFTED], ids=["level", "lifted", "lifted by nothing"])
def test_ends_are_those_of_the_histories(model, vertical):
    blocks = [(PRISM, (0.95, 0.95)), (LEANING, (0.9, 0.96)), (PRISM, (0.8, 0.8))]
    drawn, seen = [prepared(*each) for each in blocks], set()
    for level in (0.1, 0.15, 0.22, 0.3, 0.6, 1.2):
        motion = Motion(level * SHAKEN, 0.005, vertical)
        ends = ends_of(motion, drawn, gravity=PRISM.gravity, model=model)
        for number, (block, e) in enumerate(blocks):
            history = rock(block, motion, restitution=e, model=model)
            assert OUTCOMES[ends.outcome[number]] == history.outcome
            overturns = history.outcome == "overturned"
            expected = (np.nan, history.overturning_time) if overturns else (history.peak_ratio, history.peak_time)
            np.testing.assert_array_equal((ends.peak_ratio[number], ends.instant[number]), expected)
            seen.add(history.outcome)
    assert seen == set(OUTCOMES)


def test_a_block_is_refused_whose_e_is_none():
    with pytest.raises(ValueError, match=r"restitution is 1\.1; a number between 0 and 1"):
        prepared(PRISM, 1.1)
