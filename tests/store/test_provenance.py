"""Attributes of provenance, and the hash of what a result says."""

from datetime import UTC, datetime

import numpy as np
import xarray as xr
from hypothesis import given
from hypothesis import strategies as st

from colonnade.store.provenance import Origin, content_hash, coverage, global_attributes, hash_of
from colonnade.store.results import ResultId


def test_what_is_not_known_is_left_out():
    attributes = global_attributes(
        Origin("c", "C", None), ResultId("t", "rocking"), now=datetime(2024, 5, 1, 12, tzinfo=UTC)
    )
    assert "institution" not in attributes
    assert "specimen" not in attributes
    assert attributes["date_created"] == "2024-05-01T12:00:00Z"
    assert attributes["id"] == "c/t/rocking"


def test_a_triggered_record_tells_when_it_was():
    dataset = xr.Dataset(coords={"elapsed": np.arange(0, 3, 0.5), "time": 1_700_000_000.25})
    assert coverage(dataset) == {
        "time_coverage_duration": "PT2.5S",
        "time_coverage_resolution": "PT0.5S",
        "time_coverage_start": "2023-11-14T22:13:20.250Z",
        "time_coverage_end": "2023-11-14T22:13:22.750Z",
    }


def test_a_result_without_a_clock_has_no_coverage():
    assert coverage(xr.Dataset({"restitution": 0.9})) == {}


@given(st.dictionaries(st.text(max_size=4), st.integers(), max_size=5))
def test_the_hash_of_settings_does_not_know_their_order(settings):
    assert hash_of(settings) == hash_of(dict(reversed(settings.items())))


def test_the_content_knows_values_names_units_and_outcome():
    base = xr.Dataset({"slide": ("elapsed", [1.0, 2.0], {"units": "m"})}, attrs={"outcome": "rocking"})
    others = [
        base.assign(slide=("elapsed", [1.0, 3.0], {"units": "m"})),
        base.assign(slide=("elapsed", [1.0, 2.0], {"units": "mm"})),
        base.rename(slide="rocking_angle"),
        base.assign_attrs(outcome="overturned"),
    ]
    assert len({content_hash(dataset) for dataset in (base, *others)}) == 5


def test_the_content_knows_nothing_of_dates_and_versions():
    base = xr.Dataset({"slide": ("elapsed", [1.0])})
    assert content_hash(base) == content_hash(base.assign_attrs(date_created="now", colonnade_version="9"))
    assert content_hash(base) != content_hash(base.assign_attrs(warnings="[]"))
