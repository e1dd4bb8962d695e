"""A report as its readers meet it: pages as text, tags that nest, links, words."""

import re
from collections import Counter
from html.parser import HTMLParser
from posixpath import dirname, join, normpath

from colonnade.store.layout import Layout
from colonnade.workflow.graph import Graph
from colonnade.workflow.pages import Report
from colonnade.workflow.product import Catalogue
from colonnade.workflow.summary import write_summary

VOID = {"meta", "img", "br", "hr", "input", "link", "col", "wbr"}


class Page(HTMLParser):
    """Tags, ids, references and text of a page; refuses tags that do not nest."""

    def __init__(self, text):
        super().__init__()
        self.tags = Counter()
        self.ids = []
        self.links = []
        self.scripts = []
        self.attributes = Counter()
        self.words = ""
        self._open = []
        self.feed(text)
        self.close()
        assert not self._open, f"not closed: {self._open}"

    def handle_starttag(self, tag, attrs):
        self.tags[tag] += 1
        self.words += " " if tag in ("td", "th", "li", "dd", "dt", "br") else ""
        if tag not in VOID:
            self._open.append(tag)
        self.scripts += [value for name, value in attrs if tag == "script" and name == "src"]
        self.attributes.update(name for name, _ in attrs)
        self.ids += [value for name, value in attrs if name == "id"]
        self.links += [value for name, value in attrs if name in ("href", "src")]

    def handle_endtag(self, tag):
        assert tag in VOID or self._open.pop() == tag

    def handle_data(self, data):
        if self._open and self._open[-1] not in ("style", "script"):
            self.words += data


def built(campaign, layout, outdated=frozenset(), **options):
    """Write the summary and the report, as a run does."""
    graph = Graph(campaign, layout, Catalogue(layout))
    options = {"forecasts": write_summary(graph, outdated=outdated).forecasts} | options
    page = Report(graph, outdated, **options).bring_up_to_date()
    graph.catalogue.save()
    return page


def written(layout):
    """Text of every page by its address in the report's folder."""
    folder = layout.report.parent
    paths = sorted(folder.rglob("*.html"))
    return {path.relative_to(folder).as_posix(): path.read_text(encoding="utf-8") for path in paths}


def words_of(text):
    return " ".join(Page(text).words.split())


def dead_links(folder):
    """Links of a report's pages that lead nowhere or out of it, and ids that a page has twice."""
    texts = written(Layout(folder.parent))
    files = {path.relative_to(folder).as_posix() for path in folder.rglob("*")}
    pages = {address: Page(text) for address, text in texts.items()}
    dead = []
    for address, page in pages.items():
        dead += [f"{address} has #{name} twice" for name, times in Counter(page.ids).items() if times > 1]
        within = set(re.findall(r"url\(#([^)]+)\)", texts[address]))
        dead += [f"{address} has no #{name}" for name in within - set(page.ids)]
        for link in {each for each in page.links if not each.startswith("data:")}:
            path, _, anchor = link.partition("#")
            path = path.partition("?")[0]  # which tests the table of all tests shows
            target = normpath(join(dirname(address), path)) if path else address
            is_there = target in files and (not anchor or anchor in pages[target].ids)
            if re.match(r"/|[a-z]+:", link) or not is_there:  # a report may be copied elsewhere
                dead.append(f"{address} leads to {link}")
    return dead
