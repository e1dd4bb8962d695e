"""The memory and time that reading a file may use."""

from __future__ import annotations

import os
from dataclasses import dataclass
from pathlib import Path

MEGABYTE = 1_000_000

MEMORY = 1500 * MEGABYTE
"""Bytes that the reading of the smallest file may take."""
MEMORY_RATIO = 64
"""Bytes more for each byte of the file: two of them become a number of eight, compressed ones many, in a few copies."""
MEMORY_SHARE = 0.75
"""Share of the machine's memory that no reading may exceed, so that it fails before the system stops others."""
SECONDS = 8
"""Processor time that the reading of the smallest file may take."""
BYTES_PER_SECOND = MEGABYTE // 4
"""Bytes of the file that each add a second; the slowest reader, of .ods, is five times as fast."""
PATIENCE = 3.0
"""Longest time that may pass, as a multiple of the processor time, on a machine that does other things too."""


@dataclass(frozen=True)
class Bounds:
    """
    What the reading of one file may take.

    Attributes
    ----------
    memory : int
        Bytes, beyond what the process has before it opens the file.
    processor : int
        s of processor time.
    elapsed : float
        s from the start of the reading to its end.
    """

    memory: int
    processor: int
    elapsed: float


def bounds_of(*paths: Path) -> Bounds:
    """Bounds for a raw file that is in one or several files, by their size; a missing one counts as empty."""
    size = sum(_size(path) for path in paths)
    memory = min(MEMORY + MEMORY_RATIO * size, max(MEMORY, int(MEMORY_SHARE * _machine())))
    processor = SECONDS + size // BYTES_PER_SECOND
    return Bounds(memory, processor, PATIENCE * processor)


def _size(path: Path) -> int:
    try:
        return path.stat().st_size
    except OSError:
        return 0


def _machine() -> int:
    """Bytes of memory of this machine; a large number where the system does not tell."""
    try:
        return os.sysconf("SC_PHYS_PAGES") * os.sysconf("SC_PAGE_SIZE")
    except (AttributeError, ValueError, OSError):
        return 1 << 62
