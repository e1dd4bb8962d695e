"""Runs the members in blocks, on all cores; blocks that were run before by the same code are taken as they are."""

from __future__ import annotations

import hashlib
from collections.abc import Callable, Iterable
from pathlib import Path
from typing import Any

import numpy as np
from joblib import Memory, Parallel, delayed

from colonnade.sources import code_hash
from span_two_and_a_half.design import STEPS, SWEEPS, Cell, cells, intensities
from span_two_and_a_half.members import Judged, run_members

BLOCK = 60
"""Intensities of a block."""

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
    """

    def __init__(self, folder: Path, workers: int) -> None:
        self._memory = Memory(folder, verbose=0)
        self._pool = Parallel(n_jobs=workers)
        self._code = _code()

    def map(self, function: Callable[..., Any], arguments: Iterable[tuple[Any, ...]]) -> list[Any]:
        """Return `function(*each)` for each of the arguments."""
        kept = self._memory.cache(_called, ignore=["function"])
        name = f"{function.__module__}.{function.__qualname__}"
        return list(self._pool(delayed(kept)(name, self._code, each, function) for each in arguments))


def _called(name: str, code: str, arguments: tuple[Any, ...], function: Callable[..., Any]) -> Any:
    return function(*arguments)


def _code() -> str:
    """Hash the engines, and the modules of this study that runs follow from."""
    digest = hashlib.sha256(code_hash(ENGINES).encode())
    for path in sorted(Path(__file__).parent.glob("*.py")):
        if path.stem not in ("page", "drawings", "fixed"):
            digest.update(path.read_bytes())
    return digest.hexdigest()


def run_cells(runner: Runner, chosen: list[Cell] | None = None, steps: int = STEPS) -> dict[Cell, Judged]:
    """Run all members of the plane models, at every so manieth intensity if `steps` is fewer than all."""
    levels = intensities()[:: STEPS // steps]
    blocks = [
        (cell, levels[start : start + BLOCK], start * SWEEPS, SWEEPS)
        for cell in (cells() if chosen is None else chosen)
        for start in range(0, levels.size, BLOCK)
    ]
    found: dict[Cell, list[Judged]] = {}
    for block, judged in zip(blocks, runner.map(run_members, blocks), strict=True):
        found.setdefault(block[0], []).append(judged)
    return {cell: joined(parts) for cell, parts in found.items()}


def joined(parts: list[Judged]) -> Judged:
    """Put blocks of members together."""
    return Judged(*(np.concatenate([vars(part)[name] for part in parts]) for name in vars(parts[0])))
