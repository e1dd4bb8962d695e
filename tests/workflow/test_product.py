"""Products that are no results, on toys: pages with a stamp and kept text are made once, and come back if they go."""

import json
from dataclasses import replace
from pathlib import Path

import pytest

from colonnade.errors import ReadError
from colonnade.store import files
from colonnade.store.layout import Layout
from colonnade.store.results import ResultId
from colonnade.workflow.product import Catalogue, Product, brought_up_to_date, known

ROCKING = Product(ResultId("a", "rocking"), '{"peak": 1}', {"up": "aa", "gone": None}, "c0de", None, (Path("a.nc"),))
OTHERS = {
    "code changed": [replace(ROCKING, code="c1de")],
    "settings changed": [replace(ROCKING, inputs="{}"), replace(ROCKING, inputs="{}", code="c1de")],
    "upstream changed": [
        replace(ROCKING, inputs=inputs, upstream=upstream)
        for inputs in (ROCKING.inputs, "{}")
        for upstream in ({"up": "bb", "gone": None}, {"up": "aa", "gone": "bb"}, {"other": "aa", "gone": None}, {})
    ],
}


def why(product, stored):
    return product.why(lambda path: stored)


@pytest.mark.parametrize("because", OTHERS)
def test_the_first_part_that_changed_of_what_it_reads_its_settings_and_its_code_is_named(because):
    told = ROCKING.attributes(lambda path: {})
    assert why(replace(ROCKING, upstream=dict(reversed(ROCKING.upstream.items()))), told) == ""
    for other in OTHERS[because]:
        assert why(other, told) == because
        assert why(replace(other, id=ResultId("a", "ingest")), told) == because.replace("upstream", "raw file")
    assert len({ROCKING.key(), *(other.key() for other in OTHERS[because])}) == len(OTHERS[because]) + 1


@pytest.mark.parametrize("stored", [{}, {"key": "aa"}, {"key": "aa", "ingredients": "{"}])
def test_what_says_nothing_of_its_parts_was_never_run(stored):
    assert why(ROCKING, stored) == "never run"


@pytest.fixture
def layout(tmp_path):
    return Layout(tmp_path)


class Toy:
    """Makes a page and a text, and counts how often."""

    def __init__(self, layout, error=None):
        self.layout, self.error, self.made = layout, error, 0
        self.page, self.script = (layout.report.parent / f"toy.{suffix}" for suffix in ("html", "js"))

    def make(self):
        self.made += 1
        if self.error is not None:
            raise self.error
        return ["<p>toy</p>\n", "toy\n"], "kept"

    def bring(self, catalogue=None, *, inputs="a", upstream="b", code="c"):
        """Bring it up to date as a run does; give whether it was made, and what is kept."""
        catalogue, before = catalogue or Catalogue(self.layout), self.made
        product = Product("toy 1", inputs, {"up": upstream}, code, self.make, (self.page, self.script))
        made = brought_up_to_date([product], catalogue)["toy 1"]
        assert known(product, catalogue) == made or self.error is not None
        catalogue.save()
        return self.made > before, made.text or made.reason


def test_it_is_made_once_and_again_if_anything_changes_that_it_is_made_from(layout):
    toy = Toy(layout)
    assert toy.bring() == (True, "kept")
    assert toy.bring() == (False, "kept")
    for change in ({"inputs": "A"}, {"upstream": None}, {"code": "C"}):
        assert toy.bring(**change) == (True, "kept")
        assert toy.bring(**change) == (False, "kept")


def test_what_is_gone_or_altered_comes_back(layout):
    toy = Toy(layout)
    toy.bring()
    page, script = toy.page.read_bytes(), toy.script.read_bytes()
    for spoil in (toy.page.unlink, toy.script.unlink, lambda: toy.page.write_bytes(page.replace(b"toy", b"joy"))):
        spoil()
        assert toy.bring() == (True, "kept")
        assert (toy.page.read_bytes(), toy.script.read_bytes()) == (page, script)


def test_a_catalogue_that_is_lost_costs_time_only(layout):
    toy = Toy(layout)
    toy.bring()
    before = toy.page.stat()
    layout.catalogue.unlink()
    assert toy.bring() == (True, "kept")
    assert toy.page.stat() == before


def test_data_that_cannot_be_read_are_a_reason_that_lasts_but_not_those_that_the_machine_failed_at(layout):
    toy = Toy(layout, ReadError("no photo."))
    assert toy.bring() == (True, "no photo.")
    assert toy.bring() == (False, "no photo.")
    error = ReadError("stopped.")
    error.__cause__ = OSError(12, "out of memory")
    toy = Toy(layout, error)
    assert toy.bring(inputs="A") == toy.bring(inputs="A") == (True, "stopped.")


@pytest.fixture
def opened(monkeypatch):
    """Results whose files were opened, by name."""
    names = []
    for place, name in ((files, "read_attributes"), (files, "read")):
        ask = getattr(place, name)
        monkeypatch.setattr(place, name, lambda path, ask=ask: names.append(path.name) or ask(path))
    return names


def test_a_run_with_nothing_to_do_opens_no_result_of_a_test(small, opened):
    small.run()
    opened.clear()
    small.run()
    assert opened == []


NO_CATALOGUE = (
    "",
    "no JSON",
    "[" * 100_000,
    "null",
    '{"results processed/tests/pulse-01/rocking.nc": 1, "sha256": 3}',
)
ALTERED = {
    "a record that is none": ('\\"kind\\":\\"pulse\\"', '\\"kind\\":\\"pulsar\\"'),
    "another status of a file": ('"status":"done"', '"status":"failed"'),
    "another hash of a file": ('"content":"', '"content":"0'),
}


@pytest.mark.whole
def test_a_catalogue_that_is_no_good_or_was_altered_only_costs_time(small, opened):
    summary, sound = small.summary(), small.layout.catalogue.read_text(encoding="utf-8")
    (key, *_) = json.loads(sound)["kept record pulse-01"]
    assert Catalogue(small.layout).kept("record pulse-01", key)
    assert all(before in sound for before, _ in ALTERED.values())
    for text in (*NO_CATALOGUE, *(sound.replace(*change) for change in ALTERED.values())):
        small.layout.catalogue.write_text(text, encoding="utf-8")
        opened.clear()
        looked_at = Catalogue(small.layout)
        assert looked_at.attributes(small.layout.stage("pulse-01", "rocking"))["status"] == "done", text[:80]
        assert opened == ["rocking.nc"], text[:80]
        assert looked_at.kept("record pulse-01", key) is None, text[:80]
    assert small.redone() == {}
    assert small.summary() == summary
