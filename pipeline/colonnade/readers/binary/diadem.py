"""NI DIAdem data sets: a .TDM header, XML packed or plain, with a file of values next to it."""

from __future__ import annotations

import re
import zipfile
import zlib
from dataclasses import dataclass, replace
from pathlib import Path, PureWindowsPath
from xml.etree import ElementTree

import numpy as np

from colonnade.errors import ReadError
from colonnade.readers.binary.numbers import Bytes, StoredNumbers, values_at
from colonnade.readers.clock import even_times, find_clocks
from colonnade.readers.format import Format, Options, Recognition
from colonnade.readers.head import ZIP, Head, from_head, head_of
from colonnade.readers.recording import RecordedChannel, Recording
from colonnade.readers.refused import foreign_format

FORMS = {
    **{"eFloat64Usi": "f8", "eFloat32Usi": "f4", "eInt64Usi": "i8", "eInt32Usi": "i4", "eInt16Usi": "i2"},
    **{"eInt8Usi": "i1", "eUInt64Usi": "u8", "eUInt32Usi": "u4", "eUInt16Usi": "u2", "eUInt8Usi": "u1"},
}
EXPLICIT, SCALED = ("explicit", "explicit_external"), ("raw_linear", "raw_linear_external")
"""How values of a file of their own are stored: as they are, or to be scaled."""
LARGEST_HEADER = 256 << 20
"""Bytes of XML; a header that would unpack to more is not unpacked."""
LONGEST_NAME = 80
"""Characters of another file's name that are shown."""
REFERENCE = re.compile(r'id\("([^"]+)"\)')

Objects = dict[str, ElementTree.Element]


@dataclass(frozen=True)
class Described:
    """
    A channel as the header describes it.

    Attributes
    ----------
    unit : str
        Empty if it is not given.
    file : str
        Name of the file with its numbers; empty for a channel whose values follow from the numbers of their rows, from
        0, and are not stored.
    numbers : StoredNumbers
    step, begin : float
        Time step, s, 0 where the channel has none of its own, and time of the first value.
    """

    unit: str
    file: str
    numbers: StoredNumbers
    step: float
    begin: float


@from_head
def recognise(head: Head) -> Recognition:
    """Say whether a file is the header of a DIAdem data set."""
    first, path = head.content[:4096], head.path
    if first.startswith(ZIP) and b"header.xml" in first[:200]:
        return Recognition(True, "an archive with the header.xml of a .TDM")
    if first.lstrip(b"\xef\xbb\xbf").startswith(b"<?xml") and b"<usi:tdm" in first:
        return Recognition(True, "XML of a .TDM")
    if path.suffix.casefold() == ".tdx":
        headers = [entry.name for entry in path.parent.glob(f"{path.stem}.*") if entry.suffix.casefold() == ".tdm"]
        return Recognition(False, f"the values of {(headers or ['a .TDM'])[0]}: read that file instead")
    return Recognition(False, "not the header of a .TDM")


