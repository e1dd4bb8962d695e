"""Products that are no results, on toys: pages with a stamp and kept text are made once, and come back if they go."""

import pytest

from colonnade.errors import ReadError
from colonnade.store.layout import Layout
from colonnade.workflow.catalogue import Catalogue
from colonnade.workflow.product import Product, brought_up_to_date, known


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
        product = Product("toy 1", inputs, {"up": upstream}, code, self.make, (self.page, self.script), keeps=True)
        (made,) = brought_up_to_date([product], catalogue)
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
