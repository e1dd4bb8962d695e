"""
Figures as SVG text, as PNG, or as a CSV table of what they show: the only module that makes files of them.

The same figure gives the same bytes. SVG text is small, and its ids are its own, so that many figures fit on a page.
"""

from __future__ import annotations

import csv
import re
from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property
from io import BytesIO, StringIO
from itertools import zip_longest
from math import isfinite
from typing import Any
from xml.etree import ElementTree

import numpy as np
from matplotlib.figure import Figure
from numpy.typing import NDArray
from PIL import Image

from colonnade.figures.files.table import Columns, columns_of
from colonnade.figures.style import styled
from colonnade.store.records.summary import harmless

NAMESPACE = "http://www.w3.org/2000/svg"
LINK = "{http://www.w3.org/1999/xlink}href"
FONTS = "'DejaVu Sans', Verdana, 'Segoe UI', Roboto, 'Helvetica Neue', Arial, sans-serif"

_TEST = "test:"
"""Begins the address of a test in a figure."""

MARK = "made by colonnade"
"""In every file of a figure of its own: only such a file is overwritten."""

COLOURS = 64
"""Of a GIF: lines, fills and their edges need no more."""

MOST_PIXELS = 60_000
"""Of a PNG in either direction; its writer can do 65,535."""

_IDENTITY = re.compile(r"[A-Za-z][A-Za-z0-9._-]*")
_REFERENCE = re.compile(r"url\(#([^)]+)\)")
_BEYOND_HUNDREDTHS = re.compile(r"(?<=\.\d\d)\d+")
_FONT = re.compile(r"font(-family)?:([^;]*?)'DejaVu Sans'[^;]*")


@dataclass(frozen=True)
class Picture:
    """
    A figure with its id in a page, its title, and what is seen in it, for those who do not see it.

    `note` is what its caption has to add, as that only a part is drawn.
    """

    figure: Figure
    identity: str
    title: str
    description: str
    note: str = ""

    @cached_property
    def svg(self) -> str:
        """The `<svg>` element, written once: a second layout of the same figure would move it by a hair."""
        return to_svg(self.figure, identity=self.identity, title=self.title, description=self.description)


@dataclass(frozen=True)
class Movie:
    """
    A figure that moves.

    Attributes
    ----------
    figure : Figure
    show : callable
        Brings the figure to a frame, by its number.
    frames : int
    rate : float
        Frames a second.
    title, description : str
    """

    figure: Figure
    show: Callable[[int], None]
    frames: int
    rate: float
    title: str = ""
    description: str = ""


def to_gif(movie: Movie, *, dpi: int = 100) -> bytes:
    """Return a movie as a GIF that repeats; frames are written one by one."""
    pictures = []
    with styled():
        for frame in range(movie.frames):
            movie.show(frame)
            drawn = BytesIO()
            movie.figure.savefig(drawn, format="rgba", dpi=dpi, facecolor="white")
            wide, high = (round(float(side) * dpi) for side in movie.figure.get_size_inches())
            whole = Image.frombytes("RGBA", (wide, high), drawn.getvalue()).convert("RGB")
            pictures.append(whole.quantize(COLOURS, dither=Image.Dither.NONE))
    written = BytesIO()
    first, *others = pictures
    options = {"duration": round(1000 / movie.rate), "loop": 0, "comment": MARK.encode()}
    first.save(written, format="GIF", save_all=True, append_images=others, **options)
    return written.getvalue()


def link_to(test: str) -> str:
    """Return the address by which a mark of a figure leads to a test; pages know where that is."""
    return f"{_TEST}{test}"


def to_png(figure: Figure, *, dpi: int = 150) -> bytes:
    """Return a figure as a PNG file on white, without a date; one that would be too high for the format is coarser."""
    finest = MOST_PIXELS / float(max(figure.get_size_inches()))
    return _written(figure, "png", dpi=min(dpi, finest), metadata={"Software": MARK}, facecolor="white")


def to_pdf(figure: Figure) -> bytes:
    """Return a figure as a PDF file of one page, with the text as text, without a date."""
    return _written(figure, "pdf", metadata={"Creator": MARK, "Producer": MARK, "CreationDate": None})


def _written(figure: Figure, form: str, **options: Any) -> bytes:
    written = BytesIO()
    with styled():
        figure.savefig(written, format=form, **options)
    return written.getvalue()


def to_csv(figure: Figure) -> str:
    """
    Return what a figure shows as CSV text: a row of headings with units, then numbers in nine digits.

    Columns end where they have no more values; what is not known is empty.
    """
    return as_csv(columns_of(figure))


def as_csv(table: Columns) -> str:
    """Return a table as CSV text, as `to_csv`."""
    written = StringIO()
    writer = csv.writer(written, lineterminator="\n")
    writer.writerow(map(harmless, table))
    writer.writerows(zip_longest(*(map(_cell, column) for column in table.values()), fillvalue=""))
    return written.getvalue()


def _cell(value: float | str) -> str:
    if isinstance(value, str):
        return str(harmless(value))
    return f"{value:.9g}" if isfinite(value) else ""


