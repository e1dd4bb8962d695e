"""Long work in independent blocks: finished ones are kept, so that interrupted work continues from there."""

from __future__ import annotations

import io
import shutil
import zipfile
from collections.abc import Callable, Mapping, Sequence
from functools import partial
from math import ceil
from pathlib import Path
from typing import Any, Protocol, TypeVar

import numpy as np
from numpy.typing import NDArray

from colonnade.store import files
from colonnade.workflow.execution.spreading import spread

Item = TypeVar("Item")
Arrays = dict[str, NDArray[Any]]

Counted = Callable[[int, int], None]
"""Told how many blocks are done, and of how many."""


MOST_BLOCKS = 128
"""Of a map: enough for any cluster, and few enough to keep."""


class Spread(Protocol):
    """`in_blocks` with its settings of execution and progress already given."""

    def __call__(
        self, work: Callable[[Item], Mapping[str, NDArray[Any]]], blocks: Sequence[Item], folder: Path, key: str
    ) -> list[Arrays]:
        """Return the results of each block."""


def blocks_of(number: int) -> list[range]:
    """Divide a number of columns into at most `MOST_BLOCKS` blocks of equal size, the last one smaller."""
    size = ceil(number / MOST_BLOCKS)
    return [range(start, min(start + size, number)) for start in range(0, number, size)]


def in_blocks(
    work: Callable[[Item], Mapping[str, NDArray[Any]]],
    blocks: Sequence[Item],
    folder: Path,
    key: str,
    *,
    workers: int | None = None,
    scheduler: str | None = None,
    progress: Counted | None = None,
) -> list[Arrays]:
    """
    Work on each block, or take the blocks that an interrupted earlier call finished.

    Parameters
    ----------
    work : callable
        Of a module; takes a block and returns its arrays by name. What it returns may depend on the block alone.
    blocks : sequence
    folder : Path
        Where finished blocks are kept; for this work only. The caller removes it (`forget`) when their sum is stored.
    key : str
        Hash of all that the result depends on; blocks under another key are removed.
    workers, scheduler : optional
        As of `spread`.
    progress : callable, optional

    Returns
    -------
    results : list of dict
        Of each block, in the order of `blocks`, whatever the order in which they ended.

    Raises
    ------
    StoreError
        If a block cannot be written.
    ColonnadeError
        If workers fail; the blocks that are finished stay.
    """
    here = folder / key[:16]
    for other in folder.glob("*"):
        if other != here:
            shutil.rmtree(other, ignore_errors=True)
    found = {number: kept for number in range(len(blocks)) if (kept := _kept(_path(here, number))) is not None}
    missing = [number for number in range(len(blocks)) if number not in found]
    _tell(progress, len(found), len(blocks))
    numbered = partial(_numbered, work)
    for number, arrays in spread(
        numbered, [(number, blocks[number]) for number in missing], workers=workers, scheduler=scheduler
    ):
        _keep(_path(here, number), arrays)
        found[number] = arrays
        _tell(progress, len(found), len(blocks))
    return [found[number] for number in range(len(blocks))]


def forget(folder: Path) -> None:
    """Remove what `in_blocks` kept."""
    shutil.rmtree(folder, ignore_errors=True)


def _numbered(work: Callable[[Item], Mapping[str, NDArray[Any]]], numbered: tuple[int, Item]) -> tuple[int, Arrays]:
    number, block = numbered
    return number, dict(work(block))


def _path(folder: Path, number: int) -> Path:
    return folder / f"{number:06d}.npz"


def _keep(path: Path, arrays: Arrays) -> None:
    stream = io.BytesIO()
    np.savez(stream, allow_pickle=False, **arrays)
    files.write_bytes(path, stream.getbuffer())


def _kept(path: Path) -> Arrays | None:
    """Arrays of a finished block; None if it is missing or unreadable."""
    try:
        with np.load(path, allow_pickle=False) as stored:
            return {name: stored[name] for name in stored.files}
    except (OSError, ValueError, EOFError, KeyError, zipfile.BadZipFile):
        return None


def _tell(progress: Counted | None, done: int, total: int) -> None:
    if progress is not None:
        progress(done, total)
