"""Calls in this process or in others: each once, an error as it was raised, a stopped worker with what to do."""

import os
import signal
import subprocess
import sys
from pathlib import Path

import pytest

from colonnade.errors import ColonnadeError
from colonnade.workflow.executors import Where, spread


def whose(number):
    return number**2, os.getpid()


def refuse(number):
    if number == 2:
        raise ColonnadeError("number 2 cannot be")
    return number


def die(number):
    os.kill(os.getpid(), signal.SIGKILL)


def die_once(place):
    """Let the process be killed at the first call only."""
    mark = Path(place)
    if not mark.exists():
        mark.touch()
        os.kill(os.getpid(), signal.SIGKILL)
    return mark.name


@pytest.mark.whole
def test_the_caller_may_use_joblib_afterwards_and_we_after_it():
    """In a process of its own: what joblib finds depends on all that ran before."""
    program = (
        "from joblib import Parallel, delayed\n"
        "from colonnade.workflow.executors import Where, spread\n"
        "for _ in range(2):\n"
        "    found = [value for _, value in sorted(spread(abs, [-1, -2, -3], Where(workers=2)))]\n"
        "    print(found, Parallel(2)(delayed(abs)(value) for value in (-4, -5)))\n"
    )
    ended = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, check=False)
    assert ended.stdout == "[1, 2, 3] [4, 5]\n" * 2, ended.stderr


@pytest.mark.parametrize(
    ("items", "workers"), [([3, 1, 2], 1), ([3], 4), ([], 4)], ids=["one worker", "one item", "nothing"]
)
def test_one_worker_or_one_item_is_done_here_and_in_order(items, workers):
    expected = [(place, (item**2, os.getpid())) for place, item in enumerate(items)]
    assert list(spread(whose, items, Where(workers=workers))) == expected


@pytest.mark.parametrize("workers", [1, 2])
def test_an_error_is_the_one_that_was_raised(workers):
    with pytest.raises(ColonnadeError, match="number 2 cannot be"):
        list(spread(refuse, range(4), Where(workers=workers)))


@pytest.mark.whole
@pytest.mark.skipif(os.name == "nt", reason="signals of this kind are POSIX's")
def test_what_a_stopped_worker_did_is_done_again(tmp_path):
    (tmp_path / "second").touch()
    found = spread(die_once, [str(tmp_path / name) for name in ("first", "second")], Where(workers=2))
    assert sorted(found) == [(0, "first"), (1, "second")]


@pytest.mark.whole
@pytest.mark.skipif(os.name == "nt", reason="signals of this kind are POSIX's")
def test_a_worker_that_is_stopped_is_an_error_with_what_to_do():
    with pytest.raises(ColonnadeError, match=r"A worker process was stopped.*Run again with fewer workers"):
        list(spread(die, range(2), Where(workers=2)))
