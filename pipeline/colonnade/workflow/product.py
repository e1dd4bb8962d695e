"""
A product: something that a run makes and keeps, with all that it is made from.

Results, records of tests and specimens, advice, drawings, photos, pages and the PDF are products. The key of each has
one place: an attribute of a result, the stamp of a page, picture or PDF, an entry of the catalogue for kept text. The
catalogue also knows what raw files, results and pages held when they were last opened: losing it costs time only.
"""

from __future__ import annotations

import json
import os
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

from colonnade.dynamics.models import MODELS
from colonnade.errors import ReadError, StoreError
from colonnade.findings import from_text, to_text
from colonnade.interruption import expect_none
from colonnade.sources import code_hash, package_hash
from colonnade.store import files
from colonnade.store.layout import Layout
from colonnade.store.provenance import hash_of, key_of, stamped
from colonnade.store.results import ResultId
from colonnade.workflow.executors import Where, spread

if TYPE_CHECKING:
    import xarray as xr

KEPT = ("key", "status", "reason", "content", "ingredients")
"""Attributes of a result that decide whether it, and what follows from it, is up to date."""

OWN_CODE_ONLY = ("colonnade.campaign", "colonnade.store", "colonnade.workflow")
"""Rooms whose own code counts for a result, but not what they import: that reaches a stage as settings and results."""

Mark = tuple[int, int, int]
"""Size (bytes), time (ns) and inode of a file. A file that replaces another by a rename has another inode."""


def mark_of(path: Path) -> Mark:
    """Return the present mark of a file; raises OSError if there is no such file."""
    status = os.stat(path)  # noqa: PTH116 — ten thousand times a run
    return status.st_size, status.st_mtime_ns, status.st_ino


def marks_of(paths: Iterable[Path]) -> dict[Path, Mark]:
    """Return the present mark of each file that is there."""
    marks = {}
    for path in paths:
        with suppress(OSError):
            marks[path] = mark_of(path)
    return marks


class Made(NamedTuple):
    """An up-to-date product: its key and its stored text, or why no text is stored."""

    key: str
    text: str
    reason: str


