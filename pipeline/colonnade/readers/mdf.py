"""ASAM MDF measurement data (.mdf, .mf4), read by asammdf."""

from __future__ import annotations

import gc
import logging
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from datetime import datetime
from io import BytesIO
from pathlib import Path
from traceback import clear_frames
from typing import Any

import numpy as np
from pydantic import BaseModel, ConfigDict

from colonnade.errors import ReadError
from colonnade.readers.mdf_conversions import NoNumbersError, NotComputedError, convert
from colonnade.readers.recording import Array, RecordedChannel, Recording
from colonnade.readers.registry import Format, Recognition

SIGNATURES = (b"MDF     ", b"UnFinMF ")
"""First bytes of a file that was closed, and of one that was not."""
MASTER_CHANNELS = (2, 3)
"""Kinds of channels that hold the times of their group: recorded and virtual."""
REMOTE_MASTER = 1 << 3
"""Flag of a group of version 4 that has the clock of another one."""

Conversions = dict[tuple[int, int], Any]
"""Conversion blocks by the numbers of their groups and channels."""


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
            content = _content(stream)
    warnings = [] if finished else ["the recorder did not close the file: its end may be missing"]
    warnings += [f'"{name}" is left out: {reason}' for name, reason in content.left_out] + content.warnings
    if not content.channels:
        raise ReadError(f"{path.name}: no channel of the MDF file holds numbers{_because(warnings)}.")
    notes = [f"MDF {content.version}, read by asammdf", "clock: each group's own master channel"]
    if content.texts:
        notes.append(f"no numbers in {', '.join(content.texts[:8])}: left out")
    return Recording(
        path,
        "mdf",
        tuple(content.channels),
        content.start,
        tuple(notes),
        tuple(warnings),
        left_out=tuple(content.left_out),
    )


def _because(warnings: list[str]) -> str:
    return f" ({warnings[0]})" if warnings else ""


@dataclass(frozen=True)
class _Content:
    """
    What a file holds.

    Attributes
    ----------
    texts : list of str
        Names of the channels without numbers.
    left_out : list of (str, str)
        Those whose numbers are not computed, with the reason.
    """

    channels: list[RecordedChannel]
    texts: list[str]
    left_out: list[tuple[str, str]]
    start: datetime
    version: str
    warnings: list[str]


def _content(stream: Any) -> _Content:
    """Read all channels of numbers from their raw values."""
    channels: list[RecordedChannel] = []
    texts: list[str] = []
    left_out: list[tuple[str, str]] = []
    warnings: list[str] = []
    # A stream, since a file that it is given by name it may unpack, or take away.
    with _asammdf().MDF(stream, process_bus_logging=False) as file:
        version = str(file.version)
        is_version_4 = version >= "4"
        conversions = _without_conversions(file)
        for group_number, group in enumerate(file.groups):
            time, told = _clock(file, group_number, conversions, is_version_4=is_version_4)
            warnings += told
            for number, channel in enumerate(group.channels):
                if channel.channel_type in MASTER_CHANNELS or (not is_version_4 and channel.channel_type == 1):
                    continue
                try:
                    values = _values(file, group_number, number, conversions, is_version_4=is_version_4)
                except NotComputedError as reason:
                    left_out.append((channel.name, str(reason)))
                    continue
                except NoNumbersError:
                    texts.append(f'"{channel.name}"')
                    continue
                channels.append(
                    RecordedChannel(
                        channel.name,
                        _unit(channel, conversions.get((group_number, number))),
                        values,
                        time if time is not None and time.size == values.size else None,
                        heading=f"{channel.name} (group {group_number + 1})",
                    )
                )
        return _Content(channels, texts, left_out, file.start_time, version, warnings)


def _asammdf() -> Any:
    """asammdf without what it could do beside reading: evaluate a formula, write a file of its own."""
    import asammdf
    from asammdf.blocks import mdf_v3, mdf_v4, v2_v3_blocks, v4_blocks

    replaced = {
        "evaluate": _never,
        "lambdify": None,
        "NamedTemporaryFile": lambda *rest, **settings: BytesIO(),
    }
    for module in (mdf_v3, mdf_v4, v2_v3_blocks, v4_blocks):
        for name in replaced.keys() & vars(module).keys():
            setattr(module, name, replaced[name])
    return asammdf


def _never(*rest: Any, **settings: Any) -> Any:
    raise NoNumbersError("a formula in text is never evaluated")


def _without_conversions(file: Any) -> Conversions:
    """Take all conversions away, so that asammdf gives raw values, of the clocks too; return them by their channels."""
    conversions: Conversions = {}
    for group_number, group in enumerate(file.groups):
        for number, channel in enumerate(group.channels):
            if channel.conversion is not None:
                conversions[group_number, number] = channel.conversion
                channel.conversion = None
    return conversions


def _clock(
    file: Any, group_number: int, conversions: Conversions, *, is_version_4: bool
) -> tuple[Array | None, list[str]]:
    """Times of a group, or none, and the reason for that."""
    owner = group_number
    # A group may take the clock of another one; a chain of more groups than there are is a circle.
    for _ in file.groups if is_version_4 else ():
        described = file.groups[owner].channel_group
        if not described.flags & REMOTE_MASTER:
            break
        owner = int(described.cg_master_index)
    else:
        if is_version_4:
            raise ValueError("the clocks of its groups refer to one another in a circle")
    conversion = conversions.get((owner, file.masters_db.get(owner, -1)))
    raw = np.asarray(file.get_master(group_number))
    try:
        return convert(raw, conversion, is_version_4=is_version_4), []
    except NoNumbersError as reason:
        return None, [f"the clock of group {group_number + 1} is left out: {reason}; give the sampling rate"]


def _values(file: Any, group_number: int, number: int, conversions: Conversions, *, is_version_4: bool) -> Array:
    """Physical values of a channel; NoNumbersError where it holds text or arrays."""
    samples, invalid = file.get(group=group_number, index=number, samples_only=True, raw=True)
    raw = np.asarray(samples)
    if raw.dtype.kind not in "biuf" or raw.ndim != 1 or not raw.size:
        raise NoNumbersError("no numbers")
    values = convert(raw, conversions.get((group_number, number)), is_version_4=is_version_4)
    if invalid is not None:
        values[np.asarray(invalid, dtype=bool)] = np.nan
    return values


def _unit(channel: Any, conversion: Any) -> str | None:
    return (conversion is not None and conversion.unit) or getattr(channel, "unit", "") or None


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


FORMAT = Format(
    name="mdf",
    summary="ASAM MDF measurement data, versions 2 to 4.",
    suffixes=(".mdf", ".mf4", ".dat"),
    options=MdfOptions,
    recognise=recognise,
    read=read,
    modules=("asammdf",),
    package="asammdf",
    extra="mdf",
)
