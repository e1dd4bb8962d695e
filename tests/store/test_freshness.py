"""What something is made from is known by one hash, and the part that changed is named."""

from dataclasses import replace

import pytest

from colonnade.store.provenance import Recipe, key_of, stamped

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