class Catalogue:
    """
    What the files of a campaign held when they were last opened, kept from run to run.

    A file of the same size, time and inode holds the same. The catalogue only saves time: if it is missing or was
    altered, the files are opened; to `verify`, all of them are, and read to their end.
    """

    def __init__(self, layout: Layout, *, verify: bool = False) -> None:
        self._layout, self._verify = layout, verify
        self._home = os.path.join(layout.home, "")  # noqa: PTH118 — a text, with the separator at its end
        self._known, self._seen = dict[str, Any](), dict[str, Any]()
        try:
            known = json.loads(layout.catalogue.read_text(encoding="utf-8"))
            if known.pop("sha256") == hash_of(known):
                self._known = known
        except (OSError, ValueError, KeyError, TypeError, AttributeError, RecursionError):
            pass

    def entry(self, kind: str, path: Path, ask: Callable[[Path], Any], *more: Any) -> list[Any] | None:
        """
        Return what a file holds; it is opened only if it changed.

        Parameters
        ----------
        kind : str
            "raw", "results" or "pages".
        path : Path
        ask : callable
            Opens the file and returns what it holds, as JSON can hold it.
        *more
            What else the answer depends on.

        Returns
        -------
        entry : list or None
            Mark and answer; None if there is no such file.
        """
        place = os.fspath(path).removeprefix(self._home)
        name = " ".join([kind, place.replace(os.sep, "/"), *map(hash_of, more)])
        try:
            mark = mark_of(path)
        except OSError:
            return None
        known: list[Any] | None = self._seen.get(name) or (None if self._verify else self._known.get(name))
        if known is None or known[0] != list(mark):
            known = [list(mark), ask(path)]
        self._seen[name] = known
        return known

    def _result(self, path: Path) -> dict[str, str]:
        entry = self.entry("results", path, lambda path: _kept(stored_attributes(path)))
        return entry[1] if entry else {}

    def attributes(self, path: Path) -> Mapping[str, Any]:
        """Attributes `KEPT` of a result and its findings; empty if it is missing or damaged."""
        kept = self._result(path)
        return kept and {**kept, "warnings": from_text(kept["warnings"])}

    def content(self, path: Path) -> str | None:
        """What a result says and was made from, as hashes; None if it is missing or damaged."""
        kept = self._result(path)
        return f"{kept['key']} {kept['content']}" if kept else None

    def stamp(self, page: Path) -> str:
        """Key of what a page shows; empty if it is missing or was altered."""
        entry = self.entry("pages", page, key_of)
        return str(entry[1]) if entry else ""

    def code(self, made_by: Sequence[str], model: str | None = None) -> str:
        """
        Hash the code that makes a result, by names of modules; of a model's result without the code of other models.

        The sources are parsed only if one of them changed.
        """
        name = " ".join(["code", package_hash(), *made_by, *([model] if model else [])])
        if name not in self._seen:
            others = {each.engine for each in MODELS.values()} - {MODELS[model].engine} if model else ()
            self._seen[name] = self._known.get(name) or code_hash(made_by, alone=OWN_CODE_ONLY, without=others)
        return str(self._seen[name])

    def remove_altered(self) -> Iterator[str]:
        """
        Remove results that were altered since they were written; give a sentence on each.

        What has not changed since the last run is not read, unless everything is verified.
        """
        for path in self._layout.results_there():
            expect_none()
            entry = self.entry("results", path, lambda path: _kept(stored_attributes(path, whole=True)))
            if entry is not None and not entry[1]:
                files.remove(path)
                name = path.relative_to(self._layout.home).as_posix()
                yield f"{name}: it was altered or damaged, so it is recomputed."

    def kept(self, product: str, key: str) -> Made | None:
        """Return what is kept of a product, if that is of this key."""
        name = f"kept {product}"
        known = self._seen.get(name) or self._known.get(name)
        if known is None or known[0] != key:
            return None
        self._seen[name] = known
        return Made(*known)

    def keep(self, product: str, made: Made) -> None:
        """Keep what was made of a product for the next run."""
        self._seen[f"kept {product}"] = made

    def save(self) -> None:
        """Write what was looked at, and what is known from earlier runs."""
        known = self._known | self._seen
        text = json.dumps(known | {"sha256": hash_of(known)}, separators=(",", ":"), sort_keys=True)
        files.write_text(self._layout.catalogue, f"{text}\n")


def stored_attributes(path: Path, *, whole: bool = False) -> dict[str, Any]:
    """Attributes of a result, read to its end if `whole`; empty if it is missing or damaged, and has to be made."""
    try:
        return files.read(path).attrs if whole else files.read_attributes(path)
    except StoreError:
        return {}


def read_done(path: Path) -> xr.Dataset | None:
    """Read a result; None if it is missing or damaged, or there is none as it failed."""
    try:
        result = files.read(path)
    except StoreError:
        return None
    return result if result.attrs["status"] == "done" else None


def _kept(stored: Mapping[str, Any]) -> dict[str, str]:
    kept = {part: str(stored.get(part, "")) for part in KEPT}
    return kept | {"warnings": to_text(stored.get("warnings", []))} if stored else {}


NEVER_RUN = "never run"

