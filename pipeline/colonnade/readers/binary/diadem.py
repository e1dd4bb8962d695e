"""NI DIAdem data sets: a .TDM header, XML packed or plain, with a file of values next to it."""

from __future__ import annotations

import re
import zipfile
from pathlib import Path, PureWindowsPath
from xml.etree import ElementTree

import numpy as np

from colonnade.arrays import Array
from colonnade.errors import ReadError, quoted
from colonnade.readers.binary.numbers import numbers_at
from colonnade.readers.clock import even_times, with_clocks
from colonnade.readers.format import Format, Options, Recognition
from colonnade.readers.head import ZIP, Head, from_head, head_of
from colonnade.readers.recording import RecordedChannel, Recording
from colonnade.readers.refused import foreign_format

FORMS = {
    **{"eFloat64Usi": "f8", "eFloat32Usi": "f4", "eInt64Usi": "i8", "eInt32Usi": "i4", "eInt16Usi": "i2"},
    **{"eInt8Usi": "i1", "eUInt64Usi": "u8", "eUInt32Usi": "u4", "eUInt16Usi": "u2", "eUInt8Usi": "u1"},
}
KINDS = ("explicit", "explicit_external", "raw_linear", "raw_linear_external", "implicit_linear")
"""How values are given: stored as they are, stored and to be scaled, or by the numbers of their rows alone."""


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
        reason = f"it holds the values of {(headers or ['a .TDM'])[0]}; read that file instead"
        return Recognition(False, reason, is_known=True)
    return Recognition(False, "not the header of a .TDM")


def read(path: Path, options: Options) -> Recording:
    """Read a DIAdem data set by its header; ReadError if the file with the values is not in its folder."""
    header = _Header(path)
    channels, warnings = [], header.warnings
    elements = [element for element in header.root.iter() if element.tag.endswith("tdm_channel")]
    for number, element in enumerate(elements, 1):
        name = (element.findtext("name") or "").strip() or f"channel {number}"
        try:
            channels.append(header.channel(name, element))
        except (ValueError, KeyError, OverflowError) as error:
            warnings.append(f'"{name}" is left out: its entry in the header cannot be used ({error})')
    is_clocked = any(channel.time is not None for channel in channels)
    notes = ("clock: each channel's own increment",) if is_clocked else ()
    return with_clocks(Recording(path, "diadem", tuple(channels), notes=notes, warnings=tuple(warnings)))


def companions(path: Path) -> tuple[Path, ...]:
    """Give the file of the values, next to the header and of its name; DIAdem writes and reads it there."""
    values = path.with_suffix(".tdx")
    alike = [each for each in path.parent.glob("*.*") if each.name.casefold() == values.name.casefold()]
    return (alike[0] if alike and values not in alike else values,)


class _Header:
    """What the XML says: objects that refer to one another, and blocks of numbers in other files."""

    def __init__(self, path: Path) -> None:
        if reason := foreign_format(head_of(path)):
            raise ReadError(f"{path.name}: {reason}")
        content = path.read_bytes()
        if content.startswith(ZIP):
            with zipfile.ZipFile(path) as archive:
                content = archive.read(archive.infolist()[0])
        self.path, self.root, self.warnings = path, ElementTree.fromstring(content), list[str]()
        self._objects = {element.get("id"): element for element in self.root.iter()}
        self._blocks = {
            block.get("id"): (file, block) for file in self.root.iter("file") for block in file.iter("block")
        }

    def channel(self, name: str, element: ElementTree.Element) -> RecordedChannel:
        """Read a channel; ValueError or KeyError where its entry cannot be used."""
        column = self._referred(element, "local_columns")
        kind = (column.findtext("sequence_representation") or "explicit").strip()
        if kind not in KINDS:
            raise ValueError(f'its values are "{kind}"')
        scale = (0.0, 1.0)
        if kind.endswith(("linear", "linear_external")):
            offset, factor = map(float, (column.findtext("generation_parameters") or "").split())
            scale = (offset, factor)
        if kind == "implicit_linear":
            rows = int(self._referred(column, "submatrix").findtext("number_of_rows") or 0)
            values = even_times(rows, scale[1], scale[0])
        else:
            values = self._stored(name, self._referred(column, "values"), scale)
        step, begin = _attribute(element, "wf_increment"), _attribute(element, "wf_start_offset")
        unit = (element.findtext("unit_string") or "").strip("[] ")
        return RecordedChannel(name, unit or None, values, even_times(values.size, step, begin) if step > 0 else None)

    def _referred(self, element: ElementTree.Element, tag: str) -> ElementTree.Element:
        """The object that a part of an element refers to."""
        found = re.search(r'id\("([^"]+)"\)', element.findtext(tag) or "")
        return self._objects[found[1] if found else f"no {tag}"]

    def _stored(self, name: str, sequence: ElementTree.Element, scale: tuple[float, float]) -> Array:
        """Numbers of a block of another file."""
        inner = sequence.find("values")
        external = None if inner is None else inner.get("external")
        if external is None:
            raise ValueError("its values are not in a separate file")
        file, block = self._blocks[external]
        form = (">" if file.get("byteOrder") == "bigEndian" else "<") + FORMS[block.get("valueType", "")]
        count, first, stride = (int(block.get(key, "0")) for key in ("length", "byteOffset", "blockSize"))
        first += int(block.get("blockOffset", "0")) if stride else 0
        if min(count, first, stride) < 0 or 0 < stride < int(form[-1]):
            raise ValueError(f"{count} values from byte {first} on, every {stride} bytes")
        (path,) = companions(self.path)
        other = PureWindowsPath(file.get("url", "")).name
        if other.casefold() != path.name.casefold() or not path.is_file():
            raise ReadError(
                f"{self.path.name}: its values are in the file {quoted(other)}; they were expected next to it "
                f"in {path.name}. Copy the file there, or save the data set from DIAdem under a new name instead of "
                "renaming it."
            )
        content = np.memmap(path, dtype=np.uint8, mode="r") if path.stat().st_size else np.empty(0, dtype=np.uint8)
        return numbers_at(content, name, form, first, count, self.warnings, stride=stride, scale=scale, file=path.name)


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
