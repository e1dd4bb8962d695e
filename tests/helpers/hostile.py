"""
A hostile file for each library that parses a stranger's file: it runs a program, reads a secret, swells, or has no end.

Each writes its file in a campaign's folder, beside which the secrets are. What the file would do is in the function's
first line. None of them may do it.
"""

import os
import pickle
import struct
import warnings
import zlib
from pathlib import Path
from typing import NamedTuple

import h5py
import numpy as np
from scipy.io import netcdf_file

from workbooks import ods, sheet_xml, xls, xlsx

SECRET = 31337.25 + np.arange(100.0)
"""Values that are in no raw file, but in files beside the campaign's folder."""
SWOLLEN = 1 << 28
"""Bytes that a small file unpacks to."""
TIME = np.arange(200) / 100
COUNTS = np.arange(200, dtype="i2")


class Place(NamedTuple):
    """Where a file is written, what it would read, and what it would make."""

    folder: Path
    secrets: Path
    victim: Path


class Program:
    """What a pickle may hold."""

    def __init__(self, victim):
        self.victim = victim

    def __reduce__(self):
        return os.mkdir, (str(self.victim),)


def secrets(folder):
    """Write what must not be read."""
    folder.mkdir()
    (folder / "secret").write_bytes(SECRET.astype("<i4").tobytes())
    (folder / "secret.txt").write_text("\n".join(map(str, SECRET)), encoding="ascii")
    with h5py.File(folder / "secret.h5", "w") as file:
        file["x"] = SECRET


def pickle_as_text(place):
    """A pickle by the name of a text file: runs a program."""
    path = place.folder / "r.csv"
    path.write_bytes(pickle.dumps(Program(place.victim), protocol=0))
    return path


def workbook_entity(place):
    """calamine: an entity that is another file, and one that swells."""
    spread = "".join(f'<!ENTITY e{n} "{f"&e{n - 1};" * 10}">' for n in range(1, 10))
    entities = f'<!DOCTYPE x [<!ENTITY s SYSTEM "{_secret(place)}"><!ENTITY e0 "1">{spread}]>'
    rows = sheet_xml([[n, "=→&s;&e9;"] for n in range(1, 50)])
    return xlsx(place.folder / "r.xlsx", a=entities + rows)


def open_document_entity(place):
    """calamine, OpenDocument: an entity that is another file."""
    entity = f'<!DOCTYPE x [<!ENTITY s SYSTEM "{_secret(place)}">]>'
    return ods(place.folder / "r.ods", [["&s;"]], head=entity)


def _secret(place):
    return (place.secrets / "secret.txt").as_uri()


def workbook_of_97(place):
    """calamine, Excel 97: sound, to be damaged."""
    return xls(place.folder / "r.xls", [[float(value), float(value) * 2] for value in TIME])


def text_formulas(place):
    """pandas and own parsers of text: cells, names and units that are programs."""
    path = place.folder / "r.txt"
    program = f"__import__('os').mkdir('{place.victim}')"
    units = ["9**9**9**9", "m^9^9^9^9", "@" + str(place.secrets / "secret.txt")]
    rows = [f"{n};{n * 0.5};=1+1;{program if n == 20 else n}" for n in range(200)]
    path.write_text("\n".join([f"t [s];a [{units[0]}];b [{units[1]}];c [{units[2]}]", *rows, ""]), encoding="utf-8")
    return path


def tdms_index(place):
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
    return path


def diadem_entity(place):
    """expat, in the header of a DIAdem data set: an entity that is another file."""
    path = place.folder / "r.TDM"
    secret = (place.secrets / "secret.txt").as_uri()
    path.write_text(
        f'<?xml version="1.0"?><!DOCTYPE x [<!ENTITY s SYSTEM "{secret}">]><usi:tdm xmlns:usi="x"><usi:data>'
        "<tdm_channel><name>&s;</name></tdm_channel></usi:data></usi:tdm>",
        encoding="utf-8",
    )
    return path


