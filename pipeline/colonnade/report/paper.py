"""The report on paper: the pages as they are, taken apart into data, and typeset by Typst as one PDF."""

from __future__ import annotations

import json
import posixpath
import re
from collections.abc import Collection, Iterable, Iterator
from contextlib import contextmanager
from html import unescape
from importlib.resources import files as resources
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

import matplotlib
import typst
from lxml.html import HtmlElement, HTMLParser, document_fromstring
from lxml.html.builder import CAPTION

from colonnade import __version__
from colonnade.campaign import Campaign
from colonnade.errors import StoreError
from colonnade.report import addresses
from colonnade.report.test_page import facts

Element = dict[str, Any]
"""An element as data."""

SCREEN = ("script", "style", "nav", "form", "button", "input", "select", "label", "details", "template", "canvas")
"""Elements that only a screen can use; `data-paper="no"` marks others, and `hidden` what scripts would fill."""

_ONLY_ON_SCREEN = " | ".join(f".//{tag}" for tag in SCREEN) + " | .//*[@hidden or @data-paper='no']"
_SVG = re.compile(r"<svg\b.*?</svg>", re.DOTALL)
_DESCRIPTION = re.compile(r"<desc\b[^>]*>(.*?)</desc>", re.DOTALL)
_NO_XML = re.compile("[\x00-\x08\x0b\x0c\x0e-\x1f\ufffe\uffff]")  # a page of HTML may have them, an SVG file may not
_BLANKS = re.compile(r"[ \t\r\n]+")

PHOTO, DRAWING = ".jpg", ".svg"
"""Endings of the files that pages show as pictures."""


class Document:
    """
    Takes pages apart; numbers pictures through the whole document and leads links to its own places.

    Parameters
    ----------
    folder : Path
        The report.
    labels : collection of str
        Pages that the document shows: other links are none in it.

    Attributes
    ----------
    data : dict
        All that the template shows, as JSON can hold it.
    pictures : dict of str to str
        SVG by the name of its file.
    files : dict of str to Path
        Photos and drawings that are files of the report, by the name of their file in the document.
    """

    def __init__(self, folder: Path, labels: Collection[str]) -> None:
        self.data: dict[str, Any] = {}
        self.pictures: dict[str, str] = {}
        self.files: dict[str, Path] = {}
        self._folder, self._labels = folder, labels

    def page(self, address: str) -> tuple[list[HtmlElement], list[HtmlElement]]:
        """Return the paragraphs of a page's head, without its way to other pages, and what is in its main part."""
        text = _NO_XML.sub("", (self._folder / address).read_text(encoding="utf-8"))
        # By default a text above 10 MB would empty the page, without a word.
        parser = HTMLParser(huge_tree=True, remove_comments=True)
        root = document_fromstring(_SVG.sub('<img data-svg="">', text), parser=parser)
        for node, drawn in zip(root.xpath(".//img[@data-svg]"), _SVG.findall(text), strict=True):
            node.set("data-svg", drawn)
        for node in (*root.xpath(_ONLY_ON_SCREEN), *root.find_class("steps"), *root.find_class("above")):
            node.drop_tree()
        for node in root.xpath(".//a[@href]"):
            place = _within(address, node.get("href").partition("#")[0])
            if place in self._labels:
                node.set("href", place)
            else:
                node.drop_tag()
        for node in root.xpath(".//img"):
            if not self._settle(node, address):
                node.drop_tree()
        for node in root.xpath(".//figure[not(.//img)]"):
            node.drop_tree()
        for table in root.xpath(".//*[@aria-label]/table[not(caption)]"):
            table.insert(0, CAPTION(table.getparent().get("aria-label")))
        return root.xpath("body/header/p"), root.xpath(".//main/*")

    def _settle(self, image: HtmlElement, address: str) -> bool:
        """Give a picture the name of its file in the document; whether it has one."""
        drawn = image.attrib.pop("data-svg", None)
        if drawn is not None:
            name, described = f"figure-{len(self.pictures) + 1}{DRAWING}", _DESCRIPTION.search(drawn)
            self.pictures[name] = drawn
            image.set("src", name)
            image.set("alt", unescape(described[1]) if described else "")
            return True
        place = _within(address, image.get("src", ""))
        path = self._folder / place
        is_outside = place.startswith(("/", "..")) or path.is_symlink()
        if is_outside or not place.endswith((PHOTO, DRAWING)) or not path.is_file():
            return False
        name = place.replace("/", "-")
        self.files[name] = path
        image.set("src", name)
        return True


