"""Histories in blocks: the same whatever the processes and interruptions; their key depends on all inputs."""

import os
import random
import signal
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from colonnade.assessment.cases import Cases, run_cases
from colonnade.assessment.real_column import RealColumn, draw
from colonnade.dynamics.block import Block
from colonnade.dynamics.motion import Motion
from colonnade.workflow.assessing import given, outcomes_of
from colonnade.workflow.executors import Where

BLOCK = Block.measured(mass=1000.0, pole_distance=4.0, critical_angle=0.18, inertia=4 / 3 * 1000.0 * 16.0)
COLUMN = RealColumn(BLOCK, 0.95, p_range=(1.2, 1.5))
WAVES = tuple(Motion(np.sin(0.1 * hertz * np.arange(200)), 0.01, transverse=np.ones(200)) for hertz in (1, 2, 3))
DRAWS = np.stack([draw(COLUMN, 20, record=record) for record in range(3)])
CASES = Cases(COLUMN, DRAWS, WAVES, np.tile([[1.0, np.nan], [3.0, 1.0]], (3, 1, 1)))


def test_blocks_give_what_the_whole_gives(tmp_path):
    outcomes = outcomes_of(CASES, Where(workers=1), tmp_path, "key")
    whole = run_cases(CASES)
    for name in ("outcome", "peak_ratio"):
        np.testing.assert_array_equal(getattr(outcomes, name), getattr(whole, name))


@pytest.mark.parametrize(
    ("changed", "what"),
    [
        ({"column": replace(COLUMN, restitution=0.94)}, "column"),
        ({"draws": np.stack([draw(COLUMN, 20, seed=1)] * 3)}, "column"),
        ({"model": "linear"}, "column"),
        ({"motions": (*WAVES[:2], Motion(WAVES[2].acceleration, 0.011, transverse=np.ones(200)))}, "motions"),
        ({"motions": (*WAVES[:2], Motion(WAVES[2].acceleration, 0.01, vertical=np.ones(200)))}, "motions"),
        ({"factors": 2.0 * CASES.factors}, "factors"),
    ],
    ids=["e", "draws", "model", "interval", "component", "factors"],
)
def test_the_hash_of_what_is_given_changes_with_it(changed, what):
    before, after = given(CASES), given(replace(CASES, **changed))
    assert [name for name in before if before[name] != after[name]] == [what]
    assert given(replace(CASES)) == before


KILLED = """
import sys
from pathlib import Path
import test_assessing_blocks as tested
print("going", flush=True)
where = tested.Where(workers=2, progress=lambda done, total: print(done, total, flush=True))
tested.outcomes_of(tested.MANY, where, Path(sys.argv[1]), "key")
"""
MANY = replace(
    CASES, draws=np.stack([draw(COLUMN, 20)] * 120), motions=40 * WAVES, factors=np.tile(CASES.factors, (40, 1, 1))
)


@pytest.mark.slow
def test_ten_kills_and_a_resumption_give_the_undisturbed_values(start, tmp_path):
    chance, done = random.Random(1), [0]
    for _ in range(10):
        process = start(KILLED, tmp_path, said="going", cwd=Path(__file__).parent)
        found, total = map(int, process.stdout.readline().split())
        assert found >= done[-1]
        until = found + chance.randint(0, 8)
        while found < until:
            found = int(process.stdout.readline().split()[0])
        os.killpg(process.pid, signal.SIGKILL)
        process.wait()
        done.append(found)
    assert 10 < done[-1] < total
    steps = []
    again = Where(workers=2, progress=lambda *step: steps.append(step))
    outcomes = outcomes_of(MANY, again, tmp_path, "key")
    assert steps[0][0] >= done[-1]
    whole = run_cases(MANY)
    for name in ("outcome", "peak_ratio"):
        np.testing.assert_array_equal(getattr(outcomes, name), getattr(whole, name))
