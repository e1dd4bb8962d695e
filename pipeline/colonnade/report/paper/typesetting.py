"""A document as PDF, or a page of it as PNG: typeset by Typst in a folder that holds nothing else."""

from __future__ import annotations

import json
import re
from collections.abc import Iterator
from contextlib import contextmanager
from importlib.resources import files as resources
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import TYPE_CHECKING, Literal

from colonnade.campaign import Campaign
from colonnade.errors import StoreError
from colonnade.report.paper.document import Document, document_of

if TYPE_CHECKING:
    import typst

TEMPLATE = "report.typ"

NO_XML = re.compile("[\x00-\x08\x0b\x0c\x0e-\x1f\ufffe\uffff]")
"""Characters that a page of HTML may have and an SVG file may not."""

PIXELS_PER_INCH = 80
"""Of a page as PNG."""


def pdf_of(campaign: Campaign, folder: Path, *, appendix: bool = True) -> bytes:
    """Return the PDF of a campaign's report, whose pages are in `folder` and up to date."""
    return typeset(document_of(campaign, folder, appendix=appendix))[0]


def _template() -> bytes:
    return (resources("colonnade.report") / "templates" / TEMPLATE).read_bytes()


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
        (root / TEMPLATE).write_bytes(_template())
        (root / "report.json").write_text(json.dumps(document.data, ensure_ascii=False), encoding="utf-8")
        for name, picture in document.pictures.items():
            (root / name).write_text(NO_XML.sub("", picture), encoding="utf-8")
        for name, path in document.files.items():
            (root / name).write_bytes(path.read_bytes())
        yield typst.Compiler(root / TEMPLATE, root=root, font_paths=fonts, ignore_system_fonts=True)