def _within(address: str, link: str) -> str:
    """Where a page's link leads, as an address within the report."""
    return posixpath.normpath(posixpath.join(posixpath.dirname(address), link)) if link else address


def as_data(node: HtmlElement) -> Element:
    """Return an element with all that is in it; blanks are one, as on a page."""
    inside = [node.text, *(part for child in node for part in (as_data(child), child.tail))]
    said = [_BLANKS.sub(" ", part) if isinstance(part, str) else part for part in inside if part]
    return {"tag": node.tag, **node.attrib, "in": said}


SPANS = "spans"
"""Section of the overview that is a chapter of its own. A section that is not printed says so: `data-paper="no"`."""


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
    tests = {addresses.of_test(name): name for name in campaign.tests} if appendix else {}
    specimens = {addresses.of_specimen(name): f"Specimen {name}" for name in campaign.of_interest}
    overview, methods = addresses.WHOLE["overview"], addresses.WHOLE["methods"]
    optional = {page: title for page, title in addresses.OPTIONAL.items() if (folder / page).is_file()}
    document = Document(folder, {*tests, *specimens, *optional, overview, methods})
    _, summary = document.page(overview)
    spans = [node for node in summary if node.get("id") == SPANS]
    chapters = [_chapter("Summary", overview, [node for node in summary if node not in spans])]
    chapters += [_chapter(title, page, document.page(page)[1]) for page, title in specimens.items()]
    chapters += [_chapter(node.findtext("h2", ""), "", [node]) for node in spans]
    chapters += [_chapter(title, page, document.page(page)[1]) for page, title in optional.items()]
    chapters.append(_chapter("Methods", methods, document.page(methods)[1]))
    of_tests = [
        _chapter(name, page, (part for parts in document.page(page) for part in parts)) for page, name in tests.items()
    ]
    document.data = {
        "title": campaign.title,
        "campaign": campaign.campaign,
        "facts": facts.on_cover(campaign),
        "cover": next((name for name in document.files if name.endswith(PHOTO)), next(iter(document.files), None)),
        "chapters": chapters,
        "appendix": of_tests,
        "version": __version__,
    }
    return document


def _chapter(title: str, address: str, inside: Iterable[HtmlElement]) -> dict[str, Any]:
    nodes = list(inside)
    for heading in (heading for node in nodes for heading in node.findall("h2") if heading.text_content() == title):
        heading.drop_tree()
    return {"title": title, "label": address, "in": list(map(as_data, nodes))}


TEMPLATE = "report.typ"


def pdf_of(campaign: Campaign, folder: Path, *, appendix: bool = True) -> bytes:
    """
    Return the PDF of a campaign's report, whose pages are in `folder` and up to date.

    The same pages give the same bytes: no date, and only the fonts of Typst and matplotlib.

    Raises
    ------
    StoreError
        If Typst refuses it, or there is no room for its files.
    """
    try:
        with prepared(document_of(campaign, folder, appendix=appendix)) as compiler:
            made = compiler.compile(format="pdf", timestamp=0)
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
    return b"".join(made) if isinstance(made, list) else made or b""


@contextmanager
def prepared(document: Document) -> Iterator[typst.Compiler]:
    """Put a document's files, and nothing else, into a folder of their own; the compiler sees no other."""
    fonts = typst.Fonts(
        include_system_fonts=False, font_paths=[str(Path(matplotlib.get_data_path()) / "fonts" / "ttf")]
    )
    with TemporaryDirectory(prefix="colonnade-report-") as made:
        root = Path(made).resolve()
        (root / TEMPLATE).write_bytes((resources("colonnade.report") / "templates" / TEMPLATE).read_bytes())
        (root / "report.json").write_text(json.dumps(document.data, ensure_ascii=False), encoding="utf-8")
        for name, picture in document.pictures.items():
            (root / name).write_text(picture, encoding="utf-8")
        for name, path in document.files.items():
            (root / name).write_bytes(path.read_bytes())
        yield typst.Compiler(root / TEMPLATE, root=root, font_paths=fonts, ignore_system_fonts=True)
