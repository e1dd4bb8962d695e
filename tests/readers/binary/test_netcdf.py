"""NetCDF and HDF5: units, times and missing values as the CF conventions write them, through all groups."""

from datetime import UTC, datetime

import h5py
import numpy as np
import pytest
import xarray as xr
from scipy.io import netcdf_file

from colonnade.errors import ReadError
from colonnade.readers.registry import read
from every import every

TIME = np.arange(40) * 0.005
TOP = np.sin(TIME * 20)
FORMATS = ["NETCDF3_CLASSIC", "NETCDF3_64BIT", "NETCDF4", "NETCDF4_CLASSIC"]


def saved(path, form, times=TIME, encoding=None, **attributes):
    dataset = xr.Dataset(
        {"top": ("elapsed", TOP, {"units": "mm"}), "pair": (("elapsed", "side"), np.column_stack([TOP, -TOP]))},
        coords={"elapsed": ("elapsed", times, attributes)},
    )
    dataset.to_netcdf(path, format=form, encoding=encoding)
    return path


@every("form", FORMATS)
def test_a_variable_goes_by_the_coordinate_of_its_dimension(tmp_path, form):
    recording = read(saved(tmp_path / "a.nc", form, TIME * 1e3, units="ms"))
    assert recording.format == "netcdf"
    assert recording.warnings == ()
    top = recording.channel("top")
    assert top.unit == "mm"
    np.testing.assert_array_equal(top.values, TOP)
    np.testing.assert_allclose(top.time, TIME, atol=1e-12)
    np.testing.assert_array_equal(recording.channel("pair[2]").values, -TOP)
    assert recording.channel("elapsed").is_clock


@every(
    ("units", "factor", "start"),
    [
        ("seconds since 2013-04-26T10:15:00Z", 1.0, datetime(2013, 4, 26, 10, 15, tzinfo=UTC)),
        ("milliseconds since 2013-04-26 10:15:00", 1e-3, datetime(2013, 4, 26, 10, 15, tzinfo=UTC)),
        ("days since 2013-04-26 12:15:00 +02:00", 86400.0, datetime(2013, 4, 26, 10, 15, tzinfo=UTC)),
    ],
)
def test_times_since_a_moment_count_from_the_first_sample(tmp_path, units, factor, start):
    with h5py.File(tmp_path / "a.nc", "w") as file:
        time = file.create_dataset("time", data=TIME / factor)
        time.attrs["units"] = units
        time.make_scale("time")
        file["top"] = TOP
        file["top"].dims[0].attach_scale(time)
    recording = read(tmp_path / "a.nc")
    np.testing.assert_allclose(recording.channel("top").time, TIME, atol=1e-9)
    assert recording.start == start


@every("form", ["NETCDF3_CLASSIC", "NETCDF4"])
def test_packed_numbers_are_unpacked_and_missing_ones_missing(tmp_path, form):
    values = np.array([1.5, np.nan, -2.0, 4.25])
    packing = {"dtype": "int16", "scale_factor": 0.25, "add_offset": 1.0, "_FillValue": -999}
    dataset = xr.Dataset({"a": ("t", values)}, coords={"t": ("t", np.arange(4) * 0.1, {"units": "s"})})
    dataset.to_netcdf(tmp_path / "a.nc", format=form, encoding={"a": packing})
    np.testing.assert_array_equal(read(tmp_path / "a.nc").channel("a").values, values)


def test_groups_of_hdf5_have_clocks_of_their_own(tmp_path):
    with h5py.File(tmp_path / "a.h5", "w") as file:
        for name, factor in (("first", 1.0), ("second", 2.0)):
            file[f"{name}/t"] = TIME * factor
            file[f"{name}/top"] = TOP * factor
            file[f"{name}/top"].attrs["units"] = "mm"
    recording = read(tmp_path / "a.h5")
    for name, factor in (("first", 1.0), ("second", 2.0)):
        channel = recording.channel(f"{name}/top")
        assert channel.unit == "mm"
        np.testing.assert_array_equal(channel.values, TOP * factor)
        np.testing.assert_allclose(channel.time, TIME * factor)


def test_a_rate_among_the_attributes_is_the_clock_and_a_table_is_left_out(tmp_path):
    with h5py.File(tmp_path / "a.h5", "w") as file:
        file["top"] = TOP
        file["table"] = np.zeros(40, dtype=[("top", "f8"), ("remark", "S4")])
        file.attrs["sampling_rate"] = 200.0
    recording = read(tmp_path / "a.h5")
    np.testing.assert_allclose(recording.channel("top").time, TIME, atol=1e-12)
    assert "table is left out: it holds no numbers; of a table, save each column as a variable" in recording.notes


ELSEWHERE = "it holds nothing, or is a link, or its numbers are in another file; only this one is read"


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
    recording = read(path)
    assert [each.heading for each in recording.channels] == ["again", "run/top"]
    assert {note for note in recording.notes if "left out" in note} == {
        "text is left out: it holds no numbers; of a table, save each column as a variable",
        f"soft is left out: {ELSEWHERE}",
        f"elsewhere is left out: {ELSEWHERE}",
        f"external is left out: {ELSEWHERE}",
        f"empty is left out: {ELSEWHERE}",
    }


def test_variables_keep_the_order_in_which_they_were_made(path):
    with h5py.File(path, "w", track_order=True) as file:
        for name in ("top", "bottom", "table"):
            file[name] = np.arange(5.0)
    assert [channel.name for channel in read(path).channels] == ["top", "bottom", "table"]


def test_a_damaged_variable_costs_no_other(path):
    with h5py.File(path, "w") as file:
        file["sound"] = np.arange(5.0)
        file.create_dataset("packed", data=np.arange(10_000.0), chunks=True, compression="gzip", fletcher32=True)
    content = bytearray(path.read_bytes())
    content[-40:-8] = bytes(32)
    path.write_bytes(content)
    recording = read(path)
    assert "sound" in [each.name for each in recording.channels]
    assert any(warning.startswith("packed is damaged") for warning in recording.warnings)


def test_classic_netcdf_is_read_and_its_text_left_out(path):
    with netcdf_file(path, "w") as file:
        file.createDimension("n", 4)
        file.createVariable("top", "f4", ("n",))[:] = np.arange(4)
        file.createVariable("who", "c", ("n",))[:] = b"abcd"
        file.variables["top"].units = "mm"
    recording = read(path)
    (top,) = recording.channels
    assert (top.name, top.unit, top.values.tolist()) == ("top", "mm", [0, 1, 2, 3])
    assert "who is left out: it holds text" in recording.notes
    path.write_bytes(b"CDF\x05" + path.read_bytes()[4:])
    with pytest.raises(ReadError, match=r"variant CDF-5, which is not read: convert it, `nccopy -k nc4"):
        read(path)


def test_a_file_that_was_cut_off_is_refused(path):
    with h5py.File(path, "w") as file:
        file["top"] = np.arange(1000.0)
    path.write_bytes(path.read_bytes()[:-100])
    with pytest.raises(ReadError, match=r"record.raw: it cannot be read as .*truncated file.* was cut off"):
        read(path)
