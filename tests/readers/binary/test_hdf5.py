"""What an HDF5 file holds: variables of all groups, and why the rest is left out; nothing of another file is read."""

import h5py
import numpy as np
import pytest

from colonnade.errors import ReadError
from colonnade.readers.binary.hdf5 import open_hdf5
from colonnade.readers.binary.netcdf import read_classic, read_hdf5


def test_variables_come_with_their_groups_and_attributes(tmp_path):
    path = tmp_path / "a.h5"
    with h5py.File(path, "w") as file:
        file["run/deep/top"] = np.arange(5.0)
        file["run/deep/top"].attrs["units"] = np.bytes_("mm")
        file["time"] = np.arange(5.0)
        file["time"].make_scale("time")
        file["run/deep/top"].dims[0].attach_scale(file["time"])
        file.attrs["rate"] = np.array([200.0])
    content = read_hdf5(path)
    top, time = content.variables
    assert (top.path, top.groups, top.dimensions) == ("run/deep/top", ("run", "deep"), ("time",))
    assert top.attributes == {"units": "mm"}
    assert time.dimensions == ("time",)
    assert content.attributes == {"rate": 200.0}
    assert content.left_out == {}


def test_what_is_not_read_is_left_out_with_its_reason(tmp_path):
    path = tmp_path / "a.h5"
    with h5py.File(path, "w") as file:
        file["text"] = "words"
        file["soft"] = h5py.SoftLink("/text")
        file["elsewhere"] = h5py.ExternalLink("b.h5", "/x")
        file.create_dataset("external", (4,), "<i4", external=[(str(tmp_path / "b"), 0, 16)])
        file["empty"] = h5py.Empty("f8")
        file["run/top"] = np.arange(3.0)
        file["run/circle"] = file["run"]
        file["run/whole"] = file["/"]
        file["again"] = file["run/top"]
    content = read_hdf5(path)
    assert [each.path for each in content.variables] == ["again", "run/top"]
    assert content.left_out == {
        "text": "it holds no numbers",
        "soft": "it is a link to another place or file; only this file is read",
        "elsewhere": "it is a link to another place or file; only this file is read",
        "external": "its numbers are in another file; only this file is read",
        "empty": "it holds nothing",
        "run/circle": "it contains itself",
        "run/whole": "it contains itself",
    }


def test_groups_in_one_another_come_to_an_end(tmp_path):
    path = tmp_path / "a.h5"
    with h5py.File(path, "w") as file:
        file["/".join("a" * 30)] = np.arange(3.0)
    (place, reason), *_ = read_hdf5(path).left_out.items()
    assert place == "/".join("a" * 21)
    assert "in more than 20 groups" in reason


def test_a_damaged_variable_costs_no_other(tmp_path):
    path = tmp_path / "a.h5"
    with h5py.File(path, "w") as file:
        file["sound"] = np.arange(5.0)
        file.create_dataset("packed", data=np.arange(10_000.0), chunks=True, compression="gzip", fletcher32=True)
    content = bytearray(path.read_bytes())
    content[-40:-8] = bytes(32)
    path.write_bytes(content)
    found = read_hdf5(path)
    assert "sound" in [each.path for each in found.variables]
    assert any(warning.startswith("packed is damaged") for warning in found.warnings) or len(found.variables) == 2


def test_classic_netcdf_is_read_and_its_text_left_out(tmp_path):
    from scipy.io import netcdf_file

    path = tmp_path / "a.nc"
    with netcdf_file(path, "w") as file:
        file.createDimension("n", 4)
        file.createVariable("top", "f4", ("n",))[:] = np.arange(4)
        file.createVariable("who", "c", ("n",))[:] = b"abcd"
        file.variables["top"].units = "mm"
    content = read_classic(path)
    (top,) = content.variables
    assert (top.path, top.dimensions, top.attributes) == ("top", ("n",), {"units": "mm"})
    assert top.values.dtype.isnative
    assert content.left_out == {"who": "it holds text"}
    path.write_bytes(b"CDF\x05" + path.read_bytes()[4:])
    with pytest.raises(ReadError, match=r"variant CDF-5, which is not read. Convert it: nccopy -k nc4 a.nc"):
        read_classic(path)


def test_a_file_that_was_cut_off_is_refused_with_its_bytes(tmp_path):
    path = tmp_path / "a.h5"
    with h5py.File(path, "w") as file:
        file["top"] = np.arange(1000.0)
    whole = path.stat().st_size
    path.write_bytes(path.read_bytes()[: whole - 100])
    with pytest.raises(ReadError, match=rf"a.h5: it ends after {whole - 100} of {whole} bytes: .* was interrupted"):
        open_hdf5(path)


def test_a_file_that_is_no_hdf5_is_refused(tmp_path):
    (tmp_path / "a.h5").write_bytes(b"none of it" * 100)
    with pytest.raises(ReadError, match=r"a.h5: HDF5 does not open it .* the file is damaged"):
        open_hdf5(tmp_path / "a.h5")
