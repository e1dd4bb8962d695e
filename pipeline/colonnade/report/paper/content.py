"""
What a page of the report says, as data: headings, paragraphs, lists, tables and figures without their markup.

Data is a tree of texts and of tables with the entry ``is``. A template of another kind than HTML shows it; what people
wrote stays text in it.
"""

from __future__ import annotations

import re
from html import unescape
from html.parser import HTMLParser
from typing import Any

Node = dict[str, Any]
"""An element: `tag`, `attributes`, and `children`, each an element or text."""
Block = dict[str, Any]
"""A part of a page as data: what it `is`, and what belongs to that."""

VOID = frozenset(("br", "hr", "img", "input", "link", "meta", "source", "wbr", "col"))
NOT_ON_PAPER = frozenset(
    ("script", "style", "nav", "form", "button", "input", "select", "label", "details", "template", "canvas", "video")
)
"""Elements that only a screen can use; `data-paper="no"` marks others."""
INLINE = {"strong": "strong", "b": "strong", "em": "emphasis", "i": "emphasis", "code": "code", "sub": "below"}
INLINE |= {"sup": "above"}
TRANSPARENT = frozenset(("a", "span", "abbr", "small", "time", "data", "img", "br", *INLINE))
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
        parser = _Tree()
        parser.feed(_SVG.sub(self._put_aside, text))
        parser.close()
        self._root = parser.root

    def _put_aside(self, found: re.Match[str]) -> str:
        self.pictures.append(found[0])
        return f'<img data-picture="{len(self.pictures) - 1}">'

    def below_title(self) -> list[Block]:
        """Paragraphs of the page's head, without its way to other pages."""
        head = _first(self._root, "header")
        lines = [] if head is None else [node for node in head["children"] if _tag(node) == "p"]
        return self._blocks([node for node in lines if not _classes(node) & {"above", "steps"}])

    def sections(self) -> dict[str, list[Block]]:
        """Blocks of each section by its id; what is before the first section has an empty one."""
        main, found = _first(self._root, "main"), dict[str, list[Block]]()
        for node in [] if main is None else main["children"]:
            name = node["attributes"].get("id", "") if _tag(node) == "section" else ""
            found.setdefault(name, []).extend(self._blocks([node]))
        return {name: blocks for name, blocks in found.items() if blocks}

    def _blocks(self, nodes: list[Node | str]) -> list[Block]:
        """Turn elements into blocks; a run of text and of elements within a line is a paragraph."""
        blocks: list[Block] = []
        line: list[Node | str] = []
        for node in [*nodes, None]:
            if node is not None and (isinstance(node, str) or node["tag"] in TRANSPARENT) and not _picture(node):
                line.append(node)
                continue
            if said := _trimmed(self._inline(line)):
                blocks.append({"is": "paragraph", "in": said})
            line = []
            if node is not None and not isinstance(node, str):
                blocks += self._block(node)
        return blocks

    def _block(self, node: Node) -> list[Block]:
        tag, classes, children = node["tag"], _classes(node), node["children"]
        if _is_left_out(node):
            return []
        if tag in HEADINGS:
            return [{"is": "heading", "depth": HEADINGS[tag], "in": _trimmed(self._inline(children))}]
        if tag == "p" and not classes & {"note", "failure"}:
            said = _trimmed(self._inline(children))
            return [{"is": "paragraph", "soft": "soft" in classes, "in": said}] if said else []
        if tag in ("ul", "ol"):
            items = [self._blocks(item["children"]) for item in _all(children, "li")]
            return [{"is": "list", "numbered": tag == "ol", "items": items}]
        if tag == "dl":
            terms = [_trimmed(self._inline(item["children"])) for item in _all(children, "dt")]
            said = [self._blocks(item["children"]) for item in _all(children, "dd")]
            return [{"is": "facts", "items": [list(pair) for pair in zip(terms, said, strict=True)]}]
        if tag == "table":
            return [self._table(node)]
        if tag == "figure" or _picture(node):
            return self._figure(node)
        inside = self._blocks(children)
        kind = next((kind for kind in ("failure", "note") if kind in classes), None)
        return [{"is": "box", "kind": kind, "in": inside}] if kind else inside

    def _table(self, table: Node) -> Block:
        rows: dict[bool, list[list[Block]]] = {True: [], False: []}
        for part in [node for node in table["children"] if _tag(node) in ("thead", "tbody", "tfoot", "tr")]:
            for row in [part] if part["tag"] == "tr" else _all(part["children"], "tr"):
                shown = [node for node in row["children"] if not isinstance(node, str) and not _is_left_out(node)]
                rows[part["tag"] == "thead"].append([self._cell(node) for node in shown if node["tag"] in ("th", "td")])
        columns = max((sum(cell["columns"] for cell in row) for row in (*rows[True], *rows[False])), default=1)
        captions = [_trimmed(self._inline(each["children"])) for each in _all(table["children"], "caption")]
        caption = captions[0] if captions else []
        return {"is": "table", "caption": caption, "columns": columns, "head": rows[True], "body": rows[False]}

    def _cell(self, node: Node) -> Block:
        attributes, classes = node["attributes"], _classes(node)
        return {
            "is": "cell",
            "in": self._blocks(node["children"]),
            "columns": int(attributes.get("colspan", 1)),
            "rows": int(attributes.get("rowspan", 1)),
            "number": "number" in classes,
            "wide": "wide" in classes,
            "head": node["tag"] == "th",
        }

    def _figure(self, node: Node) -> list[Block]:
        images = [node] if _picture(node) else _every(node, "img")
        pictures = [found for each in images if (found := self._picture_of(each))]
        caption = [_trimmed(self._inline(each["children"])) for each in _every(node, "figcaption")]
        if not pictures:
            return []
        return [{"is": "figure", "pictures": pictures, "caption": caption[0] if caption else []}]

    def _picture_of(self, node: Node) -> Block | None:
        attributes = node["attributes"]
        if "data-picture" in attributes:
            number = int(attributes["data-picture"])
            described = _DESCRIPTION.search(self.pictures[number])
            return {"is": "picture", "number": number, "alt": unescape(described[1]) if described else ""}
        source = attributes.get("src", "")
        return (
            None
            if not source or source.startswith("data:")
            else {"is": "picture", "file": source, "alt": attributes.get("alt", "")}
        )

    def _inline(self, nodes: list[Node | str]) -> list[Any]:
        said: list[Any] = []
        for node in nodes:
            if isinstance(node, str):
                said.append(_BLANKS.sub(" ", node))
            elif node["tag"] == "br":
                said.append({"is": "break"})
            elif not _is_left_out(node):
                inside = self._inline(node["children"])
                if node["tag"] in INLINE:
                    said.append({"is": INLINE[node["tag"]], "in": inside})
                elif node["tag"] == "a":
                    said.append({"is": "link", "to": node["attributes"].get("href", ""), "in": inside})
                else:
                    said += inside
        return said


