"""One browser a module, one small report, and pages that must not complain."""

import pytest

from browsing import own_chromium, visiting


@pytest.fixture(scope="module")
def browser():
    """The machine's own chromium."""
    with own_chromium() as opened:
        yield opened


@pytest.fixture
def visit(browser, report_folder):
    """
    Open a page of the small report, or of another: `visit("index.html", screen=TELEPHONE, dark=True, scripts=False)`.

    When the test ends, no page may have written an error or a warning to its console, or asked for anything but files
    of its report.
    """
    with visiting(browser, report_folder) as open_page:
        yield open_page


@pytest.fixture(scope="module")
def visit_once(browser, report_folder):
    """The same for a page that all tests of a module share."""
    with visiting(browser, report_folder) as open_page:
        yield open_page
