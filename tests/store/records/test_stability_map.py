"""A map that is stored and read back is the map that was made."""

import json

import numpy as np
import pytest

from colonnade.dynamics.maps import StabilityMap
from colonnade.store import files
from colonnade.store.records.stored import as_dataset, as_map

OPTIONS = {"model": "linear", "cycles": 5, "width": 0.01}
CHART = StabilityMap(
    frequency_ratio=np.array([2.0, 3.0]),
    amplitude_ratio=np.array([1.0, 2.0, 4.0]),
    outcome=np.array([[0, 1, 2], [0, 2, 2]], dtype=np.int8),
    overturning_fraction=np.array([[0.0, 0.25, 1.0], [0.0, 0.5, 1.0]]),
    no_rocking=np.array([1.01, 1.02]),
    lower=np.array([2.5, np.nan]),
    upper=np.array([np.nan, 3.5]),
    interval_frequency_ratio=np.array([2.0, 3.0, 3.0]),
    interval_start=np.array([2.5, 1.8, 3.6]),
    interval_end=np.array([4.0, 1.805, 4.0]),
    options=OPTIONS,
)
ARRAYS = [name for name, value in vars(CHART).items() if isinstance(value, np.ndarray)]


def test_options_are_attributes_and_every_cell_has_its_place():
    stored = as_dataset(CHART)
    assert stored.attrs == OPTIONS
    assert int(stored["outcome"].sel(frequency_ratio=3.0, amplitude_ratio=2.0)) == 2
    assert float(stored["overturning_fraction"].sel(frequency_ratio=2.0, amplitude_ratio=2.0)) == 0.25


@pytest.mark.parametrize("name", ARRAYS)
def test_each_array_comes_back_from_a_file_as_it_was(tmp_path, name):
    path = tmp_path / "map.nc"
    files.write(as_dataset(CHART).assign_attrs(settings=json.dumps(OPTIONS)), path, attributes={})
    read = as_map(files.read(path))
    np.testing.assert_array_equal(getattr(read, name), getattr(CHART, name))
    assert read.options == OPTIONS
    np.testing.assert_array_equal(read.islands, [[3.0, 1.8, 1.805]])
