"""
What a page of the report says, as data: headings, paragraphs, lists, tables and figures without their markup.

Data is a tree of texts and of tables with the entry ``is``. A template of another kind than HTML shows it; what people
wrote stays text in it.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator
from html import unescape
from itertools import chain
from typing import Any

from lxml.html import HtmlElement, HTMLParser, document_fromstring

Block = dict[str, Any]
"""A part of a page as data: what it `is`, and what belongs to that."""

NOT_ON_PAPER = frozenset(
    ("script", "style", "nav", "form", "button", "input", "select", "label", "details", "template", "canvas", "video")
)
"""Elements that only a screen can use; `data-paper="no"` marks others."""
INLINE = {"strong": "strong", "b": "strong", "em": "emphasis", "i": "emphasis", "code": "code", "sub": "below"}
INLINE |= {"sup": "above"}
TRANSPARENT = frozenset(("a", "span", "abbr", "small", "time", "data", "br", *INLINE))
"""Elements within a line."""
HEADINGS = {"h2": 1, "h3": 2, "h4": 3, "h5": 3}
"""Elements and how deep they are in their page."""

_SVG = re.compile(r"<svg\b.*?</svg>", re.DOTALL)
_DESCRIPTION = re.compile(r"<desc\b[^>]*>(.*?)</desc>", re.DOTALL)
_BLANKS = re.compile(r"[ \t\r\n]+")


class Page:
    """
    One page of the report.

    Parameters
    ----------
    text : str
        As it was rendered; what is not its own markup is escaped in it.

    Attributes
    ----------
    pictures : list of str
        The SVG in it; a figure gives their numbers.
    """

    def __init__(self, text: str) -> None:
        self.pictures: list[str] = []
        # By default a text above 10 MB would empty the page, without a word.
        self._root = document_fromstring(_SVG.sub(self._put_aside, text), parser=HTMLParser(huge_tree=True))

    def _put_aside(self, found: re.Match[str]) -> str:
        self.pictures.append(found[0])
        return f'<img data-picture="{len(self.pictures) - 1}">'

    def below_title(self) -> list[Block]:
        """Paragraphs of the page's head, without its way to other pages."""
        lines = self._root.iterfind("body/header/p")
        return self._blocks(node for node in lines if not _classes(node) & {"above", "steps"})

    def sections(self) -> dict[str, list[Block]]:
        """Blocks of each section by its id; what is before the first section has an empty one."""
        found = dict[str, list[Block]]()
        for node in self._root.iterfind(".//main/*"):
            name = node.get("id", "") if node.tag == "section" else ""
            found.setdefault(name, []).extend(self._blocks([node]))
        return {name: blocks for name, blocks in found.items() if blocks}

    def _blocks(self, nodes: Iterable[HtmlElement | str]) -> list[Block]:
        """Turn elements into blocks; a run of text and of elements within a line is a paragraph."""
        blocks: list[Block] = []
        line: list[HtmlElement | str] = []
        for node in [*nodes, None]:
            if isinstance(node, str) or (node is not None and node.tag in TRANSPARENT):
                line.append(node)
                continue
            if said := _trimmed(self._inline(line)):
                blocks.append({"is": "paragraph", "in": said})
            line = []
            if node is not None:
                blocks += self._block(node)
        return blocks

    def _block(self, node: HtmlElement) -> list[Block]:
        tag, classes = node.tag, _classes(node)
        if _is_left_out(node):
            return []
        if tag in HEADINGS:
            return [{"is": "heading", "depth": HEADINGS[tag], "in": self._line(node)}]
        if tag == "p" and not classes & {"note", "failure"}:
            said = self._line(node)
            return [{"is": "paragraph", "soft": "soft" in classes, "in": said}] if said else []
        if tag in ("ul", "ol"):
            return [{"is": "list", "numbered": tag == "ol", "items": [self._inside(item) for item in node]}]
        if tag == "dl":
            terms, values = map(self._line, node.iterfind("dt")), map(self._inside, node.iterfind("dd"))
            return [{"is": "facts", "items": [list(pair) for pair in zip(terms, values, strict=True)]}]
        if tag == "table":
            return [self._table(node)]
        if tag in ("figure", "img"):
            return self._figure(node)
        inside = self._inside(node)
        kind = next((kind for kind in ("failure", "note") if kind in classes), None)
        return [{"is": "box", "kind": kind, "in": inside}] if kind else inside

    def _table(self, table: HtmlElement) -> Block:
        rows: dict[bool, list[list[Block]]] = {True: [], False: []}
        for row in table.iter("tr"):
            is_head = row.getparent().tag == "thead"
            rows[is_head].append([self._cell(node) for node in row if not _is_left_out(node)])
        columns = max((sum(cell["columns"] for cell in row) for row in (*rows[True], *rows[False])), default=1)
        caption = next(map(self._line, table.iterfind("caption")), [])
        return {"is": "table", "caption": caption, "columns": columns, "head": rows[True], "body": rows[False]}

    def _cell(self, node: HtmlElement) -> Block:
        classes = _classes(node)
        return {
            "is": "cell",
            "in": self._inside(node),
            "columns": int(node.get("colspan", 1)),
            "rows": int(node.get("rowspan", 1)),
            "number": "number" in classes,
            "wide": "wide" in classes,
            "head": node.tag == "th",
        }

    def _figure(self, node: HtmlElement) -> list[Block]:
        images = [node] if node.tag == "img" else _every(node, "img")
        pictures = [found for each in images if (found := self._picture_of(each))]
        caption = next(map(self._line, _every(node, "figcaption")), [])
        return [{"is": "figure", "pictures": pictures, "caption": caption}] if pictures else []

    def _picture_of(self, node: HtmlElement) -> Block | None:
        if "data-picture" in node.attrib:
            number = int(node.attrib["data-picture"])
            described = _DESCRIPTION.search(self.pictures[number])
            return {"is": "picture", "number": number, "alt": unescape(described[1]) if described else ""}
        source = node.get("src", "")
        return (
            None
            if not source or source.startswith("data:")
            else {"is": "picture", "file": source, "alt": node.get("alt", "")}
        )

    def _inside(self, node: HtmlElement) -> list[Block]:
        return self._blocks(_children(node))

    def _line(self, node: HtmlElement) -> list[Any]:
        return _trimmed(self._inline(_children(node)))

    def _inline(self, nodes: Iterable[HtmlElement | str]) -> list[Any]:
        said: list[Any] = []
        for node in nodes:
            if isinstance(node, str):
                said.append(_BLANKS.sub(" ", node))
            elif node.tag == "br":
                said.append({"is": "break"})
            elif not _is_left_out(node):
                inside = self._inline(_children(node))
                if node.tag in INLINE:
                    said.append({"is": INLINE[node.tag], "in": inside})
                elif node.tag == "a":
                    said.append({"is": "link", "to": node.get("href", ""), "in": inside})
                else:
                    said += inside
        return said


