"""The chain of segments that a TDMS file consists of, read without its content: where it is cut off or broken."""

from __future__ import annotations

import struct
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

from colonnade.errors import ReadError

if TYPE_CHECKING:
    from nptdms import TdmsChannel, TdmsFile

LEAD_IN = 28
UNFINISHED = 0xFFFF_FFFF_FFFF_FFFF
"""Length of a segment that LabVIEW did not come to finish."""
BIG_ENDIAN = 1 << 6


@dataclass(frozen=True)
class Ending:
    """
    How a TDMS file ends.

    Attributes
    ----------
    size : int
        Bytes of the file.
    declared : int or None
        Bytes that its segments add up to; None if the last one does not say, because the recorder was stopped.
    undescribed : int
        Bytes at the end that begin a segment whose description is not complete.
    present, expected : int
        Bytes of samples of the last segment: found, and declared; 0 if it is whole.
    """

    size: int
    declared: int | None
    undescribed: int = 0
    present: int = 0
    expected: int = 0


def walk(path: Path) -> Ending:
    """
    Follow the segments of a TDMS file to its end.

    Raises
    ------
    ReadError
        If a segment does not start where the one before says it does: the file was damaged there.
    """
    size = path.stat().st_size
    position = 0
    with path.open("rb") as stream:
        while position < size:
            stream.seek(position)
            lead_in = stream.read(LEAD_IN)
            if not (lead_in.startswith(b"TDSm") or b"TDSm".startswith(lead_in)):
                raise ReadError(
                    f"{path.name}: at byte {position} of {size} a segment starting with TDSm was expected, "
                    f"{lead_in[:4]!r} was found: the file is damaged. Copy it again from the recorder."
                )
            if len(lead_in) < LEAD_IN:
                return Ending(size, None, undescribed=size - position)
            order = ">" if struct.unpack("<I", lead_in[4:8])[0] & BIG_ENDIAN else "<"
            length, description = struct.unpack(order + "QQ", lead_in[12:])
            samples = position + LEAD_IN + description
            if length == UNFINISHED:
                return Ending(size, None, undescribed=size - position if samples > size else 0)
            end = position + LEAD_IN + length
            if end > size:
                if samples > size:
                    return Ending(size, end, undescribed=size - position)
                return Ending(size, end, present=size - samples, expected=end - samples)
            position = end
    return Ending(size, position)


def missing_samples(ending: Ending, file: TdmsFile) -> list[str]:
    """Tell what a file that was cut off lacks: by its bytes, and by the samples of its channels."""
    if ending.declared == ending.size:
        return []
    if ending.undescribed:
        return [
            f"it ends after {ending.size} bytes, within the description of its last segment: a recording or a copy was "
            f"interrupted; the data in its last {ending.undescribed} bytes are lost"
        ]
    if ending.declared is None:
        return ["the recorder did not finish the last segment, as happens if it is killed: read as far as it goes"]
    statuses = file.file_status.channel_statuses or {}
    channels = {channel.path: channel for group in file.groups() for channel in group.channels()}
    chunk = sum(status.expected_length * _sample_bytes(channels[path]) for path, status in statuses.items())
    lacking: dict[tuple[int, int], list[str]] = {}
    for path, status in statuses.items():
        found = len(channels[path])
        expected = found - status.read_length + status.expected_length
        if chunk and ending.expected % chunk == 0:
            later = ending.expected // chunk - -(-ending.present // chunk)
            expected += later * status.expected_length
        if found < expected:
            lacking.setdefault((found, expected), []).append(channels[path].name)
    counts = [
        f'{found} of {expected} samples of "{names[0]}"' + (f" and {len(names) - 1} others" if names[1:] else "")
        for (found, expected), names in lacking.items()
    ]
    cut = f"it ends after {ending.size} of {ending.declared} bytes: a recording or a copy was interrupted"
    return [f"{cut}; it has {', '.join(counts)}" if counts else cut]


def _sample_bytes(channel: TdmsChannel) -> int:
    """Bytes of a sample as stored; 0 where they differ from sample to sample."""
    if channel.scaler_data_types:
        return sum(each.size for each in channel.scaler_data_types.values())
    return getattr(channel.data_type, "size", None) or 0
