"""Small files in the formats of other laboratories' instruments, written here from their definitions."""

from __future__ import annotations

import struct
import warnings
import zipfile
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import NamedTuple

import numpy as np


class Column(NamedTuple):
    """A channel to be written: name, unit, values in it."""

    name: str
    unit: str
    values: np.ndarray


Writer = Callable[[Path, np.ndarray, Sequence[Column]], Path]


def lvm(path: Path, time: np.ndarray, columns: Sequence[Column]) -> Path:
    count, blank = len(columns), "\t" * len(columns)
    head = ["LabVIEW Measurement\t", "Writer_Version\t2", "Reader_Version\t2", "Separator\tTab", "Decimal_Separator\t,"]
    head += ["Multi_Headings\tNo", "X_Columns\tOne", "Time_Pref\tRelative", "Date\t2013/04/26", "Time\t10:15:00,25"]
    head += ["***End_of_Header***\t", "", f"Channels\t{count}{blank}"]
    for key, text in (("Samples", str(time.size)), ("Date", "2013/04/26"), ("Time", "10:15:00,25")):
        head.append("\t".join([key, *[text] * count]))
    head.append("\t".join(["Y_Unit_Label", *(column.unit for column in columns)]))
    head.append("\t".join(["X_Dimension", *["Time"] * count]))
    head.append("\t".join(["X0", *["0,0E+0"] * count]))
    head.append("\t".join(["Delta_X", *[f"{time[1] - time[0]:.6E}".replace(".", ",")] * count]))
    head += [f"***End_of_Header***{blank}", "\t".join(["X_Value", *(column.name for column in columns), "Comment"])]
    rows = _rows(time, columns, "\t", ",")
    path.write_bytes("\r\n".join([*head, *rows, ""]).encode("latin-1"))
    return path


def mts(path: Path, time: np.ndarray, columns: Sequence[Column]) -> Path:
    head = [
        "MTS793|MPT|DEU|1|2|,|.|:|49|1|1|A",
        "",
        "Bediener Information\t\t\t\t\t\tZeit:\t0,5\ts\t26.04.2013 10:15:00",
    ]
    head += ["Prüfer : \tAM", "Bediener Information Ende", ""]
    head += ["Datenerfassung\t\t\t\t\t\tZeit:\t10,5\ts\t26.04.2013 10:15:10"]
    head += ["\t".join(["Laufzeit", *(column.name for column in columns)])]
    head += ["\t".join(["s", *(column.unit for column in columns)])]
    path.write_bytes("\r\n".join([*head, *_rows(time, columns, "\t", ","), ""]).encode("latin-1"))
    return path


def peer(path: Path, time: np.ndarray, columns: Sequence[Column]) -> Path:
    values = columns[-1].values
    head = ["PEER NGA STRONG MOTION DATABASE RECORD", "Somewhere, 4/26/2013, Table, 0"]
    head += [f"ACCELERATION TIME SERIES IN UNITS OF {columns[-1].unit.upper()}"]
    head += [f"NPTS= {values.size:6d}, DT= {time[1] - time[0]:8.5f} SEC"]
    path.write_text("\n".join([*head, *_fixed(values, "{:15.7E}", 5), ""]), encoding="ascii")
    return path


def cosmos(path: Path, time: np.ndarray, columns: Sequence[Column]) -> Path:
    text = ""
    for number, column in enumerate(columns, 1):
        reals = np.full(100, -999.0)
        reals[61] = 1000 * (time[1] - time[0])
        head = ["Corrected acceleration    (Format v01.20 with 13 text lines)", *["a line of text"] * 6]
        head += [
            "Rcrd start time:04/26/2013, 10:15:00.250 UTC (Q=2)",
            f"Sta Chan  {number}:  0 deg (Rcrdr Chan {number})",
        ]
        head += ["a line of text"] * 4
        head += [" 100 Integer-header values follow on  10 lines, Format= (10I8)", *["    -999" * 10] * 10]
        head += [" 100 Real-header values follow on  20 lines, Format= (5F15.6)", *_fixed(reals, "{:15.6f}", 5)]
        head += ['  1 Comment line(s) follow, each starting with a "|":', "| nothing"]
        head += [f"{time.size:7d} acceleration pts, approx {time[-1]:4.0f} secs, units=cm/sec2(04),Format=(8F10.5)"]
        text += "\n".join([*head, *_fixed(column.values, "{:10.5f}", 8), "/&  ---- End of data ----", ""])
    path.write_text(text, encoding="ascii")
    return path


