"""
What a page of the report says, as data: its elements without what only a screen can use.

An element is its `tag`, its attributes, and what is `in` it: texts and elements. A template of another kind than HTML
shows them; what people wrote stays text in it.
"""

from __future__ import annotations

import posixpath
import re
from collections.abc import Collection
from html import unescape
from pathlib import Path
from typing import Any

from lxml.html import HtmlElement, HTMLParser, document_fromstring

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


class Gatherer:
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
    pictures : dict of str to str
        SVG by the name of its file.
    files : dict of str to Path
        Photos and drawings that are files of the report, by the name of their file in the document.
    """

    def __init__(self, folder: Path, labels: Collection[str]) -> None:
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
