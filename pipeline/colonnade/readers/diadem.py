"""NI DIAdem data sets: a header, .TDM or .DAT, and files of bytes beside it."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

from pydantic import BaseModel, ConfigDict

from colonnade.errors import ReadError
from colonnade.readers.clock import even_times, find_clocks
from colonnade.readers.diadem_dat import SIGNATURE, described_in_dat
from colonnade.readers.diadem_tdm import described_in_tdm
from colonnade.readers.numbered_lines import first_lines
from colonnade.readers.recording import RecordedChannel, Recording
from colonnade.readers.registry import Format, Recognition
from colonnade.readers.stored_numbers import StoredNumbers, beside, name_beside, read_stored

PACKED = b"PK\x03\x04"
TDM_MARK = b"tdm"


class DiademOptions(BaseModel):
    """Nothing has to be said about a DIAdem data set: its header tells all."""

    model_config = ConfigDict(extra="forbid", frozen=True)


def recognise(path: Path) -> Recognition:
    """Say whether a file is the header of a DIAdem data set."""
    with path.open("rb") as stream:
        head = stream.read(4096)
    if head.startswith(PACKED) and b"header.xml" in head[:200]:
        return Recognition(True, "an archive with the header.xml of a .TDM")
    if head.lstrip(b"\xef\xbb\xbf").startswith(b"<?xml") and b"<usi:tdm" in head:
        return Recognition(True, "XML of a .TDM")
    if head[:2] in (b"\xff\xfe", b"DI") and (first_lines(path, 1) or [""])[0].startswith(SIGNATURE):
        return Recognition(True, f'the first line starts with "{SIGNATURE}"')
    if path.suffix.casefold() == ".tdx":
        headers = [entry.name for entry in path.parent.glob(f"{path.stem}.*") if entry.suffix.casefold() == ".tdm"]
        return Recognition(False, f"the values of {(headers or ['a .TDM'])[0]}: read that one")
    return Recognition(False, "neither the header of a .TDM nor that of a DIAdem .DAT")


def read(path: Path, options: DiademOptions) -> Recording:
    """
    Read a DIAdem data set by its header.

    Raises
    ------
    ReadError
        If the header is damaged, a file with the values is not beside it, or no channel holds numbers.
    """
    is_text, described, warnings = _described(path)
    channels = []
    longest = _longest(path, described)
    for stored in described:
        values, told = read_stored(path, stored, longest=longest)
        warnings += told
        time = even_times(values.size, stored.step, stored.begin) if stored.step else None
        channels.append(RecordedChannel(stored.name, stored.unit or None, values, time))
    if not any(channel.values.size for channel in channels):
        told_reason = f" ({warnings[0]})" if warnings else ""
        raise ReadError(f"{path.name}: no channel holds numbers{told_reason}.")
    notes: tuple[str, ...] = ("header .DAT" if is_text else "header .TDM",)
    if any(channel.time is not None for channel in channels):
        return Recording(
            path,
            "diadem",
            tuple(channels),
            notes=(*notes, "clock: each channel's own increment"),
            warnings=tuple(warnings),
        )
    clocks = find_clocks(tuple(channels), ("number",) * len(channels))
    timed = tuple(
        replace(channel, time=time, is_clock=number in clocks.columns)
        if time is not None and time.size == channel.values.size
        else channel
        for number, (channel, time) in enumerate(zip(channels, clocks.times, strict=True))
    )
    return Recording(path, "diadem", timed, notes=notes + clocks.notes, warnings=(*warnings, *clocks.warnings))


def companions(path: Path, options: DiademOptions) -> tuple[str, ...]:
    """Names of the files with the values, all beside the header."""
    _, described, _ = _described(path)
    return tuple(dict.fromkeys(name_beside(path, stored.file) for stored in described if stored.file))


def _described(path: Path) -> tuple[bool, list[StoredNumbers], list[str]]:
    """Whether the header is a .DAT, what it says of its channels, and what there is to warn of."""
    with path.open("rb") as stream:
        is_text = not stream.read(5).startswith((PACKED, b"<?xml", b"\xef\xbb\xbf<?"))
    return is_text, *(described_in_dat(path) if is_text else described_in_tdm(path))


def _longest(path: Path, described: list[StoredNumbers]) -> int:
    """Count the values of the longest channel whose bytes are there."""
    room = [beside(path, stored.file).stat().st_size // stored.stride for stored in described if stored.file]
    counts = [stored.count for stored in described if stored.file]
    return max((min(pair) for pair in zip(counts, room, strict=True)), default=0)


FORMAT = Format(
    name="diadem",
    summary="NI DIAdem data sets: .TDM or .DAT header with its files of values beside it.",
    suffixes=(".tdm", ".dat"),
    options=DiademOptions,
    recognise=recognise,
    read=read,
    companions=companions,
)