def catman(path: Path, time: np.ndarray, columns: Sequence[Column], kind: int = 1) -> Path:
    def text(words: str, form: str = "<h") -> bytes:
        return struct.pack(form, len(words)) + words.encode("cp1252")

    def header(column: Column) -> bytes:
        extended = bytearray(148)
        struct.pack_into("<2d", extended, 0, 41390.4271875, 1000 * (time[1] - time[0]))
        extended[140] = kind
        told = struct.pack("<hi", 4, column.values.size) + text(column.name) + text(column.unit) + text("")
        told += struct.pack("<hhdi", 0, 8, 41390.4271875, len(extended)) + bytes(extended)
        return told + b"\0\0\0" + struct.pack("<h", 0) + text("") + text("", "<i")

    def values(column: Column) -> bytes:
        if kind != 2:
            return column.values.astype({0: "<f8", 1: "<f4"}[kind]).tobytes()
        low, high = column.values.min(), column.values.max()
        steps = np.round((column.values - low) / ((high - low) / 32767)).astype("<u2")
        return struct.pack("<2d", low, high) + steps.tobytes()

    written = [Column("Zeit 1", "s", time), *columns]
    common = text("") + text("") * 32 + struct.pack("<hi", len(written), 0) + b"\0" * 4 * len(written) + b"\0" * 4
    heads = b"".join(header(column) for column in written)
    offset = 6 + len(common) + len(heads)
    path.write_bytes(struct.pack("<hi", 5012, offset) + common + heads + b"".join(values(column) for column in written))
    return path


def famos(path: Path, time: np.ndarray, columns: Sequence[Column]) -> Path:
    def block(key: str, *parameters: object) -> bytes:
        content = ",".join(str(parameter) for parameter in parameters).encode("cp1252")
        return f"|{key},1,{len(content)},".encode() + content + b";"

    content = b"|CF,2,1,1;|CK,1,3,1,1;"
    for number, column in enumerate(columns, 1):
        data = column.values.astype("<f4").tobytes()
        content += block("CG", 1, 1, 1) + block("CD", f"{time[1] - time[0]:.16E}", 1, 1, "s", 0, 0, 0, "0.0", 1)
        content += block("NT", 26, 4, 2013, 10, 15, "0.25") + block("CC", 1, 1)
        content += block("CP", number, 4, 7, 32, 0, 0, 1, 0)
        content += block("CR", 0, "1.0", "0.0", 1, len(column.unit), column.unit)
        content += block("CN", 0, 0, 0, len(column.name), column.name, 0, "")
        content += block("Cb", 1, 0, number, number, 0, len(data), 0, len(data), 1, f"{time[0]:.16E}", "0.0", "")
        content += f"|CS,1,{len(data) + len(str(number)) + 1},{number},".encode() + data + b";"
    path.write_bytes(content)
    return path


def diadem(path: Path, time: np.ndarray, columns: Sequence[Column]) -> Path:
    written = [Column("Time", "s", time), *columns]
    blocks, data = "", ""
    for number, column in enumerate(written):
        place, size = 4 * number * time.size, time.size
        blocks += f'<block byteOffset="{place}" id="inc{number}" length="{size}" valueType="eFloat32Usi"/>\n'
        data += f'<tdm_channel id="c{number}"><name>{column.name}</name><unit_string>{column.unit}</unit_string>'
        data += f'<local_columns>#xpointer(id("l{number}"))</local_columns></tdm_channel>\n<localcolumn id="l{number}">'
        data += "<sequence_representation>explicit</sequence_representation>"
        data += f'<values>#xpointer(id("s{number}"))</values></localcolumn>\n'
        data += f'<float_sequence id="s{number}"><values external="inc{number}"/></float_sequence>\n'
    path.write_text(
        '<?xml version="1.0" encoding="UTF-8"?><usi:tdm xmlns:usi="http://www.ni.com/Schemas/USI/1_0" version="1.0">\n'
        f'<usi:include><file byteOrder="littleEndian" url="{path.stem}.tdx">\n{blocks}</file></usi:include>\n'
        f"<usi:data>\n{data}</usi:data></usi:tdm>\n",
        encoding="utf-8",
    )
    values = np.concatenate([column.values for column in written]).astype("<f4")
    path.with_suffix(".tdx").write_bytes(values.tobytes())
    return path


TDM = """<?xml version="1.0" encoding="UTF-8"?><usi:tdm xmlns:usi="http://www.ni.com/Schemas/USI/1_0" version="1.0">
<usi:include><file byteOrder="{order}" url="{url}"><block byteOffset="0" id="inc0" length="4" valueType="eInt16Usi"/>
<block byteOffset="8" blockOffset="0" blockSize="16" id="inc1" length="3" valueType="eFloat64Usi"/>
</file></usi:include>
<usi:data>
<short_sequence id="s1"><values external="inc0"/></short_sequence>
<double_sequence id="s2"><values external="inc1"/></double_sequence>
<tdm_channel id="c1"><name>top</name><unit_string>mm</unit_string><instance_attributes>
<double_attribute name="wf_increment">0.005</double_attribute>
<double_attribute name="wf_start_offset">-0.01</double_attribute>
</instance_attributes><local_columns>#xpointer(id("l1"))</local_columns></tdm_channel>
<tdm_channel id="c2"><name>table</name><unit_string>g</unit_string>
<local_columns>#xpointer(id("l2"))</local_columns></tdm_channel>
<tdm_channel id="c3"><name>even</name><local_columns>#xpointer(id("l3"))</local_columns></tdm_channel>
<localcolumn id="l1"><sequence_representation>{kind}</sequence_representation>
<generation_parameters>{parameters}</generation_parameters><values>#xpointer(id("s1"))</values>
<submatrix>#xpointer(id("m3"))</submatrix></localcolumn>
<localcolumn id="l2"><sequence_representation>explicit</sequence_representation><values>#xpointer(id("s2"))</values>
</localcolumn>
<localcolumn id="l3"><sequence_representation>implicit_linear</sequence_representation>
<generation_parameters>1 2</generation_parameters><submatrix>#xpointer(id("m3"))</submatrix></localcolumn>
<submatrix id="m3"><number_of_rows>{rows}</number_of_rows></submatrix>
</usi:data></usi:tdm>"""


