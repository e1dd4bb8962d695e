"""MATLAB 7.3: only the file itself is read, and what is no data, cyclic or would exhaust the memory is left out."""

import h5py
import numpy as np

from colonnade.readers.registry import read
from every import every


def v73(path, fill):
    with h5py.File(path, "w", userblock_size=512) as file:
        file.create_dataset("good", data=np.arange(5.0)[:, None]).attrs["MATLAB_class"] = np.bytes_("double")
        fill(file)  # type: ignore[operator]
    content = path.read_bytes()
    path.write_bytes(b"MATLAB 7.3 MAT-file".ljust(124) + b"\x00\x02IM" + content[128:])
    return path


def object_of_a_class(file):
    item = file.create_dataset("x", data=np.zeros((6, 1), dtype=np.uint32))
    item.attrs["MATLAB_class"] = np.bytes_("timetable")
    item.attrs["MATLAB_object_decode"] = np.int32(3)


def function(file):
    file.create_group("x").attrs["MATLAB_class"] = np.bytes_("function_handle")


def external_link(file):
    file["x"] = h5py.ExternalLink("other.mat", "good")


def external_numbers(file):
    file.create_dataset("x", shape=(5, 1), dtype="f8", external=[("/etc/hostname", 0, 40)])


def virtual_numbers(file):
    layout = h5py.VirtualLayout(shape=(5, 1), dtype="f8")
    layout[:] = h5py.VirtualSource("other.mat", "good", shape=(5, 1))
    file.create_virtual_dataset("x", layout)


def bomb(file):
    file.create_dataset("x", shape=(1 << 40, 1), dtype="f8", chunks=(1 << 16, 1), compression="gzip")


def text_of_three_dimensions(file):
    file.create_dataset("x", data=np.full((2, 3, 4), 97, dtype=np.uint16)).attrs["MATLAB_class"] = np.bytes_("char")


def sparse(file):
    file.create_group("x").attrs["MATLAB_sparse"] = np.uint64(3)


@every(
    ("fill", "reason"),
    [
        (object_of_a_class, "it is an object of MATLAB's class timetable, which only MATLAB can open"),
        (text_of_three_dimensions, "it is a text of 3 dimensions; texts of one or several lines are read"),
        (function, "it is a function; nothing in a recording is executed"),
        (external_link, "it is a link to another place or file"),
        (external_numbers, "its numbers are in another file"),
        (virtual_numbers, "its numbers are in another file"),
        (sparse, "it is a sparse matrix"),
    ],
)
def test_what_is_no_data_of_this_file_is_left_out_with_the_reason(tmp_path, fill, reason):
    recording = read(v73(tmp_path / "a.mat", fill))
    assert recording.channel("good").values.tolist() == [0.0, 1.0, 2.0, 3.0, 4.0]
    assert any(note.startswith("x is left out: ") and reason in note for note in recording.notes)


def test_numbers_that_no_memory_holds_cost_no_others(tmp_path):
    recording = read(v73(tmp_path / "a.mat", bomb))
    assert recording.channel("good").values.size == 5
    assert any(each.startswith("x is damaged, or cannot be unpacked here") for each in recording.warnings)


def test_cells_that_hold_themselves_come_to_an_end(tmp_path):
    def cycle(file):
        item = file.create_dataset("x", shape=(1, 4), dtype=h5py.ref_dtype)
        item[...] = np.array([[item.ref] * 4], dtype=h5py.ref_dtype)

    recording = read(v73(tmp_path / "a.mat", cycle))
    assert recording.channel("good").values.size == 5
    assert "x{1} is left out: it contains itself" in recording.notes


def test_an_array_of_structs_is_numbered_as_in_version_5(tmp_path):
    def structs(file):
        parts = [file.create_dataset(f"#refs#/{k}", data=np.full((5, 1), float(k))) for k in range(2)]
        group = file.create_group("run")
        group.attrs["MATLAB_class"] = np.bytes_("struct")
        group.create_dataset("a", data=np.array([[part.ref for part in parts]], dtype=h5py.ref_dtype))

    assert read(v73(tmp_path / "a.mat", structs)).channel("run(2).a").values.tolist() == [1.0] * 5
