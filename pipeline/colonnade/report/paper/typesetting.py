"""The document that is typeset: which sections of which pages it shows; as PDF, or a page of it as PNG, by Typst."""

from __future__ import annotations

import json
from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from importlib.resources import files as resources
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import TYPE_CHECKING, Any, Literal

from lxml.html import HtmlElement

from colonnade import __version__
from colonnade.campaign import Campaign
from colonnade.errors import StoreError
from colonnade.report import addresses
from colonnade.report.paper.content import PHOTO, Gatherer, as_data
from colonnade.report.test_page import facts

if TYPE_CHECKING:
    import typst

SPANS = "spans"
"""Section of the overview that is a chapter of its own. A section that is not printed says so: `data-paper="no"`."""


@dataclass(frozen=True)
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
    pictures: dict[str, str]
    files: dict[str, Path]


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
    gather = Gatherer(folder, {*tests, *specimens, *optional, overview, methods})
    _, summary = gather.page(overview)
    spans = [node for node in summary if node.get("id") == SPANS]
    chapters = [_chapter("Summary", overview, [node for node in summary if node not in spans])]
    chapters += [_chapter(title, page, gather.page(page)[1]) for page, title in specimens.items()]
    chapters += [_chapter(node.findtext("h2", ""), "", [node]) for node in spans]
    chapters += [_chapter(title, page, gather.page(page)[1]) for page, title in optional.items()]
    chapters.append(_chapter("Methods", methods, gather.page(methods)[1]) | {"equations": True})
    of_tests = [
        _chapter(name, page, (part for parts in gather.page(page) for part in parts)) for page, name in tests.items()
    ]
    shown = [image for part in (*chapters, *of_tests) for image in part.pop("images") if image["src"] in gather.files]
    data = {
        "title": campaign.title,
        "campaign": campaign.campaign,
        "facts": facts.on_cover(campaign),
        "cover": next((each for each in shown if each["src"].endswith(PHOTO)), next(iter(shown), None)),
        "chapters": chapters,
        "appendix": of_tests,
        "version": __version__,
    }
    return Document(data, gather.pictures, gather.files)


def _chapter(title: str, address: str, inside: Iterable[HtmlElement]) -> dict[str, Any]:
    nodes = list(inside)
    for heading in (heading for node in nodes for heading in node.findall("h2") if heading.text_content() == title):
        heading.drop_tree()
    images = [as_data(image) for node in nodes for image in node.iter("img")]
    return {"title": title, "label": address, "in": list(map(as_data, nodes)), "equations": False, "images": images}


TEMPLATE = "report.typ"

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
            (root / name).write_text(picture, encoding="utf-8")
        for name, path in document.files.items():
            (root / name).write_bytes(path.read_bytes())
        yield typst.Compiler(root / TEMPLATE, root=root, font_paths=fonts, ignore_system_fonts=True)
