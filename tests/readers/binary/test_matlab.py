"""MATLAB: vectors, matrices and structs of both file formats become channels, with the clock and how it was found."""

import struct

import h5py
import numpy as np
import pytest
import scipy.io

from colonnade.errors import ReadError
from colonnade.readers.registry import read
from every import every
from raw_files import as_matlab_73

TIME = np.arange(60) * 0.005
TOP = np.sin(TIME * 20)


def saved(path, variables, *, compressed=False):
    scipy.io.savemat(path, variables, do_compression=compressed)
    return path


def saved_v73(path, variables):
    """Write as MATLAB 7.3 does: HDF5 behind 512 bytes, columns as rows, classes as attributes."""
    with h5py.File(path, "w", userblock_size=512) as file:
        for name, value in variables.items():
            put(file, file, name, value)
    return as_matlab_73(path)


def put(file, group, name, value):
    if isinstance(value, dict):
        item, kind = group.create_group(name), "struct"
        for field, each in value.items():
            put(file, item, field, each)
    elif isinstance(value, str):
        item, kind = group.create_dataset(name, data=np.array([[ord(each)] for each in value], dtype=np.uint16)), "char"
    elif isinstance(value, list):
        cells = [put(file, file.require_group("#refs#"), f"{name}{k}", each).ref for k, each in enumerate(value)]
        item, kind = group.create_dataset(name, data=np.array([cells], dtype=h5py.ref_dtype)), "cell"
    else:
        item, kind = group.create_dataset(name, data=np.atleast_2d(value).T), "double"
    item.attrs["MATLAB_class"] = np.bytes_(kind)
    return item


def column(recording, name):
    channel = recording.channel(name)
    np.testing.assert_allclose(channel.time, TIME, atol=1e-12)
    return channel.values


FORMS = {
    "version 5": saved,
    "version 5, compressed": lambda path, variables: saved(path, variables, compressed=True),
    "version 7.3": saved_v73,
}


@pytest.fixture(params=list(FORMS), ids=str)
def form(request):
    return FORMS[request.param]


def test_vectors_are_channels_and_the_vector_of_times_their_clock(form, tmp_path):
    recording = read(form(tmp_path / "a.mat", {"top": TOP, "tMeas": TIME, "fs": 200.0}))
    assert recording.format == "matlab"
    np.testing.assert_array_equal(column(recording, "top"), TOP)
    assert recording.channel("tMeas").is_clock
    assert any('"tMeas" (without a unit' in note for note in recording.notes)
    assert recording.warnings == ()


def test_a_matrix_gives_a_channel_a_column_whichever_way_it_lies(form, tmp_path):
    table = np.column_stack([TOP, 2 * TOP, 3 * TOP])
    for lying in (table, table.T):
        recording = read(form(tmp_path / "a.mat", {"t": TIME, "x": lying}))
        for number in (1, 2, 3):
            np.testing.assert_array_equal(column(recording, f"x[{number}]"), number * TOP)


def test_fields_of_structs_go_by_the_clock_of_their_struct(form, tmp_path):
    run = {"time": TIME, "table": {"acceleration": TOP}}
    recording = read(form(tmp_path / "a.mat", {"run": run, "other": {"time": TIME * 2, "a": TOP}}))
    np.testing.assert_array_equal(column(recording, "run.table.acceleration"), TOP)
    np.testing.assert_array_equal(column(recording, "acceleration"), TOP)
    np.testing.assert_allclose(recording.channel("other.a").time, TIME * 2)


def test_simulinks_structure_with_time(form, tmp_path):
    signals = {"values": np.column_stack([TOP, -TOP]), "label": "angle"}
    recording = read(form(tmp_path / "a.mat", {"yout": {"time": TIME, "signals": signals}}))
    np.testing.assert_array_equal(column(recording, "angle[2]"), -TOP)
    np.testing.assert_array_equal(column(recording, "yout.signals.values[1]"), TOP)


