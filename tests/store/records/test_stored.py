"""What is stored of a test, read once and given by name; what is not there is empty, never an error."""

import json
from math import isnan

import numpy as np
import pytest
import xarray as xr

from colonnade.dynamics.maps import StabilityMap
from colonnade.findings import Severity, warning
from colonnade.store import files
from colonnade.store.layout import Layout
from colonnade.store.records.stored import Failure, Stored, as_dataset, as_map, read_test
from colonnade.store.results import ResultId


def dataset():
    return xr.Dataset(
        {"peak_ratio": 0.4, "rocking_angle": ("elapsed", [0.0, np.nan, 0.2]), "nrmse": ("model", [0.1, 0.3])},
        coords={"elapsed": [0.0, 0.1, 0.2], "model": np.array(["linear", "nonlinear"], dtype=object)},
        attrs={"outcome": "rocking", "notes": ["one", "two"]},
    )


@pytest.fixture
def stored():
    return Stored({("rocking", None): dataset(), ("compare", None): dataset(), ("predict", "linear"): dataset()})


def test_what_is_there_is_given_by_name(stored):
    assert stored.value("rocking", "peak_ratio") == 0.4
    assert stored.median("rocking", "rocking_angle") == pytest.approx(0.1)
    assert stored.compared("nrmse", "nonlinear") == 0.3
    assert stored.by("model", "rocking", "nrmse") == {"linear": 0.1, "nonlinear": 0.3}
    assert (stored.text("rocking", "outcome"), stored.texts("rocking", "notes")) == ("rocking", ["one", "two"])
    assert stored.models("predict") == ["linear"]
    assert stored.has("rocking", "nrmse")
    assert not stored.has("rocking", "slide")


def test_what_is_not_there_is_empty(stored):
    assert isnan(stored.value("rocking", "slide"))
    assert isnan(stored.value("rocking", "rocking_angle"))  # no scalar
    assert isnan(stored.compared("nrmse", "contact"))
    assert stored.array("ingest", "top").size == 0
    assert stored.by("estimator", "rocking", "nrmse") == {}
    assert (stored.text("ingest", "outcome"), stored.texts("rocking", "missing")) == ("", [])


def test_a_test_is_done_with_its_comparison_unless_something_failed(stored):
    assert stored.status == "done"
    assert Stored({("rocking", None): dataset()}).status == "pending"
    stored.failures.append(Failure("rocking", "because"))
    assert stored.status == "failed"


@pytest.fixture
def written_results(written, tmp_path):
    """Store a result of each of these stages of the pulse."""
    campaign, layout = written(), Layout(tmp_path)

    def write(*stages, **attributes):
        for stage in stages:
            given = {"key": f"key of {stage}", "warnings": [], "settings": '{"a": 1}'} | attributes
            files.write(dataset(), layout.path(ResultId("pulse-01", stage)), attributes=given)
        return lambda **options: read_test(campaign, layout, campaign.tests["pulse-01"], **options)

    return write


def test_results_are_read_with_their_settings_and_findings(written_results):
    found = written_results("rocking", "compare", warnings=[warning("gap", "a gap.")])()
    assert set(found.datasets) == {("rocking", None), ("compare", None)}
    assert found.settings["rocking", None] == {"a": 1}
    assert [(each.text, each.severity) for each in found.findings] == [("a gap.", Severity.WARNING)] * 2


def test_a_damaged_result_is_a_failure_of_its_stage(written_results, tmp_path):
    read = written_results("rocking", "compare")
    Layout(tmp_path).path(ResultId("pulse-01", "rocking")).write_bytes(b"damaged")
    found = read()
    assert [failure.stage for failure in found.failures] == ["rocking"]
    assert found.has("compare")


def test_results_of_another_campaign_are_not_read(written_results):
    read = written_results("rocking")
    assert read(is_outdated=True).datasets == {}
    assert "out of date" in read(is_outdated=True).outdated
    assert not read().outdated


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


def test_a_map_comes_back_from_a_file_as_it_was(tmp_path):
    path = tmp_path / "map.nc"
    files.write(as_dataset(CHART).assign_attrs(settings=json.dumps(OPTIONS)), path, attributes={})
    read = as_map(files.read(path))
    for name, value in vars(CHART).items():
        np.testing.assert_array_equal(getattr(read, name), value, err_msg=name)
    np.testing.assert_array_equal(read.islands, [[3.0, 1.8, 1.805]])
