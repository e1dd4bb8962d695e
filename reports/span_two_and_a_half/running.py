"""Runs the members in blocks, on all cores; blocks that were run before by the same code are taken as they are."""

from __future__ import annotations

import hashlib
import re
import time
from collections.abc import Callable, Iterable, Sequence
from pathlib import Path
from typing import Any

from joblib import Memory, Parallel, delayed

from colonnade.arrays import Mask
from colonnade.sources import code_hash
from span_two_and_a_half.design import MORE_SWEEPS, SEED, STEPS, SWEEPS, TIME_SCALE, Cell, cells, intensities
from span_two_and_a_half.members import Judged, agreeing, joined, run_members

BLOCK_MEMBERS = 480
"""Members of a block, about."""

Run = tuple[int, str, float]
STANDARD: Run = (SEED, "chopra", TIME_SCALE)
"""Seed, series of the record and factor on its time, of the study."""

MORE = 1_000_000
"""Number of the first member of those that are run in addition."""

REPORTS = Path(__file__).resolve().parents[1]
_IMPORT = re.compile(r"^from ([\w.]+) import ", re.MULTILINE)

ENGINES = ("colonnade.dynamics", "colonnade.signals.filters", "colonnade.laboratory")


class Runner:
    """
    Calls functions on many arguments, and keeps what they return.

    Parameters
    ----------
    folder : Path
        Where results are kept.
    workers : int
        Processes.

    Attributes
    ----------
    seconds : float
        Processor time of all that was asked for, s, also of what had been run before.
    """

    def __init__(self, folder: Path, workers: int) -> None:
        self._memory = Memory(folder, verbose=0)
        self._pool = Parallel(n_jobs=workers)
        self.seconds = 0.0

    def map(self, function: Callable[..., Any], arguments: Iterable[tuple[Any, ...]]) -> list[Any]:
        """Return `function(*each)` for each of the arguments."""
        kept = self._memory.cache(_called, ignore=["function"])
        code = code_of(function.__module__)
        done = self._pool(delayed(kept)(function.__qualname__, code, each, function) for each in arguments)
        self.seconds += sum(seconds for _, seconds in done)
        return [result for result, _ in done]


def _called(name: str, code: str, arguments: tuple[Any, ...], function: Callable[..., Any]) -> tuple[Any, float]:
    began = time.process_time()
    return function(*arguments), time.process_time() - began


def code_of(module: str) -> str:
    """Hash the engines, and the modules of the reports that this one needs."""
    digest = hashlib.sha256(code_hash(ENGINES).encode())
    waiting, reached = [module], set()
    while waiting:
        name = waiting.pop()
        path = REPORTS / (name.replace(".", "/") + ".py")
        if name in reached or not path.is_file():
            continue
        reached.add(name)
        waiting += _IMPORT.findall(path.read_text(encoding="utf-8"))
    for name in sorted(reached):
        digest.update((REPORTS / (name.replace(".", "/") + ".py")).read_bytes())
    return digest.hexdigest()


def run_cells(
    runner: Runner,
    *,
    steps: int = STEPS,
    sweeps: int = SWEEPS,
    more: int = MORE_SWEEPS,
    chosen: Sequence[Cell] | None = None,
    other: Run = STANDARD,
) -> tuple[dict[Cell, Judged], Mask]:
    """
    Run all members of the plane models, at every so manieth intensity if `steps` is fewer than all.

    Returns
    -------
    found : dict of Cell to Judged
    agree : ndarray of bool, shape (steps,)
        The intensities at which `more` members were run.
    """
    levels = intensities()[:: STEPS // steps]
    agree = runner.map(agreeing, [(levels, *other[1:])])[0]
    blocks = []
    for cell in cells() if chosen is None else chosen:
        for some, number, count in ((levels, 0, sweeps), (levels[agree], MORE, more)):
            size = max(BLOCK_MEMBERS // count, 1)
            blocks += [
                (cell, some[start : start + size], number + start * count, count, *other)
                for start in range(0, some.size, size)
            ]
    found: dict[Cell, list[Judged]] = {}
    for block, judged in zip(blocks, runner.map(run_members, blocks), strict=True):
        found.setdefault(block[0], []).append(judged)
    return {cell: joined(parts) for cell, parts in found.items()}, agree