def tdm(path: Path, *, packed: bool = False, **header: object) -> Path:
    """Write a header of three channels, two of them stored, and its values in a .tdx, as DIAdem writes them."""
    values = path.with_suffix(".tdx")
    told = {"order": "littleEndian", "rows": 3, "url": values.name, "kind": "raw_linear", "parameters": "10 0.5"}
    told |= header
    sign = "<" if told["order"] == "littleEndian" else ">"
    numbers = np.array([0, 1, -2, 100]).astype(f"{sign}i2").tobytes()
    floats = np.array([0.5, 9, 1.5, 9, 2.5, 9]).astype(f"{sign}f8").tobytes()
    values.write_bytes(numbers + floats)
    path.write_text(TDM.format(**told), encoding="utf-8")
    if packed:
        text = path.read_bytes()
        with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as archive:
            archive.writestr("header.xml", text)
    return path


def uff(path: Path, time: np.ndarray, columns: Sequence[Column], *, is_binary: bool = False) -> Path:
    content = b""
    for number, column in enumerate(columns, 1):
        records = [column.name, *["NONE"] * 4]
        records += [f"{1:5d}{0:10d}{1:5d}{0:10d} {'NONE':<10s}{number:10d}{1:4d} {'NONE':<10s}{0:10d}{0:4d}"]
        records += [f"{4:10d}{time.size:10d}{1:10d}{time[0]:13.5e}{time[1] - time[0]:13.5e}{0:13.5e}"]
        for kind, label, unit in ((17, "Time", "s"), (12, "Value", column.unit), *[(0, "NONE", "NONE")] * 2):
            records.append(f"{kind:10d}{0:5d}{0:5d}{0:5d} {label:<20s} {unit:<20s}")
        head = "".join(f"{record:<80s}\n" for record in records).encode("latin-1")
        data = column.values.astype("<f8").tobytes()
        if is_binary:
            first = f"{58:6d}b{1:6d}{2:6d}{11:12d}{len(data):12d}{0:6d}{0:6d}{0:12d}{0:12d}\n".encode()
            content += b"    -1\n" + first + head + data + b"\n    -1\n"
        else:
            body = "\n".join(_fixed(column.values, "{:20.12e}", 4)).encode()
            content += b"    -1\n    58\n" + head + body + b"\n    -1\n"
    path.write_bytes(content)
    return path


def waveform(path: Path, time: np.ndarray, columns: Sequence[Column]) -> Path:
    import obspy

    stream = obspy.Stream()
    for column in columns:
        header = {"station": "TABLE", "channel": column.name[:3].upper(), "delta": time[1] - time[0]}
        header["starttime"] = obspy.UTCDateTime(2013, 4, 26, 10, 15, 0, 250000) + time[0]
        stream += obspy.Trace(column.values.astype("<f4"), header)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        stream.write(str(path), format="MSEED")
    return path


def _rows(time: np.ndarray, columns: Sequence[Column], delimiter: str, decimal: str) -> list[str]:
    table = zip(time, *(column.values for column in columns), strict=True)
    return [delimiter.join(f"{value:.6f}".replace(".", decimal) for value in row) for row in table]


def _fixed(values: np.ndarray, form: str, count: int) -> list[str]:
    return ["".join(form.format(value) for value in values[row : row + count]) for row in range(0, values.size, count)]


WRITERS: dict[str, Writer] = {
    writer.__name__: writer for writer in (catman, cosmos, diadem, famos, lvm, mts, peer, uff, waveform)
}

TIME = np.arange(40) / 200
COLUMNS = (Column("top", "mm", 10 * np.sin(40 * TIME)), Column("table", "g", 0.3 * np.cos(30 * TIME)))


def as_matlab_73(path: Path) -> Path:
    """Give a file of HDF5 with 512 bytes in front the head that MATLAB writes there."""
    with path.open("r+b") as stream:
        stream.write(b"MATLAB 7.3 MAT-file, Platform: GLNXA64".ljust(124) + b"\x00\x02IM")
    return path