def test_arrays_of_structs_and_cells_are_numbered(tmp_path):
    structs = np.array([(TOP,), (-TOP,)], dtype=[("a", object)])
    cells = np.empty(2, dtype=object)
    cells[:] = [3 * TOP, "text"]
    recording = read(saved(tmp_path / "a.mat", {"t": TIME, "run": structs, "c": cells}))
    np.testing.assert_array_equal(column(recording, "run(2).a"), -TOP)
    np.testing.assert_array_equal(column(recording, "c{1}"), 3 * TOP)
    seven = saved_v73(tmp_path / "seven.mat", {"t": TIME, "c": [3 * TOP, "text"]})
    np.testing.assert_array_equal(column(read(seven), "c{1}"), 3 * TOP)


def test_the_time_that_was_given_is_taken(form, tmp_path):
    path = form(tmp_path / "a.mat", {"n": TIME * 1e3, "top": TOP})
    assert read(path).channel("top").time is None
    column(read(path, options={"time": "n", "time_unit": "ms"}), "top")
    with pytest.raises(ReadError, match='no column is called "m"'):
        read(path, options={"time": "m"})


def test_a_file_without_columns_is_refused(form, tmp_path):
    with pytest.raises(ReadError, match="no column of numbers in it"):
        read(form(tmp_path / "a.mat", {"note": "calibration", "fs": 200.0}))


def test_bristols_numbered_channels_have_names_and_units_and_the_rate_of_the_header(form, tmp_path):
    variables = {"File_Header": {"NumberOfChannels": "2", "SampleFrequency": "200"}}
    for number, (name, unit, values) in enumerate([("LVDT 1", "mm", TOP), ("ACC", "g", -TOP)], 1):
        variables[f"Channel_{number}_Header"] = {"SignalName": name, "Unit": unit, "MaxLevel": "10"}
        variables[f"Channel_{number}_Data"] = values
    recording = read(form(tmp_path / "a.mat", variables))
    assert [(each.name, each.unit) for each in recording.channels] == [("LVDT 1", "mm"), ("ACC", "g")]
    np.testing.assert_array_equal(column(recording, "LVDT 1"), TOP)


@every(
    ("content", "reason"),
    [
        (b"<!DOCTYPE html>\n<html><body>Sign in", "a web page, not a recording"),
        (b"", "the file is empty"),
        (b"MATLAB 5.0 MAT-file", "the whole header of a MATLAB file of version 5 to 7.3"),
        (b"\x93NUMPY\x01\x00v\x00{'descr': '|O'", "may contain a program"),
    ],
)
def test_a_file_that_is_none_is_refused_with_what_it_is(tmp_path, content, reason):
    path = tmp_path / "a.mat"
    path.write_bytes(content)
    # Of an empty file no format is asked.
    with pytest.raises(ReadError, match=reason):
        read(path)
    with pytest.raises(ReadError, match=reason):
        read(path, "matlab")


@every("name", ["shaketable/grashorn_testingData.mat", "matlab/labcontrol_ensaio1.mat"])
def test_the_numbers_are_those_that_scipy_reads(shared_data, name):
    recording = read(shared_data / name)
    for variable, values in scipy.io.loadmat(shared_data / name).items():
        if isinstance(values, np.ndarray) and values.size > 1:
            for number, column in enumerate(values.reshape(max(values.shape), -1).T, 1):
                head = variable if min(values.shape) == 1 else f"{variable}[{number}]"
                np.testing.assert_array_equal(recording.channel(head).values, column)


HEADER = b"MATLAB 5.0 MAT-file, Platform: TEST".ljust(124) + struct.pack("<H", 0x0100) + b"IM"


def element(kind, content):
    return struct.pack("<II", kind, len(content)) + content + bytes(-len(content) % 8)


def matrix(array_class, *parts, name=b"x", shape=(1, 3)):
    start = element(6, struct.pack("<II", array_class, 0)) + element(5, struct.pack(f"<{len(shape)}i", *shape))
    return element(14, start + element(1, name) + b"".join(parts))


def opaque(name, class_name):
    content = [element(6, struct.pack("<II", 17, 0)), element(1, name), element(1, b"MCOS"), element(1, class_name)]
    return element(14, b"".join(content) + matrix(13, element(6, bytes(24)), name=b"", shape=(6, 1)))