def read(path: Path, options: Options) -> Recording:
    """
    Read a DIAdem data set by its header.

    Raises
    ------
    ReadError
        If the header is damaged, or a file with the values is not in its folder.
    """
    described, warnings = described_channels(path)
    if not described and not warnings:
        raise ReadError(f"{path.name}: the header describes no channel: it was cut off, or nothing was recorded.")
    files = {each.file: bytes_beside(path, each.file) for each in described if each.file}
    stored = [(each.numbers, files[each.file][1].size) for each in described if each.file]
    longest = max((min(numbers.count, size // numbers.stride) for numbers, size in stored), default=0)
    channels = []
    for each in described:
        numbers = each.numbers
        if each.file:
            name, content = files[each.file]
            values, told = values_at(content, numbers, name)
            warnings += told
        else:
            values = even_times(min(numbers.count, longest), numbers.factor, numbers.offset)
        time = even_times(values.size, each.step, each.begin) if each.step else None
        channels.append(RecordedChannel(numbers.name, each.unit or None, values, time))
    notes = ["header .TDM"]
    if is_clocked := any(channel.time is not None for channel in channels):
        notes.append("clock: each channel's own increment")
    recording = Recording(path, "diadem", tuple(channels), notes=tuple(notes), warnings=tuple(warnings))
    if is_clocked or not channels:
        return recording
    clocks = find_clocks(recording.channels)
    each_time = zip(clocks.times, channels, strict=True)
    times = tuple(time if time is None or time.size == channel.values.size else None for time, channel in each_time)
    return replace(clocks, times=times).applied(recording)


def companions(path: Path, options: Options) -> tuple[str, ...]:
    """Names of the files with the values, all next to the header."""
    described, _ = described_channels(path)
    return tuple(dict.fromkeys(_beside(path, each.file)[0] for each in described if each.file))


def _beside(header: Path, name: str) -> tuple[str, bool]:
    """Name of a file of the header's folder, whatever its case, and whether it is there; no path out is followed."""
    bare = PureWindowsPath(name).name
    alike = [entry for entry in header.parent.iterdir() if entry.name.casefold() == bare.casefold()]
    names = [entry.name for entry in alike if entry.is_file()]
    return bare if bare in names or not names else names[0], bool(names)


def bytes_beside(header: Path, name: str) -> tuple[str, Bytes]:
    """Name and content of a file with values; ReadError if it is missing."""
    found, is_there = _beside(header, name)
    if not is_there:
        named = found if len(found) <= LONGEST_NAME else f"{found[:LONGEST_NAME]}…"
        raise ReadError(
            f'{header.name}: its values are in the file "{named}", which is not in its folder. Copy that file next '
            "to it."
        )
    path = header.with_name(found)
    return found, np.memmap(path, dtype=np.uint8, mode="r") if path.stat().st_size else np.empty(0, dtype=np.uint8)


def described_channels(path: Path) -> tuple[list[Described], list[str]]:
    """
    Find where the header says that its channels' numbers are, with a warning for each entry that cannot be used.

    Raises
    ------
    ReadError
        If it is not whole XML, or too large.
    """
    if reason := foreign_format(head_of(path)):
        raise ReadError(f"{path.name}: {reason}")
    try:
        root = ElementTree.fromstring(_content(path))
    except (ElementTree.ParseError, ValueError, LookupError) as error:  # the last of an encoding that there is not
        raise ReadError(
            f"{path.name}: its header is not complete XML ({error}): it was cut off or is damaged. Export it again."
        ) from error
    objects = {name: element for element in root.iter() if (name := element.get("id")) is not None}
    blocks = _blocks(root)
    stored, warnings = [], []
    channels = (element for element in root.iter() if element.tag.endswith("tdm_channel"))
    for number, channel in enumerate(channels, 1):
        name = (channel.findtext("name") or "").strip() or f"channel {number}"
        try:
            stored.append(_stored(name, channel, objects, blocks))
        except (ValueError, KeyError, OverflowError) as error:
            warnings.append(f'"{name}" is left out: its entry in the header cannot be used ({error})')
    return stored, warnings


def _content(path: Path) -> bytes:
    """Bytes of the XML, unpacked if it is in an archive."""
    if not zipfile.is_zipfile(path):
        if path.stat().st_size > LARGEST_HEADER:
            raise ReadError(f"{path.name}: a header of more than {LARGEST_HEADER >> 20} MB is not read.")
        content = path.read_bytes()
    else:
        try:
            with zipfile.ZipFile(path) as archive:
                member = archive.infolist()[0]
                if member.file_size > LARGEST_HEADER:
                    raise ReadError(f"{path.name}: it would unpack to {member.file_size} bytes; it is not unpacked.")
                with archive.open(member) as stream:
                    content = stream.read(LARGEST_HEADER)
        except (zipfile.BadZipFile, zlib.error, IndexError, RuntimeError, EOFError, OSError) as error:
            raise ReadError(f"{path.name}: the archive with its header is damaged ({error}). Copy it again.") from error
    if b"<!DOCTYPE" in content or b"<!ENTITY" in content:
        raise ReadError(f"{path.name}: its header defines its own entities, which DIAdem never does; not read.")
    return content


def _blocks(root: ElementTree.Element) -> dict[str, tuple[str, str, ElementTree.Element]]:
    """Each described piece of bytes by its id, with its file and byte order."""
    blocks = {}
    for file in root.iter("file"):
        order = ">" if file.get("byteOrder") == "bigEndian" else "<"
        for block in file.iter("block"):
            blocks[block.get("id", "")] = (file.get("url", ""), order, block)
    return blocks


def _stored(
    name: str,
    channel: ElementTree.Element,
    objects: Objects,
    blocks: dict[str, tuple[str, str, ElementTree.Element]],
) -> Described:
    """Say where a channel's numbers stand; ValueError or KeyError where that cannot be told."""
    unit = (channel.findtext("unit_string") or "").strip("[] ")
    column = _referred(channel.findtext("local_columns"), objects, "column")
    kind = (column.findtext("sequence_representation") or "explicit").strip()
    step, begin = max(0.0, _attribute(channel, "wf_increment")), _attribute(channel, "wf_start_offset")
    offset, factor = _scaling(kind, column.findtext("generation_parameters") or "")
    if kind.startswith("implicit"):
        matrix = _referred(column.findtext("submatrix"), objects, "submatrix")
        count = int(matrix.findtext("number_of_rows") or 0)
        return Described(unit, "", StoredNumbers(name, "<f8", 0, count, 8, offset, factor), step, begin)
    values = _referred(column.findtext("values"), objects, "values").find("values")
    external = None if values is None else values.get("external")
    if external is None:
        raise ValueError("its values are not in a separate file")
    file, order, block = blocks[external]
    return Described(unit, file, StoredNumbers(name, *_place(order, block), offset, factor), step, begin)


def _scaling(kind: str, parameters: str) -> tuple[float, float]:
    """Offset and factor of values of a kind; ValueError for a kind that is not read."""
    told = [float(number) for number in parameters.split()]
    if kind == "implicit_constant" and told:
        return told[0], 0.0
    if kind in ("implicit_linear", *SCALED) and len(told) > 1:
        return told[0], told[1]
    if kind in (*EXPLICIT, *SCALED):
        return 0.0, 1.0
    raise ValueError(f'its values are "{kind}"')


def _place(order: str, block: ElementTree.Element) -> tuple[str, int, int, int]:
    """Form, first byte, count and stride of a block of another file."""
    form = order + FORMS[block.get("valueType", "")]
    size = int(form[-1])
    count, first, stride = int(block.get("length", "0")), int(block.get("byteOffset", "0")), size
    if block.get("blockSize"):
        stride = int(block.get("blockSize", ""))
        first += int(block.get("blockOffset", "0"))
    if count < 0 or first < 0 or stride < size:
        raise ValueError(f"{count} values from byte {first} on, every {stride} bytes")
    return form, first, count, stride


def _referred(reference: str | None, objects: Objects, what: str) -> ElementTree.Element:
    found = REFERENCE.search(reference or "")
    if found is None or found[1] not in objects:
        raise ValueError(f"no {what}")
    return objects[found[1]]


def _attribute(channel: ElementTree.Element, name: str) -> float:
    """A number among a channel's own attributes; 0 if it is missing."""
    for attribute in channel.iter("double_attribute"):
        if attribute.get("name") == name:
            return float((attribute.text or "").strip() or 0)
    return 0.0


FORMAT = Format(
    name="diadem",
    summary="NI DIAdem data sets: .TDM header with its file of values (.tdx) next to it.",
    suffixes=(".tdm",),
    recognise=recognise,
    read=read,
    companions=companions,
)
