"""Results are loaded as xarray would load them."""

from __future__ import annotations

import netCDF4
import numpy as np
import pytest
import xarray as xr

from colonnade.store import files
from colonnade.store.loading import loaded

RESULT = xr.Dataset(
    {
        "top": ("elapsed", np.array([0.0, np.nan, 2.0]), {"channel": "top", "quantity": "displacement"}),
        "top_quality": ("elapsed", np.array([1, 9, 1])),
        "nrmse": ("model", np.array([0.1, 0.2])),
        "restitution": ((), 0.97),
    },
    coords={
        "elapsed": np.arange(3) * 0.005,
        "model": np.array(["linear", "nonlinear"], dtype=object),
        "test_id": ("test", np.array([], dtype=object)),
    },
    attrs={"outcome": "rocking", "notes": ["a", "b"]},
)


@pytest.fixture
def path(tmp_path):
    files.write(RESULT, tmp_path / "a.nc", attributes={"stage": "compare"})
    return tmp_path / "a.nc"


def read(path):
    with netCDF4.Dataset(path) as opened:
        return loaded(opened)


def test_values_attributes_and_coordinates_are_those_that_xarray_finds(path):
    with xr.open_dataset(path, decode_times=False, mask_and_scale=False) as opened:
        expected = opened.load()
    labels = expected["model_name"].variable
    expected = expected.drop_vars("model_name").assign_coords(model=("model", labels.values, labels.attrs))
    xr.testing.assert_identical(read(path), expected)
    assert {name: read(path)[name].dtype.kind for name in expected.variables} == {
        name: expected[name].dtype.kind for name in expected.variables
    }


def test_the_order_of_the_variables_is_that_of_the_file(path):
    with netCDF4.Dataset(path) as opened:
        stored = [name for name in opened.variables if name in RESULT.data_vars]
    assert [str(name) for name in read(path).data_vars] == stored
