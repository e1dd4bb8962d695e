"""
A real browser, and pages that must not complain.

Playwright drives the machine's own chromium. Without one these tests are skipped; with CI=true that is a failure.
"""

import os
import shutil
from contextlib import contextmanager

import pytest

CHROMIUM = next(filter(None, map(shutil.which, ("chromium", "chromium-browser", "google-chrome"))), None)
QUIET = ("--no-sandbox", "--disable-gpu", "--disable-quic", "--no-first-run", "--disable-background-networking")
DESK, TELEPHONE = (1200, 900), (380, 700)
"""Widths and heights of a screen."""

SERIOUS = ("serious", "critical")
"""Impacts, in axe-core's words, that fail a test."""


@contextmanager
def own_chromium():
    """
    Start the machine's own chromium.

    One a module: while Playwright is on, its event loop counts as running, and no later test could start one.
    """
    if CHROMIUM is None:
        if os.environ.get("CI") == "true":
            pytest.fail("no chromium on this machine: `apt-get install chromium`", pytrace=False)
        pytest.skip("no chromium on this machine: `apt-get install chromium`")
    from playwright.sync_api import sync_playwright

    with sync_playwright() as playwright:
        opened = playwright.chromium.launch(executable_path=CHROMIUM, args=list(QUIET))
        yield opened
        opened.close()


@contextmanager
def visiting(browser, home):
    """Give `visit`; close its pages and complain in the end."""
    contexts, complaints = [], []

    def open_page(address, *, folder=home, screen=DESK, scripts=True, dark=False):
        context = browser.new_context(
            viewport={"width": screen[0], "height": screen[1]},
            java_script_enabled=scripts,
            color_scheme="dark" if dark else "light",
            accept_downloads=True,
        )
        contexts.append(context)
        page = context.new_page()
        inside = folder.resolve().as_uri() + "/"

        def check(request):
            if not request.url.startswith((inside, "data:", "blob:")):
                complaints.append(f"{address} asks for {request.url}")

        page.on("request", check)
        page.on("requestfailed", lambda request: complaints.append(f"{address}: {request.url} was not found"))
        page.on("pageerror", lambda error: complaints.append(f"{address}: {error}"))
        page.on(
            "console",
            lambda message: message.type in ("error", "warning") and complaints.append(f"{address}: {message.text}"),
        )
        page.goto((folder / address).resolve().as_uri())
        return page

    yield open_page
    for context in contexts:
        context.close()
    assert complaints == []


def violations(page, options=None):
    """Say what axe-core finds that keeps people from reading a page."""
    from axe_playwright_python.sync_playwright import Axe

    # Lines within a picture say nothing to axe-core, and there are thousands.
    asked = {"resultTypes": ["violations"]} | (options or {})
    found = Axe().run(page, context={"exclude": [["svg[role=img] > g"]]}, options=asked).response["violations"]
    return [f"{one['id']}: {one['nodes'][0]['html'][:200]}" for one in found if one["impact"] in SERIOUS]