_CONTENT = 2
"""Counts up when `content_hash` takes in something else: all results are then recomputed."""

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
    where : Where or None
        Who works on its blocks: it is asked for in the process of the run, and `make` takes `run`, too.
    is_asked : bool
        Whether it is made whatever its state.
    """

    id: ResultId | str
    inputs: str
    upstream: Mapping[str, Path | str | None]
    code: str
    make: Callable[..., Any]
    paths: tuple[Path, ...] = ()
    where: Where | None = None
    is_asked: bool = False

    @property
    def result(self) -> ResultId:
        """Which result it is."""
        assert isinstance(self.id, ResultId)
        return self.id

    def _ingredients(self, look: Look) -> dict[str, Any]:
        """Give all that it is made from, results by the content in their attributes."""
        upstream = {
            name: look(each).get("content") if isinstance(each, Path) else each for name, each in self.upstream.items()
        }
        return {"upstream": upstream, "settings": hash_of(self.inputs), "code": self.code}

    def key(self, look: Look = lambda path: {}) -> str:
        """Hash of all that it is made from, which is kept with it; if it differs, that is out of date."""
        kind = self.id.stage if isinstance(self.id, ResultId) else self.id.partition(" ")[0]
        return hash_of({"stage": kind, "content": _CONTENT, **self._ingredients(look)})

    def attributes(self, look: Look) -> dict[str, str]:
        """What is stored with a result: its key, and its ingredients, so that `why` can say what changed since."""
        told = json.dumps(self._ingredients(look), sort_keys=True)
        return {"key": self.key(look), "ingredients": told, "settings": self.inputs}

    def why(self, look: Look) -> str:
        """
        Say why a result has to be made.

        Parameters
        ----------
        look : Look
            Gives its stored attributes, and those of results that it reads; empty ones if they are missing or damaged.

        Returns
        -------
        because : str
            "never run", "raw file changed", "upstream changed", "settings changed" or "code changed"; empty if it is
            up to date. "asked for", whatever its state, if it `is_asked`.
        """
        if self.is_asked:
            return "asked for"
        stored, now = look(self.paths[0]), self._ingredients(look)
        if stored.get("key") == self.key(look):
            return ""
        try:
            before = json.loads(stored.get("ingredients", ""))
        except ValueError:
            return NEVER_RUN
        changed = next((part for part in now if before.get(part) != now[part]), "code")
        return f"{'raw file' if changed == 'upstream' and self.result.stage == 'ingest' else changed} changed"


def known(product: Product, catalogue: Catalogue) -> Made | None:
    """Return a product if it is up to date."""
    key = product.key()
    made = catalogue.kept(str(product.id), key)
    if made is None or not (made.reason or all(catalogue.stamp(path) == key for path in product.paths)):
        return None
    return made


def brought_up_to_date(
    products: Iterable[Product], catalogue: Catalogue, *, workers: int | None = 1, in_order: bool = False
) -> dict[str, Made]:
    """
    Make those of some products that are out of date, and write each as it ends; none is a result.

    Parameters
    ----------
    products : iterable of Product
        They do not depend on each other.
    catalogue : Catalogue
    workers : int or None, optional
        Processes; None for one a core.
    in_order : bool, optional
        Whether they are written in their order, once all are made.

    Returns
    -------
    made : dict of str to Made
        By id. Data that cannot be read are a reason, which is kept as what is made is.

    Raises
    ------
    StoreError
        If a file cannot be written.
    """
    found, waiting = dict[str, Made](), []
    for product in products:
        expect_none()
        if (there := known(product, catalogue)) is not None:
            found[str(product.id)] = there
        else:
            waiting.append(product)
    ended = spread(_make, waiting, Where(workers if len(waiting) >= WORTH_A_PROCESS else 1))
    for number, ((contents, text), reason, is_lasting) in sorted(ended) if in_order else ended:
        product, key = waiting[number], waiting[number].key()
        for path, data in zip(product.paths, contents, strict=False):
            files.write_changed(path, stamped(data.encode() if isinstance(data, str) else data, key, path.suffix))
            catalogue.stamp(path)
        made = found[str(product.id)] = Made(key, text, reason)
        if is_lasting:
            catalogue.keep(str(product.id), made)
    return found


def _make(product: Product) -> tuple[Contents, str, bool]:
    """Make a product; a failure lasts unless the machine is at fault."""
    try:
        return product.make(), "", True
    except ReadError as error:
        return ([], ""), str(error), not isinstance(error.__cause__, OSError)