def diadem_elsewhere(place):
    """Own parser of DIAdem: values in a file elsewhere."""
    path = place.folder / "elsewhere.TDM"
    files, channels = "", ""
    for number, file in enumerate((str(place.secrets / "secret"), "../secrets/secret")):
        files += f'<file byteOrder="littleEndian" url="{file}"><block byteOffset="0" id="i{number}" length="100" '
        files += 'valueType="eInt32Usi"/></file>'
        channels += f'<tdm_channel id="c{number}"><local_columns>id("l{number}")</local_columns></tdm_channel>'
        channels += f'<localcolumn id="l{number}"><values>id("s{number}")</values></localcolumn>'
        channels += f'<long_sequence id="s{number}"><values external="i{number}"/></long_sequence>'
    path.write_text(
        f'<?xml version="1.0"?><usi:tdm xmlns:usi="x"><usi:include>{files}</usi:include>'
        f"<usi:data>{channels}</usi:data></usi:tdm>",
        encoding="utf-8",
    )
    return path


def numpy_object(place):
    """NumPy's own format: runs a program."""
    path = place.folder / "r.npy"
    np.save(path, np.array([Program(place.victim)], dtype=object), allow_pickle=True)
    return path


def _elsewhere(file, place):
    secret = str(place.secrets / "secret.h5")
    file["plain"] = np.arange(100.0)
    file["linked"] = h5py.ExternalLink(secret, "/x")
    raw = [(str(place.secrets / "secret"), 0, 400)]
    file.create_dataset("external", (100,), "<i4", external=raw)
    layout = h5py.VirtualLayout((100,), "<f8")
    layout[:] = h5py.VirtualSource(secret, "x", (100,))
    file.create_virtual_dataset("virtual", layout)
    file["circle"] = h5py.SoftLink("/circle")


def netcdf_elsewhere(place):
    """h5py, as NetCDF: takes numbers from another file."""
    path = place.folder / "r.nc"
    with h5py.File(path, "w") as file:
        _elsewhere(file, place)
    return path


def matlab_elsewhere(place):
    """h5py, as MATLAB 7.3: takes numbers from another file."""
    path = place.folder / "r73.mat"
    with h5py.File(path, "w", userblock_size=512) as file:
        _elsewhere(file, place)
        for item in ("plain", "external", "virtual"):
            file[item].attrs["MATLAB_class"] = np.bytes_("double")
    with path.open("r+b") as stream:
        stream.write(b"MATLAB 7.3 MAT-file".ljust(124) + b"\0\2IM")
    return path


def hdf5_swelling(place):
    """h5py: a dataset of a terabyte in a few kilobytes."""
    path = place.folder / "swelling.h5"
    with h5py.File(path, "w") as file:
        file["plain"] = np.arange(100.0)
        file.create_dataset("huge", (1 << 37,), "f8", chunks=(1 << 20,), compression="gzip")
    return path


def matlab_swelling(place):
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
    return path


def netcdf_classic(place):
    """SciPy's NetCDF 3: a dimension of two thousand million."""
    path = place.folder / "r3.nc"
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        with netcdf_file(path, "w") as file:
            file.createDimension("n", 200)
            file.createVariable("a", "f8", ("n",))[:] = TIME
    content = path.read_bytes()
    path.write_bytes(content.replace(struct.pack(">I", 200), struct.pack(">I", 0x7FFFFFFF)))
    return path


def seismic_pickle(place):
    """ObsPy, PICKLE: runs a program."""
    path = place.folder / "r.pickle"
    path.write_bytes(pickle.dumps(Program(place.victim)))
    return path


def mini_seed(place):
    """ObsPy's library in C: sound, to be damaged."""
    return _recorded(place.folder / "r.mseed", format="MSEED", encoding="STEIM2")


def gse(place):
    """ObsPy's other library in C: sound, to be damaged."""
    return _recorded(place.folder / "r.gse", format="GSE2")


def _recorded(path, **how):
    import obspy

    header = {"station": "TABLE", "channel": "ACC", "delta": 0.01}
    obspy.Stream([obspy.Trace(COUNTS.astype("i4"), header)]).write(str(path), **how)
    return path


FILES = {
    writer.__name__: writer
    for writer in (
        *(seismic_pickle, pickle_as_text, numpy_object, mini_seed, gse, tdms_index, netcdf_elsewhere),
        *(matlab_elsewhere, hdf5_swelling, matlab_swelling, netcdf_classic, workbook_entity, open_document_entity),
        *(workbook_of_97, diadem_entity, diadem_elsewhere, text_formulas),
    )
}
