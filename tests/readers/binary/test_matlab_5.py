"""MATLAB 5 to 7: what would have to be executed is left out; cut or damaged files are refused."""

import re
import struct

import numpy as np
import pytest
import scipy.io

from colonnade.errors import ReadError
from colonnade.readers.binary.matlab_5 import read_v5
from colonnade.readers.registry import read
from every import every

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


def put(path, *variables):
    path.write_bytes(HEADER + b"".join(variables))
    return path


@every(
    ("variable", "reason"),
    [
        (matrix(16, ONE), "x is left out: it is a function; nothing in a recording is executed"),
        (opaque(b"x", b"timetable"), "x is left out: it is an object of MATLAB's class timetable.*timetable2table"),
        (matrix(5, *SPARSE), "x is left out: it is a sparse matrix"),
    ],
)
def test_what_is_no_data_is_left_out_with_the_reason(tmp_path, variable, reason):
    recording = read(put(tmp_path / "a.mat", variable, NUMBERS))
    assert recording.channel("good").values.tolist() == [0.0, 1.0, 2.0]
    assert any(re.search(reason, note) for note in recording.notes)


def test_a_size_that_its_numbers_do_not_fill_is_damage(tmp_path):
    huge = matrix(6, element(9, np.arange(3.0).tobytes()), shape=(2**31 - 1, 2**31 - 1))
    recording = read(put(tmp_path / "a.mat", huge, NUMBERS))
    assert any(
        "variable x is damaged and not read: cannot reshape array of size 3 into" in each for each in recording.warnings
    )


def test_cells_without_end_are_told(tmp_path):
    recording = read(put(tmp_path / "b.mat", matrix(1, shape=(2**31 - 1, 1)), NUMBERS))
    assert recording.channel("good").values.size == 3
    assert any(each.startswith("variable x is damaged") for each in recording.warnings)


def test_a_wrong_check_sum_is_damage(tmp_path):
    path = tmp_path / "a.mat"
    scipy.io.savemat(path, {"x": np.arange(50.0)}, do_compression=True)
    content = bytearray(path.read_bytes())
    content[-1] ^= 1
    path.write_bytes(content)
    with pytest.raises(ReadError, match=r"variable x is damaged and not read: .*incorrect data check"):
        read(path)


@every("compressed", [False, True])
def test_a_file_that_was_cut_off_says_in_which_variable(tmp_path, compressed):
    path = tmp_path / "a.mat"
    chance = np.random.default_rng(7)
    scipy.io.savemat(path, {"first": chance.random(50), "second": chance.random(50)}, do_compression=compressed)
    whole = path.read_bytes()
    path.write_bytes(whole[:-60])
    recording = read(path)
    assert [channel.name for channel in recording.channels] == ["first"]
    assert any(
        f"ends after {len(whole) - 60} of {len(whole)} bytes, within variable second" in warning
        for warning in recording.warnings
    )


def test_numbers_of_the_other_byte_order_are_read(tmp_path):
    values = np.arange(3.0)
    start = struct.pack(">II", 6, 8) + struct.pack(">II", 6, 0) + struct.pack(">II", 5, 8) + struct.pack(">ii", 1, 3)
    content = start + struct.pack(">HH", 1, 1) + b"x\0\0\0" + struct.pack(">II", 9, 24) + values.astype(">f8").tobytes()
    path = tmp_path / "a.mat"
    path.write_bytes(HEADER[:124] + b"\x01\x00MI" + struct.pack(">II", 14, len(content)) + content)
    assert read(path).channel("x").values.tolist() == [0.0, 1.0, 2.0]


def test_text_of_several_encodings_is_read(tmp_path):
    path = tmp_path / "a.mat"
    scipy.io.savemat(path, {"s": {"name": "Weg öben", "two": np.array(["ab", "cd"])}, "v": np.arange(3.0)})
    struct_ = read_v5(path).variables["s"]
    assert isinstance(struct_, dict)
    assert struct_["name"] == "Weg öben"
    assert struct_["two"] == "ab\ncd"


def test_a_text_of_three_dimensions_is_left_out_in_plain_words(tmp_path):
    path = tmp_path / "a.mat"
    letters = np.array(list("abcdefghijkl")).reshape(3, 4, 1)
    scipy.io.savemat(path, {"remarks": np.concatenate([letters, letters], axis=2), "v": np.arange(3.0)})
    recording = read(path)
    assert [channel.name for channel in recording.channels] == ["v"]
    assert any("remarks is left out: it is a text of 4 dimensions; texts of one" in note for note in recording.notes)
