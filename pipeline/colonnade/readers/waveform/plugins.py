"""ObsPy's readers by format, found once: ObsPy itself searches all installed packages at each read."""

from __future__ import annotations

from collections.abc import Callable
from importlib.metadata import entry_points
from typing import Any

from obspy.core.util.base import ENTRY_POINTS

from colonnade.readers.waveform.kinds import RECOGNISED

UNSAFE = frozenset({"PICKLE"})
"""Kinds that can run code as they are read."""
IN_OTHER_FILES = frozenset({"CSS", "NNSA_KB_CORE", "Q"})
"""Kinds whose header names the files with the samples."""
KINDS = tuple(kind for kind in ENTRY_POINTS["waveform"] if kind not in UNSAFE | IN_OTHER_FILES)
"""All that may be read, as ObsPy calls them."""

_INSTALLED = entry_points()


def reader_of(kind: str) -> Callable[..., Any]:
    """ObsPy's function that reads a file of a kind, given its name."""
    (found,) = _INSTALLED.select(group=f"obspy.plugin.waveform.{kind}", name="readFormat")
    reader: Callable[..., Any] = found.load()
    return reader


for _kind in sorted(RECOGNISED):
    reader_of(_kind)  # imports what it needs
