"""The document that is typeset: which sections of which pages it shows; as PDF, or a page of it as PNG, by Typst."""

from __future__ import annotations

import json
import posixpath
import re
from collections.abc import Collection, Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass, field
from importlib.resources import files as resources
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import TYPE_CHECKING, Any, Literal

from colonnade import __version__
from colonnade.campaign import Campaign
from colonnade.errors import StoreError
from colonnade.report import addresses
from colonnade.report.paper.content import Block, Page
from colonnade.report.test_page import facts

if TYPE_CHECKING:
    import typst

SPANS = "spans"
"""Section of the overview that is a chapter of its own. A section that is not printed says so: `data-paper="no"`."""

PHOTO, DRAWING = ".jpg", ".svg"
"""Endings of the files that pages show as pictures."""


@dataclass
class Document:
    """
    A document.

    Attributes
    ----------
    data : dict
        All that the template shows, as JSON can hold it.
    pictures : dict of str to str
        SVG by the name of its file.
    files : dict of str to Path
        Photos and drawings that are files of the report, by the name of their file here.
    """

    data: dict[str, Any]
    pictures: dict[str, str] = field(default_factory=dict)
    files: dict[str, Path] = field(default_factory=dict)


def document_of(campaign: Campaign, folder: Path, *, appendix: bool = True) -> Document:
    """
    Gather the document of a campaign.

    Parameters
    ----------
    campaign : Campaign
    folder : Path
        Its report, whose pages are up to date.
    appendix : bool, optional
        Whether each test has its pages, too.
    """
    tests = list(map(addresses.of_test, campaign.tests)) if appendix else []
    specimens = list(map(addresses.of_specimen, campaign.of_interest))
    overview, methods = addresses.WHOLE["overview"], addresses.WHOLE["methods"]
    document = Document({})
    optional = {page: title for page, title in addresses.OPTIONAL.items() if (folder / page).is_file()}
    gather = _Gatherer(folder, document, {*tests, *specimens, *optional, overview, methods})
    summary = gather.page(overview)
    chapters = [_chapter("Summary", overview, summary.parts(without=SPANS))]
    for name, address in zip(campaign.of_interest, specimens, strict=True):
        chapters.append(_chapter(f"Specimen {name}", address, gather.page(address).parts()))
    if spans := summary.sections.get(SPANS):
        chapters.append(_chapter(_plain(spans[0]["in"]), "", spans))
    chapters += [_chapter(title, page, gather.page(page).parts()) for page, title in optional.items()]
    chapters.append(_chapter("Methods", methods, gather.page(methods).parts()))
    chapters[-1]["equations"] = True
    of_tests = []
    for name, address in zip(campaign.tests, tests, strict=False):  # none without the appendix
        page = gather.page(address)
        of_tests.append(_chapter(name, address, [*page.below_title, *page.parts()]))
    shown = [each for part in (*chapters, *of_tests) for each in _pictures(part["in"])]
    shown = [each for each in shown if each["file"] in document.files]
    document.data |= {
        "title": campaign.title,
        "campaign": campaign.campaign,
        "facts": facts.on_cover(campaign),
        "cover": next((each for each in shown if each["photo"]), next(iter(shown), None)),
        "chapters": chapters,
        "appendix": of_tests,
        "version": __version__,
    }
    return document


def _chapter(title: str, address: str, inside: list[Block]) -> dict[str, Any]:
    said = [block for block in inside if block["is"] != "heading" or _plain(block["in"]) != title]
    return {"title": title, "label": address, "in": said, "equations": False}


def _pictures(blocks: list[Block]) -> Iterator[Block]:
    for block in blocks:
        yield from block.get("pictures", ())


def _plain(said: list[Any]) -> str:
    return "".join(part if isinstance(part, str) else _plain(part.get("in", [])) for part in said)


@dataclass(frozen=True)
class _Gathered:
    """What is taken from one page."""

    below_title: list[Block]
    sections: Mapping[str, list[Block]]

    def parts(self, without: str | None = None) -> list[Block]:
        return [block for name, blocks in self.sections.items() if name != without for block in blocks]


