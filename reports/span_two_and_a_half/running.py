"""Runs the members in blocks, on all cores; blocks that were run before by the same code are taken as they are."""

from __future__ import annotations

import hashlib
import re
import time
from collections.abc import Callable, Iterable
from pathlib import Path
from typing import Any

from joblib import Memory, Parallel, delayed

from colonnade.sources import code_hash
from span_two_and_a_half.design import STEPS, SWEEPS, Cell, cells, intensities
from span_two_and_a_half.members import Judged, joined, run_members

BLOCK = 60
"""Intensities of a block."""

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


def run_cells(runner: Runner, *, steps: int = STEPS, sweeps: int = SWEEPS) -> dict[Cell, Judged]:
    """Run all members of the plane models, at every so manieth intensity if `steps` is fewer than all."""
    levels = intensities()[:: STEPS // steps]
    blocks = [
        (cell, levels[start : start + BLOCK], start * sweeps, sweeps)
        for cell in cells()
        for start in range(0, levels.size, BLOCK)
    ]
    found: dict[Cell, list[Judged]] = {}
    for block, judged in zip(blocks, runner.map(run_members, blocks), strict=True):
        found.setdefault(block[0], []).append(judged)
    return {cell: joined(parts) for cell, parts in found.items()}
