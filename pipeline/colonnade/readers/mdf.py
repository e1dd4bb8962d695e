"""ASAM MDF measurement data (.mdf, .mf4), read by asammdf."""

from __future__ import annotations

import gc
import logging
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from datetime import datetime
from pathlib import Path
from traceback import clear_frames
from typing import Any

import numpy as np
from pydantic import BaseModel, ConfigDict

from colonnade.errors import ReadError
from colonnade.readers.recording import RecordedChannel, Recording
from colonnade.readers.registry import Format, Recognition

SIGNATURES = (b"MDF     ", b"UnFinMF ")
"""First bytes of a file that was closed, and of one that was not."""
MASTER_CHANNELS = (2, 3)
"""Kinds of channels that hold the times of their group: recorded and virtual."""


class MdfOptions(BaseModel):
    """Nothing has to be said about an MDF file: its blocks tell all."""

    model_config = ConfigDict(extra="forbid", frozen=True)


def recognise(path: Path) -> Recognition:
    """Say whether the first bytes are those of an MDF file."""
    with path.open("rb") as stream:
        head = stream.read(8)
    if head in SIGNATURES:
        return Recognition(True, f'it starts with "{head.decode().strip()}"')
    return Recognition(False, 'it does not start with "MDF"')


def read(path: Path, options: MdfOptions) -> Recording:
    """
    Read an MDF file; each group of channels keeps its own clock.

    Raises
    ------
    ReadError
        If asammdf cannot read it, or no channel holds numbers.
    """
    with path.open("rb") as stream:
        finished = stream.read(8) == SIGNATURES[0]
        stream.seek(0)
        with _quiet(path):
            channels, left_out, start, version = _content(stream)
    warnings = [] if finished else ["the recorder did not close the file: its end may be missing"]
    if not channels:
        raise ReadError(f"{path.name}: no channel of the MDF file holds numbers.")
    notes = [f"MDF {version}, read by asammdf", "clock: each group's own master channel"]
    if left_out:
        notes.append(f"no numbers in {', '.join(left_out[:8])}: left out")
    return Recording(path, "mdf", tuple(channels), start, tuple(notes), tuple(warnings))


def _content(stream: Any) -> tuple[list[RecordedChannel], list[str], datetime, str]:
    """Read all channels of numbers, the names of the others, the start and the version."""
    from asammdf import MDF

    channels: list[RecordedChannel] = []
    left_out: list[str] = []
    with MDF(stream) as file:  # a stream, since a file that it is given by name it may unpack, or take away
        version = str(file.version)
        groups: list[Any] = file.groups
        for group_number, group in enumerate(groups):
            for number, channel in enumerate(group.channels):
                if channel.channel_type in MASTER_CHANNELS or (version < "4" and channel.channel_type == 1):
                    continue
                found = _channel(file.get(group=group_number, index=number), group_number)
                if found is None:
                    left_out.append(f'"{channel.name}"')
                else:
                    channels.append(found)
        return channels, left_out, file.start_time, version


@contextmanager
def _quiet(path: Path) -> Iterator[None]:
    """Turn what asammdf raises into one message, without its log and what its half-built objects say as they go."""
    logger, hook = logging.getLogger("asammdf"), sys.unraisablehook
    was_disabled = logger.disabled
    logger.disabled, sys.unraisablehook = True, lambda unraisable: None
    try:
        yield
    except MemoryError:
        raise
    except Exception as error:
        said = f"{type(error).__name__}: {' '.join(str(error).split())[:200]}"
        cause: BaseException | None = error
        while cause is not None:
            clear_frames(cause.__traceback__)
            cause = cause.__context__
        gc.collect()
        raise ReadError(
            f"{path.name}: asammdf cannot read it ({said}). The file was cut off or is damaged; copy it from the "
            "recorder again."
        ) from None
    finally:
        logger.disabled, sys.unraisablehook = was_disabled, hook


def _channel(signal: Any, group: int) -> RecordedChannel | None:
    """A channel of numbers; None where it holds text or arrays."""
    samples = np.asarray(signal.samples)
    if samples.dtype.kind not in "biuf" or samples.ndim != 1 or not samples.size:
        return None
    values = samples.astype(np.float64)
    if signal.invalidation_bits is not None:
        values[np.asarray(signal.invalidation_bits, dtype=bool)] = np.nan
    values[~np.isfinite(values)] = np.nan
    time = np.asarray(signal.timestamps, dtype=np.float64)
    return RecordedChannel(
        signal.name,
        signal.unit or None,
        values,
        time if time.size == values.size else None,
        heading=f"{signal.name} (group {group + 1})",
    )


FORMAT = Format(
    name="mdf",
    summary="ASAM MDF measurement data, versions 2 to 4.",
    suffixes=(".mdf", ".mf4", ".dat"),
    options=MdfOptions,
    recognise=recognise,
    read=read,
    package="asammdf",
    extra="mdf",
)
