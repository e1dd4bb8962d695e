"""What is stored of a test, read once and given by name; what is not there is empty, never an error."""

from math import isnan

import numpy as np
import pytest
import xarray as xr

from colonnade.findings import Severity, warning
from colonnade.store import files
from colonnade.store.layout import Layout
from colonnade.store.records.stored import Stored, read_test
from colonnade.store.results import ResultId


def dataset():
    return xr.Dataset(
        {"peak_ratio": 0.4, "rocking_angle": ("elapsed", [0.0, np.nan, 0.2]), "nrmse": ("model", [0.1, 0.3])},
        coords={"elapsed": [0.0, 0.1, 0.2], "model": np.array(["linear", "nonlinear"], dtype=object)},
        attrs={"outcome": "rocking", "notes": ["one", "two"]},
    )


def test_what_is_not_there_is_empty():
    stored = Stored({("rocking", None): dataset(), ("compare", None): dataset()})
    assert isnan(stored.value("rocking", "slide"))
    assert isnan(stored.value("rocking", "rocking_angle"))  # no scalar
    assert isnan(stored.compared("nrmse", "contact"))
    assert stored.array("ingest", "top").size == 0
    assert stored.by("estimator", "rocking", "nrmse") == {}
    assert (stored.text("ingest", "outcome"), stored.texts("rocking", "missing")) == ("", [])


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
