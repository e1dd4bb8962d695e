"""Opening HDF5: what is said of a file that is cut off or damaged, and that no link is followed."""

from __future__ import annotations

import struct
from pathlib import Path

import h5py
import numpy as np
import pytest

from colonnade.errors import ReadError
from colonnade.readers.binary.unpacking import UnreadableError
from colonnade.readers.hdf5.opening import HEAP, address, expect_numbers_here, member, open_hdf5


@pytest.fixture
def path(tmp_path: Path) -> Path:
    path = tmp_path / "a.h5"
    with h5py.File(path, "w") as file:
        file["run/top"] = np.arange(1000.0)
        file["again"] = file["run"]
        file["soft"] = h5py.SoftLink("/run/top")
        file["elsewhere"] = h5py.ExternalLink("b.h5", "/x")
        file.create_dataset("external", (4,), "<i4", external=[(str(tmp_path / "b"), 0, 16)])
        file["empty"] = h5py.Empty("f8")
        file["texts"] = ["one", "two"]
    return path


def test_a_file_that_was_cut_off_is_refused_with_its_bytes(path: Path) -> None:
    whole = path.stat().st_size
    path.write_bytes(path.read_bytes()[: whole - 100])
    with pytest.raises(ReadError, match=rf"a.h5: it ends after {whole - 100} of {whole} bytes: .* was interrupted"):
        open_hdf5(path)


def test_a_file_that_is_no_hdf5_is_refused(tmp_path: Path) -> None:
    (tmp_path / "a.h5").write_bytes(b"none of it" * 100)
    with pytest.raises(ReadError, match=r"a.h5: HDF5 does not open it .* the file is damaged"):
        open_hdf5(tmp_path / "a.h5")


def test_a_table_of_texts_without_an_end_is_refused_before_hdf5_reads_it(path: Path) -> None:
    content = bytearray(path.read_bytes())
    place = content.find(HEAP)
    index, _, _, length = struct.unpack_from("<HHIQ", content, place + 16)
    free = place + 16 + 16 + length + (-length % 8)
    assert index == 1
    while struct.unpack_from("<H", content, free)[0]:
        length = struct.unpack_from("<Q", content, free + 8)[0]
        free += 16 + length + (-length % 8)
    struct.pack_into("<Q", content, free + 8, 0)  # the free space has no size
    path.write_bytes(content)
    with pytest.raises(ReadError, match=rf"a.h5: its table of texts at byte {place} is damaged"):
        open_hdf5(path)


def test_only_what_is_in_the_file_itself_is_taken(path: Path) -> None:
    with open_hdf5(path) as file:
        assert member(file, "run")["top"].shape == (1000,)
        for link in ("soft", "elsewhere"):
            with pytest.raises(UnreadableError, match="it is a link"):
                member(file, link)
        expect_numbers_here(file["run/top"])
        with pytest.raises(UnreadableError, match="in another file"):
            expect_numbers_here(file["external"])
        with pytest.raises(UnreadableError, match="it holds nothing"):
            expect_numbers_here(file["empty"])


def test_one_object_by_two_names_has_one_address(path: Path) -> None:
    with open_hdf5(path) as file:
        assert address(file["run"]) == address(file["again"]) != address(file["run/top"])
