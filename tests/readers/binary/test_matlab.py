"""MATLAB: vectors, matrices and structs of both file formats become channels, with the clock and how it was found."""

import h5py
import numpy as np
import pytest
import scipy.io

from colonnade.errors import ReadError
from colonnade.readers.registry import read
from every import every

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
    content = path.read_bytes()
    path.write_bytes(b"MATLAB 7.3 MAT-file, Platform: GLNXA64".ljust(124) + b"\x00\x02IM" + content[128:])
    return path


def put(file, group, name, value):
    if isinstance(value, dict):
        item = group.create_group(name)
        item.attrs["MATLAB_class"] = np.bytes_("struct")
        for field, each in value.items():
            put(file, item, field, each)
        return item
    if isinstance(value, str):
        item = group.create_dataset(name, data=np.array([[ord(letter)] for letter in value], dtype=np.uint16))
        item.attrs["MATLAB_class"] = np.bytes_("char")
        return item
    if isinstance(value, list):
        cells = [put(file, file.require_group("#refs#"), f"{name}{k}", each).ref for k, each in enumerate(value)]
        item = group.create_dataset(name, data=np.array([cells], dtype=h5py.ref_dtype))
        if not isinstance(value[0], dict):
            item.attrs["MATLAB_class"] = np.bytes_("cell")
        return item
    item = group.create_dataset(name, data=np.atleast_2d(value).T)
    item.attrs["MATLAB_class"] = np.bytes_("double")
    return item


def column(recording, name):
    channel = recording.channel(name)
    assert channel.time is not None
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
    assert any("clock: tMeas" in note for note in recording.notes)
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
    with h5py.File(tmp_path / "seven.mat", "w"):
        pass
    seven = saved_v73(tmp_path / "seven.mat", {"t": TIME, "c": [3 * TOP, "text"]})
    np.testing.assert_array_equal(column(read(seven), "c{1}"), 3 * TOP)


def test_names_of_columns_beside_a_matrix_are_taken(tmp_path):
    heads = np.empty(2, dtype=object)
    heads[:] = ["Time [s]", "LVDT 1 [mm]"]
    imported = {"data": np.column_stack([TIME, TOP]), "colheaders": heads}
    recording = read(saved(tmp_path / "a.mat", {"imported": imported}))
    np.testing.assert_array_equal(column(recording, "LVDT 1"), TOP)
    assert recording.channel("LVDT 1").unit == "mm"


@every(
    ("scalars", "evidence"),
    [
        ({"dt": 0.005}, "by the number dt"),
        ({"Fs": 200.0}, "by the number Fs"),
        ({"Ts": 0.005, "fs": 200}, "by the number Ts"),
    ],
)
def test_a_single_number_gives_the_step_where_no_vector_is_a_clock(tmp_path, scalars, evidence):
    recording = read(saved(tmp_path / "a.mat", {"top": TOP, **scalars}))
    column(recording, "top")
    assert any(evidence in note for note in recording.notes)


def test_the_time_that_was_given_is_taken_and_a_likely_one_hinted_at(tmp_path):
    path = saved(tmp_path / "a.mat", {"n": TIME * 1e3, "top": TOP})
    recording = read(path)
    assert recording.channel("top").time is None
    assert any('set time = "n"' in note for note in recording.notes)
    column(read(path, options={"time": "n", "time_unit": "ms"}), "top")
    with pytest.raises(ReadError, match='no column is called "m"'):
        read(path, options={"time": "m"})


def test_only_the_variables_that_were_asked_for_are_read(tmp_path):
    path = saved(tmp_path / "a.mat", {"t": TIME, "top": TOP, "bottom": TOP})
    assert [each.name for each in read(path, options={"variables": ["t", "top"]}).channels] == ["t", "top"]
    with pytest.raises(ReadError, match=r'variable "tpo" not found\. Did you mean "top"'):
        read(path, options={"variables": ["tpo"]})


def test_a_file_without_columns_says_what_it_holds(form, tmp_path):
    with pytest.raises(ReadError, match=r"no column of numbers in it; it holds (?:note, fs|fs, note)\."):
        read(form(tmp_path / "a.mat", {"note": "calibration", "fs": 200.0}))


