"""The built site in a browser, from its folder: no complaint, no dead link, nothing wider than a telephone."""

from html.parser import HTMLParser
from pathlib import Path
from urllib.parse import unquote, urldefrag

import pytest

from browsing import TELEPHONE, own_chromium, violations, visiting

pytestmark = pytest.mark.whole

SITE = Path(__file__).resolve().parents[2] / "docs" / "build" / "html"
KINDS = (
    "docs/index.html",
    "docs/explanation/restitution.html",
    "docs/reference/generated/library/rock.html",
    "README.html",
    "docs/contributing.html",
    "docs/explanation/rocking.html",
    "docs/faults/scales.html",
    "docs/gallery/index.html",
    "docs/gallery/plot_01_free_rocking.html",
    "docs/how-to/stability-maps.html",
    "docs/tutorial/index.html",
    "reports/manos/index.html",
    "search.html",
)
"""Pages of every kind."""


WIDER = """() => [...document.querySelectorAll('article *')].filter(element => {
  const box = element.closest('.table-wrapper, pre, div.math, .sphx-glr-thumbnails, svg');
  return (!box || box === element) && element.getBoundingClientRect().right > document.documentElement.clientWidth + 1;
}).map(element => element.outerHTML.slice(0, 200))"""


class Links(HTMLParser):
    """Ids of a page, and what it refers to."""

    def __init__(self, text):
        super().__init__()
        self.ids: set[str] = set()
        self.targets: list[str] = []
        self.feed(text)

    def handle_starttag(self, tag, attributes):
        given = dict(attributes)
        self.ids |= {given[name] for name in ("id", "name") if given.get(name)}
        self.targets += [given[name] for name in ("href", "src") if given.get(name)]


@pytest.fixture(scope="module")
def pages():
    found = sorted(SITE.rglob("*.html"))
    assert found, "the site is not built: run `make docs`"
    return found


@pytest.fixture(scope="module")
def browser():
    with own_chromium() as opened:
        yield opened


@pytest.fixture
def visit(browser):
    with visiting(browser, SITE) as open_page:
        yield open_page


def test_every_link_leads_to_a_file_and_a_place_in_it(pages):
    read = {page: Links(page.read_text(encoding="utf-8")) for page in pages}
    dead = []
    for page, links in read.items():
        for target in links.targets:
            if "://" in target or target.startswith(("data:", "mailto:")):
                continue
            path, place = urldefrag(target)
            there = (page.parent / unquote(path.partition("?")[0])).resolve() if path else page
            if not there.is_file() or (place and there in read and unquote(place) not in read[there].ids):
                dead.append(f"{page.relative_to(SITE)} leads to {target}")
    assert dead == []


def test_no_page_complains_or_is_wider_than_a_telephone(pages, visit):
    page = visit("docs/index.html", screen=TELEPHONE)
    wider = {}
    for path in pages:
        if path == SITE / "index.html":  # leads away while the next page is opened
            continue
        page.goto(path.as_uri())
        if page.evaluate("document.documentElement.scrollWidth") > TELEPHONE[0]:
            wider[str(path.relative_to(SITE))] = page.evaluate(WIDER)[:3]
    assert wider == {}


@pytest.mark.parametrize("address", KINDS)
def test_a_page_can_be_read_by_everybody(address, visit):
    # Style sheets stand beside the page: a browser lets no script fetch them from a folder.
    assert violations(visit(address), {"preload": False}) == []


def test_equations_are_drawn_by_the_browser_and_can_be_read_aloud(pages, visit):
    with_equations = [path for path in pages if "<math" in path.read_text(encoding="utf-8")]
    page = visit(with_equations[0].relative_to(SITE).as_posix(), scripts=False)
    boxes = page.eval_on_selector_all(
        "math", "all => all.map(one => [one.getBoundingClientRect().width, one.getAttribute('alttext')])"
    )
    assert boxes
    assert all(width > 4 and text for width, text in boxes)