ONE = matrix(6, element(9, np.ones(1).tobytes()), name=b"", shape=(1, 1))
SPARSE = (element(5, bytes(4)), element(5, struct.pack("<4i", 0, 1, 1, 1)), element(9, np.ones(1).tobytes()))
NUMBERS = matrix(6, element(9, np.arange(3.0).tobytes()), name=b"good")


def of_elements(path, *variables):
    path.write_bytes(HEADER + b"".join(variables))
    return path


@every("variable", [matrix(16, ONE), opaque(b"x", b"timetable"), matrix(5, *SPARSE)])
def test_what_is_no_data_is_left_out_with_what_to_do(tmp_path, variable):
    recording = read(of_elements(tmp_path / "a.mat", variable, NUMBERS))
    assert recording.channel("good").values.tolist() == [0.0, 1.0, 2.0]
    (told,) = (note for note in recording.notes if note.startswith("x is left out: it holds no real numbers"))
    assert "nothing in a recording is executed" in told
    assert "table2struct" in told


@every(
    "damaged",
    [
        matrix(6, element(9, np.arange(3.0).tobytes()), shape=(2**31 - 1, 2**31 - 1)),
        matrix(1, shape=(2**31 - 1, 1)),
    ],
)
def test_a_variable_that_is_larger_than_its_bytes_is_damage(tmp_path, damaged):
    recording = read(of_elements(tmp_path / "a.mat", damaged, NUMBERS))
    assert recording.channel("good").values.size == 3
    assert any(each.startswith("x is damaged and not read: ") for each in recording.warnings)


def v73(path, fill):
    with h5py.File(path, "w", userblock_size=512) as file:
        of_class(file, "double", "good", data=np.arange(5.0)[:, None])
        fill(file)
    return as_matlab_73(path)


def of_class(file, name, path="x", **content):
    item = file.create_dataset(path, **content) if content else file.create_group(path)
    item.attrs["MATLAB_class"] = np.bytes_(name)
    return item


def object_of_a_class(file):
    of_class(file, "timetable", data=np.zeros((6, 1), dtype=np.uint32)).attrs["MATLAB_object_decode"] = np.int32(3)


def external_link(file):
    file["x"] = h5py.ExternalLink("other.mat", "good")


def virtual_numbers(file):
    layout = h5py.VirtualLayout(shape=(5, 1), dtype="f8")
    layout[:] = h5py.VirtualSource("other.mat", "good", shape=(5, 1))
    file.create_virtual_dataset("x", layout)


@every(
    ("fill", "reason"),
    [
        (object_of_a_class, "a function or an object of one of MATLAB's classes"),
        (lambda file: of_class(file, "function_handle"), "nothing in a recording is executed"),
        (external_link, "its numbers are in another file"),
        (
            lambda file: file.create_dataset("x", (5, 1), "f8", external=[("/etc/hostname", 0, 40)]),
            "its numbers are in another file",
        ),
        (virtual_numbers, "its numbers are in another file"),
        (lambda file: file.create_group("x").attrs.create("MATLAB_sparse", np.uint64(3)), "sparse"),
    ],
)
def test_what_is_no_data_of_this_file_is_left_out_with_the_reason(tmp_path, fill, reason):
    recording = read(v73(tmp_path / "a.mat", fill))
    assert recording.channel("good").values.tolist() == [0.0, 1.0, 2.0, 3.0, 4.0]
    assert any(note.startswith("x is left out: ") and reason in note for note in recording.notes)


def test_an_array_of_structs_is_numbered_as_in_version_5(tmp_path):
    def structs(file):
        parts = [file.create_dataset(f"#refs#/{k}", data=np.full((5, 1), float(k))) for k in range(2)]
        group = of_class(file, "struct", "run")
        group.create_dataset("a", data=np.array([[part.ref for part in parts]], dtype=h5py.ref_dtype))

    assert read(v73(tmp_path / "a.mat", structs)).channel("run(2).a").values.tolist() == [1.0] * 5
