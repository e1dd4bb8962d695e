"""NI DIAdem data sets: a .TDM header, XML packed or plain, with a file of values next to it."""

from __future__ import annotations

import re
import zipfile
from pathlib import Path, PureWindowsPath
from xml.etree import ElementTree
from xml.etree.ElementTree import Element

import numpy as np

from colonnade.arrays import Array
from colonnade.errors import ReadError, quoted
from colonnade.readers.binary.numbers import numbers_at
from colonnade.readers.clock import even_times, with_clocks
from colonnade.readers.format import Format, Options, Recognition
from colonnade.readers.head import ZIP, Head, from_head
from colonnade.readers.recording import RecordedChannel, Recording

FORMS = {
    **{"eFloat64Usi": "f8", "eFloat32Usi": "f4", "eInt64Usi": "i8", "eInt32Usi": "i4", "eInt16Usi": "i2"},
    **{"eInt8Usi": "i1", "eUInt64Usi": "u8", "eUInt32Usi": "u4", "eUInt16Usi": "u2", "eUInt8Usi": "u1"},
}
KINDS = ("explicit", "explicit_external", "raw_linear", "raw_linear_external", "implicit_linear")
"""How values are given: stored as they are, stored and to be scaled, or by the numbers of their rows alone."""
_Elements = dict[str | None, Element]
"""Parts of the header by their id."""


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
    content = path.read_bytes()
    if recognise.expected(path).content.startswith(ZIP):
        with zipfile.ZipFile(path) as archive:
            content = archive.read(archive.infolist()[0])
    root = ElementTree.fromstring(content)
    objects = {element.get("id"): element for element in root.iter()}
    files = {block.get("id"): file for file in root.iter("file") for block in file.iter("block")}
    channels: list[RecordedChannel] = []
    warnings: list[str] = []
    elements = [element for element in root.iter() if element.tag.endswith("tdm_channel")]
    for number, element in enumerate(elements, 1):
        name = (element.findtext("name") or "").strip() or f"channel {number}"
        try:
            values = _values(path, name, element, objects, files, warnings)
            step, begin = _attribute(element, "wf_increment"), _attribute(element, "wf_start_offset")
        except (ValueError, KeyError, OverflowError) as error:
            warnings.append(f'"{name}" is left out: its entry in the header cannot be used ({error})')
            continue
        unit = (element.findtext("unit_string") or "").strip("[] ") or None
        channels.append(RecordedChannel(name, unit, values, even_times(values.size, step, begin) if step > 0 else None))
    return with_clocks(Recording(path, "diadem", tuple(channels), warnings=tuple(warnings)))


def companions(path: Path) -> tuple[Path, ...]:
    """Give the file of the values, next to the header and of its name; DIAdem writes and reads it there."""
    values = path.with_suffix(".tdx")
    alike = [each for each in path.parent.glob("*.*") if each.name.casefold() == values.name.casefold()]
    return (alike[0] if alike and values not in alike else values,)


def _values(
    path: Path, name: str, element: Element, objects: _Elements, files: _Elements, warnings: list[str]
) -> Array:
    """Values of a channel, scaled; ValueError or KeyError where its entry cannot be used."""
    column = _referred(objects, element, "local_columns")
    kind = (column.findtext("sequence_representation") or "explicit").strip()
    if kind not in KINDS:
        raise ValueError(f'its values are "{kind}"')
    offset, factor = 0.0, 1.0
    if "linear" in kind:
        offset, factor = map(float, (column.findtext("generation_parameters") or "").split())
    if kind == "implicit_linear":
        return even_times(int(_referred(objects, column, "submatrix").findtext("number_of_rows") or 0), factor, offset)
    inner = _referred(objects, column, "values").find("values")
    external = None if inner is None else inner.get("external")
    if external is None:
        raise ValueError("its values are not in a separate file")
    file, block = files[external], objects[external]
    form = (">" if file.get("byteOrder") == "bigEndian" else "<") + FORMS[block.get("valueType", "")]
    count, first, stride = (int(block.get(key, "0")) for key in ("length", "byteOffset", "blockSize"))
    first += int(block.get("blockOffset", "0")) if stride else 0
    if min(count, first, stride) < 0 or 0 < stride < int(form[-1]):
        raise ValueError(f"{count} values from byte {first} on, every {stride} bytes")
    (stored,) = companions(path)
    other = PureWindowsPath(file.get("url", "")).name
    if other.casefold() != stored.name.casefold() or not stored.is_file():
        raise ReadError(
            f"{path.name}: its values are in the file {quoted(other)}; they were expected next to it in {stored.name}. "
            "Copy the file there, or save the data set from DIAdem under a new name instead of renaming it."
        )
    content = np.memmap(stored, dtype=np.uint8, mode="r") if stored.stat().st_size else np.empty(0, dtype=np.uint8)
    scale = (offset, factor)
    return numbers_at(content, name, form, first, count, warnings, stride=stride, scale=scale, file=stored.name)


def _referred(objects: _Elements, element: Element, tag: str) -> Element:
    """The object that a part of an element refers to."""
    found = re.search(r'id\("([^"]+)"\)', element.findtext(tag) or "")
    return objects[found[1] if found else f"no {tag}"]


def _attribute(channel: Element, name: str) -> float:
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