def test_bristols_numbered_channels_have_names_and_units_and_the_first_is_time(form, tmp_path):
    variables = {"File_Header": {"NumberOfChannels": "3", "SampleFrequency": "200"}}
    for number, (name, unit, values) in enumerate([("T", "s", TIME), ("LVDT 1", "mm", TOP), ("ACC", "g", -TOP)], 1):
        variables[f"Channel_{number}_Header"] = {"SignalName": name, "Unit": unit, "MaxLevel": "10"}
        variables[f"Channel_{number}_Data"] = values
    recording = read(form(tmp_path / "a.mat", variables))
    assert [(each.name, each.unit) for each in recording.channels] == [("time", "s"), ("LVDT 1", "mm"), ("ACC", "g")]
    np.testing.assert_array_equal(column(recording, "LVDT 1"), TOP)
    assert any("layout of Bristol" in note for note in recording.notes)


def test_bristols_numbered_channels_without_a_clock_go_by_the_rate_of_the_header(tmp_path):
    variables = {"File_Header": {"SampleFrequency": "200"}, "Channel_1_Data": TOP, "Channel_2_Data": -TOP}
    recording = read(saved(tmp_path / "a.mat", {**variables, "Channel_1_Header": {"SignalName": "ACC", "Unit": "g"}}))
    np.testing.assert_array_equal(column(recording, "ACC"), TOP)


def test_bristols_other_layout_warns_of_channels_that_are_not_there(tmp_path):
    variables = {"t": TIME, "chan1": TOP, "chan2": -TOP, "Frequency": 200.0}
    assert read(saved(tmp_path / "a.mat", {**variables, "No_Channels": 2})).warnings == ()
    recording = read(saved(tmp_path / "a.mat", {**variables, "No_Channels": 3}))
    np.testing.assert_array_equal(column(recording, "chan2"), -TOP)
    assert recording.warnings == ("No_Channels says 3, but 2 channels are in the file",)
    matrix = read(saved(tmp_path / "a.mat", {"t": TIME, "output": np.column_stack([TOP, -TOP]), "No_Channels": 2}))
    np.testing.assert_array_equal(column(matrix, "output[2]"), -TOP)


@every(
    ("content", "reason"),
    [
        (b"version https://git-lfs.github.com/spec/v1\noid sha256:0", "pointer of git-lfs"),
        (b"<!DOCTYPE html>\n<html><body>Sign in", "a web page, not a recording"),
        (b"", "the file is empty"),
        (bytes(600), "first bytes are all zero"),
        (b"MATLAB 5.0 MAT-file", "header is damaged or cut off"),
        (b"\x93NUMPY\x01\x00v\x00{'descr': '|O'", "may contain a program"),
        (b"\x80\x04\x95\x1b\x00", "a Python pickle, a program that runs when it is opened: never read"),
        (bytes([0, 0, 0, 0, 1, 0, 0, 0, 60, 0, 0, 0]), "if it is one of version 4, open it in MATLAB"),
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


def test_a_shake_table_recording_of_version_5(shared_data):
    recording = read(shared_data / "shaketable" / "grashorn_testingData.mat")
    assert [channel.name for channel in recording.channels] == ["AU", "tMeas", "xMeas"]
    displacement = recording.channel("xMeas")
    assert displacement.values.size == 3600
    assert displacement.time is not None
    assert np.diff(displacement.time).mean() == pytest.approx(0.004001, abs=5e-7)


def test_a_damper_test_of_version_5(shared_data):
    recording = read(shared_data / "matlab" / "labcontrol_ensaio1.mat")
    assert [each.name for each in recording.channels] == ["Tout", "dist", "forc", "x_F[1]", "x_F[2]", "x_F[3]"]
    force = recording.channel("forc")
    assert force.time is not None
    assert np.diff(force.time) == pytest.approx(0.01, abs=1e-9)
    np.testing.assert_array_equal(force.values, recording.channel("x_F[3]").values)


@every("name", ["shaketable/grashorn_testingData.mat", "matlab/labcontrol_ensaio1.mat"])
def test_the_numbers_are_those_that_scipy_reads(shared_data, name):
    recording = read(shared_data / name)
    for variable, values in scipy.io.loadmat(shared_data / name).items():
        if isinstance(values, np.ndarray) and values.size > 1 and min(values.shape) == 1:
            np.testing.assert_array_equal(recording.channel(variable).values, values.ravel())
