"""Every page in a browser: no complaint, no dead link, nothing wider than a telephone outside a box that scrolls."""

from __future__ import annotations

from pathlib import Path

import pytest
from axe_playwright_python.sync_playwright import Axe

DESK, TELEPHONE = (1200, 900), (380, 700)
OUTSIDE = """() => [...document.querySelectorAll('body *')].filter(element =>
  !element.closest('.scroll') && element.getBoundingClientRect().right > document.documentElement.clientWidth + 1
).map(element => element.outerHTML.slice(0, 200))"""
ADDRESSES = "() => [...document.querySelectorAll('a[href]')].map(a => new URL(a.getAttribute('href'), a.baseURI).href)"
SERIOUS = ("serious", "critical")
KINDS = (
    *("index.html", "quality.html", "problems.html", "methods.html", "specimens/prism.html"),
    *("tests/span-2.5.html", "tests/free-01.html", "tests/free-refused.html"),
)
"""A page of each kind."""
CONTRAST = {"runOnly": ["color-contrast"], "resultTypes": ["violations"]}
IDS = "() => [...document.querySelectorAll('[id]')].map(element => element.id)"


def pages_of(folder: Path) -> list[str]:
    return sorted(path.relative_to(folder).as_posix() for path in folder.rglob("*.html"))


@pytest.mark.parametrize("screen", [TELEPHONE, DESK], ids=["on a telephone", "on a desk"])
def test_only_boxes_that_scroll_are_wider_than_the_screen(report_folder, visit, screen):
    page = visit("index.html", screen=screen)
    for address in pages_of(report_folder):
        page.goto((report_folder / address).as_uri())
        assert page.evaluate("document.documentElement.scrollWidth") <= screen[0], address
        assert page.evaluate(OUTSIDE) == [], address


def test_every_link_leads_to_a_page_and_a_place_in_it(report_folder, visit):
    page, ids, links = visit("index.html"), {}, {}
    for address in pages_of(report_folder):
        url = (report_folder / address).as_uri()
        page.goto(url)
        ids[url], links[url] = page.evaluate(IDS), page.evaluate(ADDRESSES)
    for url, found in ids.items():
        assert len(found) == len(set(found)), url
    for url, targets in links.items():
        for target in targets:
            there, _, place = target.partition("#")
            assert there in ids, f"{url} leads to {target}"
            assert not place or place in ids[there], f"{url} leads to {target}"


def test_nobody_is_left_out(report_folder, visit):
    page = visit("index.html")
    for address in KINDS:
        page.goto((report_folder / address).as_uri())
        assert violations(page) == [], address


def test_dark_pages_are_readable(report_folder, visit):
    page = visit("index.html", dark=True)
    for address in KINDS:
        page.goto((report_folder / address).as_uri())
        assert violations(page, CONTRAST) == [], address


def violations(page, options=None) -> list[str]:
    found = Axe().run(page, options=options or {"resultTypes": ["violations"]}).response["violations"]
    return [f"{one['id']}: {one['nodes'][0]['html'][:200]}" for one in found if one["impact"] in SERIOUS]


def test_what_people_wrote_is_shown_as_text(visit):
    page = visit("tests/span-2.5.html")
    assert "<script>alert('title')</script>" in page.locator("header").inner_text()
    assert page.locator("img[src=x]").count() == 0