def to_svg(figure: Figure, *, identity: str, title: str, description: str) -> str:
    """
    Return a figure as an `<svg>` element with a text alternative.

    Parameters
    ----------
    figure : Figure
    identity : str
        Unique in the page: the element's id, and the beginning of every id inside it.
    title, description : str
        What the picture shows and what is seen in it, for those who do not see it. Any text; it is escaped.

    Returns
    -------
    svg : str
        No XML declaration, metadata, date, script or outside link. The text stays text.

    Raises
    ------
    ValueError
        If `identity` is not a valid id.
    """
    if not _IDENTITY.fullmatch(identity):
        raise ValueError(f"{identity!r} cannot be an id; a letter, then letters, digits, '.', '_' or '-' were expected")
    nothing = dict.fromkeys(("Date", "Creator", "Format", "Type"))
    root = ElementTree.fromstring(_written(figure, "svg", metadata=nothing))
    # The style sheet that matplotlib writes is meant for a file and would act on the whole page.
    for parent in list(root.iter()):
        for child in [*parent.findall("{*}metadata"), *parent.findall("{*}style")]:
            parent.remove(child)
    _rename(root, identity)
    _shorten(root)
    _describe(root, identity, title, description, role="group" if _name_links(root) else "img")
    ElementTree.register_namespace("", NAMESPACE)
    return ElementTree.tostring(root, encoding="unicode")


def _rename(root: ElementTree.Element, identity: str) -> None:
    """Give ids that are referred to a new, own name, and drop the others."""
    referred: dict[str, str] = {}
    for element in root.iter():
        link = element.attrib.get(LINK, "")
        targets = [link.removeprefix("#")] if link.startswith("#") else []
        for value in element.attrib.values():
            targets += _REFERENCE.findall(value)
        for target in targets:
            referred.setdefault(target, f"{identity}-{len(referred) + 1}")
    for element in root.iter():
        own = element.attrib.pop("id", None)
        if own in referred:
            element.set("id", referred[own])
        if LINK in element.attrib:
            # What is no reference is a picture within the picture: a raster, as of a field of colours.
            link = element.attrib.pop(LINK)
            element.set("href", "#" + referred[link.removeprefix("#")] if link.startswith("#") else link)
        for name, value in element.attrib.items():
            element.set(name, _REFERENCE.sub(lambda found: f"url(#{referred[found[1]]})", value))


def _shorten(root: ElementTree.Element) -> None:
    """Write coordinates to 0.01 pt, drop white space between elements, and name fonts that other machines have."""
    for element in root.iter():
        for name in element.attrib.keys() & {"x", "y", "transform", "points"}:
            element.set(name, _BEYOND_HUNDREDTHS.sub("", element.attrib[name]))
        if "d" in element.attrib:
            element.set("d", shorter(element.attrib["d"]))
        if "style" in element.attrib:
            element.set("style", _FONT.sub(rf"font\1:\2{FONTS}", element.attrib["style"]))
        if element.text is not None and not element.text.strip():
            element.text = None
        element.tail = None


def _name_links(root: ElementTree.Element) -> bool:
    """Give each link the id of its test as name; return whether there is any."""
    links = [element for element in root.iter(f"{{{NAMESPACE}}}a") if element.get("href", "").startswith(_TEST)]
    for element in links:
        name = element.attrib["href"].removeprefix(_TEST)
        element.attrib.pop("target", None)
        element.set("aria-label", name)
        title = ElementTree.Element(f"{{{NAMESPACE}}}title")
        title.text = name
        element.insert(0, title)
    return bool(links)


def _describe(root: ElementTree.Element, identity: str, title: str, description: str, *, role: str) -> None:
    for name in ("width", "height", "version"):
        root.attrib.pop(name, None)
    root.attrib |= {
        "id": identity,
        "role": role,
        "aria-labelledby": f"{identity}-title {identity}-description",
        "stroke-linejoin": "round",
        "stroke-linecap": "butt",
    }
    for position, (tag, name, text) in enumerate((("title", "title", title), ("desc", "description", description))):
        element = ElementTree.Element(f"{{{NAMESPACE}}}{tag}", id=f"{identity}-{name}")
        element.text = text
        root.insert(position, element)


_NUMBERS_ONLY = str.maketrans("MLz", "   ")
_LEADING_ZERO = re.compile(r"(?<!\d)0\.")


def shorter(path: str) -> str:
    """
    Write a path of straight lines by steps, rounded to hundredths; one with curves comes back as it is.

    Points are rounded first, so that no error grows along a line.

    Examples
    --------
    >>> shorter("M 72 50.404 L 72.5 49.1 L 73 60 z")
    'M72 50.4l.5-1.3 .5 10.9z'
    """
    if "C" in path or "Q" in path:
        return _BEYOND_HUNDREDTHS.sub("", path).replace("\n", "")
    points = np.rint(100 * np.fromstring(path.translate(_NUMBERS_ONLY), sep=" ")).astype(np.int64).reshape(-1, 2)
    written: list[str] = []
    for line in path.split("M")[1:]:
        count = 1 + line.count("L")
        own, points = points[:count], points[count:]
        written += ["M", _hundredths(own[0])]
        if count > 1:
            written += ["l", _hundredths(np.diff(own, axis=0).ravel())]
        if "z" in line:
            written.append("z")
    return _LEADING_ZERO.sub(".", "".join(written))


def _hundredths(numbers: NDArray[np.int64]) -> str:
    """Write hundredths; the sign or a space parts each from what is before."""
    return " ".join(f"{number / 100:.6g}" for number in numbers.tolist()).replace(" -", "-")