class _Tree(HTMLParser):
    """Builds the tree of a page."""

    def __init__(self) -> None:
        super().__init__(convert_charrefs=True)
        self.root: Node = {"tag": "", "attributes": {}, "children": []}
        self._open = [self.root]

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        node = {"tag": tag, "attributes": {name: value or "" for name, value in attrs}, "children": []}
        self._open[-1]["children"].append(node)
        if tag not in VOID:
            self._open.append(node)

    def handle_endtag(self, tag: str) -> None:
        if any(node["tag"] == tag for node in self._open[1:]):
            while self._open.pop()["tag"] != tag:
                pass

    def handle_data(self, data: str) -> None:
        self._open[-1]["children"].append(data)


def _tag(node: Node | str) -> str:
    return "" if isinstance(node, str) else node["tag"]


def _classes(node: Node | str) -> set[str]:
    return set() if isinstance(node, str) else set(node["attributes"].get("class", "").split())


def _picture(node: Node | str) -> bool:
    return _tag(node) == "img"


def _is_left_out(node: Node) -> bool:
    attributes = node["attributes"]
    is_marked = attributes.get("data-paper") == "no" or "hidden" in attributes
    return node["tag"] in NOT_ON_PAPER or is_marked or "steps" in _classes(node)


def _all(nodes: list[Node | str], tag: str) -> list[Node]:
    return [node for node in nodes if not isinstance(node, str) and node["tag"] == tag]


def _every(node: Node, tag: str) -> list[Node]:
    """Find the elements of a kind in another one, at any depth, in their order."""
    found: list[Node] = []
    for child in node["children"]:
        if isinstance(child, str) or _is_left_out(child):
            continue
        found += [child] if child["tag"] == tag else _every(child, tag)
    return found


def _first(node: Node, tag: str) -> Node | None:
    return next(iter(_every(node, tag)), None)


def _trimmed(said: list[Any]) -> list[Any]:
    """Leave out blanks at both ends of a line; empty if nothing is left."""
    said = [part for part in said if part != ""]
    while said and isinstance(said[0], str) and not (said := [said[0].lstrip(), *said[1:]])[0]:
        said = said[1:]
    while said and isinstance(said[-1], str) and not (said := [*said[:-1], said[-1].rstrip()])[-1]:
        said = said[:-1]
    return said
