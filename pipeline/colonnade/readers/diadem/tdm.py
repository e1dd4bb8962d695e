"""Headers of DIAdem data sets in XML (.TDM), packed or plain: objects that refer to one another by their ids."""

from __future__ import annotations

import re
import zipfile
import zlib
from functools import partial
from pathlib import Path
from xml.etree import ElementTree

from colonnade.errors import ReadError
from colonnade.readers.binary.stored_numbers import DescribedChannel, StoredNumbers

FORMS = {
    **{"eFloat64Usi": "f8", "eFloat32Usi": "f4", "eInt64Usi": "i8", "eInt32Usi": "i4", "eInt16Usi": "i2"},
    **{"eInt8Usi": "i1", "eUInt64Usi": "u8", "eUInt32Usi": "u4", "eUInt16Usi": "u2", "eUInt8Usi": "u1"},
}
EXPLICIT, SCALED = ("explicit", "explicit_external"), ("raw_linear", "raw_linear_external")
"""How values of a file of their own are stored: as they are, or to be scaled."""
LARGEST_HEADER = 256 << 20
"""Bytes of XML; a header that would unpack to more is not unpacked."""
REFERENCE = re.compile(r'id\("([^"]+)"\)')

Objects = dict[str, ElementTree.Element]


def channels_in_tdm(path: Path) -> tuple[list[DescribedChannel], list[str]]:
    """
    Find what a .TDM header describes; there is nothing to warn of.

    Raises
    ------
    ReadError
        If it is not whole XML, or too large.
    """
    try:
        root = ElementTree.fromstring(_content(path))
    except (ElementTree.ParseError, ValueError, LookupError) as error:  # the last of an encoding that there is not
        raise ReadError(
            f"{path.name}: its header is not complete XML ({error}): it was cut off or is damaged. Export it again."
        ) from error
    objects = {name: element for element in root.iter() if (name := element.get("id")) is not None}
    blocks = _blocks(root)
    described: list[DescribedChannel] = []
    channels = (element for element in root.iter() if element.tag.endswith("tdm_channel"))
    for number, channel in enumerate(channels, 1):
        name = (channel.findtext("name") or "").strip() or f"channel {number}"
        described.append((name, partial(_stored, name, channel, objects, blocks)))
    return described, []


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
        except (
            zipfile.BadZipFile,
            IndexError,
            NotImplementedError,
            RuntimeError,
            EOFError,
            OSError,
            zlib.error,
        ) as error:
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
) -> StoredNumbers:
    """Say where a channel's numbers stand; ValueError or KeyError where that cannot be told."""
    unit = (channel.findtext("unit_string") or "").strip("[] ")
    column = _referred(channel.findtext("local_columns"), objects, "column")
    kind = (column.findtext("sequence_representation") or "explicit").strip()
    step, begin = max(0.0, _attribute(channel, "wf_increment")), _attribute(channel, "wf_start_offset")
    offset, factor = _scaling(kind, column.findtext("generation_parameters") or "")
    if kind.startswith("implicit"):
        matrix = _referred(column.findtext("submatrix"), objects, "submatrix")
        count = int(matrix.findtext("number_of_rows") or 0)
        return StoredNumbers(name, unit, "", "<f8", 0, count, 8, offset, factor, step, begin)
    values = _referred(column.findtext("values"), objects, "values").find("values")
    external = None if values is None else values.get("external")
    if external is None:
        raise ValueError("its values are not in a separate file")
    return StoredNumbers(name, unit, *_place(*blocks[external]), offset, factor, step, begin)


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


def _place(file: str, order: str, block: ElementTree.Element) -> tuple[str, str, int, int, int]:
    """File, form, first byte, count and stride of a block of another file."""
    form = order + FORMS[block.get("valueType", "")]
    size = int(form[-1])
    count, first, stride = int(block.get("length", "0")), int(block.get("byteOffset", "0")), size
    if block.get("blockSize"):
        stride = int(block.get("blockSize", ""))
        first += int(block.get("blockOffset", "0"))
    if count < 0 or first < 0 or stride < size:
        raise ValueError(f"{count} values from byte {first} on, every {stride} bytes")
    return file, form, first, count, stride


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
