"""Attributes of provenance, and the hash of what a result says."""

from dataclasses import replace
from datetime import UTC, datetime

import numpy as np
import pytest
import xarray as xr
from hypothesis import given
from hypothesis import strategies as st

from colonnade.store.provenance import (
    Origin,
    Recipe,
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


RECIPE = Recipe("rocking", "c0de", '{"lowest_peak": 0.01}', {"conditioned": "aa", "daq2": None})
OTHERS = {
    "stage": replace(RECIPE, stage="predict"),
    "code": replace(RECIPE, code="c1de"),
    "settings": replace(RECIPE, settings="{}"),
    "upstream": replace(RECIPE, upstream={"conditioned": "bb", "daq2": None}),
    "upstream that is not there": replace(RECIPE, upstream={"conditioned": "aa", "daq2": "bb"}),
    "name": replace(RECIPE, upstream={"recorded": "aa", "daq2": None}),
}


def test_each_part_is_part_of_the_key():
    assert len({RECIPE.key, *(other.key for other in OTHERS.values())}) == len(OTHERS) + 1


def test_the_order_of_what_is_read_is_not():
    assert replace(RECIPE, upstream=dict(reversed(RECIPE.upstream.items()))).key == RECIPE.key


def test_the_same_parts_are_up_to_date():
    assert replace(RECIPE).why(RECIPE.attributes) == ""
    assert RECIPE.why({"key": RECIPE.key}) == ""  # of a page and a record, the key is all that is kept


@pytest.mark.parametrize("stored", [{}, {"key": "aa"}, {"key": "aa", "ingredients": "{"}])
def test_what_says_nothing_of_its_parts_was_never_run(stored):
    assert RECIPE.why(stored) == "never run"


@pytest.mark.parametrize("part", ["code", "settings", "upstream", "upstream that is not there", "name"])
def test_the_part_that_changed_is_named(part):
    because = f"{part if part in ('code', 'settings') else 'upstream'} changed"
    assert RECIPE.why(OTHERS[part].attributes) == because
    assert OTHERS[part].why(RECIPE.attributes) == because


def test_what_is_read_from_raw_files_says_so():
    first = Recipe("ingest", "c0de", "{}", {"main": "aa"})
    assert replace(first, upstream={"main": "bb"}).why(first.attributes) == "raw file changed"


def test_a_changed_input_goes_before_settings_and_those_before_code():
    changed = replace(RECIPE, settings="{}", code="c1de")
    assert changed.why(RECIPE.attributes) == "settings changed"
    assert replace(changed, upstream={}).why(RECIPE.attributes) == "upstream changed"


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
