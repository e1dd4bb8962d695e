"""NI DIAdem data sets: a header, .TDM or .DAT, with files of bytes next to it."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

from colonnade.errors import ReadError
from colonnade.readers.binary.magic import ZIP
from colonnade.readers.binary.stored_numbers import StoredNumbers, beside, name_beside, read_stored
from colonnade.readers.clock import even_times, find_clocks
from colonnade.readers.diadem.dat import SIGNATURE, channels_in_dat
from colonnade.readers.diadem.tdm import channels_in_tdm
from colonnade.readers.format import Format, Options, Recognition
from colonnade.readers.recording import RecordedChannel, Recording
from colonnade.readers.text.lines.numbered import first_lines


def recognise(path: Path) -> Recognition:
    """Say whether a file is the header of a DIAdem data set."""
    with path.open("rb") as stream:
        head = stream.read(4096)
    if head.startswith(ZIP) and b"header.xml" in head[:200]:
        return Recognition(True, "an archive with the header.xml of a .TDM")
    if head.lstrip(b"\xef\xbb\xbf").startswith(b"<?xml") and b"<usi:tdm" in head:
        return Recognition(True, "XML of a .TDM")
    if head[:2] in (b"\xff\xfe", b"DI") and (first_lines(path, 1) or [""])[0].startswith(SIGNATURE):
        return Recognition(True, f'the first line starts with "{SIGNATURE}"')
    if path.suffix.casefold() == ".tdx":
        headers = [entry.name for entry in path.parent.glob(f"{path.stem}.*") if entry.suffix.casefold() == ".tdm"]
        return Recognition(False, f"the values of {(headers or ['a .TDM'])[0]}: read that file instead")
    return Recognition(False, "neither the header of a .TDM nor that of a DIAdem .DAT")


def read(path: Path, options: Options) -> Recording:
    """
    Read a DIAdem data set by its header.

    Raises
    ------
    ReadError
        If the header is damaged, or a file with the values is not in its folder.
    """
    is_text, described, warnings = _described(path)
    channels = []
    longest = _longest(path, described)
    for stored in described:
        values, told = read_stored(path, stored, longest=longest)
        warnings += told
        time = even_times(values.size, stored.step, stored.begin) if stored.step else None
        channels.append(RecordedChannel(stored.name, stored.unit or None, values, time))
    notes = ["header .DAT" if is_text else "header .TDM"]
    if is_clocked := any(channel.time is not None for channel in channels):
        notes.append("clock: each channel's own increment")
    recording = Recording(path, "diadem", tuple(channels), notes=tuple(notes), warnings=tuple(warnings))
    if is_clocked or not channels:
        return recording
    clocks = find_clocks(recording.channels, ("number",) * len(channels))
    each = zip(clocks.times, channels, strict=True)
    times = tuple(time if time is None or time.size == channel.values.size else None for time, channel in each)
    return replace(clocks, times=times).applied(recording)


def companions(path: Path, options: Options) -> tuple[str, ...]:
    """Names of the files with the values, all next to the header."""
    _, described, _ = _described(path)
    return tuple(dict.fromkeys(name_beside(path, stored.file) for stored in described if stored.file))


def _described(path: Path) -> tuple[bool, list[StoredNumbers], list[str]]:
    """Whether the header is a .DAT, what it says of its channels, and what there is to warn of."""
    with path.open("rb") as stream:
        is_text = not stream.read(5).startswith((ZIP, b"<?xml", b"\xef\xbb\xbf<?"))
    described, warnings = channels_in_dat(path) if is_text else channels_in_tdm(path)
    if not described:
        raise ReadError(f"{path.name}: the header describes no channel: it was cut off, or nothing was recorded.")
    stored = []
    for name, place in described:
        try:
            stored.append(place())
        except (ValueError, KeyError, OverflowError) as error:
            warnings.append(f'"{name}" is left out: its entry in the header cannot be used ({error})')
    return is_text, stored, warnings


def _longest(path: Path, described: list[StoredNumbers]) -> int:
    """Count the values of the longest channel whose bytes are there."""
    room = [beside(path, stored.file).stat().st_size // stored.stride for stored in described if stored.file]
    counts = [stored.count for stored in described if stored.file]
    return max((min(pair) for pair in zip(counts, room, strict=True)), default=0)


FORMAT = Format(
    name="diadem",
    summary="NI DIAdem data sets: .TDM or .DAT header with its files of values next to it.",
    suffixes=(".tdm", ".dat"),
    recognise=recognise,
    read=read,
    companions=companions,
)
