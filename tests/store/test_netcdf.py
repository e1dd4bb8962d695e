"""A dataset goes into NetCDF and comes back as it was: attributes, labels, long arrays and short ones."""

import json
import shutil
from collections import namedtuple

import netCDF4
import numpy as np
import pytest
import xarray as xr
from hypothesis import given
from hypothesis import strategies as st

from colonnade.errors import StoreError
from colonnade.findings import note, serious, warning
from colonnade.store import files
from colonnade.store.netcdf import loaded, restored, storable
from every import every

FINDINGS = [
    serious("unit", "Column a is in mm, the campaign file says cm.", follows=("gain",)),
    warning("jitter", "Steps vary by 3 %."),
    note("rounded times", "Rounded to 1 ms."),
]


def test_attributes_come_back_but_for_what_is_not_known():
    held = {"settings": {"b": 1, "a": {"x": None}}, "zero": 0, "empty": "", "none": [], "warnings": FINDINGS}
    stored = storable(held | {"nothing": None, "yes": True, "no": np.False_})
    assert "nothing" not in stored
    assert [stored.pop(name).tolist() for name in ("yes", "no")] == [1, 0]
    assert stored["settings"] == storable({"settings": {"a": {"x": None}, "b": 1}})["settings"]
    assert restored(stored) == held | {"settings": json.dumps(held["settings"], sort_keys=True)}


@given(st.lists(st.text()))
def test_a_list_of_text_comes_back(lines):
    stored = storable({"notes": lines, "refused": tuple(lines)})
    assert all(isinstance(value, str) for value in stored.values())
    assert restored(stored) == {"notes": lines, "refused": lines}


@every("text", ["[1, 2]", '["a", 1]', '[["a"]]', "[not json", "[", '{"a": "b"}', '"a"', " []", "null"])
def test_text_that_is_not_a_list_of_text_passes(text):
    assert restored({"reason": text}) == {"reason": text}


SIZE = 2000


@pytest.fixture
def long_from_a_thousand_on(monkeypatch):
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
        attrs={"warnings": FINDINGS, "outcome": "", "nothing": None},
    )


def test_values_attributes_and_coordinates_are_those_that_xarray_finds(tmp_path):
    labels = {"model": np.array(["linear", "nonlinear"], dtype=object), "test_id": ("test", np.array([], dtype=object))}
    result = record().assign(nrmse=("model", [0.1, 0.2]), restitution=((), 0.97)).assign_coords(labels)
    files.write(result, tmp_path / "a.nc", attributes={"stage": "compare"})
    with xr.open_dataset(tmp_path / "a.nc", decode_times=False, mask_and_scale=False) as opened:
        expected = opened.load()
    labels = expected["model_name"].variable
    expected = expected.drop_vars("model_name").assign_coords(model=("model", labels.values, labels.attrs))
    with netCDF4.Dataset(tmp_path / "a.nc") as opened:
        found = loaded(opened)
    xr.testing.assert_identical(found, expected)
    assert {name: found[name].dtype.kind for name in expected.variables} == {
        name: each.dtype.kind for name, each in expected.variables.items()
    }


@pytest.mark.parametrize("long", [1000, 10_000], ids=["long", "short"])
def test_a_result_comes_back_as_it_went(tmp_path, monkeypatch, long):
    monkeypatch.setattr("colonnade.store.provenance.LONG", long)
    path = tmp_path / "tests" / "a" / "recorded.nc"
    content = files.write(record(), path, attributes={"stage": "ingest", "key": "k"}).attrs["content"]
    stored = files.read(path)
    assert stored.attrs["content"] == content
    assert files.read_attributes(path)["content"] == content
    assert stored.attrs["warnings"] == record().attrs["warnings"]
    assert (stored.attrs["status"], stored.attrs["outcome"], stored.attrs["key"]) == ("done", "", "k")
    assert "nothing" not in stored.attrs
    assert stored["top"].attrs["bridged"] == 1
    for name, variable in record().variables.items():
        np.testing.assert_array_equal(stored[name], variable)
        assert stored[name].dims == variable.dims
    assert stored["top_quality"].dtype == np.int8


@pytest.mark.usefixtures("long_from_a_thousand_on")
@pytest.mark.parametrize("threads", [1, 4])
def test_the_content_does_not_depend_on_threads(tmp_path, monkeypatch, threads):
    expected = files.write(record(), tmp_path / "a.nc", attributes={}).attrs["content"]
    monkeypatch.setattr("colonnade.signals.samples.threads", lambda: threads)
    assert files.write(record(), tmp_path / "b.nc", attributes={}).attrs["content"] == expected
    assert files.write(record(1e-9), tmp_path / "c.nc", attributes={}).attrs["content"] != expected


@pytest.mark.usefixtures("long_from_a_thousand_on")
def test_one_changed_bit_is_told(tmp_path):
    path = tmp_path / "a.nc"
    files.write(record(), path, attributes={})
    content = bytearray(path.read_bytes())
    place = content.index(record()["top"].to_numpy()[500:510].tobytes())
    content[place] ^= 1
    path.write_bytes(content)
    with pytest.raises(StoreError, match="its values differ from those that were written"):
        files.read(path)


def test_a_disk_without_room_is_told_before_anything_is_written(tmp_path, monkeypatch):
    usage = namedtuple("usage", "total used free")(10_000_000, 9_990_000, 10_000)
    monkeypatch.setattr(shutil, "disk_usage", lambda folder: usage)
    with pytest.raises(StoreError, match=r"the disk is full \(0\.0 MB free\)"):
        files.write(record(), tmp_path / "a.nc", attributes={})
    assert list(tmp_path.iterdir()) == []
