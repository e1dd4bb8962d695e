"""A damaged binary file gives a recording or a message that names it, never anything else, and soon."""

import random
from collections import Counter

import h5py
import numpy as np
import scipy.io
import xlwt
from nptdms import ChannelObject, TdmsWriter

from colonnade.errors import ReadError
from colonnade.readers.registry import read
from damage import KINDS, damaged
from every import every

TIME = np.arange(60) * 0.01
TABLE = np.random.default_rng(5).random((60, 3))
MUTATIONS = 36


def tdms(path):
    start = np.datetime64("2020-01-01T00:00:00")
    with TdmsWriter(path) as writer:
        for _ in range(3):
            properties = {"wf_increment": 0.01, "wf_start_offset": 0.0, "wf_start_time": start, "unit_string": "mm"}
            writer.write_segment(
                [
                    ChannelObject("g", "a", TIME, properties),
                    ChannelObject("g", "b", np.arange(60, dtype=np.int16)),
                    ChannelObject("g", "t", start + np.arange(60) * np.timedelta64(1000, "us")),
                    ChannelObject("g", "s", ["a"] * 60),
                ]
            )


def variables():
    cells = np.empty(2, dtype=object)
    cells[:] = ["text", TIME]
    structs = np.array([(1.0, TIME), (3.0, TIME)], dtype=[("a", object), ("b", object)])
    return {"t": TIME, "x": TABLE, "s": {"a": TIME, "n": "text", "c": cells}, "st": structs}


def matlab_plain(path):
    scipy.io.savemat(path, variables())


def matlab_compressed(path):
    scipy.io.savemat(path, variables(), do_compression=True)


def matlab_hdf5(path):
    with h5py.File(path, "w", userblock_size=512) as file:
        file.create_dataset("t", data=TIME[:, None]).attrs["MATLAB_class"] = np.bytes_("double")
        group = file.create_group("s")
        group.attrs["MATLAB_class"] = np.bytes_("struct")
        group.create_dataset("x", data=TABLE.T, compression="gzip")
        file["c"] = np.array([file["t"].ref, file["s/x"].ref], dtype=h5py.ref_dtype)
    content = path.read_bytes()
    path.write_bytes(b"MATLAB 7.3 MAT-file".ljust(124) + b"\x00\x02IM" + content[128:])


def netcdf4(path):
    with h5py.File(path, "w") as file:
        time = file.create_dataset("time", data=TIME)
        time.attrs["units"] = "s"
        time.make_scale("time")
        top = file.create_dataset("run/top", data=TABLE, compression="gzip")
        top.dims[0].attach_scale(time)
        top.attrs["units"] = "mm"


def netcdf3(path):
    with scipy.io.netcdf_file(path, "w") as file:
        file.createDimension("time", 60)
        for name, values in (("time", TIME), ("top", TABLE[:, 0])):
            file.createVariable(name, "f8", ("time",))[:] = values
        file.variables["time"].units = b"s"


def xls(path):
    book = xlwt.Workbook()
    sheet = book.add_sheet("A")
    for row, (time, value) in enumerate(zip(TIME, TABLE[:, 0], strict=True)):
        sheet.write(row, 0, float(time))
        sheet.write(row, 1, float(value))
    book.save(str(path))


WRITERS = {
    "tdms": (tdms, ".tdms"),
    "matlab 5, plain": (matlab_plain, ".mat"),
    "matlab 5, compressed": (matlab_compressed, ".mat"),
    "matlab 7.3": (matlab_hdf5, ".mat"),
    "netcdf 4": (netcdf4, ".nc"),
    "netcdf 3": (netcdf3, ".nc"),
    "xls": (xls, ".xls"),
}


def read_or_refusal(path):
    try:
        return read(path)
    except ReadError as error:
        return error


@every("name", list(WRITERS))
def test_a_damaged_file_is_read_or_refused(tmp_path, name):
    writer, suffix = WRITERS[name]
    path = tmp_path / f"damaged{suffix}"
    writer(path)
    content = path.read_bytes()
    whole = read(path)
    assert whole.warnings == ()
    samples = sum(channel.values.size for channel in whole.channels)
    seen = Counter()
    for seed in range(MUTATIONS):
        path.write_bytes(damaged(content, list(KINDS)[seed % len(KINDS)], random.Random(f"{name} {seed}")))
        recording = read_or_refusal(path)
        if isinstance(recording, ReadError):
            assert path.name in str(recording)
            seen["refused"] += 1
            continue
        assert not any(np.isinf(channel.values).any() for channel in recording.channels)
        assert sum(channel.values.size for channel in recording.channels) <= 10 * max(samples, len(content))
        seen["read"] += 1
    assert min(seen["read"], seen["refused"]) > 0


@every("name", list(WRITERS))
def test_a_file_that_ends_anywhere_is_refused_or_warned_of(tmp_path, name):
    writer, suffix = WRITERS[name]
    path = tmp_path / f"cut{suffix}"
    writer(path)
    content = path.read_bytes()
    whole = sum(channel.values.size for channel in read(path).channels)
    for length in range(0, len(content), max(len(content) // 25, 1)):
        path.write_bytes(content[:length])
        recording = read_or_refusal(path)
        if isinstance(recording, ReadError):
            assert path.name in str(recording)
            continue
        complete = sum(channel.values.size for channel in recording.channels) == whole
        assert complete or recording.warnings, f"{length} of {len(content)} bytes"
