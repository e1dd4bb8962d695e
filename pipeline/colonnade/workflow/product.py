"""
A product: something that a run makes and keeps, with all that it is made from.

Results, records of tests and specimens, advice, drawings, photos, pages and the PDF are products. The key of each has
one place: an attribute of a result, the stamp of a page, picture or PDF, an entry of the catalogue for kept text. So a
catalogue that is lost costs time only.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any, NamedTuple

from colonnade.errors import ReadError
from colonnade.interruption import expect_none
from colonnade.store import files
from colonnade.store.provenance import Recipe, stamped
from colonnade.store.results import ResultId
from colonnade.workflow.catalogue import Catalogue
from colonnade.workflow.executors import spread

Look = Callable[[Path], Mapping[str, Any]]
"""Returns the stored attributes of a result, given its path."""

WORTH_A_PROCESS = 4
"""Products from which on other processes are used: one takes as long to start as two pages to draw."""

Contents = tuple[Sequence[str | bytes], str]
"""What the files of a product hold, in their order, and the text that is kept of it."""


@dataclass(frozen=True)
class Product:
    """
    What is needed to make one product.

    Attributes
    ----------
    id : ResultId or str
        Its kind and what it is of, as "page free-01".
    inputs : str
        All that it reads of the campaign.
    upstream : mapping of str to Path, str or None
        Results that it reads, by name; or the hash of what else it is made from.
    code : str
        Hash of the code that makes it.
    make : callable
        Of a result: takes the results of `upstream` by name, and returns an xr.Dataset. Of all else: gives `Contents`.
    paths : tuple of Path
        Its files: of a result one.
    keeps : bool
        Whether the catalogue keeps a text of it.
    """

    id: ResultId | str
    inputs: str
    upstream: Mapping[str, Path | str | None]
    code: str
    make: Callable[..., Any]
    paths: tuple[Path, ...] = ()
    keeps: bool = False

    @property
    def result(self) -> ResultId:
        """Which result it is."""
        assert isinstance(self.id, ResultId)
        return self.id

    def recipe(self, look: Look = lambda path: {}) -> Recipe:
        """Give all that it is made from, results by the content in their attributes."""
        kind = self.id.stage if isinstance(self.id, ResultId) else self.id.partition(" ")[0]
        upstream = {
            name: look(each).get("content") if isinstance(each, Path) else each for name, each in self.upstream.items()
        }
        return Recipe(kind, self.code, self.inputs, upstream)


class Made(NamedTuple):
    """A product that is up to date: its key, the text that is kept of it, and why there is none of it."""

    product: Product
    key: str
    text: str
    reason: str


def known(product: Product, catalogue: Catalogue) -> Made | None:
    """Return a product if it is up to date."""
    key = product.recipe().key
    entry = catalogue.kept(str(product.id), key)
    text, reason = entry or ("", "")
    is_there = (entry is not None or not product.keeps) and all(catalogue.stamp(path) == key for path in product.paths)
    return Made(product, key, text, reason) if reason or is_there else None


def brought_up_to_date(products: Iterable[Product], catalogue: Catalogue, *, workers: int | None = 1) -> Iterator[Made]:
    """
    Make those of some products that are out of date, in any order; none is a result.

    Parameters
    ----------
    products : iterable of Product
        They do not depend on each other.
    catalogue : Catalogue
    workers : int or None, optional
        Processes; None for one a core.

    Yields
    ------
    made : Made
        First those that were up to date. Data that cannot be read are a reason, which is kept as what is made is.

    Raises
    ------
    StoreError
        If a file cannot be written.
    """
    waiting = []
    for product in products:
        expect_none()
        if (there := known(product, catalogue)) is not None:
            yield there
        else:
            waiting.append(product)
    processes = workers if len(waiting) >= WORTH_A_PROCESS else 1
    for number, (contents, text), reason, is_lasting in spread(_make, list(enumerate(waiting)), workers=processes):
        product, key = waiting[number], waiting[number].recipe().key
        for path, data in zip(product.paths, contents, strict=False):
            files.write_changed(path, stamped(data.encode() if isinstance(data, str) else data, key, path.suffix))
            catalogue.stamp(path)
        if is_lasting:
            catalogue.keep(str(product.id), key, text, reason)
        yield Made(product, key, text, reason)


def _make(numbered: tuple[int, Product]) -> tuple[int, Contents, str, bool]:
    """Make a product; a failure lasts unless the machine is at fault."""
    number, product = numbered
    try:
        return number, product.make(), "", product.keeps
    except ReadError as error:
        return number, ([], ""), str(error), not isinstance(error.__cause__, OSError)