class _Gatherer:
    """Takes pages apart; numbers pictures through the whole document and leads links to its own places."""

    def __init__(self, folder: Path, document: Document, labels: Collection[str]) -> None:
        self._folder, self._document, self._labels = folder, document, labels

    def page(self, address: str) -> _Gathered:
        page = Page((self._folder / address).read_text(encoding="utf-8"))
        sections = page.sections()
        for blocks in (page_head := page.below_title(), *sections.values()):
            self._settle(blocks, page, address)
        return _Gathered(page_head, sections)

    def _settle(self, node: Any, page: Page, address: str) -> None:
        """Give pictures the names of their files, and links the places that they lead to."""
        if isinstance(node, list):
            for each in node:
                self._settle(each, page, address)
        if not isinstance(node, dict):
            return
        if node["is"] == "figure":
            node["pictures"] = [found for each in node["pictures"] if (found := self._file(each, page, address))]
        if node["is"] == "link":
            place = _within(address, node["to"].partition("#")[0])
            node["to"] = place if place in self._labels else ""
        for each in node.values():
            self._settle(each, page, address)

    def _file(self, picture: Block, page: Page, address: str) -> Block | None:
        if "number" in picture:
            name = f"figure-{len(self._document.pictures) + 1}{DRAWING}"
            self._document.pictures[name] = page.pictures[picture["number"]]
            return {"is": "picture", "file": name, "alt": picture["alt"], "photo": False}
        place = _within(address, picture["file"])
        path = self._folder / place
        is_outside = place.startswith(("/", "..")) or path.is_symlink()
        if is_outside or not place.endswith((PHOTO, DRAWING)) or not path.is_file():
            return None
        name = place.replace("/", "-")
        self._document.files[name] = path
        return {"is": "picture", "file": name, "alt": picture["alt"], "photo": place.endswith(PHOTO)}


def _within(address: str, link: str) -> str:
    """Where a page's link leads, as an address within the report."""
    return posixpath.normpath(posixpath.join(posixpath.dirname(address), link)) if link else address


TEMPLATE = "report.typ"

NO_XML = re.compile("[\x00-\x08\x0b\x0c\x0e-\x1f\ufffe\uffff]")
"""Characters that a page of HTML may have and an SVG file may not."""

PIXELS_PER_INCH = 80
"""Of a page as PNG."""


def pdf_of(campaign: Campaign, folder: Path, *, appendix: bool = True) -> bytes:
    """Return the PDF of a campaign's report, whose pages are in `folder` and up to date."""
    return typeset(document_of(campaign, folder, appendix=appendix))[0]


def typeset(document: Document, format: Literal["pdf", "png"] = "pdf") -> list[bytes]:
    """
    Typeset a document.

    Parameters
    ----------
    document : Document
    format : {"pdf", "png"}
        One file, or one for each page.

    Returns
    -------
    files : list of bytes
        The same document gives the same bytes: no date, and only the fonts of Typst and matplotlib.

    Raises
    ------
    StoreError
        If Typst refuses it, or there is no room for its files.
    """
    import typst

    try:
        with prepared(document) as compiler:
            made = compiler.compile(format=format, timestamp=0, ppi=PIXELS_PER_INCH if format == "png" else None)
    except typst.TypstError as error:
        raise StoreError(
            f"report.pdf: the pages cannot be typeset ({error.message}). The pages themselves are whole; please report "
            "this, with the campaign file."
        ) from error
    except OSError as error:
        raise StoreError(
            f"{error.filename}: the report cannot be typeset ({error.strerror}). A folder for temporary files with "
            "room for the report was expected; free some space and run again."
        ) from error
    return made if isinstance(made, list) else [made or b""]


@contextmanager
def prepared(document: Document) -> Iterator[typst.Compiler]:
    """Put a document's files, and nothing else, into a folder of their own; the compiler sees no other."""
    import matplotlib
    import typst

    fonts = typst.Fonts(
        include_system_fonts=False, font_paths=[str(Path(matplotlib.get_data_path()) / "fonts" / "ttf")]
    )
    with TemporaryDirectory(prefix="colonnade-report-") as made:
        root = Path(made).resolve()
        (root / TEMPLATE).write_bytes((resources("colonnade.report") / "templates" / TEMPLATE).read_bytes())
        (root / "report.json").write_text(json.dumps(document.data, ensure_ascii=False), encoding="utf-8")
        for name, picture in document.pictures.items():
            (root / name).write_text(NO_XML.sub("", picture), encoding="utf-8")
        for name, path in document.files.items():
            (root / name).write_bytes(path.read_bytes())
        yield typst.Compiler(root / TEMPLATE, root=root, font_paths=fonts, ignore_system_fonts=True)
