"""Results with long arrays: the same as those with short ones, written in another way."""

from __future__ import annotations

import errno
import os
import shutil
from collections import namedtuple

import netCDF4
import numpy as np
import pytest
import xarray as xr

from colonnade.errors import StoreError
from colonnade.findings import note
from colonnade.store import files

SIZE = 2000


@pytest.fixture(autouse=True)
def _long_from_a_thousand_on(monkeypatch):
    monkeypatch.setattr("colonnade.store.provenance.LONG", 1000)


def record(first=0.0):
    values = np.random.default_rng(3).normal(size=SIZE)
    values[:2] = first, np.nan
    flags = np.where(np.isnan(values), 9, 1)
    return xr.Dataset(
        {
            "top": ("elapsed", values, {"channel": "top", "quantity": "displacement", "bridged": True}),
            "top_recorded": ("elapsed", 1e3 * values),
            "top_quality": ("elapsed", flags),
            "near": ("elapsed_near", np.arange(10.0), {"channel": "near", "quantity": "displacement"}),
        },
        coords={"elapsed": np.arange(SIZE) * 0.005, "elapsed_near": np.arange(10) * 0.5},
        attrs={"warnings": [note("missing samples", "top: 1 sample is missing")]},
    )


def test_a_long_result_comes_back_as_it_went(tmp_path):
    path = tmp_path / "tests" / "a" / "recorded.nc"
    content = files.write(record(), path, attributes={"stage": "ingest", "key": "k"}).attrs["content"]
    stored = files.read(path)
    assert stored.attrs["content"] == content
    assert stored.attrs["warnings"] == record().attrs["warnings"]
    for name, variable in record().variables.items():
        np.testing.assert_array_equal(stored[name], variable)
        assert stored[name].dims == variable.dims
    assert stored["top_quality"].dtype == np.int8


def test_long_and_short_arrays_are_described_alike(tmp_path, monkeypatch):
    files.write(record(), tmp_path / "long.nc", attributes={"stage": "ingest"})
    monkeypatch.setattr("colonnade.store.provenance.LONG", 10_000)
    files.write(record(), tmp_path / "short.nc", attributes={"stage": "ingest"})
    with netCDF4.Dataset(tmp_path / "long.nc") as long, netCDF4.Dataset(tmp_path / "short.nc") as short:
        assert set(long.variables) == set(short.variables)
        assert set(long.ncattrs()) == set(short.ncattrs())
        for name in short.variables:
            assert str(long[name].__dict__) == str(short[name].__dict__)
            assert (long[name].dtype, long[name].dimensions) == (short[name].dtype, short[name].dimensions)
            is_long = long[name].size > 1000
            assert (long[name].chunking() == "contiguous", long[name].filters()["zlib"]) == (is_long, not is_long)


def test_xarray_opens_a_long_file_as_anyone_would(tmp_path):
    files.write(record(), tmp_path / "a.nc", attributes={})
    with xr.open_dataset(tmp_path / "a.nc") as opened:
        np.testing.assert_array_equal(opened["top"], record()["top"])


@pytest.mark.parametrize("threads", [1, 4])
def test_the_content_does_not_depend_on_threads(tmp_path, monkeypatch, threads):
    expected = files.write(record(), tmp_path / "a.nc", attributes={}).attrs["content"]
    monkeypatch.setattr("colonnade.signals.parallel.threads", lambda: threads)
    assert files.write(record(), tmp_path / "b.nc", attributes={}).attrs["content"] == expected
    assert files.write(record(1e-9), tmp_path / "c.nc", attributes={}).attrs["content"] != expected


def test_one_changed_bit_is_told(tmp_path):
    path = tmp_path / "a.nc"
    files.write(record(), path, attributes={})
    content = bytearray(path.read_bytes())
    place = content.index(record()["top"].to_numpy()[500:510].tobytes())
    content[place] ^= 1
    path.write_bytes(content)
    with pytest.raises(StoreError, match="its values differ from those that were written"):
        files.read(path)


def test_a_long_write_that_breaks_off_leaves_the_old_file_and_nothing_beside_it(tmp_path, monkeypatch):
    path = tmp_path / "a.nc"
    files.write(record(), path, attributes={})
    before = path.read_bytes()

    def interrupted(descriptor):
        raise KeyboardInterrupt

    monkeypatch.setattr(os, "fsync", interrupted)
    with pytest.raises(KeyboardInterrupt):
        files.write(record(3.0), path, attributes={})
    assert path.read_bytes() == before
    assert [entry.name for entry in tmp_path.iterdir()] == ["a.nc"]


def test_a_disk_that_refuses_a_long_file_is_told_in_words(tmp_path, monkeypatch):
    def refused(descriptor):
        raise OSError(errno.EROFS, os.strerror(errno.EROFS))

    monkeypatch.setattr(os, "fsync", refused)
    with pytest.raises(StoreError, match="it cannot be written"):
        files.write(record(), tmp_path / "a.nc", attributes={})
    assert list(tmp_path.iterdir()) == []


def test_a_disk_without_room_is_told_before_anything_is_written(tmp_path, monkeypatch):
    usage = namedtuple("usage", "total used free")(10_000_000, 9_990_000, 10_000)
    monkeypatch.setattr(shutil, "disk_usage", lambda folder: usage)
    with pytest.raises(StoreError, match=r"the disk is full \(0\.0 MB free\)"):
        files.write(record(), tmp_path / "a.nc", attributes={})
    assert list(tmp_path.iterdir()) == []
