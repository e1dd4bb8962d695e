"""Attributes of provenance, and the hash of what a result says."""

from datetime import UTC, datetime

import numpy as np
import pytest
import xarray as xr
from hypothesis import given
from hypothesis import strategies as st

from colonnade.store.provenance import (
    Origin,
    content_hash,
    coverage,
    global_attributes,
    hash_of,
    key_of,
    stamped,
)
from colonnade.store.results import ResultId


def test_what_is_not_known_is_left_out():
    attributes = global_attributes(
        Origin("c", "C", None), ResultId("t", "rocking"), now=datetime(2024, 5, 1, 12, tzinfo=UTC)
    )
    assert "institution" not in attributes
    assert "specimen" not in attributes
    assert attributes["date_created"] == "2024-05-01T12:00:00Z"
    assert attributes["id"] == "c/t/rocking"


def test_a_record_tells_how_long_it_is_and_how_fine():
    found = coverage(xr.Dataset(coords={"elapsed": np.arange(0, 3, 0.5)}))
    assert found == {"time_coverage_duration": "PT2.5S", "time_coverage_resolution": "PT0.5S"}
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


@pytest.mark.parametrize("suffix", [".html", ".svg", ".js", ".jpg", ".pdf"])
def test_a_stamped_file_says_what_it_was_made_from_unless_it_was_altered(tmp_path, suffix):
    path = tmp_path / f"page{suffix}"
    path.write_bytes(stamped(b"first\nlast\n", "ab12", suffix))
    assert key_of(path) == "ab12"
    path.write_bytes(stamped(path.read_bytes(), "cd34", suffix))
    assert key_of(path) == "cd34"
    path.write_bytes(path.read_bytes().replace(b"first", b"worst"))
    assert key_of(path) == ""
    path.write_bytes(b"first\n")
    assert key_of(path) == key_of(tmp_path / "none") == ""
