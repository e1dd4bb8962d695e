"""Hostile files of measurement systems: MDF, TDMS, DIAdem."""

from __future__ import annotations

import struct
import zlib
from pathlib import Path

import numpy as np

from hostile.place import COUNTS, SECRET, SWOLLEN, TIME, Hostile, Place, formula


def _mdf(path: Path, version: str, text: str) -> Path:
    import asammdf
    from asammdf.blocks import v2_v3_blocks, v4_blocks

    blocks, kind = (v4_blocks, 3) if version >= "4" else (v2_v3_blocks, 10)
    conversion = blocks.ChannelConversion(conversion_type=kind, formula=text)
    with asammdf.MDF(version=version) as file:
        file.append(
            [
                asammdf.Signal(COUNTS, TIME, name="a", conversion=conversion),
                asammdf.Signal(COUNTS, TIME, name="plain"),
            ]
        )
        written = Path(file.save(path.with_suffix(".mf4" if version >= "4" else ".mdf"), overwrite=True))
    return written.rename(path)


def mdf_program(place: Place) -> Hostile:
    """asammdf, version 4: runs a program."""
    return Hostile(_mdf(place.folder / "free-01.csv", "4.10", formula(place.victim)))


def mdf_3_program(place: Place) -> Hostile:
    """asammdf, version 3: runs a program."""
    return Hostile(_mdf(place.folder / "free-02.csv", "3.30", formula(place.victim)))


def mdf_endless(place: Place) -> Hostile:
    """asammdf: does not end."""
    return Hostile(_mdf(place.folder / "free-03.csv", "4.10", "X1+9**9**9**9"))


def mdf_attached(place: Place) -> Hostile:
    """asammdf: has a file elsewhere attached to a channel."""
    import asammdf

    with asammdf.MDF(version="4.10") as file:
        file.append([asammdf.Signal(COUNTS, TIME, name="a")])
        number = file.attach((place.secrets / "secret").read_bytes(), file_name="secret", embedded=False)
        file.groups[0].channels[1].attachment = number
        file.attachments[number].file_name = str(place.secrets / "secret")
        written = Path(file.save(place.folder / "attached.mf4", overwrite=True))
    return Hostile(written)


def mdf_swelling(place: Place) -> Hostile:
    """asammdf: a quarter of a megabyte that unpacks to a quarter of a gigabyte."""
    import asammdf

    with asammdf.MDF(version="4.10") as file:
        file.append([asammdf.Signal(np.zeros(1000), np.arange(1000.0), name="a")])
        path = Path(file.save(place.folder / "swelling.mf4", overwrite=True, compression=1))
    content = bytearray(path.read_bytes())
    start = content.find(b"##DZ")
    packed = zlib.compress(bytes(SWOLLEN), 9)
    head = content[start : start + 24]
    struct.pack_into("<Q", head, 8, 48 + len(packed))
    sizes = struct.pack("<2sBBIQQ", b"DT", 0, 0, 0, SWOLLEN, len(packed))
    moved = bytes(content).replace(struct.pack("<Q", start), struct.pack("<Q", len(content)))
    path.write_bytes(moved + bytes(head) + sizes + packed)
    return Hostile(path)


def tdms_index(place: Place) -> Hostile:
    """npTDMS: has the index of another file beside it, and text, timestamps and a property."""
    from nptdms import ChannelObject, TdmsWriter

    path = place.folder / "r.tdms"
    with TdmsWriter(path) as writer:
        values = {"wf_increment": 0.01, "unit_string": "mm", "description": "__import__('os')"}
        writer.write_segment([ChannelObject("g", "a", COUNTS.copy(), values), ChannelObject("g", "s", ["a", "b"], {})])
    other = place.secrets / "other.tdms"
    with TdmsWriter(str(other), index_file=True) as writer:
        writer.write_segment([ChannelObject("g", "other", SECRET.copy(), {})])
    (place.secrets / "other.tdms_index").rename(place.folder / "r.tdms_index")
    return Hostile(path)


def diadem_entity(place: Place) -> Hostile:
    """expat, in the header of a DIAdem data set: an entity that is another file."""
    path = place.folder / "r.TDM"
    secret = (place.secrets / "secret.txt").as_uri()
    path.write_text(
        f'<?xml version="1.0"?><!DOCTYPE x [<!ENTITY s SYSTEM "{secret}">]><usi:tdm xmlns:usi="x"><usi:data>'
        "<tdm_channel><name>&s;</name></tdm_channel></usi:data></usi:tdm>",
        encoding="utf-8",
    )
    return Hostile(path)


def diadem_elsewhere(place: Place) -> Hostile:
    """Own parser of DIAdem: values in a file elsewhere."""
    path = place.folder / "r.dat"
    lines = ["DIAEXTENDED  {@:ENGLISH", "#BEGINGLOBALHEADER", "112,High -> Low", "#ENDGLOBALHEADER"]
    for number, file in enumerate((str(place.secrets / "secret"), "../secrets/secret")):
        lines += ["#BEGINCHANNELHEADER", f"200,c{number}", "202,mm", "210,EXPLICIT", f"211,{file}", "213,CHANNEL"]
        lines += ["214,INT32", "220,100", "221,1", "240,0", "241,1", "252,No", "#ENDCHANNELHEADER"]
    path.write_text("\n".join([*lines, ""]), encoding="utf-8")
    return Hostile(path)
