"""One browser a module, one small report, and pages that must not complain."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING

import pytest

from browsing import Visit, own_chromium, visiting

if TYPE_CHECKING:
    from playwright.sync_api import Browser


@pytest.fixture(scope="module")
def browser() -> Iterator[Browser]:
    """The machine's own chromium."""
    with own_chromium() as opened:
        yield opened


@pytest.fixture
def visit(browser: Browser, report_folder: Path) -> Iterator[Visit]:
    """
    Open a page of the small report, or of another: `visit("index.html", screen=TELEPHONE, dark=True, scripts=False)`.

    When the test ends, no page may have written an error or a warning to its console, or asked for anything but files
    of its report.
    """
    with visiting(browser, report_folder) as open_page:
        yield open_page


@pytest.fixture(scope="module")
def visit_once(browser: Browser, report_folder: Path) -> Iterator[Visit]:
    """The same for a page that all tests of a module share."""
    with visiting(browser, report_folder) as open_page:
        yield open_page