def _children(node: HtmlElement) -> Iterator[HtmlElement | str]:
    """Give the texts and elements of an element in their order."""
    parts = chain([node.text], *([child, child.tail] for child in node))
    return (part for part in parts if part is not None and part != "")


def _classes(node: HtmlElement) -> set[str]:
    return set(node.get("class", "").split())


def _is_left_out(node: HtmlElement) -> bool:
    is_marked = node.get("data-paper") == "no" or "hidden" in node.attrib
    return node.tag in NOT_ON_PAPER or is_marked or "steps" in _classes(node)


def _every(node: HtmlElement, tag: str) -> list[HtmlElement]:
    """Find the elements of a kind in another one, at any depth, in their order."""
    found: list[HtmlElement] = []
    for child in node:
        if not _is_left_out(child):
            found += [child] if child.tag == tag else _every(child, tag)
    return found


def _trimmed(said: list[Any]) -> list[Any]:
    """Leave out blanks at both ends of a line; empty if nothing is left."""
    said = [part for part in said if part != ""]
    while said and isinstance(said[0], str) and not (said := [said[0].lstrip(), *said[1:]])[0]:
        said = said[1:]
    while said and isinstance(said[-1], str) and not (said := [*said[:-1], said[-1].rstrip()])[-1]:
        said = said[:-1]
    return said
