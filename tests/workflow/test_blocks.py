"""Blocks that are finished are not done again, damaged ones are, and the sum is the same whatever the workers."""

import os

import numpy as np
import pytest

from colonnade.workflow.executors import Where, in_blocks

pytestmark = pytest.mark.whole

BLOCKS = tuple(range(6))


def squares(block):
    """Work of a block; it leaves a mark of who did it."""
    return {"squares": np.arange(block, block + 3.0) ** 2, "process": np.array(os.getpid())}


def failing_at_four(block):
    if block == 4:
        raise KeyboardInterrupt
    return squares(block)


def never(block):
    raise AssertionError(f"block {block} was done again")


def values(results):
    return [result["squares"].tolist() for result in results]


@pytest.mark.parametrize("workers", [1, 2])
def test_results_come_in_the_order_of_the_blocks_whatever_the_workers(tmp_path, workers):
    results = in_blocks(squares, BLOCKS, tmp_path / "kept", "key", Where(workers))
    assert values(results) == [[float(k**2), float((k + 1) ** 2), float((k + 2) ** 2)] for k in BLOCKS]
    assert (os.getpid() in {int(result["process"]) for result in results}) == (workers == 1)


def test_what_was_finished_before_an_interrupt_is_not_done_again(tmp_path):
    with pytest.raises(KeyboardInterrupt):
        in_blocks(failing_at_four, BLOCKS, tmp_path, "key", Where(1))
    done = []
    results = in_blocks(squares, BLOCKS, tmp_path, "key", Where(1, progress=lambda *state: done.append(state)))
    assert done == [(4, 6), (5, 6), (6, 6)]
    assert values(results) == values(in_blocks(never, BLOCKS, tmp_path, "key", Where(1)))


def test_blocks_of_another_plan_are_not_taken_and_go(tmp_path):
    in_blocks(squares, BLOCKS, tmp_path, "one", Where(1))
    with pytest.raises(AssertionError, match="block 0"):
        in_blocks(never, BLOCKS, tmp_path, "other", Where(1))
    assert [path.name for path in tmp_path.iterdir() if any(path.iterdir())] == []


@pytest.mark.parametrize(
    "damage",
    [
        lambda whole: whole[: len(whole) // 2],
        lambda whole: b"",
        lambda whole: whole[:150] + bytes([whole[150] ^ 1]) + whole[151:],
    ],
    ids=["cut off", "empty", "one bit"],
)
def test_a_damaged_block_is_done_again(tmp_path, damage):
    first = in_blocks(squares, BLOCKS, tmp_path, "key", Where(1))
    path = sorted(tmp_path.rglob("*.npz"))[2]
    path.write_bytes(damage(path.read_bytes()))
    again = in_blocks(squares, BLOCKS, tmp_path, "key", Where(1))
    assert values(again) == values(first)


KILLED = """
import sys, time
from pathlib import Path
import numpy as np
from colonnade.workflow.executors import Where, in_blocks
def slow(block):
    time.sleep(0.05)
    return {"value": np.array(block)}
told = lambda done, total: print(done, flush=True)
in_blocks(slow, range(200), Path(sys.argv[1]), "key", Where(1, progress=told))
"""


def value(block):
    return {"value": np.array(block)}


def test_a_kill_at_any_instant_leaves_whole_blocks_only(start, tmp_path):
    process = start(KILLED, tmp_path, said=5)
    process.kill()
    process.wait()
    kept = len(list(tmp_path.rglob("*.npz")))
    assert 5 <= kept < 200
    started = []
    results = in_blocks(value, range(200), tmp_path, "key", Where(1, progress=lambda *state: started.append(state)))
    assert started[0] == (kept, 200)
    assert [int(result["value"]) for result in results] == list(range(200))
