"""Headers of DIAdem data sets in XML (.TDM), packed or plain: objects that refer to one another by their ids."""

from __future__ import annotations

import re
import zipfile
import zlib
from pathlib import Path
from xml.etree import ElementTree

from colonnade.errors import ReadError
from colonnade.readers.stored_numbers import StoredNumbers

FORMS = {
    **{"eFloat64Usi": "f8", "eFloat32Usi": "f4", "eInt64Usi": "i8", "eInt32Usi": "i4", "eInt16Usi": "i2"},
    **{"eInt8Usi": "i1", "eUInt64Usi": "u8", "eUInt32Usi": "u4", "eUInt16Usi": "u2", "eUInt8Usi": "u1"},
}
LARGEST_HEADER = 256 << 20
"""Bytes of XML; a header that would unpack to more is not unpacked."""
REFERENCE = re.compile(r'id\("([^"]+)"\)')

Objects = dict[str, ElementTree.Element]


def described_in_tdm(path: Path) -> tuple[list[StoredNumbers], list[str]]:
    """
    Read what a .TDM header says of its channels.

    Returns
    -------
    stored : list of StoredNumbers
    warnings : list of str
        Channels that are left out, each with the reason.

    Raises
    ------
    ReadError
        If it is no whole XML, too large, or describes no channel.
    """
    try:
        root = ElementTree.fromstring(_content(path))
    except (ElementTree.ParseError, ValueError, LookupError) as error:  # the last of an encoding that there is not
        raise ReadError(
            f"{path.name}: its header is no whole XML ({error}): it was cut off or is damaged. Export it again."
        ) from error
    objects = {name: element for element in root.iter() if (name := element.get("id")) is not None}
    blocks = _blocks(root)
    stored: list[StoredNumbers] = []
    warnings: list[str] = []
    channels = [element for element in root.iter() if element.tag.endswith("tdm_channel")]
    for channel in channels:
        name = (channel.findtext("name") or "").strip() or f"channel {len(stored) + 1}"
        try:
            stored.append(_stored(name, channel, objects, blocks))
        except (ValueError, KeyError, OverflowError) as error:
            warnings.append(f'"{name}" is left out: what the header says of it cannot be used ({error})')
    if not channels:
        raise ReadError(f"{path.name}: the header describes no channel.")
    return stored, warnings


def _content(path: Path) -> bytes:
    """Bytes of the XML, out of the archive where it is packed."""
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
        raise ReadError(f"{path.name}: its header defines entities of its own, as none of DIAdem's does; not read.")
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
    told = [float(number) for number in (column.findtext("generation_parameters") or "").split()]
    step, begin = _attribute(channel, "wf_increment"), _attribute(channel, "wf_start_offset")
    step = step if step > 0 else 0.0
    if kind.startswith("implicit"):
        matrix = _referred(column.findtext("submatrix"), objects, "submatrix")
        count = int(matrix.findtext("number_of_rows") or 0)
        if kind not in ("implicit_linear", "implicit_constant") or not told:
            raise ValueError(f'its values are "{kind}"')
        factor = told[1] if kind == "implicit_linear" else 0.0
        return StoredNumbers(name, unit, "", "<f8", 0, count, 8, told[0], factor, step, begin)
    if kind not in ("explicit", "raw_linear", "raw_linear_external", "explicit_external"):
        raise ValueError(f'its values are "{kind}"')
    offset, factor = (told[0], told[1]) if kind.startswith("raw_linear") and len(told) > 1 else (0.0, 1.0)
    values = _referred(column.findtext("values"), objects, "values").find("values")
    external = None if values is None else values.get("external")
    if external is None:
        raise ValueError("its values are not in a file of their own")
    file, order, block = blocks[external]
    form = order + FORMS[block.get("valueType", "")]
    count, first, stride = int(block.get("length", "0")), int(block.get("byteOffset", "0")), int(form[-1])
    if block.get("blockSize"):
        stride = int(block.get("blockSize", ""))
        first += int(block.get("blockOffset", "0"))
    if count < 0 or first < 0 or stride < int(form[-1]):
        raise ValueError(f"{count} values from byte {first} on, every {stride} bytes")
    return StoredNumbers(name, unit, file, form, first, count, stride, offset, factor, step, begin)


def _referred(reference: str | None, objects: Objects, what: str) -> ElementTree.Element:
    found = REFERENCE.search(reference or "")
    if found is None or found[1] not in objects:
        raise ValueError(f"no {what}")
    return objects[found[1]]


def _attribute(channel: ElementTree.Element, name: str) -> float:
    """A number among a channel's own attributes; 0 where it is not there."""
    for attribute in channel.iter("double_attribute"):
        if attribute.get("name") == name:
            return float((attribute.text or "").strip() or 0)
    return 0.0
